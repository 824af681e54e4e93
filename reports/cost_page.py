#!/usr/bin/env python3
"""reports/cost.html from reports/cost.csv; part of reports/cost.sh.

usage: cost_page.py cost.csv cost.html
"""
import csv
import html
import math
import os
import sys

TABLE, OUT = sys.argv[1:]
LAWS = {"roller": "law roller", "elastic": "law elastic"}
PROBLEMS = {"a-huang-at-rest": "a: the paper's clutch at rest", "b-huang-at-speed": "b: the same at speed",
            "c-24-sprags": "c: 24 sprags", "d-indexing-elastic": "d: law elastic", "e-starter-eight": "e: eight variables"}
OURS = "sprag-design optimize"
# By how much a margin of a search may be off, as the CHANGELOG has it.
STATED = {"roller": 1e-6, "elastic": 2e-6}
# That of the pages of all commands; texts of the plots have its colours.
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "report", "page.css")) as style:
    STYLE = style.read() + """svg text { font: 12px system-ui, sans-serif; fill: var(--ink); }
svg .soft { fill: var(--soft); }
svg .axis { stroke: var(--soft); fill: none; }
svg .grid { stroke: var(--rule); fill: none; }
table.wide th.n { white-space: normal; max-width: 8.5rem; }
table.wide td:first-child { white-space: nowrap; }
tr.ours { background: var(--tint); font-weight: 600; }
@media print { p { break-inside: avoid; } h2 + p { break-after: avoid; } }
"""
# Where a contact just closes in a swing, or rolling would have to pull.
STATED_PULLED = 5e-6
STATED_WORDS = (f"stated are {STATED['roller']:.0e}, with law elastic {STATED['elastic']:.0e}, and {STATED_PULLED:.0e} where a contact just closes "
                "in a swing or rolling would have to pull").replace("e-0", "e-")
e = html.escape


class Figures:
    def __init__(self, path):
        with open(path, newline="") as f:
            self.first = f.readline().removeprefix("#").strip()
            self.rows = list(csv.DictReader(f))
        self.by = {(r["part"], r["design"], r["who"], r["setting"], r["quantity"]): r["value"] for r in self.rows}

    def text(self, part, design, who, setting, quantity):
        return self.by.get((part, design, who, setting, quantity))

    def __call__(self, *key):
        found = self.text(*key)
        return None if found in (None, "") else float(found)

    def settings(self, part, design, who):
        """In the order of the table, each once."""
        found = [r["setting"] for r in self.rows if (r["part"], r["design"], r["who"]) == (part, design, who)]
        return list(dict.fromkeys(found))

    def who(self, part, design):
        return list(dict.fromkeys(r["who"] for r in self.rows if (r["part"], r["design"]) == (part, design)))

    def series(self, part, design, who, across, up):
        pairs = [(self(part, design, who, s, across), self(part, design, who, s, up)) for s in self.settings(part, design, who)]
        return [(x, y) for x, y in pairs if x is not None and y is not None]


F = Figures(TABLE)
# Width of a plot that shares its line with another, px.
HALF = 500
BEFORE = F.text("head", "", "before", "", "name")
WHO = (["before"] if BEFORE else []) + ["now"]


def number(x, digits=3):
    """Plain where that is short, else with a power of ten; "–" where there is none."""
    if x is None:
        return "–"
    if x == 0:
        return "0"
    if 1e-3 <= abs(x) < 1e6:
        places = max(0, digits - 1 - math.floor(math.log10(abs(x))))
        return f"{x:.{places}f}"
    mantissa, power = f"{x:.1e}".split("e")
    return f"{mantissa}e{int(power)}"


def millions(x):
    return number(x / 1e6)


def table(head, rows, caption="", ours=()):
    """First column words, the others numbers; rows of `ours` are marked."""
    out = ["<div class=table>"]
    if caption:
        out.append(f"<p class=caption>{e(caption)}</p>")
    out.append("<table class=wide><thead><tr>" + "".join(
        f"<th{' class=n' * (k > 0)}>{e(h)}</th>" for k, h in enumerate(head)) + "</tr></thead><tbody>")
    for row in rows:
        out.append(f"<tr{' class=ours' * (row[0] in ours)}>" + "".join(
            f"<td{' class=n' * (k > 0)}>{e(str(c))}</td>" for k, c in enumerate(row)) + "</tr>")
    return "".join(out) + "</tbody></table></div>"


def figure(draw, caption, width=760):
    """Drawn twice: for a window and for a phone, as the plots of the program are."""
    return (f'<figure>{draw(width, "window")}{draw(360, "phone")}<figcaption>{e(caption)}</figcaption></figure>')


def legend(names, width):
    """Entries of a legend in lines that fit, and their height."""
    out, x, y = [], 8, 14
    for colour, name in names:
        wide = 28 + 6.6 * len(name)
        if x > 8 and x + wide > width:
            x, y = 8, y + 18
        out.append(f'<rect x="{x}" y="{y - 9}" width="10" height="10" fill="var(--c{colour})"/>'
                   f'<text x="{x + 15}" y="{y}">{e(name)}</text>')
        x += wide
    return "".join(out), y + 10


def bars(parts, rows):
    """Stacked bars: `rows` are (name, [values]); values in millions."""
    def draw(width, name):
        key, top = legend(list(enumerate(parts)), width)
        left, high, most = 108, 26, max(sum(v) for _, v in rows)
        per = (width - left - 66) / most
        out = []
        for k, (label, values) in enumerate(rows):
            y, x = top + 4 + k * (high + 8), left
            out.append(f'<text x="{left - 6}" y="{y + 17}" text-anchor="end">{e(label)}</text>')
            for colour, v in enumerate(values):
                out.append(f'<rect x="{x:.1f}" y="{y}" width="{max(v * per, 0):.1f}" height="{high}" fill="var(--c{colour})"/>')
                x += max(v * per, 0)
            out.append(f'<text x="{x + 5:.1f}" y="{y + 17}">{sum(values):.1f} M</text>')
        height = top + 4 + len(rows) * (high + 8)
        return f'<svg class="{name}" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">{key}{"".join(out)}</svg>'
    return draw


def decades(values):
    low, high = math.floor(math.log10(min(values)) + 1e-9), math.ceil(math.log10(max(values)) - 1e-9)
    return (low, high) if high > low else (low, low + 1)


SUPER = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def log_plot(series, across, up, line=None, bare=()):
    """Log against log: `series` are (name, colour, points); points alone where there are one or two, the line alone of those in `bare`.
    `line`: a level and its name."""
    series = [(n, c, [(x, y) for x, y in p if x > 0 and y > 0]) for n, c, p in series]
    series = [s for s in series if s[2]]
    xs = [x for _, _, p in series for x, _ in p]
    ys = [y for _, _, p in series for _, y in p] + ([line[0]] if line else [])
    (x0, x1), (y0, y1) = decades(xs), decades(ys)

    def draw(width, name):
        key, top = legend([(c, n) for n, c, _ in series], width)
        top += 18
        left, right, bottom = 50, 14, 250 + top
        def at_x(x): return left + (math.log10(x) - x0) / (x1 - x0) * (width - left - right)
        def at_y(y): return bottom - (math.log10(y) - y0) / (y1 - y0) * 250
        out = [f'<text class="soft" x="{left}" y="{top - 7}">{e(up)}</text>']
        for p in range(y0, y1 + 1):
            if (y1 - p) % max(1, math.ceil((y1 - y0) / 8)) == 0:
                y = at_y(10.0 ** p)
                out.append(f'<line class="grid" x1="{left}" x2="{width - right}" y1="{y:.1f}" y2="{y:.1f}"/>'
                           f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">10{str(p).translate(SUPER)}</text>')
        short = x1 - x0 <= 2
        for p in range(x0, x1 + 1):
            for m in ((1, 2, 5) if short and width > 400 else (1,)):
                x = at_x(m * 10.0 ** p)
                if x > width - right + 1:
                    continue
                said = f"{m * 10 ** p:g}" if -3 <= p <= 4 else f"{'' if m == 1 else f'{m}·'}10{str(p).translate(SUPER)}"
                out.append(f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{bottom}"/>'
                           f'<text x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{said}</text>')
        out.append(f'<rect class="axis" x="{left}" y="{top}" width="{width - left - right}" height="250"/>')
        if line:
            y = at_y(line[0])
            out.append(f'<line x1="{left}" x2="{width - right}" y1="{y:.1f}" y2="{y:.1f}" stroke="var(--soft)" stroke-dasharray="5 4"/>'
                       f'<text class="soft" x="{width - right - 4}" y="{y - 5:.1f}" text-anchor="end">{e(line[1])}</text>')
        for name_of, colour, points in series:
            way = " ".join(f"{at_x(x):.1f},{at_y(y):.1f}" for x, y in points)
            if len(points) > 2:
                out.append(f'<polyline points="{way}" fill="none" stroke="var(--c{colour})" stroke-width="1.6"/>')
            for x, y in points if name_of not in bare else ():
                out.append(f'<circle cx="{at_x(x):.1f}" cy="{at_y(y):.1f}" r="3.4" fill="var(--c{colour})"/>')
        out.append(f'<text class="soft" x="{width - right}" y="{bottom + 34}" text-anchor="end">{e(across)}</text>')
        height = bottom + 42
        return f'<svg class="{name}" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">{key}{"".join(out)}</svg>'
    return draw


def phase_names():
    return [r["quantity"] for r in F.rows if (r["part"], r["design"], r["who"]) == ("phases", "roller", "now")
            and r["quantity"] not in ("whole", "closures", "closure")]


# Shorter, and which is which of the issue's own words.
NAMES = {"the file: values put in, read": "file", "curves": "curves", "rows of the load state": "margins at rest",
         "scenes made ready, without curves": "scenes made ready", "pure-rolling runs": "scenes run", "runs where no friction suffices": "scenes run again", "all else": "rest"}


def phases():
    names = phase_names()
    drawn = figure(bars([NAMES.get(n, n) for n in names],
                        [(f"{law}, {who}", [F("phases", law, who, "", n) / 1e6 for n in names]) for law in LAWS for who in WHO]),
                   "Instructions of one evaluation, millions, by phase; counted by callgrind, means of four points.")
    head = ["phase"] + [f"{law}, {who}, M instructions" for law in LAWS for who in WHO] + [f"{law}, share now" for law in LAWS]
    if BEFORE:
        head += [f"{law}, before / now" for law in LAWS]
    rows = []
    for n in [*names, "whole"]:
        at = {(law, who): F("phases", law, who, "", n) for law in LAWS for who in WHO}
        row = [NAMES.get(n, n)] + [f"{at[law, who] / 1e6:.2f}" for law in LAWS for who in WHO]
        row += [f"{100 * at[law, 'now'] / F('phases', law, 'now', '', 'whole'):.1f} %" for law in LAWS]
        if BEFORE:
            row += [f"{at[law, 'before'] / at[law, 'now']:.1f}" if at[law, "now"] > 0.0 else "–" for law in LAWS]
        rows.append(row)
    said = [f"{LAWS[law]}: {millions(F('phases', law, 'now', '', 'whole'))} M instructions"
            + (f" where {millions(F('phases', law, 'before', '', 'whole'))} M were needed, {gain(law):.1f} times fewer" if BEFORE else "")
            for law in LAWS]
    return drawn, said, table(head, rows, ours=("whole",))


def earlier():
    if not BEFORE:
        return "No earlier program was given to stand beside this one."
    roller, elastic = (number(F("speed", law, "before", "", "largest difference of a margin"), 2) for law in LAWS)
    return (f"The program before is one commit, neither the first nor the slowest. At the 100 points its margins are those of now to {roller} "
            f"with law roller. Law elastic is another model since then (margins differ by up to {elastic}): there work is compared, not the same answer.")


def gain(law):
    return F("phases", law, "before", "", "whole") / F("phases", law, "now", "", "whole")


def speed():
    head = ["law, threads"] + [f"{who}, evaluations a second" for who in WHO] + [f"{who}, processor time of one, ms" for who in WHO]
    if BEFORE:
        head += ["times as fast, wall", "times as fast, processor"]
    rows = []
    for law in LAWS:
        for setting in F.settings("speed", law, "now"):
            row = [f"{law}, {setting}"] + [f"{F('speed', law, who, setting, 'evaluations a second'):.0f}" for who in WHO]
            row += [number(F("speed", law, who, setting, "processor time of one")) for who in WHO]
            if BEFORE:
                row += [number(F("speed", law, "now", setting, f"times as fast, {t} time, median of pairs"), 2) for t in ("wall", "processor")]
            rows.append(row)
    return table(head, rows)


def floor():
    rows, shares = [], {}
    for law in LAWS:
        whole, runs = F("phases", law, "now", "", "whole"), F("phases", law, "now", "", "pure-rolling runs")
        closures, each = F("phases", law, "now", "", "closures"), F("phases", law, "now", "", "closure")
        sides = F("floor", law, "now", "all", "right-hand sides")
        rows.append([f"{law}: closures", f"{closures:.0f}", f"{each:.0f}", millions(closures * each), f"{100 * closures * each / whole:.0f} %"])
        rows.append([f"{law}: right-hand sides", f"{sides:.0f}", f"{runs / sides:.0f}", millions(runs), f"{100 * runs / whole:.0f} %"])
        shares[law] = (closures * each + runs) / whole
        rows.append([f"{law}: floor", "", "", millions(closures * each + runs), f"{100 * shares[law]:.0f} %"])
    return shares, table(["work", "number", "instructions each", "M instructions", "share of the evaluation"], rows,
                         ours=[f"{law}: floor" for law in LAWS])


def curve():
    out, said = [], []
    for law, title in LAWS.items():
        series = [(name, colour, F.series("curve", law, how, "instructions", "error of the normal force"))
                  for how, name, colour in (("linear", "table of closures, straight lines", 5),
                                            ("cubic", "table of closures, cubics with slopes", 1),
                                            ("search", "curve of a search", 2), ("full", "curve of check", 0))]
        out.append(figure(log_plot(series, "instructions", "largest error of N", (1e-7, "stated: 1e-7")),
                          f"{title}: largest relative error of the normal force from 1 % of the largest load on, against exact equilibria.", HALF))
        s, f = (F("curve", law, how, "", "error of the normal force") for how in ("search", "full"))
        said.append(f"{law} {number(s)} for {millions(F('curve', law, 'search', '', 'instructions'))} M instructions "
                    f"({F('curve', law, 'search', '', 'closures'):.0f} closures), in full {number(f)} for "
                    f"{millions(F('curve', law, 'full', '', 'instructions'))} M ({F('curve', law, 'full', '', 'closures'):.0f})")
    rows = []
    for law in LAWS:
        for how, name in (("search", "curve of a search"), ("full", "curve of check"), ("cubic", "cubics"), ("linear", "straight lines")):
            for s in F.settings("curve", law, how):
                rows.append([f"{law}: {name}", f"{F('curve', law, how, s, 'closures'):.0f}",
                             millions(F("curve", law, how, s, "instructions")), number(1e3 * F("curve", law, how, s, "time")),
                             number(F("curve", law, how, s, "error of the normal force")), number(F("curve", law, how, s, "error of the windup"))])
    head = ["curve", "closures", "M instructions", "time, ms, least of 15", "error of N", "error of windup, against check's"]
    return "; ".join(said), f"<div class=row>{''.join(out)}</div>" + folded("The figures", table(head, rows, ours=[
        f"{law}: curve of {w}" for law in LAWS for w in ("a search", "check")]))


def folded(name, inside):
    return f"<details class=apart><summary>{e(name)}</summary>{inside}</details>"


def envelope(points):
    """The least error found with so much work or less."""
    out = []
    for x, y in sorted(points):
        if not out or y < out[-1][1]:
            out.append((x, y))
    return out


def per_decade(name):
    """Times as many right-hand sides for ten times less error, from the loosest tolerance to the tightest."""
    points = F.series("scene", "roller", name, "right-hand sides", "error of the angle")
    (n0, e0), (n1, e1) = points[0], points[-1]
    return (n1 / n0) ** (1 / math.log10(e0 / e1))


def scene():
    series = []
    for colour, name in enumerate(("high-10", "rated-45")):
        series.append((f"{name}, angle", colour, F.series("scene", "roller", name, "right-hand sides", "error of the angle")))
    series.append(("rated-45, required friction", 2, F.series("scene", "roller", "rated-45", "right-hand sides", "error of the required friction")))
    drawn = figure(log_plot(series, "right-hand sides", "error"), "simulate from --tolerance 1e-3 to 1e-10, each held against 1e-12: error of the inner "
                   "race's angle at the end, rad, and of the required friction, over right-hand sides.", HALF)
    rows = []
    for name in ("high-10", "rated-45"):
        for t in F.settings("scene", "roller", name):
            at = lambda q: F("scene", "roller", name, t, q)  # noqa: E731
            rows.append([f"{name}, {t}", f"{at('right-hand sides'):.0f}", f"{1e3 * at('processor time'):.0f}", number(at("error of the angle"), 2),
                         number(at("stated error of the angle"), 2), number(at("error of the required friction"), 2)])
    peers = []
    methods = F.who("integrators", "roller")
    keep = ["ours, one run", "differential-equations dop853, restarted", "differential-equations dop853", "diffsol BDF", "diffsol tsit45", "published RK4"]
    for m in methods:
        if any(m.startswith(k) for k in keep) and len(peers) < 6:
            peers.append((m, len(peers), envelope(F.series("integrators", "roller", m, "right-hand sides", "error of the angle"))))
    beside = figure(log_plot(peers, "right-hand sides of one run", "error of the angle, rad"),
                    "One run of high-10 by our integrator and by those of others, as reports/accuracy-peers.csv has them (another run, counts alone): the least error with so many right-hand sides or fewer, by the method's tolerance.", HALF)
    worst = max(F("scene", "roller", n, t, "error of the angle") / F("scene", "roller", n, t, "stated error of the angle")
                for n in ("high-10", "rated-45") for t in F.settings("scene", "roller", n))
    head = ["scene, tolerance", "right-hand sides", "processor time of the command, ms", "error of the angle, rad", "stated, rad", "error of the required friction"]
    return worst, f"<div class=row>{drawn}{beside}</div>" + table(head, rows)


def evaluation():
    rows, worst = [], 0.0
    for law in LAWS:
        setting = next(s for s in F.settings("evaluation", law, "quick") if s.endswith("points"))
        at = next(s for s in F.settings("evaluation", law, "quick") if s.startswith(("limit.", "objective.")))
        off = F("evaluation", law, "quick", setting, "largest difference of a margin")
        worst = max(worst, off)
        rows.append([law, setting, f"{F('evaluation', law, 'quick', setting, 'margins compared'):.0f}", number(off, 2), at.split(".", 1)[1],
                     f"{number(STATED[law])}, {number(STATED_PULLED)}",
                     number(F("evaluation", law, "quick", "", "processor time of one"), 2), number(F("evaluation", law, "full", "", "processor time of one"), 2),
                     number(F("evaluation", law, "quick", "", "times as fast as full, median of pairs"), 2)])
    head = ["law", "with a clutch", "margins", "largest difference", "of", "stated", "quick, ms", "--full, ms", "times as fast"]
    return worst, table(head, rows)


def optimum():
    out, counts = [], []
    for problem, title in PROBLEMS.items():
        best = max(F("optimum", problem, w, "", "slip margin") or -math.inf for w in F.who("optimum", problem))
        course = [(float(s), max((best - F("course", problem, OURS, s, "slip margin, best so far")) / abs(best), 1e-9))
                  for s in F.settings("course", problem, OURS)]
        # Steps, not slopes: a design is the best until a better one is found.
        steps = [p for k, (n, v) in enumerate(course) for p in ([(n, course[k - 1][1])] if k else []) + [(n, v)]]
        near, ended = [], []
        for w in F.who("optimum", problem):
            if w != OURS:
                n, v = F.text("optimum", problem, w, "", "until within 0.1 % of the best"), F("optimum", problem, w, "", "below the best, relative")
                near += [(float(n), 1e-3)] if n not in (None, "", "never") else []
                ended += [(F("optimum", problem, w, "", "evaluations"), max(v, 1e-9))] if v is not None else []
        smart = log_plot_points([(OURS, 0, steps, True), ("others, within 0.1 %", 1, near, False), ("others, at their end", 5, ended, False)],
                                "evaluations", "below the best", (1e-3, "0.1 %"))
        out.append(figure(smart, f"{title}: how far the best design so far lies below the best that any method found, relative; 1e-9 stands for less.", HALF))
        ours = F("optimum", problem, OURS, "", "until within 0.1 % of the best")
        counts.append((title, ours, F("optimum", problem, OURS, "", "evaluations"), F("optimum", problem, OURS, "", "below the best, relative")))
    rows = []
    for w in F.who("optimum", "a-huang-at-rest"):
        row = [w]
        for p in PROBLEMS:
            row += [F.text("optimum", p, w, "", "evaluations") or "–", F.text("optimum", p, w, "", "until within 0.1 % of the best") or "–",
                    number(F("optimum", p, w, "", "below the best, relative"), 2)]
        rows.append(row)
    head = ["method"] + [f"{p[0]}: {q}" for p in PROBLEMS for q in ("evaluations", "within 0.1 % after", "below the best")]
    climbs = []
    for p in PROBLEMS:
        for t in F.settings("climb", p, OURS):
            at = lambda q: F("climb", p, OURS, t, q)  # noqa: E731
            climbs.append([f"{p[0]}, {t}", f"{at('evaluations'):.0f}", number(at("processor time"), 2), number(at("off the sharpest, relative"), 2),
                           number(at("any margin moves, looked at in full"), 2)])
    climbed = table(["problem, --tolerance", "evaluations", "processor time, s", "optimum off that of 1e-9, relative", "any margin moves, looked at in full"], climbs)
    moved = max(float(r["value"]) for r in F.rows if r["part"] == "climb" and r["quantity"] == "off the sharpest, relative")
    return counts, moved, f"<div class=row>{''.join(out)}</div>" + table(head, rows, ours=(OURS,)), climbed


def local():
    """How soon local methods of others come near, beside ours."""
    theirs, ours = [], []
    for p in PROBLEMS:
        for w in F.who("optimum", p):
            n = F.text("optimum", p, w, "", "until within 0.1 % of the best")
            if n not in (None, "", "never"):
                (ours if w == OURS else theirs if "starts" in w else []).append(int(float(n)))
    return (f"COBYLA and SLSQP from five starts come within 0.1 % after {min(theirs)} to {max(theirs)} evaluations, "
            f"ours after {min(ours)} to {max(ours)}.")


def log_plot_points(series, across, up, line):
    """As `log_plot`; a series whose last word is False is points alone."""
    lines = log_plot([s[:3] for s in series], across, up, line, [s[0] for s in series if s[3]])
    loose = {s[1] for s in series if not s[3]}

    def draw(width, name):
        svg = lines(width, name)
        for colour in loose:
            start = svg.find("<polyline")
            while start >= 0:
                end = svg.find("/>", start) + 2
                if f"--c{colour})" in svg[start:end]:
                    svg = svg[:start] + svg[end:]
                    start = svg.find("<polyline", start)
                else:
                    start = svg.find("<polyline", end)
        return svg
    return draw


def scaling():
    jobs = list(dict.fromkeys(r["design"] for r in F.rows if r["part"] == "scaling" and r["quantity"] == "time"))
    same = all(F.text("scaling", job, "now", "2 threads", "the same bytes as on one") == "yes" for job in jobs)
    at = lambda setting: F("scaling", "sweep", "now", setting, "largest memory")  # noqa: E731
    said = (f"Every answer is {'the same' if same else 'NOT the same'} to the last byte on one thread and on two, run times apart, and a sweep of ten times the "
            f"points takes {number(at('3000 points, 1 thread') / at('300 points, 1 thread'), 3)} times the memory "
            f"({number(at('3000 points, 1 thread'), 3)} MB; {number(at('3000 points, 2 threads'), 3)} MB on two threads).")
    rows = []
    for job in jobs:
        one, two = (F("scaling", job, "now", t, "time") for t in ("1 thread", "2 threads"))
        rows.append([job, number(one), number(two), number(F("scaling", job, "now", "2 threads", "times as fast as one, median of pairs"), 3)])
    more = "Medians of three runs of each in turn. Two threads gain what other work leaves free of the second processor."
    return said, more, table(["", "one thread, s", "two threads, s", "times as fast"], rows)


def main():
    first = F.first
    version, command = F.text("head", "", "now", "", "version"), first.split("; ")[-1]
    busy = [F("head", "", "", "", f"processes that wanted to run, {w}") for w in ("least", "most")]
    cores = F("head", "", "", "", "processors")
    drawn, said, phase_table = phases()
    shares, floor_table = floor()
    curves, curve_part = curve()
    worst_scene, scene_part = scene()
    worst, evaluation_part = evaluation()
    counts, moved, optimum_part, climbs = optimum()
    scaled, times, scaling_part = scaling()
    speeds = [F("speed", "roller", "now", t, "evaluations a second") for t in ("1 thread", "2 threads")]
    each = F("speed", "roller", "now", "1 thread", "processor time of one")
    verdict = (f"An evaluation of the README's problem takes {millions(F('phases', 'roller', 'now', '', 'whole'))} M instructions"
               + (f", {gain('roller'):.1f} times fewer than before ({gain('elastic'):.1f} times with law elastic)" if BEFORE else "")
               + f", {number(each)} ms of a processor: {1e3 / each:.0f} a second on each that is free. At the points compared no margin is off by more than {number(worst, 2)}; {STATED_WORDS}.")
    loaded = f"The machine has {cores:.0f} processors; {busy[0]:.1f} to {busy[1]:.1f} processes wanted to run at a time, these among them. "
    loaded += ("" if busy[1] <= cores + 0.5 else "It did other work: wall times and evaluations a second are lower than on a quiet machine; counts of "
               "instructions are not touched by that, processor times little.")
    optima = "; ".join(f"{title}: {near:.0f} of {all_:.0f} evaluations, in the end {number(off, 2)} below the best"
                       for title, near, all_, off in counts)
    hashes = [F.text("head", law, "now", "", "design_hash")[:12] for law in LAWS]
    before = f"<dt>Before</dt><dd>{e(BEFORE)}</dd>" if BEFORE else ""
    page = f"""<!-- {e(first)} -->
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="sprag-design {version}">
<title>What an evaluation costs</title>
<style>
{STYLE}</style>
</head>
<body>
<main>
<header>
<p class="kind">Cost of an evaluation, and the error it buys</p>
<h1>What an evaluation costs</h1>
<dl><dt>Designs</dt><dd>huang2017-multi-arc (law roller) {hashes[0]}, huang2017-elastic (law elastic) {hashes[1]}</dd>
<dt>Command</dt><dd><code>{e(command)}</code></dd><dt>Made by</dt><dd>sprag-design {version}, commit {F.text("head", "", "now", "", "commit")}</dd>{before}</dl>
</header>
<p class="verdict said">{e(verdict)}</p>
{drawn}
<h2>Where the instructions go</h2>
<p>{e(". ".join(s[0].upper() + s[1:] for s in said))}. An evaluation is every margin of one design: four scenes and the clutch at rest.</p>
{phase_table}
<h2>Evaluations a second</h2>
<p>{e(f"Now {speeds[0]:.0f} evaluations a second of law roller on one thread and {speeds[1]:.0f} on two; an evaluation takes {number(each)} ms of a processor.")}</p>
{speed()}
<p>{e("Before and now in turn, five pairs; each evaluates the same 100 points of the box at which there is a clutch, the start of the program taken off. " if BEFORE else "Five times the same 100 points of the box at which there is a clutch, the start of the program taken off. ")}{e(loaded)}</p>
<h2>The floor</h2>
<p>{e(f"Static equilibria and right-hand sides, with the steps they belong to, are {100 * shares['roller']:.0f} % of an evaluation with law roller and {100 * shares['elastic']:.0f} % with elastic: what is left to save without fewer of them is the rest.")}</p>
{floor_table}
<p>A closure is one static equilibrium of a sprag. The instructions of a right-hand side are those of the rolling runs over their right-hand sides: the sums of
a step, the looks for peaks and the table of the curve on the way are in it. {e(f"Scene high-6 takes {F('floor', 'roller', 'now', 'high-6', 'right-hand sides'):.0f} of them with law roller and {F('floor', 'elastic', 'now', 'high-6', 'right-hand sides'):.0f} with elastic, the other three some 6000 each.")}</p>
<h2>Error against cost: the static curve</h2>
<p>{e(f"Error of the curve: {curves}. As many closures in a plain table are worse by decades.")}</p>
{curve_part}
<h2>Error against cost: a scene</h2>
<p>{e(f"Ten times less error takes {number(per_decade('high-10'))} times the right-hand sides where the clutch slips (high-10) and {number(per_decade('rated-45'))} where it rolls (rated-45); the error found is at most {number(worst_scene, 2)} of the error stated.")}</p>
{scene_part}
<h2>Error against cost: an evaluation</h2>
<p>{e(f"Quick against full evaluations differ by {number(worst, 2)} of a margin at most (relative where a margin is above 1); {STATED_WORDS}.")}</p>
{evaluation_part}
<h2>Error against cost: the optimum</h2>
<p>{e(f"Evaluations until within 0.1 % of the best that any method found: {optima}.")}</p>
{optimum_part}
<p>{e(f"With 1e-3 to 1e-8 allowed in an evaluation a climb takes as many evaluations and its optimum moves by {number(moved, 2)} of itself at most.")}</p>
{folded("One climb by the error allowed in an evaluation", climbs)}
<p>The others' counts are those of <a href="optimiser-peers.html">optimiser-peers</a>, on the same evaluator; –: not known or never. That page counts our derivatives at their cost
and has a sixth problem, under tolerances; here evaluations alone are counted. {e(local())} Our search goes on with new starts
until no other optimum is to be expected.</p>
<h2>Threads and memory</h2>
<p>{e(scaled)}</p>
{scaling_part}
<p>{e(times)} </p>
<h2>Omissions</h2>
<ul><li>Two clutches with four scenes each; the cost of others goes with the periods of their scenes and with their arcs.</li>
<li>Instructions are not time: a memory access costs more than a sum.</li>
<li>{e(earlier())}</li></ul>
</main>
</body>
</html>
"""
    with open(OUT + ".new", "w") as f:
        f.write(page)
    os.replace(OUT + ".new", OUT)


main()
