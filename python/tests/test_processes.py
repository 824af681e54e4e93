"""Threads, forks, Ctrl-C."""

from __future__ import annotations

import sys
import threading

import pytest

import sprag_design as sd

from .conftest import MULTI_ARC, python


def test_nobody_holds_the_lock_while_it_computes(design: sd.Design) -> None:
    """Python never takes the lock away here: another thread runs only if the computing one gives it up."""
    start, calls = design.problem().start, 30
    begun = threading.Event()
    done = 0

    def evaluate() -> None:
        nonlocal done
        begun.set()
        for _ in range(calls):
            design.evaluate(start)
            done += 1

    before = sys.getswitchinterval()
    sys.setswitchinterval(1e6)
    try:
        thread = threading.Thread(target=evaluate)
        thread.start()
        begun.wait()
        seen = done
        thread.join()
    finally:
        sys.setswitchinterval(before)
    assert seen < calls == done


def test_threads_have_the_same_answers(design: sd.Design) -> None:
    answers: list[object] = []
    threads = [threading.Thread(target=lambda: answers.append(design.stiffness().to_dict()["laws"])) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 6 and all(answer == answers[0] for answer in answers)


needs_fork = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no fork")

FORK = """
import os, sys, threading
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
def answer(): return design.stiffness(laws=["roller", "hertz"]).to_dict()["laws"]
known = answer()
def in_child(deeper):
    child = os.fork()
    if child == 0:
        ok = answer() == known and (deeper == 0 or in_child(deeper - 1))
        os._exit(0 if ok else 1)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
"""


@needs_fork
def test_a_forked_process_computes_and_so_does_its_child() -> None:
    done = python(FORK + "sys.exit(not (in_child(2) and answer() == known))", MULTI_ARC)
    assert done.returncode == 0, done.stderr


@needs_fork
def test_a_fork_while_another_thread_computes_does_not_hang() -> None:
    code = """
go = True
def busy():
    while go: answer()
thread = threading.Thread(target=busy); thread.start()
same = all([in_child(0) for _ in range(10)])
go = False; thread.join()
sys.exit(not same)
"""
    done = python(FORK + code, MULTI_ARC)
    assert done.returncode == 0, done.stderr


@needs_fork
def test_a_pool_of_forked_processes_evaluates() -> None:
    code = """
import multiprocessing, sys
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
problem = design.problem()
known = [problem.evaluate(problem.start), design.stiffness().to_dict()["laws"]]
def work(i): return [problem.evaluate(problem.start), design.stiffness().to_dict()["laws"]]
with multiprocessing.get_context("fork").Pool(2) as pool:
    found = pool.map(work, range(4))
# What goes to another process by pickling computes there too.
with multiprocessing.get_context("fork").Pool(1) as pool:
    found.append([pool.apply(problem.evaluate, (problem.start,)), known[1]])
sys.exit(any(f != known for f in found))
"""
    done = python(code, MULTI_ARC)
    assert done.returncode == 0, done.stderr


@needs_fork
@pytest.mark.parametrize(
    "call",
    [
        "design.optimize(starts=1000, evaluations=100000)",
        "design.set('scenarios[high-10].duration_s', 3600).simulate('high-10', tolerance=1e-12, most_steps=10**9)",
    ],
)
def test_ctrl_c_stops_what_would_take_for_ever(call: str) -> None:
    code = """
import os, signal, sys, threading
import sprag_design as sd
design = sd.Design.load(sys.argv[1])
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    CALL
except KeyboardInterrupt:
    print("stopped", design.stiffness([16.8]).windup_deg[0] > 1.9)
""".replace("CALL", call)
    done = python(code, MULTI_ARC)
    assert done.stdout.split() == ["stopped", "True"], done.stderr


@needs_fork
def test_ctrl_c_ends_the_command_of_the_wheel() -> None:
    code = """
import os, signal, sys, threading
sys.argv = ["sprag-design", "optimize", sys.argv[1], "-o", sys.argv[2] + "/new.toml", "--starts", "1000", "--quiet"]
from sprag_design._command import main
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
sys.exit(main())
"""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        done = python(code, MULTI_ARC, folder)
    assert done.returncode == 130, done.stderr
