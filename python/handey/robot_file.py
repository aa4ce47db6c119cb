"""What does the robot file say that a URDF does not, and which robot do both describe?

Reads the YAML robot file (docs: formats, section 1) strictly, then has the compiled core read the
URDF with it. The faults of both files are reported together where the robot file says enough to
look at the URDF at all.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from handey.errors import Fault, InvalidInput
from handey.formats.fields import Field
from handey.formats.pose import read_pose
from handey.formats.strict_yaml import read_yaml

if TYPE_CHECKING:
    from handey import _core

__all__ = ["GripperEntry", "RobotEntry", "load_robot", "read_robot"]

VERSION = 1


@dataclass(frozen=True)
class GripperEntry:
    """The parallel jaw, as the robot file gives it."""

    link: str
    X_LH: np.ndarray  # grasp frame in the link, (4, 4)
    fingers: tuple[str, str]
    opening: tuple[float, float]  # least, greatest distance between the pads [m]
    pad: tuple[float, float]  # width along x, length along z of the grasp frame [m]


@dataclass(frozen=True)
class RobotEntry:
    """The content of a robot file; the URDF is not read yet."""

    file: Path
    name: str
    urdf: Path
    arm: tuple[str, ...]
    home: tuple[float, ...]  # [rad]
    acceleration: tuple[float, ...]  # [rad/s2]; empty: the default of the core
    gripper: GripperEntry
    ignore_collisions: tuple[tuple[str, str], ...]


def read_robot(path: str | os.PathLike[str]) -> RobotEntry:
    """Reads a robot file without its URDF.

    Raises:
        InvalidInput: with every fault of the file.
    """
    document = read_yaml(path)
    entries = Field(document, (), document.value).mapping(
        required=("handey_robot", "name", "urdf", "arm", "home", "gripper"),
        optional=("acceleration", "ignore_collisions"),
    )
    entries = entries or {}
    if "handey_robot" in entries:
        entries["handey_robot"].version(VERSION)
    name = entries["name"].text() if "name" in entries else None
    urdf = entries["urdf"].file() if "urdf" in entries else None
    arm = _distinct(entries["arm"], "joint") if "arm" in entries else None
    home = _per_joint(entries.get("home"), arm)
    acceleration = (
        _per_joint(entries.get("acceleration"), arm, above=0.0) if "acceleration" in entries else ()
    )
    gripper = _read_gripper(entries["gripper"]) if "gripper" in entries else None
    ignored = _read_pairs(entries["ignore_collisions"]) if "ignore_collisions" in entries else ()
    if gripper is not None and arm is not None:
        for joint in sorted(set(gripper.fingers) & set(arm)):
            message = f"'{joint}' is an arm joint; a finger joint is another one"
            entries["gripper"].fault("E_DUP", message)
    document.raise_faults()
    assert name and urdf and arm and home and gripper and acceleration is not None
    return RobotEntry(Path(path), name, urdf, arm, home, acceleration, gripper, ignored)


def load_robot(path: str | os.PathLike[str]) -> tuple[_core.Robot, list[str]]:
    """Reads a robot file and its URDF.

    Returns:
        The robot and the warnings of its URDF.

    Raises:
        InvalidInput: with every fault of the robot file, or of the URDF and what is said of it.
    """
    entry = read_robot(path)
    return build_robot(entry)


def build_robot(entry: RobotEntry) -> tuple[_core.Robot, list[str]]:
    """The robot that a robot file and its URDF describe, and the warnings of the URDF."""
    from handey import _core

    description = _core.RobotDescription(
        name=entry.name,
        arm=list(entry.arm),
        home=list(entry.home),
        acceleration=list(entry.acceleration),
        gripper_link=entry.gripper.link,
        X_LH=entry.gripper.X_LH,
        fingers=list(entry.gripper.fingers),
        min_opening=entry.gripper.opening[0],
        max_opening=entry.gripper.opening[1],
        pad_width=entry.gripper.pad[0],
        pad_length=entry.gripper.pad[1],
        ignore_collisions=list(entry.ignore_collisions),
    )
    try:
        loaded = _core.load_robot(os.fspath(entry.urdf), description)
    except InvalidInput as error:
        raise InvalidInput([_in_file(fault, entry) for fault in error.faults]) from None
    said = [_within(entry.urdf.name, warning) for warning in loaded.warnings]
    return loaded.robot, [f"{entry.urdf}: {warning}" for warning in said]


def _in_file(fault: Fault, entry: RobotEntry) -> Fault:
    """The fault with its file: the URDF, whose name then starts the place, or the robot file."""
    for name in (os.fspath(entry.urdf), entry.urdf.name):
        if fault.place.startswith(name):
            place = _within(name, fault.place)
            return Fault(fault.code, place, fault.message, os.fspath(entry.urdf))
    return Fault(fault.code, fault.place, fault.message, fault.file or os.fspath(entry.file))


def _within(name: str, place: str) -> str:
    """The place without the file's name before it: "line 12: joint 'joint2'"."""
    return re.sub(r"^(\d+)", r"line \1", place.removeprefix(name).lstrip(": "))


def _distinct(field: Field, what: str) -> tuple[str, ...] | None:
    names = field.texts()
    if names is None:
        return None
    if not names:
        field.fault("E_TYPE", f"expected at least one {what}, found none")
        return None
    twice = sorted({name for name in names if names.count(name) > 1})
    for name in twice:
        field.fault("E_DUP", f"'{name}' is named twice")
    return None if twice else tuple(names)


def _per_joint(
    field: Field | None, arm: tuple[str, ...] | None, **limits: float
) -> tuple[float, ...] | None:
    """One number for each arm joint."""
    if field is None:
        return None
    numbers = field.numbers(None if arm is None else len(arm), code="E_DOF", **limits)
    return None if numbers is None else tuple(numbers.tolist())


def _read_gripper(field: Field) -> GripperEntry | None:
    entries = field.mapping(required=("link", "grasp_frame", "fingers", "opening", "pad"))
    if entries is None:
        return None
    link = entries["link"].text() if "link" in entries else None
    X_LH = read_pose(entries["grasp_frame"]) if "grasp_frame" in entries else None
    fingers = entries["fingers"].texts(2) if "fingers" in entries else None
    if fingers and fingers[0] == fingers[1]:
        entries["fingers"].fault(
            "E_DUP", f"'{fingers[0]}' is named twice; expected two finger joints"
        )
    opening = entries["opening"].numbers(2, least=0.0, most=1.0) if "opening" in entries else None
    if opening is not None and not opening[0] < opening[1]:
        message = (
            f"expected the least opening, then a greater one, found {opening[0]:g}, {opening[1]:g}"
        )
        entries["opening"].fault("E_RANGE", message)
    pad = _read_pad(entries["pad"]) if "pad" in entries else None
    if link is None or X_LH is None or fingers is None or opening is None or pad is None:
        return None
    least, greatest = opening.tolist()
    return GripperEntry(link, X_LH, (fingers[0], fingers[1]), (least, greatest), pad)


def _read_pad(field: Field) -> tuple[float, float] | None:
    entries = field.mapping(required=("width", "length")) or {}
    sizes = [
        entries[key].number(above=0.0, most=1.0) for key in ("width", "length") if key in entries
    ]
    if len(sizes) != 2 or sizes[0] is None or sizes[1] is None:
        return None
    return sizes[0], sizes[1]


def _read_pairs(field: Field) -> tuple[tuple[str, str], ...]:
    pairs = []
    for item in field.items() or []:
        names = item.texts(2)
        if names is not None:
            pairs.append((names[0], names[1]))
    return tuple(pairs)
