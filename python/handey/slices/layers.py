"""The cells of a slice of configuration space at one waist angle: theta2 against theta3.

A cell is proved free by the core for every configuration in it (and every wrist value of the
slice's range), or else tried at its centre only: free there, or a collision. What is free at the
centre of a cell that is not proved shows how much the slice leaves unused.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from handey import _core
from handey.cache import table_directory
from handey.errors import Fault, InvalidInput
from handey.slices.legs import Leg

__all__ = ["BLOCKED", "FREE", "NOT_PROVED", "SLICES", "Layer", "make_layers"]

FREE, NOT_PROVED, BLOCKED = 0, 1, 2
SLICES = ("start", "range", "goal")
FINEST = 3  # level of the lattice: one degree (article)


@dataclass(frozen=True, eq=False)
class Layer:
    """The cells of one slice at one waist angle.

    Attributes:
        slice: which: "start", "range" or "goal".
        theta1: waist angle [rad].
        kinds: (theta3 cells, theta2 cells) of FREE, NOT_PROVED, BLOCKED.
        lower: least theta2 and theta3 [rad].
        size: of a cell [rad].
        reason: why no cell of the slice can be free; empty if there is no such reason.
    """

    slice: str
    theta1: float
    kinds: np.ndarray
    lower: tuple[float, float]
    size: tuple[float, float]
    reason: str = ""

    def counts(self) -> dict[str, int]:
        """Cells by kind."""
        names = {FREE: "free", NOT_PROVED: "not_proved", BLOCKED: "blocked"}
        return {name: int(np.count_nonzero(self.kinds == kind)) for kind, name in names.items()}


def make_layers(leg: Leg, theta1: list[float], slices: tuple[str, ...] = SLICES) -> list[Layer]:
    """The layers of some slices of a gross motion at some waist angles, slice by slice.

    Args:
        leg: the gross motion.
        theta1: waist angles [rad].
        slices: of SLICES: with the wrist as at the start, anywhere between, as at the goal.
    """
    checker = _core.CollisionChecker(_core.make_collision_model(leg.cell), leg.cell)
    layers = []
    for name in slices:
        if name == "range":
            layers += _range_layers(checker, leg, theta1)
        else:
            values = leg.positions[0 if name == "start" else -1][3:]
            wrist = _core.WristRange(lower=values, upper=values)
            layers += [_proved_layer(checker, leg, name, wrist, a, FINEST) for a in theta1]
    return layers


def wrist_range(leg: Leg) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest values of the wrist joints between the ends [rad]."""
    ends = leg.positions[[0, -1]][:, 3:]
    return ends.min(axis=0), ends.max(axis=0)


def _proved_layer(
    checker: _core.CollisionChecker,
    leg: Leg,
    name: str,
    wrist: _core.WristRange,
    theta1: float,
    level: int,
) -> Layer:
    options = _core.LayerOptions(level=level)
    layer = _core.prove_layer(checker, theta1, wrist, leg.opening, options)
    return _layer(_core.make_lattice(leg.cell.robot), level, name, theta1, layer.kinds)


def _range_layers(checker: _core.CollisionChecker, leg: Leg, theta1: list[float]) -> list[Layer]:
    """Layers of the range slice, from the robot's tables."""
    lower, upper = wrist_range(leg)
    options = _core.ArmTableOptions(directory=table_directory())
    table, reason = _core.make_arm_table(leg.cell.robot, options)
    if table is None:
        raise InvalidInput(Fault("E_KINEMATICS", "robot.file", f"no range slice: {reason}"))
    wrist = _core.WristRange(lower=lower, upper=upper)
    cells = _core.Slice(checker, table, wrist, leg.opening)
    lattice, level, layers = cells.lattice, cells.level, []
    for angle in theta1:
        tried = _core.prove_layer(
            checker, angle, wrist, leg.opening, _core.LayerOptions(level=level)
        )
        is_blocked = cells.blocked(lattice.index_of(level, 0, angle)).T
        kinds = np.where(is_blocked, np.maximum(tried.kinds, NOT_PROVED), FREE)
        layer = _layer(lattice, level, "range", angle, kinds)
        layers.append(replace(layer, reason=cells.reason))
    return layers


def _layer(
    lattice: _core.Lattice, level: int, name: str, theta1: float, kinds: np.ndarray
) -> Layer:
    lower = (lattice.lower[1], lattice.lower[2])
    size = (lattice.cell_width(level, 1), lattice.cell_width(level, 2))
    return Layer(name, theta1, kinds, lower, size)
