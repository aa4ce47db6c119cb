"""How soon planning ends when it is told to: deadlines and cancelling, 200 runs, stage by stage.

Half of the runs have a deadline, half are cancelled by another thread at that time. Told of each:
the time on the clock from the request until `handey.plan` has returned its report; the CPU time
that the planning thread still took, which does not depend on what else the machine is doing; and
the stage that was at work. Runs that end before the request do not count; another cell is taken
instead. One run in ten is followed by another plan, which must be the same as before, byte for
byte.

    python tests/deadline_cells.py --runs 200
    python tests/deadline_cells.py --runs 40 --deadlines 5
"""

from __future__ import annotations

import argparse
import itertools
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import hard_cells
import long_cells
import numpy as np

import handey

LIMIT = 0.1  # s


@dataclass
class Run:
    """One stopped run: seconds from the request to the return."""

    cell: str
    seconds: float
    by_deadline: bool
    stage: str
    wall: float
    cpu: float


@dataclass(frozen=True)
class Ready:
    """A cell that is read, with what planning is allowed."""

    name: str
    cell: handey.CellFile
    options: handey.PlanOptions


def stopped(ready: Ready, seconds: float, by_deadline: bool) -> Run | None:
    """One run; None if it ended before."""
    token, ended = handey.CancelToken(), threading.Event()
    clock = time.pthread_getcpuclockid(threading.get_ident())
    asked: list[float] = []
    stages = [""]

    def ask() -> None:
        if not ended.wait(seconds):
            asked.extend((time.perf_counter(), time.clock_gettime(clock)))
            if not by_deadline:
                token.cancel()

    asker = threading.Thread(target=ask)
    options = replace(ready.options, deadline=seconds if by_deadline else None)
    start = time.perf_counter()
    asker.start()
    result = handey.plan(
        ready.cell, options, cancel=token, progress=lambda stage, _: stages.append(stage)
    )
    wall, cpu = time.perf_counter(), time.clock_gettime(clock)
    ended.set()
    asker.join()
    # Advice ends without a word in the report.
    if len(stages) > 1 and stages[-1] == "advice":
        heeded = bool(asked) or wall - start >= seconds
    else:
        heeded = result.report.stopped
    if not heeded:
        return None
    since = start + seconds if by_deadline else asked[0]
    taken = cpu - asked[1] if asked else 0.0
    return Run(ready.name, seconds, by_deadline, stages[-1], wall - since, taken)


def line(what: str, values: list[float]) -> str:
    median, high = np.percentile(values, [50, 95])
    within = sum(value <= LIMIT for value in values)
    figures = f"{1e3 * median:8.1f} {1e3 * high:8.1f} {1e3 * max(values):8.1f}"
    return f"{what:30s} {len(values):5d} {figures} {within:6d}"


def steps(result: handey.PlanResult) -> list[bytes]:
    assert result.plan is not None
    return [step.positions.tobytes() for step in result.plan.steps]


def read_cells(names: list[str], folder: Path) -> list[Ready]:
    known: dict[object, handey.CellFile] = {}
    found = []
    for name in names:
        if name in hard_cells.CELLS:
            made: object = hard_cells.CELLS[name]
            options = handey.PlanOptions()
            write = hard_cells.write_cell
        else:
            made, options = long_cells.CELLS[name].make, long_cells.CELLS[name].options
            write = long_cells.write_cell
        if made not in known:
            known[made] = handey.load_cell(write(name, folder))
        found.append(Ready(name, known[made], options))
    return found


def tell(done: list[Run], deadlines: list[float]) -> None:
    print(f"{'[ms]':30s} {'runs':>5s} {'median':>8s} {'p95':>8s} {'max':>8s} {'<=100':>6s}")
    for seconds in deadlines:
        for kind in (True, False):
            of = [r for r in done if r.seconds == seconds and r.by_deadline == kind]
            if of:
                way = "deadline" if kind else "cancel"
                print(line(f"{way} {seconds:g} s, clock", [r.wall for r in of]))
                print(line(f"{way} {seconds:g} s, CPU", [r.cpu for r in of]))
    for what in ("cell", "stage"):
        for name in sorted({getattr(r, what) for r in done}):
            print(line(f"{what} {name}, CPU", [r.cpu for r in done if getattr(r, what) == name]))
    print(line("all, on the clock", [r.wall for r in done]))
    print(line("all, CPU of the thread", [r.cpu for r in done]))


def main() -> int:
    every = [*long_cells.CELLS, *hard_cells.CELLS]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=200, help="in all")
    parser.add_argument("--deadlines", type=float, nargs="+", default=[0.05, 0.5, 5.0])
    parser.add_argument("--cells", nargs="+", choices=every, default=every)
    options = parser.parse_args()
    easy = handey.load_cell(hard_cells.ROBOT.parents[2] / "cells" / "open_table.yaml")
    expected, same = steps(handey.plan(easy)), True
    done: list[Run] = []
    short: set[tuple[str, float]] = set()
    with tempfile.TemporaryDirectory() as folder:
        cells = read_cells(options.cells, Path(folder))
        turns: Iterator[Ready] = itertools.cycle(cells)
        kinds = itertools.cycle(itertools.product((True, False), options.deadlines))
        for i, (by_deadline, seconds) in enumerate(itertools.islice(kinds, options.runs)):
            for ready in itertools.islice(turns, len(cells)):
                if (ready.name, seconds) in short:
                    continue
                run = stopped(ready, seconds, by_deadline)
                if run is not None:
                    done.append(run)
                    break
                short.add((ready.name, seconds))
            if i % 10 == 9:
                same = same and steps(handey.plan(easy)) == expected
    tell(done, options.deadlines)
    early = ", ".join(f"{name} {seconds:g} s" for name, seconds in sorted(short))
    print(f"ended before: {early or 'none'}; plans afterwards {'the same' if same else 'DIFFER'}")
    return 0 if same and all(r.cpu <= LIMIT for r in done) else 1


if __name__ == "__main__":
    sys.exit(main())
