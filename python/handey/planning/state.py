"""Where parts and arm are after some moves, and which goals are reached."""

from __future__ import annotations

from dataclasses import dataclass

from handey import _core
from handey.motion.carry import Carry
from handey.task import PlaceAt

__all__ = ["Move", "State"]


@dataclass(frozen=True)
class Move:
    """One part carried somewhere: to its goal, or aside for the sake of another's."""

    goal: int  # index in the task
    target: PlaceAt
    carry: Carry


@dataclass(frozen=True)
class State:
    """Where the parts and the arm are after some moves.

    Attributes:
        reached: goals that are done with; of a part's last goal this is asked anew each time where
            the order is free.
    """

    cell: _core.Cell
    current: _core.Configuration
    moves: tuple[Move, ...] = ()
    reached: frozenset[int] = frozenset()

    def after(self, index: int, target: PlaceAt, carry: Carry, is_own: bool) -> State:
        """The state after a part was carried to a target for the sake of a goal."""
        assert carry.end is not None
        return State(
            self.cell.with_part_at(self.cell.part_index(target.part), target.X_WP),
            carry.end,
            (*self.moves, Move(index, target, carry)),
            self.reached | {index} if is_own else self.reached,
        )
