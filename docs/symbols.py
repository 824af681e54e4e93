"""The figure of symbols, angles far larger than a clutch's: python3 docs/symbols.py > docs/src/symbols.svg"""
from math import atan2, cos, degrees, hypot, pi, radians, sin

R_I, R_E, R_ARC_E = 95.0, 150.0, 34.0
BETA = radians(11)
RADII, TURNS = [26.0, 34.0, 44.0], [-radians(t) for t in (-40, 12, 28, 42)]
SCALE, X0, Y0 = 7.0, 380.0, 1150.0
parts = []


def px(p):
    return f"{X0 + SCALE * p[0]:.1f} {Y0 - SCALE * p[1]:.1f}"


def polar(r, azimuth, centre=(0.0, 0.0)):
    return (centre[0] + r * sin(azimuth), centre[1] + r * cos(azimuth))


def arc(centre, r, a, b, style, close=""):
    n = 60
    points = [polar(r, a + (b - a) * i / n, centre) for i in range(n + 1)]
    parts.append(f'<path d="M{" L".join(px(p) for p in points)}{close}" {style}/>')


def line(p, q, style='class="l"'):
    parts.append(f'<path d="M{px(p)} L{px(q)}" {style}/>')


def text(p, words, dx=0, dy=0, anchor="middle", kind=""):
    x, y = (float(v) for v in px(p).split())
    parts.append(f'<text x="{x + dx:.0f}" y="{y + dy:.0f}" text-anchor="{anchor}"{kind}>{words}</text>')


def dot(p):
    x, y = px(p).split()
    parts.append(f'<circle cx="{x}" cy="{y}" r="4"/>')


def sub(a, b):
    return f'{a}<tspan dy="5" font-size="13">{b}</tspan>'


C_E, B = (0.0, R_E - R_ARC_E), (0.0, R_E)
A = polar(R_I, BETA)
C_1 = polar(R_I + RADII[0], BETA)
wide = radians(21)
for r, sign in ((R_E, 1), (R_I, -1)):
    ring = [polar(r, -wide + 2 * wide * i / 80) for i in range(81)] + [polar(r + sign * 10, wide - 2 * wide * i / 80) for i in range(81)]
    parts.append(f'<path d="M{" L".join(px(p) for p in ring)}Z" class="race"/>')
# The profile: arcs tangent to one another; the contact's normal turns into the body from one to the next.
down = BETA + pi
profile, centre, joints, centres = [], C_1, [], []
for k, r in enumerate(RADII):
    a, b = down + TURNS[k], down + TURNS[k + 1]
    profile += [polar(r, a + (b - a) * i / 20, centre) for i in range(21)]
    centres.append(centre)
    joints.append(profile[-1])
    if k + 1 < len(RADII):
        centre = polar(r - RADII[k + 1], b, centre)
outer = [polar(R_ARC_E, radians(-36) + radians(72) * i / 40, C_E) for i in range(41)]
parts.append(f'<path d="M{" L".join(px(p) for p in outer + profile[::-1])}Z" class="body"/>')
# Centre lines.
O_ = (0.0, 78.0)
line(O_, B)
line(polar(78.0, BETA), C_1)
line(A, B, 'class="strut"')
for p, name, dx, dy, anchor in ((A, "A", -2, 22, "middle"), (B, "B", 10, -8, "start"), (C_E, sub("C", "e"), -10, 4, "end"), (C_1, sub("C", "i1"), 4, -10, "start")):
    dot(p)
    text(p, name, dx, dy, anchor)
line(C_E, C_1, 'class="size"')
text(((C_E[0] + C_1[0]) / 2, (C_E[1] + C_1[1]) / 2), sub("e", "1"), -24, 2)
G = (-5.0, 122.5)
dot(G)
text(G, "G", -10, 5, "end")
line(O_, (G[0] * 1.0, G[1]), 'class="thin"')
for k, r in enumerate(RADII):
    middle = down + (TURNS[k] + TURNS[k + 1]) / 2 if k else down + radians(22)
    end = polar(r, middle, centres[k])
    start = polar(r * (0.45, 0.5, 0.62)[k], middle, centres[k])
    line(start, end, 'class="size" marker-end="url(#a)"')
    text(start, sub("r", f"i{k + 1}"), 0, -6)
for k, j in enumerate(joints[:-1]):
    dot(j)
    text(j, f"junction {k + 1}", 10, 14, "start", ' class="s"')
end = polar(R_ARC_E, radians(24), C_E)
line(polar(R_ARC_E * 0.45, radians(24), C_E), end, 'class="size" marker-end="url(#a)"')
text(polar(R_ARC_E * 0.72, radians(24), C_E), sub("r", "e"), 14, 8)
# Angles.
strut = atan2(B[0] - A[0], B[1] - A[1])
arc(A, 20, strut, BETA, 'class="angle"')
text(polar(23.5, (strut + BETA) / 2, A), "ω", 0, 0)
arc(B, 17, pi, pi + strut, 'class="angle"')
text(polar(20, pi + strut / 2, B), "ν", 2, 6)
arc((0, 0), 84, 0, BETA, 'class="angle"')
text(polar(81.5, BETA / 2), "β", 0, 0)
gamma = atan2(G[0], G[1])
arc((0, 0), 87, gamma, 0, 'class="angle"')
text(polar(89.5, gamma / 2), "γ", -4, 0)
# Forces on the sprag at A.
line(A, polar(14, BETA, A), 'class="force" marker-end="url(#f)"')
text(polar(14, BETA, A), sub("N", "bi"), 12, 6, "start", ' class="f"')
line(A, polar(8, BETA - pi / 2, A), 'class="force" marker-end="url(#f)"')
text(polar(8, BETA - pi / 2, A), sub("T", "bi"), -8, 4, "end", ' class="f"')
# Races, torque, radii.
for r, name, at in ((R_E, sub("R", "e"), -15), (R_I, sub("R", "i"), -19)):
    p = polar(r, radians(at))
    line(polar(r - 12, radians(at)), p, 'class="size" marker-end="url(#a)"')
    text(polar(r - 13, radians(at)), name, 0, 14)
arc((0, 0), R_E + 5, radians(-17), radians(-7), 'class="turn" marker-end="url(#t)"')
text(polar(R_E + 4.4, radians(-5.5)), "outer race", 0, 6, "start", ' class="s"')
arc((0, 0), R_I - 5, radians(22), radians(15), 'class="turn" marker-end="url(#t)"')
text(polar(R_I - 5, radians(23)), "inner race", -60, 34, "start", ' class="s"')
text((-52.0, 72.0), "Curved arrows: how the races turn against each other as torque engages the clutch (windup).", 0, 0, "start", ' class="s"')
style = """text{font:18px sans-serif;fill:#1a1d21}.s{font-size:14px;fill:#4a5560}.f{fill:#1d4f91}.race{fill:#e4e8ee;stroke:#5b6672}
.body{fill:#cfdbe8;fill-opacity:.85;stroke:#20364f;stroke-width:2}.l{stroke:#4a5560;stroke-dasharray:14 4 3 4;fill:none}.thin{stroke:#4a5560;stroke-dasharray:3 4;fill:none}
.strut{stroke:#b02a1e;stroke-width:1.6}.size{stroke:#4a5560;fill:none}.angle{stroke:#b02a1e;fill:none;stroke-width:1.4}.force{stroke:#1d4f91;stroke-width:2.4}.turn{stroke:#4a5560;stroke-width:1.6;fill:none}"""
mark = '<marker id="{}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="{}" markerHeight="{}" orient="auto"><path d="M0 0L8 4L0 8Z" fill="{}"/></marker>'
marks = mark.format("a", 8, 8, "#4a5560") + mark.format("f", 5, 5, "#1d4f91") + mark.format("t", 7, 7, "#4a5560")
print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 760 660" width="760" height="660" role="img"><title>Symbols: one sprag between its races, angles far larger than a clutch\'s</title><style>{style}</style><defs>{marks}</defs><rect width="760" height="660" fill="#fff"/>')
print("\n".join(parts))
print("</svg>")
