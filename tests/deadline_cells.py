"""How soon planning ends when it is told to: hard cells, deadlines and cancelling, 200 runs.

Half of the runs have a deadline, half are cancelled by another thread at that time. Told of each:
the time on the clock from the request until `handey.plan` has returned its report, and, of those
that are cancelled, the CPU time that the planning thread still took, which does not depend on what
else the machine is doing. Runs that end before the request are told apart. One run in ten is
followed by another plan, which must be the same as before, byte for byte.

    python tests/deadline_cells.py --runs 200
    python tests/deadline_cells.py --runs 40 --deadlines 5
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import hard_cells
import numpy as np

import handey

LIMIT = 0.1  # s


@dataclass
class Run:
    """One stopped run: seconds from the request to the return."""

    cell: str
    seconds: float
    wall: float
    cpu: float | None


def timed_out(name: str, cell: handey.CellFile, seconds: float) -> Run | None:
    """A run with a deadline; None if it ended before."""
    start = time.perf_counter()
    result = handey.plan(cell, handey.PlanOptions(deadline=seconds))
    wall = time.perf_counter() - start - seconds
    return Run(name, seconds, wall, None) if result.report.deadline_passed else None


def cancelled(name: str, cell: handey.CellFile, seconds: float) -> Run | None:
    """A run that another thread cancels; None if it ended before."""
    token, ended = handey.CancelToken(), threading.Event()
    clock = time.pthread_getcpuclockid(threading.get_ident())
    asked: list[float] = []

    def cancel() -> None:
        if not ended.wait(seconds):
            asked.extend((time.perf_counter(), time.clock_gettime(clock)))
            token.cancel()

    canceller = threading.Thread(target=cancel)
    canceller.start()
    result = handey.plan(cell, cancel=token)
    wall, cpu = time.perf_counter(), time.clock_gettime(clock)
    ended.set()
    canceller.join()
    if not result.report.cancelled:
        return None
    return Run(name, seconds, wall - asked[0], cpu - asked[1])


def line(what: str, values: list[float]) -> str:
    median, high = np.percentile(values, [50, 95])
    within = sum(value <= LIMIT for value in values)
    figures = f"{1e3 * median:8.1f} {1e3 * high:8.1f} {1e3 * max(values):8.1f}"
    return f"{what:30s} {len(values):5d} {figures} {within:6d}"


def steps(result: handey.PlanResult) -> list[bytes]:
    assert result.plan is not None
    return [step.positions.tobytes() for step in result.plan.steps]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=200, help="in all")
    parser.add_argument("--deadlines", type=float, nargs="+", default=[0.05, 0.5, 5.0])
    parser.add_argument("--cells", nargs="+", choices=hard_cells.CELLS, default=[*hard_cells.CELLS])
    options = parser.parse_args()
    easy = handey.load_cell(hard_cells.ROBOT.parents[2] / "cells" / "open_table.yaml")
    expected, same = steps(handey.plan(easy)), True
    done: list[Run] = []
    early = 0
    with tempfile.TemporaryDirectory() as folder:
        cells = {
            name: handey.load_cell(hard_cells.write_cell(name, Path(folder)))
            for name in options.cells
        }
        for i in range(options.runs):
            name = options.cells[i % len(cells)]
            seconds = options.deadlines[i // (2 * len(cells)) % len(options.deadlines)]
            way = (timed_out, cancelled)[i // len(cells) % 2]
            run = way(name, cells[name], seconds)
            early += run is None
            done += [run] if run is not None else []
            if i % 10 == 9:
                same = same and steps(handey.plan(easy)) == expected
    print(f"{'[ms]':30s} {'runs':>5s} {'median':>8s} {'p95':>8s} {'max':>8s} {'<=100':>6s}")
    for seconds in options.deadlines:
        for way, kind in (("deadline", True), ("cancel", False)):
            of = [r for r in done if r.seconds == seconds and (r.cpu is None) == kind]
            if of:
                print(line(f"{way} {seconds:g} s", [r.wall for r in of]))
    for name in options.cells:
        if any(r.cell == name for r in done):
            print(line(f"cell {name}", [r.wall for r in done if r.cell == name]))
    print(line("all, on the clock", [r.wall for r in done]))
    taken = [r.cpu for r in done if r.cpu is not None]
    if taken:
        print(line("cancelled, CPU of the thread", taken))
    print(f"{early} runs ended before; plans afterwards {'the same' if same else 'DIFFER'}")
    return 0 if same and all(r.wall <= LIMIT for r in done) else 1


if __name__ == "__main__":
    sys.exit(main())
