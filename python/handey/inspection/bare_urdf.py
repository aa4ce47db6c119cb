"""Which robot does a URDF describe, read without the robot file that planning needs?

A URDF does not say which joints are the arm, which are the fingers, or where the grasp frame is. If
it has just two prismatic joints that hang on one chain of revolute ones, they are taken for fingers
and the chain for the arm. If it has none, the longest chain is the arm, and fingers without shape
are made up at its end: then kinematics and reach are told, and shapes are not looked at. What was
taken for what is told as a warning; the grasp frame is the frame of the last link.
"""

from __future__ import annotations

import math
import os
import re
import tempfile
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from handey import _core
from handey.errors import Fault, InvalidInput

__all__ = ["BareRobot", "load_bare_urdf"]

MOST_BYTES = 16 << 20
NEEDED = "a robot file says which joints are the arm and the fingers"
MADE_UP = ("made_up_finger_a", "made_up_finger_b")


@dataclass(frozen=True)
class BareRobot:
    """A robot that a URDF alone describes.

    Attributes:
        robot: with what was taken for arm and fingers.
        has_jaws: False where the fingers are made up.
        warnings: what was taken for what comes first.
    """

    robot: _core.Robot
    has_jaws: bool
    warnings: tuple[str, ...]


def load_bare_urdf(path: str | os.PathLike[str]) -> BareRobot:
    """Reads a URDF alone.

    Raises:
        InvalidInput: if arm and fingers cannot be told, or with the faults of the file.
    """
    file = os.fspath(path)
    root = _root(file)
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    fingers = [name for name, joint in joints.items() if joint.get("type") == "prismatic"]
    if not fingers:
        return _without_fingers(file, root, joints)
    if len(fingers) != 2:
        raise _fault(file, f"found {len(fingers)} prismatic joints, expected two fingers; {NEEDED}")
    arms = [_arm_to(joints, _link(joints[finger], "parent")) for finger in fingers]
    if arms[0] != arms[1] or not arms[0]:
        raise _fault(file, f"{fingers[0]} and {fingers[1]} hang on different chains; {NEEDED}")
    bounds = [_limits(joints[finger]) for finger in fingers]
    link = _link(joints[fingers[0]], "parent")
    opening = (2 * max(0.0, *(low for low, _ in bounds)), 2 * min(high for _, high in bounds))
    robot, said = _load(file, file, joints, arms[0], link, fingers, opening)
    taken = (
        f"no robot file: arm {', '.join(arms[0])}; fingers {', '.join(fingers)}; grasp point at "
        f"the origin of '{link}', pads and accelerations are guesses"
    )
    return BareRobot(robot, True, (taken, *said))


def _without_fingers(
    file: str, root: ElementTree.Element, joints: dict[str, ElementTree.Element]
) -> BareRobot:
    """The arm alone: the longest chain, its end the grasp frame."""
    links = [link.get("name", "") for link in root.findall("link")]
    arms = {link: _arm_to(joints, link) for link in links}
    longest = max((len(arm) for arm in arms.values()), default=0)
    ends = [link for link, arm in arms.items() if len(arm) == longest]
    if not longest or len({tuple(arms[link]) for link in ends}) != 1:
        raise _fault(file, f"found no single longest chain of revolute joints; {NEEDED}")
    link = max(ends, key=lambda name: len(_chain_to(joints, name)))  # the flange or tool, if fixed
    for body in root.findall("link"):
        for tag in ("collision", "visual", "inertial"):
            for element in body.findall(tag):
                body.remove(element)
    for finger in MADE_UP:
        ElementTree.SubElement(root, "link", name=f"{finger}_link")
        joint = ElementTree.SubElement(root, "joint", name=finger, type="prismatic")
        ElementTree.SubElement(joint, "parent", link=link)
        ElementTree.SubElement(joint, "child", link=f"{finger}_link")
        ElementTree.SubElement(joint, "axis", xyz="0 1 0" if finger == MADE_UP[0] else "0 -1 0")
        limit = {"lower": "0", "upper": "0.05", "velocity": "1", "effort": "1"}
        ElementTree.SubElement(joint, "limit", limit)
    with tempfile.TemporaryDirectory() as folder:
        made = str(Path(folder) / "robot.urdf")
        ElementTree.ElementTree(root).write(made, encoding="utf-8", xml_declaration=True)
        arm = arms[link]
        robot, said = _load(file, made, joints, arm, link, list(MADE_UP), (0.0, 0.1))
    taken = (
        f"no robot file and no fingers: arm {', '.join(arm)}; the reach is that of the origin of "
        f"'{link}'; shapes are not looked at"
    )
    return BareRobot(robot, False, (taken, *(words for words in said if "made_up" not in words)))


def _load(
    file: str,
    read: str,
    joints: dict[str, ElementTree.Element],
    arm: list[str],
    link: str,
    fingers: list[str],
    opening: tuple[float, float],
) -> tuple[_core.Robot, list[str]]:
    """The robot and the warnings of its file; `read` is the file or a copy of it."""
    description = _core.RobotDescription(
        name="",
        arm=arm,
        home=[_home(joints[name]) for name in arm],
        gripper_link=link,
        X_LH=np.eye(4),
        fingers=fingers,
        min_opening=opening[0],
        max_opening=opening[1],
    )
    try:
        loaded = _core.load_robot(read, description)
    except InvalidInput as error:
        faults = [
            Fault(fault.code, _place(fault.place, file, read), fault.message, file)
            for fault in error.faults
        ]
        raise InvalidInput(faults) from None
    return loaded.robot, [_place(warning, file, read) for warning in loaded.warnings]


def _place(words: str, file: str, read: str) -> str:
    """Without the name of the file that was read; lines of a copy say nothing."""
    for name in (read, os.path.basename(read)):
        words = words.removeprefix(name).lstrip(": ")
    return re.sub(r"^(\d+)(: )?", r"line \1\2" if read == file else "", words)


def _root(file: str) -> ElementTree.Element:
    if file.endswith(".xacro"):
        raise _fault(file, "xacro is not read; expand it to a URDF first")
    try:
        if os.path.getsize(file) > MOST_BYTES:
            raise _fault(file, f"found more than {MOST_BYTES >> 20} MB")
        root = ElementTree.parse(file).getroot()
    except OSError as error:
        raise _fault(file, f"cannot be read: {error.strerror}", "E_PATH") from error
    except (ElementTree.ParseError, UnicodeError, LookupError) as error:
        raise _fault(file, f"not XML: {error}", "E_XML") from error
    if root.tag != "robot":
        raise _fault(file, f"expected a URDF, found <{root.tag}>")
    return root


def _chain_to(joints: dict[str, ElementTree.Element], link: str) -> list[str]:
    """Names of the joints from the root to a link."""
    parents = {_link(joint, "child"): name for name, joint in joints.items()}
    chain: list[str] = []
    name = parents.get(link)
    while name is not None and name not in chain:
        chain.insert(0, name)
        name = parents.get(_link(joints[name], "parent"))
    return chain


def _arm_to(joints: dict[str, ElementTree.Element], link: str) -> list[str]:
    """The joints that turn, of the chain to a link."""
    turning = ("revolute", "continuous")
    return [name for name in _chain_to(joints, link) if joints[name].get("type") in turning]


def _link(joint: ElementTree.Element, end: str) -> str:
    found = joint.find(end)
    return "" if found is None else found.get("link", "")


def _limits(joint: ElementTree.Element) -> tuple[float, float]:
    limit = joint.find("limit")
    try:
        values = [0.0 if limit is None else float(limit.get(k, 0.0)) for k in ("lower", "upper")]
    except ValueError:  # the core tells it with its place
        values = [0.0, 0.0]
    return (values[0], values[1]) if all(map(math.isfinite, values)) else (0.0, 0.0)


def _home(joint: ElementTree.Element) -> float:
    """Zero, or the limit next to it."""
    if joint.get("type") == "continuous":
        return 0.0
    lower, upper = _limits(joint)
    return min(max(0.0, lower), upper)


def _fault(file: str, message: str, code: str = "E_MISSING") -> InvalidInput:
    return InvalidInput(Fault(code, "", message, file))
