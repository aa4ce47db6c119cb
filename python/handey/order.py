"""In which order are the goals reached, and what must be moved aside first?

A search, depth first, over the states of the cell that a goal reached or a part moved aside leads
to. Where the order is given, the next goal is the only one; where handey may choose it, those come
first that nothing stands in the way of. Cheap tests tell what does: a part stands on the one to be
moved, or where it is to go. Where they tell nothing and no motion is found, the goal is planned as
if the parts that may move were not there: those that this motion meets are in the way. They are
moved aside, to a placement on a support, clear of where parts are to go. A state that leads nowhere
is left, and the search goes on from the one before.
Not guaranteed: completeness. Each part is moved aside twice at most, and the number of goals tried
is bounded. Article: "Task-level planning", the order of operations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import Protocol

import numpy as np

from handey import _core
from handey.cell_file import CellFile
from handey.goal_places import is_met, places_for, rest_of
from handey.in_the_way import Hindrance, carries, hindrance, runs_into, topmost
from handey.pick_and_place import Carry, Workspace
from handey.plan_options import PlanOptions
from handey.report import GoalReport, Report, StageClock
from handey.resting import PlacementOptions, Sought, placements
from handey.task import Goal, PlaceAt

__all__ = ["Hands", "Move", "plan_order"]

MOST_TRIES = 60  # Choice: goals and parts moved aside tried in one pass of the search
MOST_PLACES = (12, 4)  # Choice: of an open goal tried with little effort, and with all of it
MOST_PLACES_ASIDE = 8  # Choice: of a part moved aside, tried before another part is
WAYS_ON = 2  # Choice: placements of one part from which the search goes on
MOST_ASIDE = 2  # Choice: times that one part is moved aside
# Choice: between a part moved aside and where others go; the jaws must get between [m].
ASIDE = 0.04
FAR_AWAY = 50.0  # under the cell, out of the way [m]


class GoalPlanner(Protocol):
    """Plans one part to one pose, steps 1 to 7; tells the report what came of it."""

    def __call__(
        self, work: Workspace, options: PlanOptions, report: GoalReport, stop_at: float | None
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
        stop_at: when planning stops; None for never.
        respect: raises when it is time to stop.
    """

    model: _core.CollisionModel
    solver: _core.SphericalWristSolver
    table: Callable[[], _core.ArmTable | None]
    clock: StageClock
    plan_goal: GoalPlanner
    stop_at: float | None
    respect: Callable[[], None]


@dataclass(frozen=True)
class Move:
    """One part carried somewhere: to its goal, or aside for the sake of another's."""

    goal: int  # index in the task
    target: PlaceAt
    carry: Carry


@dataclass(frozen=True)
class _State:
    """Where the parts and the arm are after some moves.

    Attributes:
        reached: goals that are done with; of a part's last goal this is asked anew each time where
            the order is free.
    """

    cell: _core.Cell
    current: _core.Configuration
    moves: tuple[Move, ...] = ()
    reached: frozenset[int] = frozenset()


def plan_order(
    cell_file: CellFile, options: PlanOptions, hands: Hands, report: Report
) -> list[Move] | None:
    """The moves that reach all goals; None if none were found: the report's goals say why."""
    search = _Search(cell_file, options, hands, report)
    found = search.run()
    moves = None if found is None else _served(found.moves, cell_file.goals)
    search.conclude(moves)
    return moves


def _served(moves: tuple[Move, ...], goals: tuple[Goal, ...]) -> list[Move]:
    """The moves, with each part moved aside for the sake of the goal that is reached next."""
    found: list[Move] = []
    for move in reversed(moves):
        serves_own = move.target.part == goals[move.goal].part
        found.append(move if serves_own or not found else replace(move, goal=found[-1].goal))
    return found[::-1]


@dataclass
class _Search:
    cell_file: CellFile
    options: PlanOptions
    hands: Hands
    report: Report
    effort: int = 0  # of this pass: 0 little, 1 all
    tries: int = 0
    dead: set[tuple[object, ...]] = field(default_factory=set)
    known: dict[tuple[object, ...], bool] = field(default_factory=dict)
    farthest: tuple[int, list[GoalReport]] = (-1, [])  # moves, and the goals' reports then

    @property
    def goals(self) -> tuple[Goal, ...]:
        return self.cell_file.goals

    @property
    def any_order(self) -> bool:
        return self.cell_file.task.any_order

    def run(self) -> _State | None:
        start = _State(self.cell_file.cell, self.cell_file.cell.start)
        for effort in (0, 1) if self._has_choice() else (1,):
            self.effort, self.tries = effort, 0
            self.dead.clear()
            found = self._go_on(start)
            if found is not None:
                return found
        return None

    def _has_choice(self) -> bool:
        """Is there more than one thing to try?"""
        open_goals = any(not isinstance(goal, PlaceAt) for goal in self.goals)
        may_move = any(part.may_move for part in self.cell_file.cell.parts)
        return open_goals or may_move or (self.any_order and len(self.goals) > 1)

    def conclude(self, moves: list[Move] | None) -> None:
        """Bring the goals' reports in line with what the search came to."""
        if moves is None:
            self.report.goals = self.farthest[1] or self.report.goals
            return
        for index, goal in enumerate(self.report.goals):
            moved = [move.target.part for move in moves if move.goal == index]
            goal.status = "planned" if moved else "met already"
            goal.aside = moved[:-1]

    # What is still to be done.

    def _last_of(self, part: str) -> int:
        return max(i for i, goal in enumerate(self.goals) if goal.part == part)

    def _note_met(self, state: _State) -> _State:
        """Goals that need no move."""
        while True:
            met = [i for i in self._next(state) if not self._is_final(i) and self._met(state, i)]
            if not met:
                return state
            for index in met:
                self.report.goals[index].status = "met already"
            state = replace(state, reached=state.reached | set(met))

    def _is_final(self, index: int) -> bool:
        """Where the order is free, a part may leave its last goal's place and come back."""
        return self.any_order and index == self._last_of(self.goals[index].part)

    def _met(self, state: _State, index: int) -> bool:
        key = (index, *(part.X_WB.tobytes() for part in state.cell.parts))
        if key not in self.known:
            goal, model = self.goals[index], self.hands.model
            self.known[key] = is_met(goal, state.cell, model, self.cell_file.cell)
        return self.known[key]

    def _pending(self, state: _State) -> list[int]:
        return [
            i
            for i in range(len(self.goals))
            if i not in state.reached and not (self._is_final(i) and self._met(state, i))
        ]

    def _next(self, state: _State) -> list[int]:
        """Goals that may be reached next: of each part the first."""
        pending = self._pending(state)
        if not self.any_order:
            return pending[:1]
        first: dict[str, int] = {}
        for index in pending:
            first.setdefault(self.goals[index].part, index)
        return sorted(first.values())

    def _movable(self, state: _State) -> list[int]:
        """Parts that may be moved aside now."""
        found = []
        for index, part in enumerate(state.cell.parts):
            mine = [i for i, goal in enumerate(self.goals) if goal.part == part.name]
            served = {move.goal for move in state.moves if move.target.part == part.name}
            aside = [m for m in state.moves if m.target.part == part.name and m.goal not in mine]
            free = part.may_move
            if mine:
                last = max(mine)
                free = last not in served and (self.any_order or last not in state.reached)
            if free and len(aside) < MOST_ASIDE:
                found.append(index)
        return found

    # The search.

    def _go_on(self, state: _State) -> _State | None:
        state = self._note_met(state)
        pending = self._pending(state)
        if not pending:
            return state
        key = self._key(state)
        if key in self.dead:
            return None
        ready = self._next(state)
        with self.hands.clock("order"):
            seen = {i: hindrance(self.goals[i], state.cell, self.hands.model) for i in ready}
        for index in ready:
            obstacle = seen[index]
            if obstacle is not None:
                self._fail(index, self._words(obstacle))
                continue
            for after in self._reached(state, index):
                found = self._go_on(after)
                if found is not None:
                    return found
        for index in ready:
            for after in self._cleared(state, index, seen[index]):
                found = self._go_on(after)
                if found is not None:
                    return found
        self.dead.add(key)
        self._keep_reports(state, ready)
        return None

    def _keep_reports(self, state: _State, ready: list[int]) -> None:
        """What is told if nothing is found: of the state in which most was done."""
        if len(state.moves) < self.farthest[0]:
            return
        served = {move.goal for move in state.moves if move.target.part == self._part(move.goal)}
        kept = [replace(goal) for goal in self.report.goals]
        for index, goal in enumerate(kept):
            if index in ready:
                goal.status = "failed"
            elif index in served:
                goal.status = "planned"
            elif goal.status != "met already":
                goal.status = "not tried"
        self.farthest = (len(state.moves), kept)

    def _key(self, state: _State) -> tuple[object, ...]:
        poses = [np.round(part.X_WB, 5).tobytes() for part in state.cell.parts]
        aside = sorted(m.target.part for m in state.moves if m.target.part != self._part(m.goal))
        return (*poses, state.reached, *aside)

    def _part(self, index: int) -> str:
        return self.goals[index].part

    def _words(self, obstacle: Hindrance) -> list[str]:
        earlier = "" if self.any_order else "; an earlier goal may clear it"
        return [f"{reason}{earlier}" for reason in obstacle.reasons]

    def _fail(self, index: int, reasons: list[str]) -> None:
        report = self.report.goals[index]
        report.funnel, report.attempts, report.status = {}, [], "failed"
        report.reasons = reasons

    # Moves.

    def _options(self) -> PlanOptions:
        """Of one try: with little effort, one pass over the grasps."""
        if self.effort:
            return self.options
        rounds = self.options.sampling_rounds[:2]
        return replace(
            self.options, denser=(), sampling_rounds=rounds, most_by_arm=0, thorough=False
        )

    def _work(
        self, state: _State, cell: _core.Cell, target: PlaceAt, home: np.ndarray | None
    ) -> Workspace:
        hands = self.hands
        part = cell.part_index(target.part)
        scene = _core.GraspScene(model=hands.model, cell=cell, part=part, X_WP_goal=target.X_WP)
        return Workspace(
            hands.model, scene, hands.solver, state.current, home, hands.clock, hands.table
        )

    def _plan(self, work: Workspace, options: PlanOptions, report: GoalReport) -> Carry | None:
        self.tries += 1
        carry = self.hands.plan_goal(work, options, report, self.hands.stop_at)
        for (action, planner), count in work.given.items():
            counts = self.report.planners.setdefault(action, {})
            counts[planner] = counts.get(planner, 0) + count
        return carry

    def _after(self, state: _State, index: int, target: PlaceAt, carry: Carry) -> _State:
        part = state.cell.part_index(target.part)
        assert carry.end is not None
        return _State(
            state.cell.with_part_at(part, target.X_WP),
            carry.end,
            (*state.moves, Move(index, target, carry)),
            state.reached | {index} if target.part == self._part(index) else state.reached,
        )

    def _home(self, state: _State, index: int, target: PlaceAt) -> np.ndarray | None:
        """Where the arm goes afterwards, if this is the last move."""
        if not self.cell_file.task.return_to_start:
            return None
        part = state.cell.part_index(target.part)
        after = replace(
            state,
            cell=state.cell.with_part_at(part, target.X_WP),
            reached=state.reached | {index},
        )
        left = [i for i in self._pending(after) if not self._met(after, i)]
        return None if left else self.cell_file.cell.start.q

    def _targets(
        self, state: _State, cell: _core.Cell, index: int, sought: Sought
    ) -> Iterator[PlaceAt]:
        """Poses for a goal, as many as are tried in this pass."""
        goal = self.goals[index]
        later = [self.goals[i] for i in self._pending(state) if i != index]
        stream = places_for(
            goal,
            cell,
            self.hands.model,
            self.hands.solver,
            self.cell_file.cell,
            kept_free=[other for other in later if isinstance(other, PlaceAt)],
            seed=self.options.seed,
            sought=sought,
        )
        for _ in range(MOST_PLACES[self.effort]):
            with self.hands.clock("placements"):
                target = next(stream, None)
            if target is None:
                return
            yield target

    def _reached(self, state: _State, index: int) -> Iterator[_State]:
        """States after the goal was reached."""
        report, sought, ways, tried = self.report.goals[index], Sought(), 0, 0
        for target in self._targets(state, state.cell, index, sought):
            if self.tries >= MOST_TRIES:
                return
            self.hands.respect()
            tried += 1
            work = self._work(state, state.cell, target, self._home(state, index, target))
            carry = self._plan(work, self._options(), report)
            if carry is not None:
                ways += 1
                yield self._after(state, index, target, carry)
                if ways == WAYS_ON:
                    return
        if isinstance(self.goals[index], PlaceAt) or ways:
            return
        if tried:
            report.reasons.insert(0, f"{tried} places tried; of the last:")
        else:
            self._fail(index, [f"no place found: {sought.reason()}"])

    # Parts in the way.

    def _cleared(self, state: _State, index: int, obstacle: Hindrance | None) -> Iterator[_State]:
        """States in which something that is in the goal's way was moved aside."""
        movable = self._movable(state)
        if not movable or (obstacle is not None and not obstacle.parts):
            return
        if obstacle is not None:
            blockers = list(obstacle.parts)
        else:
            blockers = self._in_the_way(state, index, movable)
        cell, model = state.cell, self.hands.model
        tops = list(dict.fromkeys(topmost(cell, model, blocker) for blocker in blockers))
        tops = [top for top in tops if cell.parts[top].name != self._part(index)]
        if any(top not in movable for top in tops):
            return
        for top in tops:
            yield from self._moved_aside(state, index, top)

    def _in_the_way(self, state: _State, index: int, movable: list[int]) -> list[int]:
        """Parts that a motion meets which is planned as if they were not there."""
        goal = self.goals[index]
        absent = [
            i
            for i in movable
            if state.cell.parts[i].name != goal.part and not carries(state.cell, goal, i)
        ]
        if not absent:
            return []
        cell = state.cell
        for i in absent:
            cell = cell.with_part_at(i, _under(cell.parts[i].X_WB))
        scratch = GoalReport(index, "")
        for target in islice(self._targets(state, cell, index, Sought()), 2):
            if self.tries >= MOST_TRIES:
                return []
            self.hands.respect()
            carry = self._plan(self._work(state, cell, target, None), self._options(), scratch)
            if carry is None:
                continue
            with self.hands.clock("order"):
                found = []
                for i in absent:
                    real = cell.with_part_at(i, state.cell.parts[i].X_WB)
                    if runs_into(carry, target, real, self.hands.model, i):
                        found.append(i)
            return found
        return []

    def _moved_aside(self, state: _State, index: int, part: int) -> Iterator[_State]:
        """States in which a part stands somewhere on a support, out of the way."""
        cell, model = state.cell, self.hands.model
        name, X_WP = cell.parts[part].name, cell.parts[part].X_WB
        movable = {cell.parts[i].name for i in self._movable(state)}
        bodies = [*cell.fixtures, *cell.parts]
        on = [b.name for b in bodies if b.support and b.name not in {*movable, name}]
        rest = rest_of(_core.resting_poses(cell.parts[part]), X_WP)
        sought = Sought()
        stream = placements(
            cell,
            model,
            part,
            on=on,
            only=None if rest is None else [rest],
            near=X_WP,
            solver=self.hands.solver,
            options=PlacementOptions(seed=self.options.seed),
            sought=sought,
        )
        later = [self.goals[i] for i in self._pending(state)]
        kept = [goal for goal in later if isinstance(goal, PlaceAt) and goal.part != name]
        scratch, ways, tried = GoalReport(index, f"{name} aside"), 0, 0
        while tried < MOST_PLACES_ASIDE and ways < WAYS_ON and self.tries < MOST_TRIES:
            with self.hands.clock("placements"):
                place = next((p for p in stream if self._is_aside(cell, part, p.X_WP, kept)), None)
            if place is None:
                break
            self.hands.respect()
            tried += 1
            target = PlaceAt(name, place.X_WP)
            carry = self._plan(self._work(state, cell, target, None), self._options(), scratch)
            if carry is not None:
                ways += 1
                yield self._after(state, index, target, carry)
        if not ways:
            why = f"none of {tried} places could be reached" if tried else sought.reason()
            why = why if on else "no fixture has 'support: true'"
            self._note(index, f"{name} could not be moved aside: {why}")

    def _note(self, index: int, reason: str) -> None:
        reasons = self.report.goals[index].reasons
        if reason not in reasons:
            reasons.append(reason)

    def _is_aside(self, cell: _core.Cell, part: int, X_WP: np.ndarray, kept: list[PlaceAt]) -> bool:
        """Is a place clear of where the other parts are to go?"""
        there = cell.with_part_at(part, X_WP)
        for goal in kept:
            other = cell.part_index(goal.part)
            later = there.with_part_at(other, goal.X_WP)
            near = _core.touching_bodies(self.hands.model, later, part, ASIDE)
            if any(r.kind == _core.BodyRef.Kind.Part and r.index == other for r in near):
                return False
        return True


def _under(X_WP: np.ndarray) -> np.ndarray:
    moved: np.ndarray = X_WP.copy()
    moved[2, 3] -= FAR_AWAY
    return moved
