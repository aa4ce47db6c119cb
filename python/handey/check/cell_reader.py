"""Reads a cell file: robot, fixtures, parts, measured obstacles, task.

Method: an own strict reading. A body's shapes are kept in the body's frame.
Measured obstacles become fixtures of one mesh each (see depth).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from handey.check.camera import read_camera
from handey.check.cell import Body, Cell, Goal
from handey.check.depth import heights_solid, read_heights
from handey.check.robot import read_robot
from handey.check.shapes import Shape, box, cylinder, read_mesh, sphere
from handey.check.values import Array, fault, keys, load_yaml, number, pose, positive, text, vector

__all__ = ["read_cell"]

SHAPES = ("box", "cylinder", "sphere", "mesh", "shapes")


def read_cell(path: Path) -> Cell:
    """Reads a cell file and all that it refers to.

    Raises:
        InvalidInput: naming the first thing that is wrong.
    """
    return _Reader(path).cell()


class _Reader:
    def __init__(self, path: Path) -> None:
        self.path, self.file = path, str(path)

    def cell(self) -> Cell:
        content = keys(
            load_yaml(self.path), self.file, "", ("handey_cell", "name", "robot"),
            ("fixtures", "parts", "depth_maps", "task", "order", "finish"),
        )  # fmt: skip
        if content["handey_cell"] != 1:
            raise fault(
                "E_VERSION", self.file, "handey_cell", f"expected 1, found {content['handey_cell']}"
            )
        place = keys(
            content["robot"], self.file, "robot", ("file",), ("base", "start", "start_opening")
        )
        robot = read_robot(self.path.parent / text(place["file"], self.file, "robot.file"))
        start, opening = robot.home, robot.opening[1]
        if "start" in place:
            start = vector(place["start"], len(robot.joints), self.file, "robot.start")
        if "start_opening" in place:
            opening = number(place["start_opening"], self.file, "robot.start_opening")
        fixtures = [
            self.body(n, b, f"fixtures.{n}", False) for n, b in self.named(content, "fixtures")
        ]
        parts = [self.body(n, b, f"parts.{n}", True) for n, b in self.named(content, "parts")]
        cell = Cell(
            text(content["name"], self.file, "name"), self.file, robot,
            pose(place.get("base"), self.file, "robot.base"), start, opening, fixtures, parts, [],
            self.choice(content, "order", ("given", "any")),
            self.choice(content, "finish", ("start", "anywhere")),
        )  # fmt: skip
        # What one depth map shows explains nothing of another.
        maps = self.named(content, "depth_maps")
        measured = [self.depth_map(n, m, f"depth_maps.{n}", cell) for n, m in maps]
        names = [body.name for body in fixtures + parts + measured]
        fixtures += [body for body in measured if len(body.shapes[0].faces)]
        for name in names:
            if names.count(name) > 1:
                raise fault("E_DUP", self.file, name, "is the name of two bodies")
        for i, goal in enumerate(content.get("task") or []):
            cell.task.append(self.goal(goal, f"task[{i}]", cell))
        return cell

    def named(self, content: dict[str, Any], key: str) -> list[tuple[str, Any]]:
        value = content.get(key) or {}
        if not isinstance(value, dict):
            raise fault("E_TYPE", self.file, key, "expected a mapping from names to bodies")
        return [(text(name, self.file, key), body) for name, body in value.items()]

    def choice(self, content: dict[str, Any], key: str, legal: tuple[str, str]) -> bool:
        """Whether the first (default) of two words is chosen."""
        value = content.get(key, legal[0])
        if value not in legal:
            raise fault("E_TYPE", self.file, key, f"expected {' or '.join(legal)}, found {value!r}")
        return bool(value == legal[0])

    def flag(self, value: dict[str, Any], key: str, place: str) -> bool:
        result = value.get(key, False)
        if not isinstance(result, bool):
            raise fault(
                "E_TYPE", self.file, f"{place}.{key}", f"expected true or false, found {result!r}"
            )
        return result

    def body(self, name: str, value: Any, place: str, part: bool) -> Body:
        optional = [*SHAPES, "scale", "pose", "support", "friction", "mass", "density"]
        value = keys(value, self.file, place, (), [*optional, *(["may_move"] if part else [])])
        if "shapes" in value:
            if not isinstance(value["shapes"], list) or not value["shapes"]:
                raise fault("E_TYPE", self.file, f"{place}.shapes", "expected a list of shapes")
            shapes = []
            for i, item in enumerate(value["shapes"]):
                where = f"{place}.shapes[{i}]"
                item = keys(item, self.file, where, (), [*SHAPES[:-1], "scale", "pose"])
                shapes.append(
                    self.shape(item, where, pose(item.get("pose"), self.file, f"{where}.pose"))
                )
        else:
            shapes = [self.shape(value, place, np.eye(4))]
        if part and not all(shape.closed for shape in shapes):
            raise fault("E_NOT_CLOSED", self.file, place, "the part's mesh is not closed")
        friction = positive(value.get("friction", 0.4), self.file, f"{place}.friction")
        return Body(
            name, shapes, pose(value.get("pose"), self.file, f"{place}.pose"),
            self.flag(value, "support", place), friction, self.flag(value, "may_move", place),
        )  # fmt: skip

    def shape(self, value: dict[str, Any], place: str, X_BS: Array) -> Shape:
        given = [key for key in SHAPES if key in value]
        if len(given) != 1:
            raise fault(
                "E_GEOMETRY",
                self.file,
                place,
                f"expected one of {', '.join(SHAPES)}, found {given}",
            )
        where, content = f"{place}.{given[0]}", value[given[0]]
        if given[0] == "box":
            size = vector(content, 3, self.file, where)
            return box(np.array([positive(x, self.file, where) for x in size]), X_BS)
        if given[0] == "mesh":
            scale = positive(value.get("scale", 1.0), self.file, f"{place}.scale")
            path = self.path.parent / text(content, self.file, where)
            return read_mesh(path, np.full(3, scale), X_BS, self.file, where)
        if given[0] == "cylinder":
            content = keys(content, self.file, where, ("radius", "length"))
            length = positive(content["length"], self.file, f"{where}.length")
            return cylinder(positive(content["radius"], self.file, f"{where}.radius"), length, X_BS)
        content = keys(content, self.file, where, ("radius",))
        return sphere(positive(content["radius"], self.file, f"{where}.radius"), X_BS)

    def depth_map(self, name: str, value: Any, place: str, cell: Cell) -> Body:
        if not isinstance(value, dict) or ("heights" in value) == ("depth" in value):
            raise fault("E_TYPE", self.file, place, "expected heights or depth")
        if "heights" in value:
            value = keys(value, self.file, place, ("heights", "cell"), ("pose",))
            heights = read_heights(
                self.path.parent / value["heights"], self.file, f"{place}.heights"
            )
            side = positive(value["cell"], self.file, f"{place}.cell")
            shape = heights_solid(heights, side)
        else:
            shape = read_camera(self.path.parent, value, self.file, place, cell)
        return Body(name, [shape], pose(value.get("pose"), self.file, f"{place}.pose"))

    def goal(self, value: Any, place: str, cell: Cell) -> Goal:
        value = keys(
            value, self.file, place, ("place",), ("at", "on", "inside", "region", "resting")
        )
        if sum(key in value for key in ("at", "on", "inside")) != 1:
            raise fault("E_TYPE", self.file, place, "expected one of at, on, inside")
        goal = Goal(text(value["place"], self.file, f"{place}.place"))
        if goal.part not in cell.part_names():
            raise fault(
                "E_REF",
                self.file,
                f"{place}.place",
                f"no part {goal.part!r}; parts: {cell.part_names()}",
            )
        names = [body.name for body in cell.fixtures]
        for key in ("on", "inside"):
            if key in value and value[key] not in names:
                raise fault(
                    "E_REF",
                    self.file,
                    f"{place}.{key}",
                    f"no fixture {value[key]!r}; fixtures: {names}",
                )
        if "at" in value:
            goal.at = pose(value["at"], self.file, f"{place}.at")
        goal.on, goal.inside = value.get("on"), value.get("inside")
        if "region" in value:
            region = value["region"]
            if not isinstance(region, list) or len(region) != 2:
                raise fault("E_TYPE", self.file, f"{place}.region", "expected [[x0, y0], [x1, y1]]")
            goal.region = np.array(
                [vector(p, 2, self.file, f"{place}.region[{i}]") for i, p in enumerate(region)]
            )
        if "resting" in value and value["resting"] != "same":
            raise fault(
                "E_TYPE",
                self.file,
                f"{place}.resting",
                f"expected same, found {value['resting']!r}",
            )
        goal.same_rest = value.get("resting") == "same"
        return goal
