"""The nearest change of a cell with which a goal plans that fails as it is.

A change is told in words and as edits of the cell's or the robot's file, so that it can be applied
as it stands.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["Advice", "Edit"]


@dataclass(frozen=True)
class Edit:
    """One value to be set in a file.

    Attributes:
        file: path of the cell or robot file, as it was given, or of the robot's URDF; empty for a
            cell made in a program.
        place: dotted path of the value: "fixtures.wall.pose.xyz", "task[0].at.xyz",
            "gripper.opening"; mappings on the way are made where they are missing. In a URDF an
            XPath from the root: "joint[@name='left_finger_joint']/limit/@upper".
        value: the new value, of JSON types; None takes the entry out.
    """

    file: str
    place: str
    value: Any


@dataclass(frozen=True)
class Advice:
    """A single change that was planned with.

    Attributes:
        kind: "jaws", "fixture moved", "goal shifted", "goal turned", "support", "may move", ...
        text: for people: "move wall by 60 mm along +y: then goal 0 plans".
        edits: the change.
        size: how large it is, in the unit that the text names [m or rad].
        verified: with all edits applied a plan was found; False would not be told.
    """

    kind: str
    text: str
    edits: tuple[Edit, ...]
    size: float = 0.0
    verified: bool = True

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return vars(self) | {"edits": [vars(edit) for edit in self.edits]}
