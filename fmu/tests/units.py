"""Units of the clutch of Huang (2017) under FMPy: validation, against `simulate`, state, twenty side by side, bad questions.

units.py TOOL LIBRARY DESIGN FOLDER PAGE. Every figure is printed; the first that is not as it should be ends the script.
"""

import concurrent.futures
import contextlib
import ctypes
import io
import json
import math
import os
import random
import re
import resource
import subprocess
import sys
import time

from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu

TOOL, LIBRARY, DESIGN, FOLDER, PAGE = (os.path.abspath(path) for path in sys.argv[1:6])
OMEGA = 2.0 * math.pi * 100.0
OUTPUTS = [
    "inner.angle", "inner.speed", "inner.acceleration", "outer.angle", "outer.speed", "outer.acceleration",
    "inner_contact.normal_force", "inner_contact.friction", "outer_contact.normal_force", "outer_contact.friction",
]
# Scenes of the design: preload and amplitude, Nm; parameters that the scene overrides.
SCENES = {
    "low-6": (16.8, 6.0, {}),
    "high-10": (3.34, 10.0, {}),
    "low-10-mu082": (16.8, 10.0, {"friction.static": 0.082, "friction.kinetic": 0.082}),
}


def tool(*args):
    done = subprocess.run([TOOL, *args], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


class Unit:
    """One instance of either version, by names."""

    def __init__(self, fmi, name="unit", logging=False, token=None):
        self.fmi, self.messages = fmi, []
        self.md, folder = UNITS[fmi]
        self.of = {v.name: v for v in self.md.modelVariables}
        args = dict(guid=token or self.md.guid, unzipDirectory=folder, modelIdentifier=self.md.coSimulation.modelIdentifier,
                    instanceName=name)
        if fmi == 2:
            self.fmu = FMU2Slave(**args)
            callbacks = fmi2CallbackFunctions()
            callbacks.logger = fmi2CallbackLoggerTYPE(lambda _, name, status, category, message: self.note(status, message))
            self.fmu.instantiate(callbacks=callbacks, loggingOn=logging)
        else:
            self.fmu = FMU3Slave(**args)
            self.fmu.instantiate(logMessage=lambda _, status, category, message: self.note(status, message),
                                 loggingOn=logging)

    def note(self, status, message):
        self.messages.append((status, message.decode()))

    def set(self, **values):
        self.set_all({name.replace("__", "."): value for name, value in values.items()})

    def set_all(self, values):
        for name, value in values.items():
            v, fmu = self.of[name], self.fmu
            if v.type == "Boolean":
                fmu.setBoolean([v.valueReference], [value])
            elif self.fmi == 2:
                fmu.setReal([v.valueReference], [value])
            else:
                fmu.setFloat64([v.valueReference], [value])

    def get(self, *names):
        refs = [self.of[name].valueReference for name in names]
        return tuple(self.fmu.getReal(refs) if self.fmi == 2 else self.fmu.getFloat64(refs))

    def whole(self, name):
        ref = [self.of[name].valueReference]
        return (self.fmu.getInteger(ref) if self.fmi == 2 else self.fmu.getInt32(ref))[0]

    def begin(self, start=0.0, **values):
        self.set(**values)
        if self.fmi == 2:
            self.fmu.setupExperiment(startTime=start)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=start)
        self.fmu.exitInitializationMode()
        return self

    def step(self, t, dt):
        return self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=dt)

    def state(self):
        return self.fmu.getFMUstate() if self.fmi == 2 else self.fmu.getFMUState()

    def restore(self, state):
        (self.fmu.setFMUstate if self.fmi == 2 else self.fmu.setFMUState)(state)

    def free_state(self, state):
        (self.fmu.freeFMUstate if self.fmi == 2 else self.fmu.freeFMUState)(state)

    def bytes(self, state):
        return self.fmu.serializeFMUstate(state) if self.fmi == 2 else self.fmu.serializeFMUState(state)

    def of_bytes(self, data):
        return self.fmu.deSerializeFMUstate(data) if self.fmi == 2 else self.fmu.deserializeFMUState(data)

    def free(self):
        self.fmu.freeInstance()


def scene_unit(fmi, scene, start=0.0):
    preload, _, parameters = SCENES[scene]
    unit = Unit(fmi)
    unit.set_all({**parameters, "start.torque": preload, "start.without_spring": True, "abutment.stiffness": 5000.0,
                  "inner.torque": -preload})
    return unit.begin(start)


def run_scene(fmi, scene, times, start=0.0):
    """Angles at the end, with the torque straight over each step (FMI 2) or constant at its value in the middle (FMI 3)."""
    amplitude = SCENES[scene][1]
    unit = scene_unit(fmi, scene, start)
    outer = [unit.of["outer.torque"].valueReference]
    for from_s, until_s in zip(times, times[1:]):
        dt = until_s - from_s
        at, end = amplitude * math.sin(OMEGA * (from_s - start)), amplitude * math.sin(OMEGA * (until_s - start))
        if fmi == 2:
            unit.fmu.setReal(outer, [at])
            ref = (ctypes.c_uint * 1)(*outer)
            unit.fmu.fmi2SetRealInputDerivatives(unit.fmu.component, ref, 1, (ctypes.c_int * 1)(1),
                                                 (ctypes.c_double * 1)((end - at) / dt))
        else:
            unit.fmu.setFloat64(outer, [amplitude * math.sin(OMEGA * (0.5 * (from_s + until_s) - start))])
        unit.step(from_s, dt)
    angles = unit.get("inner.angle", "outer.angle")
    unit.free()
    return angles


def even(count, start=0.0, duration=0.3):
    return [start + duration * i / count for i in range(count + 1)]


def refused(unit, question, words):
    """The question ends in an error, with a message that holds the words."""
    unit.messages.clear()
    try:
        question()
    except FMICallException as error:
        told = " ".join(m for status, m in unit.messages if status == 3)
        assert error.status == 3 and words in told, (error.status, words, unit.messages)
        print(f"   refused: {told.splitlines()[0][:150]}")
        return
    raise AssertionError(f"not refused: {words}")


def stage(name):
    print(f"-- {name}", flush=True)


UNITS = {}
for fmi in (2, 3):
    stage(f"FMI {fmi}.0: export and validation")
    path = os.path.join(FOLDER, f"clutch-{fmi}.fmu")
    print("  ", json.loads(tool("export", DESIGN, "--format", "fmu", "--fmi", str(fmi), "--library", LIBRARY, "-o", path,
                               "--force", "--json"))["bytes"], "bytes")
    problems = validate_fmu(path)
    assert not problems, problems
    print("   validate: no problems found")
    assert subprocess.run([os.path.join(os.path.dirname(sys.executable), "fmpy"), "validate", path]).returncode == 0
    UNITS[fmi] = (read_model_description(path), extract(path, os.path.join(FOLDER, f"unit-{fmi}")))
    first = open(path, "rb").read()
    tool("export", DESIGN, "--format", "fmu", "--fmi", str(fmi), "--library", LIBRARY, "-o", path, "--force")
    assert open(path, "rb").read() == first, "the same files give the same bytes"
    result = simulate_fmu(path, stop_time=0.02, output_interval=1e-4,
                          start_values={"inner.torque": -5.0, "outer.torque": 5.0, "start.torque": 5.0},
                          output=["inner.angle", "outer.angle", "inner_contact.normal_force", "open"])
    turned = math.degrees(result["outer.angle"][-1] - result["inner.angle"][-1])
    print(f"   simulate_fmu: {len(result)} rows, windup {turned:.4f} deg, N {result['inner_contact.normal_force'][-1]:.2f} N")
    assert 0.1 < turned < 2.0

for scene, counts, most in [("low-6", (600, 1200, 6000), 1e-6), ("low-10-mu082", (3000, 6000, 30000), 1e-6),
                            ("high-10", (3000, 6000, 30000), 1e-6)]:
    truth = json.loads(tool("simulate", DESIGN, "--scenario", scene, "--json"))
    expected = [truth["theta_inner_end_rad"], truth["theta_outer_end_rad"]]
    stage(f"{scene}: against simulate, inner race {expected[0]:.9f} rad, outer race {expected[1]:.9f} rad")
    for fmi in (2, 3):
        errors = []
        for count in counts:
            found = run_scene(fmi, scene, even(count))
            errors.append(max(abs(a - b) for a, b in zip(found, expected)))
        order = math.log(errors[0] / errors[-1]) / math.log(counts[-1] / counts[0])
        told = ", ".join(f"{0.3 / n * 1e6:.0f} us {e:.2e} rad" for n, e in zip(counts, errors))
        print(f"   FMI {fmi}: {told}; order {order:.2f}")
        assert errors[-1] < most, errors
    if scene == "low-6":
        random.seed(1)
        uneven = sorted({0.0, 0.3, *(0.3 * random.random() for _ in range(9000))})
        error = max(abs(a - b) for a, b in zip(run_scene(2, scene, uneven), expected))
        print(f"   9000 uneven steps: {error:.2e} rad")
        assert error < most
        assert run_scene(2, scene, even(600, 1e3), 1e3) is not None

for fmi in (2, 3):
    stage(f"FMI {fmi}.0: state, saved and restored in the midst of slip")
    unit, other = scene_unit(fmi, "high-10"), scene_unit(fmi, "high-10")
    dt = 1e-4

    def march(unit, first, count):
        seen = []
        for i in range(first, first + count):
            unit.set(outer__torque=10.0 * math.sin(OMEGA * (i + 0.5) * dt))
            unit.step(i * dt, dt)
            seen.append((*unit.get(*OUTPUTS), unit.whole("inner_contact.slip"), unit.whole("outer_contact.slip")))
        return seen

    slipped = march(unit, 0, 55)
    state = unit.state()
    kept = unit.bytes(state)
    straight = march(unit, 55, 300)
    unit.restore(state)
    again = march(unit, 55, 300)
    there = other.of_bytes(kept)
    other.restore(there)
    elsewhere = march(other, 55, 300)
    assert straight == again == elsewhere, "not the same bits"
    slips = sum(row[-2] != 0 for row in slipped + straight)
    print(f"   300 steps, {len(straight[0])} outputs: the same bits, in another instance too; {len(kept)} bytes; slip in {slips} rows")
    assert slips > 3
    # Parameters belong to the state.
    unit.set_all({"races.outer_inertia_kg_m2": 3e-3})
    assert march(unit, 355, 20) != march(other, 355, 20)
    unit.restore(state)
    assert march(unit, 55, 300) == straight
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(20000):
        unit.free_state(unit.state())
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(f"   20 000 states taken and freed: {grown} kB more")
    assert grown < 4000
    unit.free_state(state)
    other.free_state(there)
    unit.free()
    other.free()

    stage(f"FMI {fmi}.0: twenty side by side")

    def one(i):
        unit = Unit(fmi, f"unit-{i}").begin(start__torque=1.0 + i, sprags__count=12.0 + i % 3)
        seen = []
        for k in range(200):
            unit.set(inner__torque=-(1.0 + i), outer__torque=(1.0 + i) * (1.0 + 0.2 * math.sin(0.1 * k)))
            unit.step(k * dt, dt)
            seen.append(unit.get(*OUTPUTS))
        unit.free()
        return seen

    alone = [one(i) for i in range(20)]
    with concurrent.futures.ThreadPoolExecutor(20) as pool:
        together = list(pool.map(one, range(20)))
    assert together == alone and len({str(rows[-1]) for rows in alone}) == 20
    print("   20 threads of 200 steps: each the same bits as alone, all different")
    units = [Unit(fmi, f"unit-{i}").begin(start__torque=1.0 + i, sprags__count=12.0 + i % 3) for i in range(20)]
    for k in range(200):
        for i, unit in enumerate(units):
            unit.set(inner__torque=-(1.0 + i), outer__torque=(1.0 + i) * (1.0 + 0.2 * math.sin(0.1 * k)))
            unit.step(k * dt, dt)
    assert [u.get(*OUTPUTS) for u in units] == [rows[-1] for rows in alone]
    print("   20 in turns: the same bits")

    stage(f"FMI {fmi}.0: bad questions")
    unit = Unit(fmi)
    refused(unit, lambda: unit.set(inner__torque=float("nan")), "inner.torque: found")
    refused(unit, lambda: unit.set(inner__angle=1.0), "cannot be set")
    ref = 9999
    refused(unit, lambda: (unit.fmu.setReal if fmi == 2 else unit.fmu.setFloat64)([ref], [1.0]), "value reference 9999")
    refused(unit, lambda: unit.step(0.0, 1e-3), "before the initialisation is over")
    for values, words in [
        ({"races.inner_radius_mm": 50.0}, "inner_radius_mm"),
        ({"sprags.count": 12.5}, "sprags.count"),
        ({"friction.kinetic": 0.5}, "friction"),
        ({"start.torque": 1e5}, "is not carried"),
        ({"tolerance": 0.5}, "tolerance"),
        ({"start.overrun": -1.0}, "overrun"),
    ]:
        bad = Unit(fmi)
        refused(bad, lambda: (bad.set_all(values), bad.begin()), words)
        bad.free()
    unit.begin()
    refused(unit, lambda: unit.step(0.0, -1e-3), "step (s)")
    refused(unit, lambda: unit.step(7.0, 1e-3), "stands at 0 s")
    refused(unit, lambda: unit.set(start__speed=3.0), "start.speed: can be set before")
    refused(unit, lambda: unit.restore(unit.of_bytes(b'{"token":"other"}')), "no state of this unit")
    unit.step(0.0, 1e-3)
    print("   and goes on:", unit.get("inner.speed"))
    unit.free()
    try:
        Unit(fmi, token="another")
        raise AssertionError("another token")
    except Exception as error:
        assert "instantiate" in str(error), error

    stage(f"FMI {fmi}.0: states that somebody has tampered with")
    random.seed(fmi)
    unit = scene_unit(fmi, "high-10")
    march(unit, 0, 57)
    state = unit.state()
    kept = unit.bytes(state)
    unit.free_state(state)
    numbers = list(re.finditer(rb"-?\d+\.?\d*(?:e-?\d+)?", kept))
    odd = [b"0", b"-1", b"3", b"1e6", b"-1e6", b"1e14", b"-1e14", b"1e-300", b"1e300", b"null", b"true"]
    taken = 0
    for _ in range(1000):
        at = random.choice(numbers)
        tampered = kept[: at.start()] + random.choice(odd) + kept[at.end():]
        unit = scene_unit(fmi, "high-10")
        try:
            unit.restore(unit.of_bytes(tampered))
            taken += 1
            for _ in range(3):
                unit.step(unit.get("time")[0], dt)
        except FMICallException as error:
            assert error.status in (2, 3)
        assert all(math.isfinite(x) for x in unit.get(*OUTPUTS)), tampered
        assert not any("a fault of sprag-design" in m for _, m in unit.messages), unit.messages
        unit.free()
    print(f"   1000, of which {taken} were taken: no crash, no panic, no number that is none")

    stage(f"FMI {fmi}.0: overload ends, with a name")
    unit = Unit(fmi, logging=True).begin()
    assert any("begins at 0 s" in m for _, m in unit.messages), unit.messages
    unit.set(inner__torque=-2000.0, outer__torque=2000.0)
    ended = False
    for k in range(100):
        try:
            answer = unit.step(k * 1e-3, 1e-3)
            ended = fmi == 3 and answer[1]
            reached = answer[3] if ended else None
        except FMICallException as error:
            assert error.status == 2
            ended, reached = unit.fmu.getBooleanStatus(3), unit.fmu.getRealStatus(2)
        if ended:
            break
    told = [m for status, m in unit.messages if status == 2]
    print(f"   at {reached:.6f} s: {told}")
    assert ended and "curve-end" in told[0] and k * 1e-3 <= reached < (k + 1) * 1e-3
    unit.free()

stage("time of a step")
for fmi in (2, 3):
    unit = Unit(fmi).begin(start__torque=16.8, inner__torque=-16.8)
    ref, count = [unit.of["outer.torque"].valueReference], 5000
    put = unit.fmu.setReal if fmi == 2 else unit.fmu.setFloat64
    torques = [16.8 + 6.0 * math.sin(OMEGA * 1e-4 * k) for k in range(count)]
    started = time.perf_counter()
    for k, torque in enumerate(torques):
        put(ref, [torque])
        unit.step(k * 1e-4, 1e-4)
    print(f"   FMI {fmi}: {(time.perf_counter() - started) / count * 1e6:.1f} us for 0.1 ms, both races free, with FMPy's own share")
    unit.free()

stage("the guide's example")
page = open(PAGE, encoding="utf-8").read()
os.chdir(FOLDER)
os.replace("clutch-2.fmu", "clutch.fmu")
told = io.StringIO()
with contextlib.redirect_stdout(told):
    exec(page.split("```python\n")[1].split("```")[0], {})
print("  ", told.getvalue().strip())
# The load takes the whole torque in the end: 20 Nm at 200 rad/s, approached with J/(0.1 Nm s).
speed = float(told.getvalue().split()[0])
inertia = 0.05 + 1.41e-3 + 12 * 1.8e-3 * 15.29e-3**2
assert abs(speed - 200.0 * (1.0 - math.exp(-2.0 * 0.1 / inertia))) < 0.2, speed
print("all as it should be")
