"""Which robot does a URDF describe, read without the robot file that planning needs?

A URDF does not say which joints are the arm, which are the fingers, or where the grasp frame is. If
it has just two prismatic joints that hang on one chain of revolute ones, they are taken for fingers
and the chain for the arm; the grasp frame is then the frame of the link that carries the fingers.
What was taken for what is told as a warning.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ElementTree

import numpy as np

from handey import _core
from handey.errors import Fault, InvalidInput

__all__ = ["load_bare_urdf"]

MOST_BYTES = 16 << 20
NEEDED = "a robot file says which joints are the arm and the fingers"


def load_bare_urdf(path: str | os.PathLike[str]) -> tuple[_core.Robot, list[str]]:
    """Reads a URDF alone.

    Returns:
        The robot, and warnings: what was taken for what comes first.

    Raises:
        InvalidInput: if arm and fingers cannot be told, or with the faults of the file.
    """
    file = os.fspath(path)
    joints = _joints(file)
    fingers = [name for name, joint in joints.items() if joint.get("type") == "prismatic"]
    if len(fingers) != 2:
        raise _fault(file, f"found {len(fingers)} prismatic joints, expected two fingers; {NEEDED}")
    parents = {_link(joint, "child"): name for name, joint in joints.items()}
    chains = [_chain(joints, parents, finger) for finger in fingers]
    arms = [[name for name in chain if _turns(joints[name])] for chain in chains]
    if arms[0] != arms[1] or not arms[0]:
        raise _fault(file, f"{fingers[0]} and {fingers[1]} hang on different chains; {NEEDED}")
    arm = arms[0]
    links = [_link(joints[finger], "parent") for finger in fingers]
    link = links[0]
    bounds = [_limits(joints[finger]) for finger in fingers]
    least = 2 * max(0.0, *(lower for lower, _ in bounds))
    most = 2 * min(upper for _, upper in bounds)
    description = _core.RobotDescription(
        name="",
        arm=arm,
        home=[_home(joints[name]) for name in arm],
        gripper_link=link,
        X_LH=np.eye(4),
        fingers=fingers,
        min_opening=least,
        max_opening=most,
    )
    try:
        loaded = _core.load_robot(file, description)
    except InvalidInput as error:
        raise InvalidInput([_of_file(fault, file) for fault in error.faults]) from None
    said = (
        f"no robot file: arm {', '.join(arm)}; fingers {', '.join(fingers)}; grasp point at "
        f"the origin of '{link}', pads and accelerations are guesses"
    )
    return loaded.robot, [said, *loaded.warnings]


def _joints(file: str) -> dict[str, ElementTree.Element]:
    """The joints by name."""
    if file.endswith(".xacro"):
        raise _fault(file, "xacro is not read; expand it to a URDF first")
    try:
        if os.path.getsize(file) > MOST_BYTES:
            raise _fault(file, f"found more than {MOST_BYTES >> 20} MB")
        root = ElementTree.parse(file).getroot()
    except OSError as error:
        raise _fault(file, f"cannot be read: {error.strerror}", "E_PATH") from error
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise _fault(file, f"not XML: {error}", "E_XML") from error
    if root.tag != "robot":
        raise _fault(file, f"expected a URDF, found <{root.tag}>")
    return {joint.get("name", ""): joint for joint in root.findall("joint")}


def _chain(
    joints: dict[str, ElementTree.Element], parents: dict[str, str], finger: str
) -> list[str]:
    """Names of the joints from the root to a finger, without it."""
    chain: list[str] = []
    name = parents.get(_link(joints[finger], "parent"))
    while name is not None and name not in chain:
        chain.insert(0, name)
        name = parents.get(_link(joints[name], "parent"))
    return chain


def _turns(joint: ElementTree.Element) -> bool:
    return joint.get("type") in ("revolute", "continuous")


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


def _of_file(fault: Fault, file: str) -> Fault:
    place = fault.place.removeprefix(file).lstrip(": ")
    return Fault(fault.code, place, fault.message, file)


def _fault(file: str, message: str, code: str = "E_MISSING") -> InvalidInput:
    return InvalidInput(Fault(code, "", message, file))
