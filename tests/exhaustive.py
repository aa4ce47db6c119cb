"""Is there a way at all? An exhaustive search for one direct goal, to judge the planner by.

All grasps on a fine lattice (every feature pair, hand poses every 6 mm and 5 degrees, both half
turns, several openings, every configuration of the arm at both ends) are tried in random order;
from a legal one the hand is led out along straight lines in many directions or, where these are
blocked, by a flood of (x, y, theta) in the grasp plane; gross motions join the ends. Every edge is
certified, and a way counts only as a whole plan that `handey check` calls valid. No ranking, no
merit, no heuristic of the planner takes part. Not guaranteed: that a cell without a way has none;
the verdict says whether the search was cut off.

    python tests/exhaustive.py CELL [--seconds 60] [-o PLAN]
"""

from __future__ import annotations

import argparse
import dataclasses
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
from exhaustive_grasps import LEAST_CONTACT, Ends, Grasp, Lattice, OutOfTime, Stopwatch
from exhaustive_motions import Way, WaysOut

import handey
from handey import _core
from handey.cache import table_directory

ROUNDS = (1000, 8000, 40000)  # iterations of the gross motions, round after round


@dataclasses.dataclass(frozen=True)
class Local:
    """The motions near obstacles for one grasp: ways from the contact outwards."""

    grasp: Grasp
    out: Way  # the empty hand's, from the open grasp
    depart: Way
    places: list[tuple[Way, Way]]  # part's, hand's
    how: str


@dataclasses.dataclass
class Verdict:
    """What the search found.

    Attributes:
        solvable: a valid plan was found.
        cut_off: time ran out before the lattice was done; without a plan nothing is then proved.
        plan: the valid plan.
        grasp: that it uses.
        how: how the hand was led out from the grasp.
        seconds: of the processor.
        counts: hand poses by where they fell.
    """

    solvable: bool = False
    cut_off: bool = False
    plan: handey.Plan | None = None
    grasp: Grasp | None = None
    how: str = ""
    seconds: float = 0.0
    counts: Counter = dataclasses.field(default_factory=Counter)

    def __str__(self) -> str:
        state = "solvable" if self.solvable else "cut off" if self.cut_off else "no way found"
        counts = ", ".join(f"{count} {name}" for name, count in self.counts.items())
        return f"{state} in {self.seconds:.1f} s ({counts})"


class Search:
    """One goal of one cell; the cell as it is at the start."""

    def __init__(
        self,
        cell_file: handey.CellFile,
        seconds: float,
        seed: int = 0,
        least_contact: float = LEAST_CONTACT,
    ) -> None:
        self.cell_file, self.seed = cell_file, seed
        self.ends, self.watch = Ends(cell_file), Stopwatch(seconds)
        self.lattice = Lattice(self.ends, self.watch, seed, least_contact)
        self.ways = WaysOut(self.ends, self.watch)
        tables = _core.ArmTableOptions(directory=table_directory())
        self.table, _ = _core.make_arm_table(self.ends.robot, tables)
        self.verdict = Verdict(counts=self.lattice.counts)

    def run(self) -> Verdict:
        kept: list[Local] = []
        try:
            for grasp in self.lattice.grasps():
                local = self.lead_out(grasp)
                if local is None:
                    continue
                self.verdict.counts["led out at both ends"] += 1
                if self.join(local, ROUNDS[0]):
                    return self.done()
                kept.append(local)
            for iterations in ROUNDS[1:]:
                for local in kept:
                    if self.join(local, iterations):
                        return self.done()
        except OutOfTime:
            self.verdict.cut_off = True
        return self.done()

    def done(self) -> Verdict:
        self.verdict.seconds = self.watch.passed
        return self.verdict

    def lead_out(self, grasp: Grasp) -> Local | None:
        """Ways out of the contact for hand and part, at both ends; the first of each that works."""
        counts = self.verdict.counts
        for q_pick in grasp.q_pick[:4]:
            self.watch.respect()
            out, how = self.ways.empty_hand_out(self.ends.before, grasp, q_pick)
            if not out:
                counts["not approached"] += 1
                continue
            depart = self.ways.lift(self.ends.cell, grasp, q_pick)
            if not depart:
                counts["not lifted"] += 1
                continue
            places = []
            for q_place in grasp.q_place[:6]:
                deposit = self.ways.lift(self.ends.goal_cell, grasp, q_place)
                if not deposit:
                    counts["not put down"] += 1
                    continue
                withdraw, _ = self.ways.empty_hand_out(self.ends.after, grasp, q_place)
                if withdraw:
                    places.append((deposit, withdraw))
                else:
                    counts["not withdrawn"] += 1
            if places:
                return Local(grasp, out, depart, places, how)
        return None

    def join(self, local: Local, iterations: int) -> bool:
        """Join the local motions by gross motions; True with a valid plan."""
        self.watch.respect()
        counts = self.verdict.counts
        options = _core.GrossOptions(
            free_space=_core.FreeSpaceOptions(table=self.table),
            search=_core.SearchOptions(max_proofs=5 * iterations),
            separation=_core.SeparationOptions(most_cells=0),
            sampling=_core.SamplingOptions(seed=self.seed, max_iterations=iterations),
        )
        start, grasp = self.ends.cell.start, local.grasp
        opened = _core.Configuration(q=start.q, opening=grasp.opening)
        if not _core.certify_edge(self.ends.before, start, opened).is_free:
            counts["no room to open the hand at the start"] += 1
            return False
        transit = _core.plan_gross_motion(self.ends.before, opened, [local.out[-1]], options)
        if not transit:
            counts["not joined to the start"] += 1
            return False
        held = self.ends.cell.with_held(self.ends.part, np.linalg.inv(grasp.X_PH))
        carried = _core.CollisionChecker(self.ends.model, held)
        goals = [deposit[-1] for deposit, _ in local.places]
        transfer = _core.plan_gross_motion(carried, local.depart[-1], goals, options)
        if not transfer:
            counts["not joined to the destination"] += 1
            return False
        deposit, withdraw = local.places[transfer.goal]
        end = _core.Configuration(q=start.q, opening=grasp.opening)
        home = _core.plan_gross_motion(self.ends.after, withdraw[-1], [end], options)
        if not home:
            counts["not joined to the end"] += 1
            return False
        shut_pick = _core.Configuration(q=local.out[0].q, opening=grasp.width)
        shut_place = _core.Configuration(q=withdraw[0].q, opening=grasp.width)
        plan = self.timed(
            grasp,
            [
                ("transit", [start, *transit.path]),
                ("approach", local.out[::-1]),
                ("grasp", [local.out[0], shut_pick]),
                ("depart", local.depart),
                ("transfer", list(transfer.path)),
                ("deposit", deposit[::-1]),
                ("release", [shut_place, withdraw[0]]),
                ("withdraw", withdraw),
                ("transit", list(home.path)),
            ],
        )
        if not self.is_valid(plan):
            counts["not valid"] += 1
            return False
        self.verdict.solvable, self.verdict.plan = True, plan
        self.verdict.grasp, self.verdict.how = grasp, local.how
        return True

    def timed(
        self, grasp: Grasp, motions: list[tuple[str, list[_core.Configuration]]]
    ) -> handey.Plan:
        clock, steps = 0.0, []
        X_HP = np.linalg.inv(grasp.X_PH)
        for action, path in motions:
            rests = all(
                np.array_equal(path[0].q, c.q) and c.opening == path[0].opening for c in path[1:]
            )
            if rests and action in ("transit", "transfer"):
                continue
            timed = _core.time_path(self.ends.robot, path)
            held = action in ("depart", "transfer", "deposit")
            steps.append(
                handey.Step(
                    action=action,
                    goal=0,
                    part=self.ends.name if held else None,
                    part_in_grasp_frame=X_HP if held else None,
                    time=clock + np.array(timed.time),
                    positions=np.array([c.q for c in timed.configurations]),
                    opening=np.array([c.opening for c in timed.configurations]),
                )
            )
            clock += timed.duration
        return handey.Plan(
            cell=self.cell_file.name,
            joints=tuple(joint.name for joint in self.ends.robot.joints),
            steps=tuple(steps),
            placements={self.ends.name: self.ends.X_WP_goal},
        )

    def is_valid(self, plan: handey.Plan) -> bool:
        """By the checker, which shares no code with planner or search."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "plan.json"
            plan.save(out)
            checked = handey.check(self.cell_file.file, out)
        self.faults = [str(fault) for fault in checked.faults[:3]]
        return checked.ok


def search(
    cell: Path, seconds: float = 60.0, seed: int = 0, least_contact: float = LEAST_CONTACT
) -> Verdict:
    """Look for a way for the first goal of a cell, for so many seconds of the processor."""
    return Search(handey.load_cell(cell), seconds, seed, least_contact).run()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cell", type=Path)
    parser.add_argument("--seconds", type=float, default=60.0, help="of the processor, at most")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("-o", "--output", type=Path, help="the valid plan that was found")
    args = parser.parse_args()
    verdict = search(args.cell, args.seconds, args.seed)
    print(verdict)
    if verdict.plan is not None and args.output is not None:
        verdict.plan.save(args.output)
    return 0 if verdict.solvable else 3


if __name__ == "__main__":
    sys.exit(main())
