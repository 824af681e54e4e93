"""Three designs as the FMI cross-check wants them (rules 4.1, section 9.1 and appendix B), then replayed by two importers.

cross_check.py TOOL LIBRARY DESIGNS FOLDER writes FOLDER/fmus/2.0/cs/PLATFORM/sprag-design/VERSION/NAME with NAME.fmu, NAME_in.csv,
NAME_ref.csv, NAME_ref.opt and README.md. The reference is what `simulate` computes, with the same torques on both races as a
`[[drivetrain]]`: no unit takes part in it. The importers are FMPy and, where it is installed, libcosim (DNV, SINTEF); each reads
NAME_in.csv and NAME_ref.opt and is compared with NAME_ref.csv. The first figure that is not as it should be ends the script.
"""

import csv
import ctypes
import math
import os
import re
import shutil
import subprocess
import sys

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu, supported_platforms
from fmpy.fmi2 import FMU2Slave
from fmpy.util import read_csv, read_ref_opt_file
from fmpy.validation import validate_fmu

TOOL, LIBRARY, DESIGNS, FOLDER = (os.path.abspath(path) for path in sys.argv[1:5])
# What the unit calls it, and the column of `simulate --csv`.
COLUMNS = {
    "inner.angle": "theta_inner_rad",
    "inner.speed": "theta_inner_rate_rad_per_s",
    "outer.angle": "theta_outer_rad",
    "outer.speed": "theta_outer_rate_rad_per_s",
    "inner_contact.normal_force": "normal_inner_n",
    "outer_contact.normal_force": "normal_outer_n",
}
INPUTS = ["inner.torque", "outer.torque"]
STEP_S, ROWS, REL_TOL = 5e-6, 201, 2e-3
MOST_BYTES = 1_000_000


def even(until_s, count, torque):
    """Rows of both torques: what engages on the outer race, and against it on the inner one."""
    times = [until_s * i / count for i in range(count + 1)]
    return [(t, -torque(t), torque(t)) for t in times]


# Name: design, what it shows, the torques at both races (s, Nm, Nm), straight between the rows.
MODELS = {
    "MultiArc": (
        "huang2017-multi-arc.toml",
        "A torque that swings at 100 Hz about a preload; the sprags stick.",
        even(0.1, 400, lambda t: min(t / 0.02, 1.0) * (16.8 + 4.0 * math.sin(2.0 * math.pi * 100.0 * t))),
    ),
    "Starter": (
        "starter.toml",
        "A starter's torque rises to 300 Nm against a load that gives way; both races speed up together.",
        [(0.0, 0.0, 0.0), (0.01, -300.0, 300.0), (0.03, -300.0, 300.0), (0.035, -200.0, 240.0), (0.06, -180.0, 240.0)],
    ),
    "Overrun": (
        "huang2017-bench.toml",
        "The clutch carries, is turned the other way until the sprags slide on the inner race, and grips again.",
        [(0.0, 0.0, 0.0), (5e-3, -4.0, 4.0), (0.02, -4.0, 4.0), (0.022, 1.0, -1.0), (0.04, 1.0, -1.0), (0.044, -3.0, 3.0), (0.1, -3.0, 3.0)],
    ),
}


def tool(*args):
    done = subprocess.run([TOOL, *args], capture_output=True, text=True)
    assert done.returncode in (0, 1), (args, done.stderr)
    return done.stdout


def number(value):
    """A C literal that reads back as the same number."""
    return repr(float(value))


def write(path, names, rows):
    with open(path, "w", newline="", encoding="ascii") as file:
        file.write(",".join(f'"{name}"' for name in ["time", *names]) + "\n")
        file.writelines(",".join(number(value) for value in row) + "\n" for row in rows)


def reference(design, torques, folder):
    """What `simulate` says of the clutch with these torques on its races: rows of time and COLUMNS."""
    clutch = open(design, encoding="utf-8").read()
    clutch = re.split(r"^\[(?:limits|optimize|life|tolerances|lubrication|\[scenarios\]|\[drivetrain\])", clutch, flags=re.M)[0]
    train = ""
    for race, column in (("inner", 1), ("outer", 2)):
        with open(os.path.join(folder, f"{race}.csv"), "w", encoding="ascii") as file:
            file.write("time_s,torque_nm\n")
            file.writelines(f"{number(row[0])},{number(row[column])}\n" for row in torques)
        train += f'\n[[drivetrain]]\nname = "{race}"\nto = "{race}-race"\ntorque_history_csv = "{race}.csv"\n'
    scene = f'\n[[scenarios]]\nname = "replay"\nkind = "transient"\nduration_s = {torques[-1][0]}\n'
    path = os.path.join(folder, "reference.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(clutch + train + scene)
    table = os.path.join(folder, "reference.csv")
    tool("simulate", path, "--samples", str(ROWS), "--tolerance", "1e-9", "--csv", table, "--force", "--quiet")
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    # A row for each change of mode stands between the even ones where a scene has many.
    return [[float(row["time_s"]), *(float(row[column]) for column in COLUMNS.values())] for row in rows]


def held_to_the_rules(path, allowed, start_s, stop_s, all_of_them):
    """Appendix B: what a table of the cross-check may be."""
    data = open(path, "rb").read()
    assert len(data) <= MOST_BYTES, f"{path}: {len(data)} bytes"
    lines = data.decode("ascii").splitlines()
    names = re.fullmatch(r'"time"(?:,"[^",]+")+', lines[0])
    assert names, lines[0]
    names = [name.strip('"') for name in lines[0].split(",")]
    assert set(names[1:]) <= set(allowed) and len(set(names)) == len(names) <= 11, names
    assert not all_of_them or set(names[1:]) == set(allowed), names
    literal = r"[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?"
    row = re.compile(",".join([literal] * len(names)))
    assert all(row.fullmatch(line) for line in lines[1:]), path
    times = [float(line.split(",")[0]) for line in lines[1:]]
    assert all(a <= b for a, b in zip(times, times[1:])) and times[0] == start_s and times[-1] == stop_s, path
    return len(lines) - 1, len(data)


def apart(found, wanted):
    """Largest distance of each column by what the reference spans."""
    most = 0.0
    for name in COLUMNS:
        at = np.interp(wanted["time"], found["time"], found[name])
        most = max(most, float(np.max(np.abs(at - wanted[name])) / np.ptp(wanted[name])))
    return most


def by_fmpy(unit, opt, signals):
    """FMPy's own loop: it holds the inputs over each step."""
    return simulate_fmu(unit, start_time=opt["StartTime"], stop_time=opt["StopTime"], output_interval=opt["StepSize"], input=signals,
                        output=list(COLUMNS), fmi_type="CoSimulation")


def steps(opt):
    """Start and end of each step."""
    grid = [opt["StartTime"] + i * opt["StepSize"] for i in range(round((opt["StopTime"] - opt["StartTime"]) / opt["StepSize"]) + 1)]
    return zip(grid, grid[1:])


def torques_at(t, signals):
    return [float(np.interp(t, signals["time"], signals[name])) for name in INPUTS]


def table(rows):
    return np.array(rows, dtype=[("time", float), *((name, float) for name in COLUMNS)])


def with_slopes(unit, opt, signals):
    """By FMPy's calls, the slope of each input given too; FMPy's own loop does that for nine inputs only."""
    about = read_model_description(unit)
    of = {v.name: v.valueReference for v in about.modelVariables}
    folder = extract(unit)
    clutch = FMU2Slave(guid=about.guid, unzipDirectory=folder, modelIdentifier=about.coSimulation.modelIdentifier)
    clutch.instantiate()
    clutch.setupExperiment(startTime=opt["StartTime"])
    clutch.enterInitializationMode()
    clutch.exitInitializationMode()
    refs, rows = [of[name] for name in INPUTS], []
    vrs, orders = (ctypes.c_uint * len(refs))(*refs), (ctypes.c_int * len(refs))(*[1] * len(refs))
    for t, until in steps(opt):
        now, then = torques_at(t, signals), torques_at(until, signals)
        clutch.setReal(refs, now)
        slopes = (ctypes.c_double * len(refs))(*((b - a) / (until - t) for a, b in zip(now, then)))
        clutch.fmi2SetRealInputDerivatives(clutch.component, vrs, len(refs), orders, slopes)
        clutch.doStep(currentCommunicationPoint=t, communicationStepSize=until - t)
        rows.append((until, *clutch.getReal([of[name] for name in COLUMNS])))
    clutch.terminate()
    clutch.freeInstance()
    shutil.rmtree(folder)
    return table(rows)


def by_libcosim(unit, opt, signals):
    """The same by libcosim's own fixed-step master; torques are put in before each step."""
    from libcosimpy.CosimEnums import CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    # Its FMI Library misses a start value of `time`, which the standard forbids it to have (modelon-community/fmi-library, issue 21):
    # two lines of error without a consequence. What goes wrong is in the answers of its functions.
    log_output_level(CosimLogLevel.FATAL)
    of = {v.name: v.valueReference for v in read_model_description(unit).modelVariables}
    master = CosimExecution.from_step_size(round(opt["StepSize"] * 1e9))
    slave = master.add_local_slave(CosimLocalSlave(fmu_path=unit, instance_name="clutch"))
    assert slave >= 0
    hands, eyes = CosimManipulator.create_override(), CosimObserver.create_last_value()
    assert master.add_manipulator(hands) and master.add_observer(eyes)
    refs = [of[name] for name in INPUTS]
    for name in INPUTS:
        assert master.real_initial_value(slave, of[name], float(signals[name][0]))
    rows = []
    for t, until in steps(opt):
        assert hands.slave_real_values(slave, refs, torques_at(t, signals)) and master.step()
        rows.append((until, *eyes.last_real_values(slave, [of[name] for name in COLUMNS])))
    return table(rows)


def main():
    version = tool("--version").split()[1]
    root = os.path.join(FOLDER, "fmus", "2.0", "cs")
    shutil.rmtree(root, ignore_errors=True)
    try:
        import libcosimpy
    except ImportError:
        libcosimpy = None
        print("   libcosim is not installed: FMPy alone")
    for name, (design, shows, torques) in MODELS.items():
        print(f"-- cross-check: {name}", flush=True)
        design = os.path.join(DESIGNS, design)
        draft = os.path.join(FOLDER, f"{name}.fmu")
        tool("export", design, "--format", "fmu", "--clutch-alone", "--library", LIBRARY, "-o", draft, "--force", "--quiet")
        platforms = supported_platforms(draft)
        assert len(platforms) == 1, platforms
        folder = os.path.join(root, platforms[0], "sprag-design", version, name)
        os.makedirs(folder)
        unit, given, ref, opts = (os.path.join(folder, name + end) for end in (".fmu", "_in.csv", "_ref.csv", "_ref.opt"))
        shutil.move(draft, unit)
        start_s, stop_s = torques[0][0], torques[-1][0]
        write(given, INPUTS, torques)
        write(ref, COLUMNS, reference(design, torques, FOLDER))
        with open(opts, "w", encoding="ascii") as file:
            for key, value in (("StartTime", start_s), ("StopTime", stop_s), ("StepSize", STEP_S), ("RelTol", REL_TOL)):
                file.write(f"{key}, {number(value)}\n")
        with open(os.path.join(folder, "README.md"), "w", encoding="utf-8") as file:
            file.write(
                f"# {name}\n\n{shows}\n\n"
                f"Exported by sprag-design {version} from `designs/{os.path.basename(design)}`, FMI 2.0 co-simulation. Inputs: the torques "
                "that the flanges pass on to both races, N m, straight between the rows. All else has the values it starts with. Nothing "
                "beside the system's own libraries is needed, no licence is asked for.\n\n"
                "The reference was computed by `sprag-design simulate`, without the unit, to a relative 1e-9. A step holds its torques "
                f"where the importer gives no slopes: StepSize is short enough for RelTol = {REL_TOL:g} of what a variable spans.\n"
            )
        about = read_model_description(unit)
        inputs = [v.name for v in about.modelVariables if v.causality == "input"]
        outputs = [v.name for v in about.modelVariables if v.causality == "output"]
        assert not validate_fmu(unit)
        print(f"   {name}_in.csv: %d rows, %d bytes" % held_to_the_rules(given, inputs, start_s, stop_s, True))
        print(f"   {name}_ref.csv: %d rows, %d bytes" % held_to_the_rules(ref, outputs, start_s, stop_s, False))
        expected = [name + end for end in (".fmu", "_in.csv", "_ref.csv", "_ref.opt")] + ["README.md"]
        assert sorted(os.listdir(folder)) == sorted(expected), os.listdir(folder)
        # From here on as an importer: from the files alone.
        opt, signals, wanted = read_ref_opt_file(opts), read_csv(given), read_csv(ref)
        importers = [("FMPy", by_fmpy, opt["RelTol"]), ("FMPy's calls, with slopes", with_slopes, 1e-5)]
        if libcosimpy:
            importers.append(("libcosim", by_libcosim, opt["RelTol"]))
        for importer, run, most in importers:
            off = apart(run(unit, opt, signals), wanted)
            print(f"   {importer}: {off:.1e} of what each variable spans, {most:g} allowed", flush=True)
            assert off <= most
        # The comparison sees a clutch that is another: a torque that is 2 % more.
        more = signals.copy()
        for torque in INPUTS:
            more[torque] *= 1.02
        assert apart(by_fmpy(unit, opt, more), wanted) > opt["RelTol"]
    print("all as it should be")


if __name__ == "__main__":
    main()
