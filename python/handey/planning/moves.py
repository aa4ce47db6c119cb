"""Single moves: a part to its goal, or aside, from one state of the cell to the next.

Each move is planned with little effort at first, so that a search over many of them does not stop
at the first hard one; then with all. A goal that leaves the pose open is tried at some of its
places.
Not guaranteed: a move that exists is found.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.motion.carry import Carry, Workspace
from handey.motion.stage_clock import StageClock
from handey.planning.goal_places import Places, places_for
from handey.planning.in_the_way import carries, runs_into
from handey.planning.places_aside import places_aside
from handey.planning.plan_options import PlanOptions
from handey.planning.proofs import Proofs, Proved
from handey.planning.state import State
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason
from handey.reporting.report import Report
from handey.resting import Sought
from handey.task import PlaceAt

__all__ = ["Hands", "Mover"]

# Choice: moves tried in one pass of the search, and more of them for each goal.
MOST_TRIES, TRIES_PER_GOAL = 60, 4
MOST_PLACES = (12, 6, 4)  # Choice: of an open goal tried with little effort, and with more
MOST_PLACES_ASIDE = 8  # Choice: of a part moved aside, tried before another part is
WAYS_ON = 2  # Choice: placements of one part from which the search goes on
FAR_AWAY = 50.0  # under the cell, out of the way [m]


class GoalPlanner(Protocol):
    """Plans one part to one pose, steps 1 to 7; tells the report what came of it."""

    def __call__(
        self, work: Workspace, options: PlanOptions, report: GoalReport
    ) -> Carry | None: ...


@dataclass(frozen=True)
class Hands:
    """What the search plans with.

    Attributes:
        model: collision geometry of the cell.
        solver: inverse kinematics of the arm.
        table: makes or reads maps of the arm's plane.
        clock: CPU seconds by stage.
        plan_goal: plans one part to one pose.
        proofs: that a goal cannot be reached; None: they are not looked for.
    """

    model: _core.CollisionModel
    solver: _core.SphericalWristSolver
    table: Callable[[], _core.ArmTable | None]
    clock: StageClock
    plan_goal: GoalPlanner
    proofs: Proofs | None = None


@dataclass
class Mover:
    """Plans moves, and counts how many were tried.

    Attributes:
        effort: 0 little, 1 with regrasps, 2 all that the options allow.
        tries: in this pass.
    """

    cell_file: CellFile
    options: PlanOptions
    hands: Hands
    report: Report
    effort: int = 0
    tries: int = 0
    _places: dict[tuple[object, ...], Places] = field(default_factory=dict)

    def begin(self, effort: int) -> None:
        """Start a pass of the search."""
        self.effort, self.tries = effort, 0

    def is_spent(self) -> bool:
        """Have as many moves been tried as may be?"""
        return self.tries >= MOST_TRIES + TRIES_PER_GOAL * len(self.cell_file.goals)

    def reached(
        self,
        state: State,
        index: int,
        home: Callable[[PlaceAt], np.ndarray | None],
        kept_free: Sequence[PlaceAt],
    ) -> Iterator[State]:
        """States in which a goal was reached.

        Args:
            state: before.
            index: of the goal.
            home: where the arm goes after the part was put somewhere; None to stay.
            kept_free: where other parts are to go.
        """
        report, ways, tried = self.report.goals[index], 0, 0
        for target in self._targets(state.cell, index, kept_free):
            if self.is_spent():
                return
            tried += 1
            carry = self._plan(state, state.cell, target, home(target), report, index)
            if carry is not None:
                ways += 1
                yield state.after(index, target, carry, is_own=True)
                if ways == WAYS_ON:
                    return
        if isinstance(self.cell_file.goals[index], PlaceAt) or ways:
            return
        if tried:
            report.reasons.insert(0, f"{tried} places tried; of the last:")
        else:
            sought = self._places_of(state.cell, index, kept_free).sought
            text, on = f"no place found: {sought.reason()}", (self._fixture(index),)
            report.fail([Reason("no_place", "found", text, end="destination", bodies=on)])

    def _fixture(self, index: int) -> str:
        goal = self.cell_file.goals[index]
        return "" if isinstance(goal, PlaceAt) else goal.fixture

    def in_the_way(
        self, state: State, index: int, movers: Sequence[int], kept_free: Sequence[PlaceAt]
    ) -> list[int] | None:
        """Parts that a motion to a goal meets which is planned as if they were not there.

        Returns:
            Their indices; None if no motion was found, though all of `movers` were away.
        """
        goal, cell = self.cell_file.goals[index], state.cell
        absent = [
            i
            for i in movers
            if cell.parts[i].name != goal.part and not carries(cell, self.hands.model, goal, i)
        ]
        if not absent:
            return None
        for i in absent:
            cell = cell.with_part_at(i, _under(cell.parts[i].X_WB))
        scratch = GoalReport(index, "")
        for target in self._targets(cell, index, kept_free):
            if self.is_spent():
                return []
            carry = self._plan(state, cell, target, None, scratch, index)
            if carry is None:
                continue
            with self.hands.clock("order"):
                return [i for i in absent if self._meets(state, cell, target, carry, i)]
        return None

    def _meets(
        self, state: State, cell: _core.Cell, target: PlaceAt, carry: Carry, other: int
    ) -> bool:
        real = cell.with_part_at(other, state.cell.parts[other].X_WB)
        return runs_into(carry, target, real, self.hands.model, other)

    def moved_aside(
        self, state: State, index: int, part: int, on: list[str], kept_free: Sequence[PlaceAt]
    ) -> Iterator[State]:
        """States in which a part stands out of the way of a goal.

        Args:
            state: before.
            index: of the goal.
            part: index of the part.
            on: names of bodies that it may be put on.
            kept_free: where other parts are to go.
        """
        name, sought = state.cell.parts[part].name, Sought()
        scratch, ways, tried = GoalReport(index, f"{name} aside"), 0, 0
        stream = places_aside(
            state.cell,
            self.hands.model,
            part,
            on=on,
            kept_free=kept_free,
            solver=self.hands.solver,
            seed=self.options.seed,
            sought=sought,
        )
        while tried < MOST_PLACES_ASIDE and ways < WAYS_ON and not self.is_spent():
            with self.hands.clock("placements"):
                target = next(stream, None)
            if target is None:
                break
            tried += 1
            carry = self._plan(state, state.cell, target, None, scratch)
            if carry is not None:
                ways += 1
                yield state.after(index, target, carry, is_own=False)
        if not ways:
            why = f"none of {tried} places could be reached" if tried else sought.reason()
            why = why if on else "no fixture has 'support: true'"
            text = f"{name} could not be moved aside: {why}"
            self.report.goals[index].note(Reason("in_the_way", "found", text, bodies=(name,)))

    def _targets(
        self, cell: _core.Cell, index: int, kept_free: Sequence[PlaceAt]
    ) -> Iterator[PlaceAt]:
        """Poses for a goal, as many as are tried in this pass."""
        places = self._places_of(cell, index, kept_free)
        for number in range(MOST_PLACES[self.effort]):
            with self.hands.clock("placements"):
                target = places.at(number)
            if target is None:
                return
            yield target

    def _places_of(self, cell: _core.Cell, index: int, kept_free: Sequence[PlaceAt]) -> Places:
        """They do not depend on the effort, so each pass goes on with those of the pass before."""
        key = (
            index,
            *(part.X_WB.tobytes() for part in cell.parts),
            *((goal.part, goal.X_WP.tobytes()) for goal in kept_free),
        )
        if key not in self._places:
            sought = Sought()
            stream = places_for(
                self.cell_file.goals[index],
                cell,
                self.hands.model,
                self.hands.solver,
                self.cell_file.cell,
                kept_free=kept_free,
                seed=self.options.seed,
                sought=sought,
            )
            self._places[key] = Places(stream, sought)
        return self._places[key]

    def _plan(
        self,
        state: State,
        cell: _core.Cell,
        target: PlaceAt,
        home: np.ndarray | None,
        report: GoalReport,
        index: int | None = None,
    ) -> Carry | None:
        """One part to one pose; `index` of the goal that cannot be reached if this cannot be."""
        hands = self.hands
        self.tries += 1
        part = cell.part_index(target.part)
        scene = _core.GraspScene(model=hands.model, cell=cell, part=part, X_WP_goal=target.X_WP)
        work = Workspace(
            hands.model, scene, hands.solver, state.current, home, hands.clock, hands.table
        )
        if index is not None:
            work = replace(
                work,
                give_up=lambda legal: self._give_up(index, legal),
                give_part_up=lambda: self._give_part_up(index),
            )
        carry = hands.plan_goal(work, self._options(), report)
        for (action, planner), count in work.given.items():
            counts = self.report.planners.setdefault(action, {})
            counts[planner] = counts.get(planner, 0) + count
        return carry

    def _give_up(self, index: int, legal: bool) -> None:
        """Raise if it is proved that a goal cannot be reached, by its grasps or its motions."""
        proofs = self.hands.proofs
        if proofs is None:
            return
        with self.hands.clock("proofs"):
            proof = proofs.no_way(index) if legal else proofs.no_grasp(index)
        if proof is not None:
            raise Proved(index, proof)

    def _give_part_up(self, index: int) -> None:
        """Raise if it is proved that the part of a goal does not come to it, whoever carries it."""
        proofs = self.hands.proofs
        if proofs is None:
            return
        with self.hands.clock("proofs"):
            proof = proofs.shut_in(index)
        if proof is not None:
            raise Proved(index, proof)

    def _options(self) -> PlanOptions:
        """Of one try: with little effort, one pass over the grasps."""
        if self.effort == 2:
            return self.options
        rounds = self.options.sampling_rounds[:2]
        little = replace(
            self.options, denser=(), sampling_rounds=rounds, most_by_arm=0, thorough=False
        )
        # Another order or another place may spare the regrasp.
        forbidden = replace(self.options.regrasp, most_regrasps=0)
        return little if self.effort else replace(little, regrasp=forbidden)


def _under(X_WP: np.ndarray) -> np.ndarray:
    moved: np.ndarray = X_WP.copy()
    moved[2, 3] -= FAR_AWAY
    return moved
