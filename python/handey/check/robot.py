"""The robot as the checker reads it: bodies, joints, gripper, from a robot file and its URDF.

Links joined by fixed joints are one body, in the frame of the first of them. Not read: dynamics,
sensors, transmissions. A movable joint that the robot file does not name is a fault.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.shapes import Shape, box, cylinder, read_mesh, sphere
from handey.check.values import (
    Array,
    fault,
    keys,
    load_yaml,
    number,
    pose,
    rpy_matrix,
    text,
    vector,
)

__all__ = ["Joint", "Robot", "RobotBody", "read_robot"]


@dataclass
class RobotBody:
    """Links that move as one; shapes in the frame of the first."""

    name: str
    links: list[str]
    shapes: list[Shape] = field(default_factory=list)
    visuals: list[Shape] = field(default_factory=list)


@dataclass
class Joint:
    """child = parent * origin * motion, motion about or along the unit `axis`."""

    name: str
    parent: int
    child: int
    origin: Array
    axis: Array
    lower: float
    upper: float
    velocity: float
    prismatic: bool


@dataclass
class Robot:
    """What the files say of the robot: `bodies[0]` is the base, `joints` lead to the flange."""

    name: str
    file: str
    bodies: list[RobotBody]
    joints: list[Joint]
    fingers: list[Joint]
    hand: int
    grasp_frame: Array  # in the hand's body
    home: Array
    opening: tuple[float, float]
    pad: tuple[float, float]  # width (x), length (z)
    ignored: list[tuple[int, int]]

    def joint_names(self) -> list[str]:
        """Of the arm, base to flange."""
        return [joint.name for joint in self.joints]


def read_robot(path: Path) -> Robot:
    """Reads a robot file and its URDF.

    Raises:
        InvalidInput: naming the first thing that is wrong.
    """
    file = str(path)
    content = keys(
        load_yaml(path), file, "",
        ("handey_robot", "name", "urdf", "arm", "home", "gripper"),
        ("acceleration", "ignore_collisions"),
    )  # fmt: skip
    gripper = keys(
        content["gripper"], file, "gripper", ("link", "fingers", "opening", "pad"), ("grasp_frame",)
    )
    pad = keys(gripper["pad"], file, "gripper.pad", ("width", "length"))
    arm, fingers = content["arm"], gripper["fingers"]
    if not isinstance(arm, list) or not isinstance(fingers, list) or len(fingers) != 2:
        raise fault(
            "E_TYPE", file, "arm", "expected lists of joint names, two of them for the fingers"
        )
    tree = _Urdf(path.parent / text(content["urdf"], file, "urdf"))
    bodies, body_of, joints = tree.bodies([*arm, *fingers])
    for name in [*arm, *fingers]:
        if name not in joints:
            raise fault("E_REF", file, "arm", f"the URDF has no movable joint {name!r}")
    hand_link = text(gripper["link"], file, "gripper.link")
    if hand_link not in body_of:
        raise fault("E_REF", file, "gripper.link", f"the URDF has no link {hand_link!r}")
    hand, X_BL = body_of[hand_link]
    opening = vector(gripper["opening"], 2, file, "gripper.opening")
    ignored = []
    for i, pair in enumerate(content.get("ignore_collisions") or []):
        if (
            not isinstance(pair, list)
            or len(pair) != 2
            or any(link not in body_of for link in pair)
        ):
            raise fault("E_REF", file, f"ignore_collisions[{i}]", "expected two links of the URDF")
        ignored.append((body_of[pair[0]][0], body_of[pair[1]][0]))
    return Robot(
        text(content["name"], file, "name"), file, bodies,
        [joints[name] for name in arm], [joints[name] for name in fingers], hand,
        X_BL @ pose(gripper.get("grasp_frame"), file, "gripper.grasp_frame"),
        vector(content["home"], len(arm), file, "home"), (float(opening[0]), float(opening[1])),
        (
            number(pad["width"], file, "gripper.pad.width"),
            number(pad["length"], file, "gripper.pad.length"),
        ),
        ignored,
    )  # fmt: skip


class _Urdf:
    """A URDF's links and joints."""

    def __init__(self, path: Path) -> None:
        self.path, self.file = path, str(path)
        try:
            self.root = ElementTree.parse(path).getroot()
        except (OSError, ElementTree.ParseError, ValueError) as error:
            raise fault("E_XML", self.file, "", f"cannot be read: {error}") from error
        self.links = {link.get("name", ""): link for link in self.root.findall("link")}
        self.joints = self.root.findall("joint")

    def bodies(
        self, movable: list[str]
    ) -> tuple[list[RobotBody], dict[str, tuple[int, Array]], dict[str, Joint]]:
        """The bodies, where each link is in its body, and the movable joints by name."""
        children = {self._end(joint, "child") for joint in self.joints}
        roots = [name for name in self.links if name not in children]
        if len(roots) != 1:
            raise fault("E_TREE", self.file, "", f"expected one root link, found {roots}")
        bodies: list[RobotBody] = []
        place: dict[str, tuple[int, Array]] = {}
        found: dict[str, Joint] = {}

        def visit(link: str, body: int, X_BL: Array) -> None:
            if link in place or link not in self.links:
                raise fault("E_TREE", self.file, link, "is no link, or is reached twice")
            place[link] = (body, X_BL)
            bodies[body].links.append(link)
            bodies[body].shapes += self._shapes(link, "collision", X_BL)
            bodies[body].visuals += self._shapes(link, "visual", X_BL)
            for joint in self.joints:
                if self._end(joint, "parent") != link:
                    continue
                child, origin = self._end(joint, "child"), X_BL @ self._origin(joint)
                if joint.get("type") == "fixed":
                    visit(child, body, origin)
                    continue
                name = joint.get("name", "")
                if name not in movable:
                    raise fault(
                        "E_REF", self.file, name, "moves, but the robot file does not name it"
                    )
                bodies.append(RobotBody(child, []))
                found[name] = self._joint(joint, body, len(bodies) - 1, origin)
                visit(child, len(bodies) - 1, np.eye(4))

        bodies.append(RobotBody(roots[0], []))
        visit(roots[0], 0, np.eye(4))
        return bodies, place, found

    def _end(self, joint: ElementTree.Element, tag: str) -> str:
        element = joint.find(tag)
        return "" if element is None else element.get("link", "")

    def _numbers(self, written: str | None, count: int, default: Any, place: str) -> Array:
        if written is None:
            return np.array(default, dtype=float)
        return vector(written.split(), count, self.file, place)

    def _origin(self, element: ElementTree.Element) -> Array:
        result = np.eye(4)
        origin = element.find("origin")
        if origin is not None:
            place = f"{element.tag} {element.get('name', '')}"
            result[:3, 3] = self._numbers(origin.get("xyz"), 3, [0, 0, 0], place)
            result[:3, :3] = rpy_matrix(*self._numbers(origin.get("rpy"), 3, [0, 0, 0], place))
        return result

    def _joint(self, element: ElementTree.Element, parent: int, child: int, origin: Array) -> Joint:
        name, kind = element.get("name", ""), element.get("type")
        if kind not in ("revolute", "continuous", "prismatic"):
            raise fault("E_JOINT_TYPE", self.file, name, f"unsupported joint type {kind!r}")
        axis_tag, limit = element.find("axis"), element.find("limit")
        axis = self._numbers(None if axis_tag is None else axis_tag.get("xyz"), 3, [1, 0, 0], name)
        if np.linalg.norm(axis) < 1e-9 or limit is None:
            raise fault("E_LIMIT", self.file, name, "expected an axis and a <limit>")
        lower, upper = -math.inf, math.inf
        if kind != "continuous":
            lower = number(limit.get("lower", "0"), self.file, f"{name} lower")
            upper = number(limit.get("upper", "0"), self.file, f"{name} upper")
        safety = element.find("safety_controller")
        if safety is not None and kind != "continuous":
            lower = max(lower, number(safety.get("soft_lower_limit", "-1e9"), self.file, name))
            upper = min(upper, number(safety.get("soft_upper_limit", "1e9"), self.file, name))
        velocity = number(limit.get("velocity", "0"), self.file, f"{name} velocity")
        axis = axis / np.linalg.norm(axis)
        return Joint(name, parent, child, origin, axis, lower, upper, velocity, kind == "prismatic")

    def _shapes(self, link: str, tag: str, X_BL: Array) -> list[Shape]:
        result = []
        for element in self.links[link].findall(tag):
            geometry = element.find("geometry")
            if geometry is None or len(geometry) != 1:
                raise fault("E_GEOMETRY", self.file, link, f"expected one shape in each <{tag}>")
            try:
                result.append(self._shape(geometry[0], X_BL @ self._origin(element), link))
            except ValueError:
                if tag == "collision":
                    raise
                return []  # pictures only: the collision shapes will do
        return result

    def _shape(self, geometry: ElementTree.Element, X_BS: Array, link: str) -> Shape:
        if geometry.tag == "box":
            return box(self._numbers(geometry.get("size"), 3, [], link), X_BS)
        if geometry.tag == "cylinder":
            radius, length = (
                number(geometry.get(key), self.file, link) for key in ("radius", "length")
            )
            return cylinder(radius, length, X_BS)
        if geometry.tag == "sphere":
            return sphere(number(geometry.get("radius"), self.file, link), X_BS)
        if geometry.tag == "mesh":
            scale = self._numbers(geometry.get("scale"), 3, [1, 1, 1], link)
            return read_mesh(
                self._mesh_path(geometry.get("filename", ""), link), scale, X_BS, self.file, link
            )
        raise fault("E_UNSUPPORTED", self.file, link, f"unsupported shape <{geometry.tag}>")

    def _mesh_path(self, name: str, link: str) -> Path:
        if not name.startswith("package://"):
            return self.path.parent / name.removeprefix("file://")
        package, _, rest = name.removeprefix("package://").partition("/")
        for folder in (self.path.parent, *self.path.resolve().parents):
            if folder.name == package:
                return folder / rest
            if (folder / package).is_dir():
                return folder / package / rest
        raise fault(
            "E_PATH", self.file, link, f"package {package!r} is not found above {self.path}"
        )
