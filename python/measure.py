"""What a call of `evaluate` costs beside its computation, and what a second thread of Python brings.

    python python/measure.py [DESIGN.toml]

A call's cost is by processor time, which others' load does not enter. Two threads are judged by the wall where the machine gave
them two cores; where others kept it busy the wall says nothing of them, and what is left is processor time per call (2 where a
call costs no more beside another) and the share of a call for which Python's lock is held (no other thread runs in that).
Exit code 1 where a call costs 50 us or more, or two threads bring less than 1.8 times one.
"""

from __future__ import annotations

import os
import statistics
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

# One thread in the pool too, before that is made: both ways of asking then compute alike.
os.environ["RAYON_NUM_THREADS"] = "1"

import sprag_design as sd

CALLS = 40
ROUNDS = 9
MOST_US, LEAST_GAIN = 50.0, 1.8


def cpu_us(work: Callable[[], object], calls: int) -> float:
    """Processor time of this thread per call, the least of several rounds, us."""
    rounds = []
    for _ in range(ROUNDS):
        start = time.thread_time_ns()
        for _ in range(calls):
            work()
        rounds.append((time.thread_time_ns() - start) / calls / 1e3)
    return min(rounds)


def overhead(problem: sd.Problem) -> float:
    """What one call takes beside its computation, us: in Python's own words, in the border between both languages, and what is
    left of a call against one of many points, which has one border for all."""
    x = problem.start
    answer = problem._core.evaluate(x)

    class Known:
        def evaluate(self, _x: list[float]) -> object:
            return answer

    words = sd.Problem.__new__(sd.Problem)
    words._core = Known()  # type: ignore[assignment]
    own = cpu_us(lambda: words.evaluate(x), 2000)

    def refused() -> None:
        try:
            problem._core.evaluate(x[:-1])
        except ValueError:
            pass

    border = cpu_us(refused, 2000)
    apart, together = [], []
    for _ in range(ROUNDS):
        start = time.process_time_ns()
        for _ in range(CALLS):
            problem.evaluate(x)
        between = time.process_time_ns()
        problem.evaluate_all([x] * CALLS)
        apart.append((between - start) / CALLS / 1e3)
        together.append((time.process_time_ns() - between) / CALLS / 1e3)
    # A machine's own noise only adds to a round: the least of each holds the least of it.
    left = min(apart) - min(together)
    noise = max(sorted(rounds)[1] - min(rounds) for rounds in (apart, together))
    print(f"overhead of a call, us: {own:.1f} in Python, {border:.1f} at the border, {left:.1f} ± {noise:.1f} against one call for many")
    return own + border + max(0.0, left)


def threads(problem: sd.Problem, beside_us: float) -> float:
    """Gain of two threads over one."""

    def work(count: int) -> Callable[[], None]:
        def run() -> None:
            for _ in range(count):
                problem.evaluate(problem.start)

        return run

    def spent(workers: int) -> tuple[float, float]:
        all_of_them = [threading.Thread(target=work(CALLS)) for _ in range(workers)]
        wall, cpu = time.perf_counter(), time.process_time()
        for thread in all_of_them:
            thread.start()
        for thread in all_of_them:
            thread.join()
        return time.perf_counter() - wall, time.process_time() - cpu

    pairs = [(spent(1), spent(2)) for _ in range(ROUNDS)]
    by_wall = statistics.median(2 * one[0] / two[0] for one, two in pairs)
    by_cpu = statistics.median(4 * one[1] / two[1] for one, two in pairs)
    cores = statistics.median(two[1] / two[0] for _, two in pairs)
    call_us = statistics.median(one[1] for one, _ in pairs) / CALLS * 1e6
    locked = beside_us / call_us
    print(
        f"two threads over one: {by_wall:.2f} by wall, {by_cpu:.2f} by processor time; {cores:.2f} cores were had, load average "
        f"{os.getloadavg()[0]:.1f} on {os.cpu_count()}; Python's lock is held for at most {100 * locked:.1f} % of a call"
    )
    # Two calls side by side hold it one after the other.
    return by_wall if cores > 1.7 else min(by_cpu, 2.0) * (1.0 - locked)


def main() -> int:
    usual = Path(__file__).resolve().parents[1] / "designs" / "huang2017-multi-arc.toml"
    problem = sd.Design.load(sys.argv[1] if len(sys.argv) > 1 else usual).problem()
    problem.evaluate(problem.start)
    beside_us = overhead(problem)
    gain = threads(problem, beside_us)
    held = beside_us < MOST_US and gain >= LEAST_GAIN
    print("HELD" if held else "NOT HELD", f"{beside_us:.1f} us of {MOST_US:.0f}, {gain:.2f} times of {LEAST_GAIN}")
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
