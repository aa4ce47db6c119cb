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

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from handey.cell_file import CellFile
from handey.planning.goal_places import is_met
from handey.planning.in_the_way import Hindrance, hindrance, topmost
from handey.planning.moves import Hands, Mover
from handey.planning.plan_options import PlanOptions
from handey.planning.state import Move, State
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason
from handey.reporting.report import Report
from handey.task import Goal, PlaceAt

__all__ = ["plan_order"]

MOST_ASIDE = 2  # Choice: times that one part is moved aside


def plan_order(
    cell_file: CellFile, options: PlanOptions, hands: Hands, report: Report
) -> list[Move] | None:
    """The moves that reach all goals; None if none were found: the report's goals say why."""
    search = _Search(cell_file, hands, report, Mover(cell_file, options, hands, report))
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
    hands: Hands
    report: Report
    mover: Mover
    dead: set[tuple[object, ...]] = field(default_factory=set)
    hopeless: set[tuple[int, bytes]] = field(default_factory=set)
    known: dict[tuple[object, ...], bool] = field(default_factory=dict)
    farthest: tuple[int, list[GoalReport]] = (-1, [])  # moves, and the goals' reports then

    @property
    def goals(self) -> tuple[Goal, ...]:
        return self.cell_file.goals

    @property
    def any_order(self) -> bool:
        return self.cell_file.task.any_order

    def run(self) -> State | None:
        start = State(self.cell_file.cell, self.cell_file.cell.start)
        for effort in (0, 1, 2) if self._has_choice() else (2,):
            self.mover.begin(effort)
            self.dead.clear()
            self.hopeless.clear()
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

    def _note_met(self, state: State) -> State:
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

    def _met(self, state: State, index: int) -> bool:
        key = (index, *(part.X_WB.tobytes() for part in state.cell.parts))
        if key not in self.known:
            goal, model = self.goals[index], self.hands.model
            self.known[key] = is_met(goal, state.cell, model, self.cell_file.cell)
        return self.known[key]

    def _pending(self, state: State) -> list[int]:
        return [
            i
            for i in range(len(self.goals))
            if i not in state.reached and not (self._is_final(i) and self._met(state, i))
        ]

    def _next(self, state: State) -> list[int]:
        """Goals that may be reached next: of each part the first."""
        pending = self._pending(state)
        if not self.any_order:
            return pending[:1]
        first: dict[str, int] = {}
        for index in pending:
            first.setdefault(self.goals[index].part, index)
        return sorted(first.values())

    def _movable(self, state: State) -> list[int]:
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

    def _go_on(self, state: State) -> State | None:
        state = self._note_met(state)
        pending = self._pending(state)
        if not pending:
            return state
        key = self._key(state)
        if key in self.dead:
            return None
        ready = self._next(state)
        meets: dict[int, list[int] | None] = {}
        seen = {index: self._hindrance(state, index) for index in ready}
        for index in ready:
            obstacle, ways = seen[index], 0
            if obstacle is not None:
                self.report.goals[index].fail(self._words(obstacle))
                continue
            for after in self._reached(state, index):
                ways += 1
                found = self._go_on(after)
                if found is not None:
                    return found
            if not ways:
                meets[index] = self._meets(state, index)
                if meets[index] is None:
                    self._leave(state, key, [index])
                    return None
        for index in ready:
            for after in self._cleared(state, index, seen[index], meets.get(index)):
                found = self._go_on(after)
                if found is not None:
                    return found
        self._leave(state, key, ready)
        return None

    def _hindrance(self, state: State, index: int) -> Hindrance | None:
        """What is seen to be in the way; of a goal without alternatives its planner tells that."""
        if not self._has_choice():
            return None
        with self.hands.clock("order"):
            return hindrance(self.goals[index], state.cell, self.hands.model)

    def _leave(self, state: State, key: tuple[object, ...], failed: list[int]) -> None:
        """Nothing leads on from a state."""
        self.dead.add(key)
        self._keep_reports(state, failed)

    def _keep_reports(self, state: State, ready: list[int]) -> None:
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

    def _key(self, state: State) -> tuple[object, ...]:
        poses = [np.round(part.X_WB, 5).tobytes() for part in state.cell.parts]
        aside = sorted(m.target.part for m in state.moves if m.target.part != self._part(m.goal))
        return (*poses, state.reached, *aside)

    def _part(self, index: int) -> str:
        return self.goals[index].part

    def _words(self, obstacle: Hindrance) -> list[Reason]:
        earlier = "" if self.any_order else "; an earlier goal may clear it"
        return [replace(reason, text=f"{reason.text}{earlier}") for reason in obstacle.reasons]

    # Moves.

    def _kept_free(self, state: State, besides: str) -> list[PlaceAt]:
        """Where the other parts are still to go."""
        goals = [self.goals[i] for i in self._pending(state)]
        return [goal for goal in goals if isinstance(goal, PlaceAt) and goal.part != besides]

    def _reached(self, state: State, index: int) -> Iterator[State]:
        """States after the goal was reached; none if that is known to be hopeless."""
        if self._place(state, index) in self.hopeless:
            return
        kept_free = self._kept_free(state, self._part(index))
        yield from self.mover.reached(
            state, index, lambda target: self._home(state, index, target), kept_free
        )

    def _home(self, state: State, index: int, target: PlaceAt) -> np.ndarray | None:
        """Where the arm goes afterwards, if this is the last move."""
        if not self.cell_file.task.return_to_start:
            return None
        part = state.cell.part_index(target.part)
        cell = state.cell.with_part_at(part, target.X_WP)
        after = replace(state, cell=cell, reached=state.reached | {index})
        left = [i for i in self._pending(after) if not self._met(after, i)]
        return None if left else self.cell_file.cell.start.q

    def _place(self, state: State, index: int) -> tuple[int, bytes]:
        """A goal, and where its part is."""
        part = state.cell.parts[state.cell.part_index(self._part(index))]
        return index, np.round(part.X_WB, 5).tobytes()

    def _meets(self, state: State, index: int) -> list[int] | None:
        """Parts in the way of a goal that was not reached; None if it is hopeless.

        What cannot be reached with all away that ever moves cannot be in any other order either.
        """
        if self._place(state, index) in self.hopeless:
            return None
        with_goal = {goal.part for goal in self.goals}
        parts = state.cell.parts
        movers = [i for i, p in enumerate(parts) if p.may_move or p.name in with_goal]
        kept_free = self._kept_free(state, self._part(index))
        found = self.mover.in_the_way(state, index, movers, kept_free)
        if found is None:
            self.hopeless.add(self._place(state, index))
        return found

    def _cleared(
        self, state: State, index: int, obstacle: Hindrance | None, meets: list[int] | None
    ) -> Iterator[State]:
        """States in which something that is in the goal's way was moved aside."""
        movable, cell, model = self._movable(state), state.cell, self.hands.model
        blockers = list(obstacle.parts) if obstacle is not None else meets or []
        tops = list(dict.fromkeys(topmost(cell, model, blocker) for blocker in blockers))
        tops = [top for top in tops if cell.parts[top].name != self._part(index)]
        if any(top not in movable for top in tops):
            return
        may_move = {cell.parts[i].name for i in movable}
        bodies = [*cell.fixtures, *cell.parts]
        on = [body.name for body in bodies if body.support and body.name not in may_move]
        for top in tops:
            kept_free = self._kept_free(state, cell.parts[top].name)
            own = [name for name in on if name != cell.parts[top].name]
            yield from self.mover.moved_aside(state, index, top, own, kept_free)
