"""Cells, each broken by one known cause: is the cause told, and does the advice mend them?

Told of each: the verdict, the cause that the report names and whether it is the true one, the
advice and whether the cell plans once it is applied to copies of its files, with a plan that the
check finds valid; CPU seconds of planning, diagnosis and advice together. That each has one cause
is shown by its healthy twin, the same without the break, which must plan.

A cell that the reader refuses is told of where the refusal states the break; no advice is given.

    python tests/broken_cells.py
    python tests/broken_cells.py --batch fresh
    python tests/broken_cells.py --only slot_too_deep --healthy -v
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import broken_ends
import broken_fresh
import broken_later
import broken_ways
import numpy as np
import yaml
from broken_truth import CELLS, Broken

import handey
from handey.advising.change import with_edits
from handey.reporting.advice import Advice
from handey.reporting.failure_text import failure_lines
from handey.reporting.goal_report import GoalReport

__all__ = ["CELLS", "Answer", "answer", "is_planned"]

# Importing them fills CELLS. By those of "first" the diagnosis was made; the others were written
# down before any of them was planned.
BATCHES = {
    "first": (broken_ends, broken_ways),
    "fresh": (broken_fresh,),
    "later": (broken_later,),
}
LIMIT = 2.0  # s


@dataclass(frozen=True)
class Answer:
    """What came of a broken cell.

    Attributes:
        broken: the cell.
        verdict: of planning it, or "refused".
        told: the report of the goal that it breaks; None if it was refused.
        is_told: the true cause is named.
        is_mended: the advice, applied, makes it plan, with a valid plan.
        cpu_s, wall_s: seconds until the answer, with diagnosis and advice.
        faults: why it was refused.
    """

    broken: Broken
    verdict: str
    told: GoalReport | None
    is_told: bool
    is_mended: bool
    cpu_s: float
    wall_s: float
    faults: tuple[str, ...] = ()

    def row(self) -> str:
        """One line of the table."""
        cause = self.told.cause if self.told else None
        advice = self.told.advice if self.told else None
        why = f"{cause.kind}: {cause.text}" if cause else "; ".join(self.faults) or "-"
        cells = (
            f"{self.broken.name:29} {self.verdict:10}",
            f"{'right' if self.is_told else 'WRONG':5} {why[:120]}",
            f"{'plans' if self.is_mended else 'NO'}: {advice.text[:100] if advice else '-'}",
            f"{self.cpu_s:.2f} s ({self.wall_s:.2f} s)",
        )
        return " | ".join(cells)


def answer(broken: Broken, folder: Path, options: handey.PlanOptions | None = None) -> Answer:
    """Plan a broken cell; apply the advice to copies of its files, and plan these."""
    path = broken.write(folder / "broken", is_broken=True)
    begin = time.process_time(), time.perf_counter()
    try:
        cell = handey.load_cell(path)
    except handey.InvalidInput as error:
        took = time.process_time() - begin[0], time.perf_counter() - begin[1]
        faults = tuple(str(fault) for fault in error.faults)
        is_told = broken.is_refused(error.faults)
        return Answer(broken, "refused", None, is_told, False, *took, faults)
    report = handey.plan(cell, options).report
    goal = report.goals[broken.goal]
    is_mended = goal.advice is not None and is_mended_by(goal.advice, path)
    is_told = broken.is_told(goal.cause)
    return Answer(broken, report.verdict, goal, is_told, is_mended, report.cpu_s, report.wall_s)


def is_mended_by(advice: Advice, path: Path) -> bool:
    """Does a copy of the cell plan once the advice is applied to it?"""
    mended = path.parent.with_name("mended")
    shutil.copytree(path.parent, mended)
    apply(advice, mended)
    return is_planned(mended / path.name)


def apply(advice: Advice, folder: Path) -> None:
    """Set what the edits say, in the files of the same names in a folder."""
    for file in {edit.file for edit in advice.edits}:
        edits = [edit for edit in advice.edits if edit.file == file]
        path = folder / Path(file).name
        if path.suffix != ".urdf":
            content = with_edits(yaml.safe_load(path.read_text()), edits)
            path.write_text(yaml.safe_dump(content, sort_keys=False))
            continue
        tree = ElementTree.parse(path)
        for edit in edits:
            element, _, attribute = edit.place.rpartition("/@")
            (found,) = tree.getroot().findall(element)
            found.set(attribute, repr(edit.value))
        tree.write(path)


def is_planned(path: Path) -> bool:
    """Is there a plan, and is it valid?"""
    result = handey.plan(handey.load_cell(path), handey.PlanOptions(advice=False))
    return result.plan is not None and handey.check(path, result.plan).ok


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--batch", choices=[*BATCHES, "all"], default="all")
    parser.add_argument("--only", help="names of cells, with commas between")
    parser.add_argument("--healthy", action="store_true", help="plan the healthy twins too")
    parser.add_argument("--seconds", type=float, default=1.0, help="for advice, by the clock")
    parser.add_argument("-v", "--verbose", action="store_true", help="print the reports")
    args = parser.parse_args()
    chosen = {maker.__name__ for maker in BATCHES.get(args.batch, sum(BATCHES.values(), ()))}
    names = [name for name, broken in CELLS.items() if broken.batch in chosen]
    names = args.only.split(",") if args.only else names
    options = handey.PlanOptions(advice_seconds=args.seconds, deadline=30.0)
    answers: list[Answer] = []
    for name in names:
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            if args.healthy and not is_planned(CELLS[name].write(folder / "healthy", False)):
                print(f"{name}: the healthy twin does not plan")
            answers.append(answer(CELLS[name], folder, options))
        print(answers[-1].row(), flush=True)
        if args.verbose and answers[-1].told is not None:
            print("\n".join(failure_lines(answers[-1].told)))
    cpu = [each.cpu_s for each in answers]
    print(
        f"broken: {len(answers)} cells, the cause told of {sum(a.is_told for a in answers)}, "
        f"mended by the advice {sum(a.is_mended for a in answers)}; answers within {LIMIT:g} s "
        f"{sum(s <= LIMIT for s in cpu)}, CPU median {np.median(cpu):.2f} s, most {max(cpu):.2f} s"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
