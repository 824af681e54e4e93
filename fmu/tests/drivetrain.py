"""A train that this script integrates, with the unit as its clutch, against `simulate` of the same `[[drivetrain]]`.

drivetrain.py TOOL LIBRARY DESIGN FOLDER. Two masters: one that repeats each step until the torques at its end agree with the motion
(states are taken and given back), of second order, whose two finest lengths of step are extrapolated and must agree to 1e-6 of each
figure; and one that never goes back, as most do, of first order, extrapolated alike. The first figure that is not as it should be
ends the script.
"""

import csv
import ctypes
import math
import os
import subprocess
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

TOOL, LIBRARY, DESIGN, FOLDER = (os.path.abspath(path) for path in sys.argv[1:5])
# Load on the inner race, motor on the outer one: inertia, stiffness and damping of the shaft, torque; the motor's rises over 1 ms.
INERTIA, STIFFNESS, DAMPING, TORQUE = (3.0e-3, 2.0e-3), (700.0, 900.0), (0.08, 0.05), (-14.0, 12.0)
RISE_NM, RISE_S, UNTIL_S = 6.0, 1e-3, 0.02
NAMES = ["inner race", "outer race", "load", "motor"]
TRAIN = """
[[drivetrain]]
name = "load"
to = "inner-race"
inertia_kg_m2 = {0[0]}
stiffness_nm_per_rad = {1[0]}
damping_nm_s_per_rad = {2[0]}
torque_nm = {3[0]}

[[drivetrain]]
name = "motor"
to = "outer-race"
inertia_kg_m2 = {0[1]}
stiffness_nm_per_rad = {1[1]}
damping_nm_s_per_rad = {2[1]}
torque_nm = {3[1]}
torque_history_csv = "rise.csv"

[[scenarios]]
name = "rise"
kind = "transient"
duration_s = {4}
"""


def tool(*args):
    done = subprocess.run([TOOL, *args], capture_output=True, text=True)
    assert done.returncode in (0, 1), (args, done.stderr)
    return done.stdout


def inside(path):
    """How far races and ends of the shafts move in `simulate`, rad."""
    table = os.path.join(FOLDER, "rise-answer.csv")
    tool("simulate", path, "--samples", "2", "--tolerance", "1e-9", "--csv", table, "--force", "--quiet")
    with open(table, encoding="utf-8", newline="") as file:
        first, *_, last = csv.DictReader(line for line in file if not line.startswith("#"))
    columns = ["theta_inner_rad", "theta_outer_rad", "load_angle_rad", "motor_angle_rad"]
    return [float(last[c]) - float(first[c]) for c in columns]


class Clutch:
    """The unit, in balance under an engaging torque."""

    def __init__(self, about, folder, carried_nm):
        self.of = {v.name: v.valueReference for v in about.modelVariables}
        self.unit = FMU2Slave(guid=about.guid, unzipDirectory=folder, modelIdentifier=about.coSimulation.modelIdentifier)
        self.unit.instantiate()
        self.unit.setReal([self.of["start.torque"], self.of["tolerance"]], [carried_nm, 1e-10])
        self.unit.setupExperiment(startTime=0.0)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()
        self.torques = [self.of["inner.torque"], self.of["outer.torque"]]
        self.motion = [self.of[name] for name in ("inner.angle", "inner.speed", "outer.angle", "outer.speed")]

    def races(self):
        """Angle and speed of each race."""
        angles = self.unit.getReal(self.motion)
        return (angles[0], angles[1]), (angles[2], angles[3])

    def step(self, t, dt, start_nm, end_nm):
        """Torques of both flanges, straight over the step."""
        self.unit.setReal(self.torques, list(start_nm))
        slopes = (ctypes.c_double * 2)(*((b - a) / dt for a, b in zip(start_nm, end_nm)))
        self.unit.fmi2SetRealInputDerivatives(self.unit.component, (ctypes.c_uint * 2)(*self.torques), 2, (ctypes.c_int * 2)(1, 1), slopes)
        self.unit.doStep(currentCommunicationPoint=t, communicationStepSize=dt)


def shafts(races, ends):
    return [k * (end[0] - race[0]) + d * (end[1] - race[1]) for k, d, race, end in zip(STIFFNESS, DAMPING, races, ends)]


def outside(t):
    return TORQUE[0], TORQUE[1] + RISE_NM * min(t / RISE_S, 1.0)


def moved(about, folder, race_inertia, dt, repeats):
    """How far all four have moved at the end. Ends of shafts: the acceleration is straight over a step, exactly integrated."""
    # All speed up alike at the start: what the clutch carries brings the inner side along.
    total = sum(INERTIA) + sum(race_inertia)
    acceleration = sum(TORQUE) / total
    carried = -TORQUE[0] + (INERTIA[0] + race_inertia[0]) * acceleration
    clutch = Clutch(about, folder, carried)
    begin = clutch.races()
    ends = [(race[0] + (m - j * acceleration) / k, 0.0) for race, m, j, k in zip(begin, TORQUE, INERTIA, STIFFNESS)]
    first = [race[0] for race in begin] + [end[0] for end in ends]
    for step in range(round(UNTIL_S / dt)):
        t = step * dt
        before = shafts(clutch.races(), ends)
        after, saved = before, clutch.unit.getFMUstate() if repeats else None
        for again in range(max(repeats, 1)):
            if again:
                clutch.unit.setFMUstate(saved)
            clutch.step(t, dt, before, after)
            fresh = []
            for (angle, speed), j, m0, m1, s0, s1 in zip(ends, INERTIA, outside(t), outside(t + dt), before, after):
                a, b = (m0 - s0) / j, (m1 - s1) / j
                fresh.append((angle + dt * speed + dt * dt * (a / 3.0 + b / 6.0), speed + 0.5 * dt * (a + b)))
            after = shafts(clutch.races(), fresh)
        if saved:
            clutch.unit.freeFMUstate(saved)
        ends = fresh
    last = [race[0] for race in clutch.races()] + [end[0] for end in ends]
    clutch.unit.terminate()
    clutch.unit.freeInstance()
    return [b - a for a, b in zip(first, last)]


def apart(found, wanted):
    return max(abs(a - b) / abs(b) for a, b in zip(found, wanted))


def main():
    text = open(DESIGN, encoding="utf-8").read()
    race_inertia = [float(text.split(f"{race}_inertia_kg_m2 = ")[1].split()[0]) for race in ("inner", "outer")]
    path = os.path.join(FOLDER, "rise.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.split("[limits]")[0] + TRAIN.format(INERTIA, STIFFNESS, DAMPING, TORQUE, UNTIL_S))
    with open(os.path.join(FOLDER, "rise.csv"), "w", encoding="ascii") as file:
        file.write(f"time_s,torque_nm\n0,0\n{RISE_S},{RISE_NM}\n{UNTIL_S},{RISE_NM}\n")
    wanted = inside(path)
    print("   simulate: " + ", ".join(f"{name} {value:.9f} rad" for name, value in zip(NAMES, wanted)))
    unit = os.path.join(FOLDER, "rise.fmu")
    refused = subprocess.run([TOOL, "export", path, "--format", "fmu", "--library", LIBRARY, "-o", unit, "--force"], capture_output=True)
    assert refused.returncode == 2 and b"--clutch-alone" in refused.stderr, refused
    tool("export", path, "--format", "fmu", "--clutch-alone", "--library", LIBRARY, "-o", unit, "--force")
    about, folder = read_model_description(unit), extract(unit, os.path.join(FOLDER, "rise-unit"))
    for what, repeats, order, steps, most in [
        ("each step repeated", 6, 2, (1e-4, 5e-5, 2.5e-5), 1e-6),
        ("never back", 0, 1, (2e-5, 1e-5, 5e-6), 1e-4),
    ]:
        found = [moved(about, folder, race_inertia, dt, repeats) for dt in steps]
        errors = [apart(f, wanted) for f in found]
        seen = math.log2(errors[-2] / errors[-1])
        weight = 2.0**order
        best = apart([(weight * b - a) / (weight - 1.0) for a, b in zip(found[-2], found[-1])], wanted)
        told = ", ".join(f"{dt * 1e6:g} us {e:.1e}" for dt, e in zip(steps, errors))
        print(f"   {what}: {told}; order {seen:.2f}; extrapolated {best:.1e}, {most:g} allowed", flush=True)
        assert abs(seen - order) < 0.25 and best <= most
    print("all as it should be")


if __name__ == "__main__":
    main()
