"""What each model does to one clutch: python3 reports/models.py BINARY writes reports/models.md.

The clutch is that of the README, `new --for two-speed --bore 40 --torque 1000`; each row is one question, answered without the model
and with it, both by the program. What a table of the design file says beyond that clutch stands above its rows."""

import json
import pathlib
import subprocess
import sys
import tempfile

binary = pathlib.Path(sys.argv[1]).resolve()
here = pathlib.Path(__file__).resolve().parent
work = pathlib.Path(tempfile.mkdtemp())
version = subprocess.run([binary, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]


def run(*args):
    found = subprocess.run([str(binary), *map(str, args), "--quiet"], capture_output=True, text=True, cwd=work)
    if found.returncode not in (0, 1):
        sys.exit(f"{' '.join(map(str, args))}: {found.stderr}")
    return found.stdout


def ask(*args):
    return json.loads(run(*args, "--json"))


def design(name, *tables):
    (work / name).write_text((work / "plain.toml").read_text() + "".join(tables))
    return name


def margin(answer, code):
    return next(m for m in answer["margins"] if m["code"] == code)


def number(x, unit="", digits=4):
    if x is None:
        return "–"
    text = f"{x:.{digits}g}" if abs(x) < 10**digits else f"{x:.0f}"
    return f"{text} {unit}".strip()


def percent(x, digits=3):
    return number(100 * x, "%", digits)


run("new", "--for", "two-speed", "--bore", 40, "--torque", 1000, "-o", "plain.toml")

OIL = """
[lubrication]
oil = "ISO VG 32"
temperature_c = 60.0
race_roughness_um = 0.25
sprag_roughness_um = 0.25
boundary_friction = 0.11
sprag_wear_mm3_per_nm = 1e-9
race_wear_mm3_per_nm = 1e-9
slip = { torque_nm = 500.0, speed_m_s = 0.5, path_mm = 1.0 }
"""
HOT = """
[thermal]
inner_race_c = 90.0
sprags_c = 80.0
outer_race_c = 60.0
"""
UNLIKE = """
[sharing]
seed = 1
size_within_um = 3.0
friction_within = 0.005
"""
OFF = """
[races.eccentricity]
offset_mm = 0.01
"""
LIFE = """
[life]
loads = [ { torque_nm = 1000.0, engagements = 1e5 } ]
pitting = { pressure_mpa = 4200.0, cycles = 1e6 }
friction_scatter = 0.1
torque_scatter = 0.05
overruns = [ { scenario = "overrun", hours = 2000.0 } ]
"""

parts = []


def part(title, given, rows, unknown):
    lines = [f"## {title}", ""]
    if given:
        lines += ["```toml", given.strip(), "```", ""]
    lines += ["| question | without | with | by |", "|---|---|---|---|"]
    lines += [f"| {q} | {before} | {after} | `{command}` |" for q, before, after, command in rows]
    lines += ["", "Unknown still: " + unknown, ""]
    parts.append("\n".join(lines))


plain = ask("check", "plain.toml")
stiff = {law: ask("stiffness", "plain.toml", "--contact", law, "--torques", "1000")["points"][0] for law in ("roller", "elastic")}
roller = ask("check", "plain.toml", "--set", 'contact.law="roller"', "--set", "contact.roller_coefficient=3.944e-5")
rows = [
    ("windup at 1000 Nm", number(stiff["roller"]["windup_deg"], "°"), number(stiff["elastic"]["windup_deg"], "°"), "stiffness"),
    ("N of one sprag at A", number(stiff["roller"]["normal_inner_n"], "N", 5), number(stiff["elastic"]["normal_inner_n"], "N", 5), "stiffness"),
    ("tan ω", number(stiff["roller"]["tan_omega"]), number(stiff["elastic"]["tan_omega"]), "stiffness"),
    ("end of the profile, margin", percent(margin(roller, "end-of-profile")["margin"]), percent(margin(plain, "end-of-profile")["margin"]), "check"),
]
part(
    "Contact: the paper's roller law, or elasticity of the whole bodies",
    "",
    rows,
    "axial bending of races longer or shorter than the sprags; law `elastic` is within 0.4 % of finite elements in windup on ten clutches (calculix-ten-decks.md).",
)

film_file = design("film.toml", OIL)
film = ask("overrun", film_file)
speed = next(line for line in film["lines"] if round(line["speed_rpm"]) == 1000)
part(
    "Overrun on a film of oil",
    OIL,
    [
        ("friction of the sliding contact at 1000 rpm", number(speed["friction_dry"]), number(speed["friction"]), "overrun"),
        ("drag at 1000 rpm", number(speed["drag_torque_dry_nm"], "Nm", 3), number(speed["drag_torque_nm"], "Nm", 3), "overrun"),
        ("film over roughness λ at 1000 rpm", "–", number(speed["lambda"], "", 3), "overrun"),
        ("growth of a small swing at 1000 rpm", number(speed["growth_dry_per_s"], "1/s", 3), number(speed["growth_rate_per_s"], "1/s", 3), "overrun"),
        ("temperature of the contact at 1000 rpm", "–", number(speed["contact_c"], "°C", 3), "overrun"),
        ("flash of the slip above the bodies", "–", number(film["slip"]["flash_k"], "K", 3), "overrun"),
    ],
    "oil that runs short (starvation), the film while the load swings; temperatures are good to a factor of two of their rise where conductances are estimated.",
)

hot = ask("check", design("hot.toml", HOT))
gaps = hot["running"]
part(
    "Temperatures in service",
    HOT,
    [
        ("race gap at rest", number(gaps["gap_as_made_mm"], "mm", 6), number(gaps["gap_as_run_mm"], "mm", 6), "check"),
        ("hertz-peak-inner, margin", percent(margin(plain, "hertz-peak-inner")["margin"]), percent(margin(hot, "hertz-peak-inner")["margin"]), "check"),
        ("end of the profile, margin", percent(margin(plain, "end-of-profile")["margin"]), percent(margin(hot, "end-of-profile")["margin"]), "check"),
        ("lift-off of the outer race", number(plain["lift_off_rpm"], "rpm", 5), number(hot["lift_off_rpm"], "rpm", 5), "check"),
    ],
    "stresses by gradients of temperature within a body.",
)

shared = ask("sharing", design("unlike.toml", UNLIKE, OFF))
worst = max(shared["turn"], key=lambda t: t["hertz_mpa"])
pressure = margin(plain, "hertz-nominal-inner")["demand"]
part(
    "Sprags one by one, axes 10 µm apart",
    UNLIKE + OFF,
    [
        ("largest share of the mean force at 1000 Nm", "1", number(worst["largest_share"]), "sharing"),
        ("largest Hertz pressure", number(pressure, "MPa"), number(worst["hertz_mpa"], "MPa"), "sharing"),
        ("largest share at a hundredth of that", "1", number(shared["engagement"][1]["largest_share"]), "sharing"),
        ("sprags that may fail", "–", number(shared["may_be_lost"]), "sharing"),
        ("force on the bearings", "0", number(worst["radial_force_n"], "N"), "sharing"),
    ],
    "tilted tracks; a housing that keeps a thin race round.",
)

bending = ask("sharing", design("bending.toml", UNLIKE), "--scenario", "swing")
part(
    "Races that bend between sprags one by one, in the scene `swing`",
    UNLIKE,
    [
        ("largest share at rest under the scene's largest torque", number(bending["share_at_rest_round"]), number(bending["share_at_rest"]), "sharing"),
        ("largest share in the scene", "–", number(bending["largest_share"]), "sharing"),
        ("lowest mode of a ring", "–", number(min(bending["lowest_mode_inner_hz"], bending["lowest_mode_outer_hz"]), "Hz"), "sharing"),
        ("of the bending left out with the rings' inertia", "–", percent(bending["bending_left_out"]), "sharing"),
    ],
    "blows shorter than a swing of a ring.",
)

life = ask("life", design("life.toml", OIL, LIFE))
used = {p["code"]: p for p in life["places"]}
wear = life["wear"]["states"]
last = wear[-1]
part(
    "A life: 1e5 engagements at 1000 Nm, 2000 h of overrun",
    LIFE,
    [
        ("pitting of the sprags, lives", "–", number(used["pitting-sprag-inside"]["lives"], "", 3), "life"),
        ("slips expected by chance", "0", number(life["expected_slips"], "", 3), "life"),
        (f"tan ω at first contact, after {number(last['hours'], 'h')}", number(wear[0]["first_tan_omega"]), number(last["first_tan_omega"]), "life"),
        ("the flat worn into a sprag there", "0", number(last["flat_um"], "µm", 3), "life"),
        ("lowest torque capacity there", number(wear[0]["capacity_nm"], "Nm"), number(last["capacity_nm"], "Nm"), "life"),
    ],
    "the coefficients of wear, to a power of ten; the point of the pitting curve is the maker's or that of own tests.",
)

curve = ask("stiffness", "plain.toml")["end"]
over = curve["beyond"]
blow = ask("reengage", "plain.toml", "--paths", "0.01")
swing = ask("resonance", "plain.toml")["states"][0]
scene = margin(plain, "slip:swing")
part(
    "Beyond the end, blows, vibration",
    "",
    [
        ("torque where the profile ends", number(curve["torque_nm"], "Nm"), number(over["peak"]["torque_nm"], "Nm") + ", the most beyond it", "stiffness"),
        ("blow after 0.01 mm of slip at 1000 Nm", "–", number(blow["blows"][0]["peak_torque_nm"], "Nm"), "reengage"),
        ("friction that the swing needs", number(scene["demand"]) + ", first two periods", number(swing["required_static_friction"]) + ", once its start is forgotten", "resonance"),
    ],
    "damping in the drive, which decides blows and resonance more than the clutch does.",
)

text = f"""<!-- sprag-design {version}; python3 reports/models.py BINARY -->
# What each model does to the README's clutch

The clutch of the README (two-speed, bore 40 mm, 1000 Nm), asked with one model more at a time: oil and temperatures hardly touch its strength
and change its overrun; unlike sprags cost it some {100 * (worst["largest_share"] - 1):.0f} % of force on one sprag; wear and chance decide its life.

"""
path = here / "models.md"
temporary = path.with_suffix(".md.tmp")
temporary.write_text(text + "\n".join(parts))
temporary.rename(path)
