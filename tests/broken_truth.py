"""What a broken cell is made of: a maker, and the truth about its one break as typed data.

A cell is a folder with cell.yaml and a robot.yaml of its own, so that advice for either can be
applied to a copy. A maker gives the cell broken or healthy: the break is the only difference.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from handey.errors import Fault
from handey.reporting.reasons import KINDS, Reason

MODELS = Path(__file__).resolve().parent.parent / "models"
DATA = MODELS.parent.parent / "shared" / "data"
PUMA = MODELS / "robots" / "puma560"
TABLE = {"box": [1.8, 1.6, 0.05], "pose": {"xyz": [0.6, 0, -0.025]}, "support": True}
START, GOAL = (0.5, 0.25), (0.5, -0.25)


@dataclass(frozen=True)
class Truth:
    """One true statement about a break; a cause that says anything else is wrong.

    Attributes:
        kinds: of `reasons.KINDS`, any of which is true.
        end: "origin" or "destination"; empty where the break is at neither.
        bodies: of which the cause must name one first; empty where no body is to blame.
        movers: of which one met them; empty for any.
        joints: that are past their limits.
        by: how much is missing, in the kind's unit, with the tolerance; None where no number is.
        refused: the code with which the reader refuses the cell, in words that name all `bodies`;
            empty where it is to be planned.
    """

    kinds: tuple[str, ...] = ()
    end: str = ""
    bodies: tuple[str, ...] = ()
    movers: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    by: tuple[float, float] | None = None
    refused: str = ""

    def __post_init__(self) -> None:
        unknown = set(self.kinds) - set(KINDS)
        if unknown:
            raise ValueError(f"no kinds of reasons: {sorted(unknown)}")

    def holds(self, cause: Reason | None) -> bool:
        """Does the cause say this?"""
        if cause is None or cause.kind not in self.kinds:
            return False
        named = cause.bodies[0] if cause.bodies else ""
        return (
            (not self.end or cause.end == self.end)
            and (not self.bodies or named in self.bodies)
            and (not self.movers or cause.mover in self.movers)
            and (not self.joints or cause.joint in self.joints)
            and (self.by is None or self._is_near(cause.by))
        )

    def is_in(self, faults: Sequence[Fault]) -> bool:
        """Is the cell refused with this?"""
        return any(
            fault.code == self.refused and all(name in fault.message for name in self.bodies)
            for fault in faults
        )

    def _is_near(self, by: float | None) -> bool:
        assert self.by is not None
        return by is not None and abs(by - self.by[0]) <= self.by[1]


Maker = Callable[[Path, bool], dict[str, Any]]


@dataclass(frozen=True)
class Broken:
    """A cell with one break.

    Attributes:
        name: of the cell.
        sentence: what is broken.
        make: writes what the cell needs to a folder and gives it, broken if asked.
        truths: each a full statement of the break.
        goal: index of the goal that it breaks.
        batch: name of the module that makes it.
    """

    name: str
    sentence: str
    make: Maker
    truths: tuple[Truth, ...]
    goal: int = 0
    batch: str = ""

    def write(self, folder: Path, is_broken: bool) -> Path:
        """The cell as a file in a folder of its own."""
        folder.mkdir(parents=True, exist_ok=True)
        cell = self.make(folder, is_broken)
        path = folder / "cell.yaml"
        plain = json.loads(json.dumps({"name": self.name, **cell}))  # no value twice, no anchors
        path.write_text(yaml.safe_dump(plain, sort_keys=False))
        return path

    def is_told(self, cause: Reason | None) -> bool:
        """Does the cause state the break?"""
        return any(truth.holds(cause) for truth in self.truths)

    def is_refused(self, faults: Sequence[Fault]) -> bool:
        """Does the reader's refusal state the break?"""
        return any(truth.is_in(faults) for truth in self.truths)


CELLS: dict[str, Broken] = {}


def broken(*truths: Truth, goal: int = 0) -> Callable[[Maker], Maker]:
    """Note a maker, under its name and with its docstring as the sentence."""

    def note(make: Maker) -> Maker:
        name = make.__name__
        sentence = " ".join((make.__doc__ or "").split())
        CELLS[name] = Broken(name, sentence, make, truths, goal, make.__module__)
        return make

    return note


def cell(
    folder: Path,
    fixtures: dict[str, Any],
    parts: dict[str, Any],
    task: list[dict[str, Any]],
    *,
    table: dict[str, Any] | None = None,
    robot: dict[str, Any] | None = None,
    opening: float = 0.10,
    least_opening: float = 0.0,
    limits: dict[str, tuple[float, float]] | None = None,
    arm: str = "puma560",
    **more: Any,
) -> dict[str, Any]:
    """A cell on a table, with a robot file of its own: other jaws or joint limits, if given."""
    write_robot(folder, (least_opening, opening), limits or {}, arm)
    return {
        "handey_cell": 1,
        "robot": {"file": "robot.yaml", **(robot or {})},
        "fixtures": {"table": table or TABLE, **fixtures},
        "parts": parts,
        "task": task,
        **more,
    }


def write_robot(
    folder: Path, opening: tuple[float, float], limits: dict[str, tuple[float, float]], arm: str
) -> None:
    """An arm's files, with other jaws and joint limits [rad]."""
    if arm == "puma560":
        shutil.copytree(PUMA, folder, dirs_exist_ok=True)
    else:
        write_irb120(folder)
    robot = yaml.safe_load((folder / "robot.yaml").read_text())
    robot["gripper"]["opening"] = list(opening)
    (folder / "robot.yaml").write_text(yaml.safe_dump(robot, sort_keys=False))
    urdf = folder / robot["urdf"]
    text = urdf.read_text()
    for joint, (lower, upper) in limits.items():
        pattern = rf'(<joint name="{joint}".*?<limit)( effort="[^"]*")? lower="[^"]*" upper="[^"]*"'
        text, count = re.subn(pattern, rf'\1\2 lower="{lower}" upper="{upper}"', text, flags=re.S)
        assert count == 1
    urdf.write_text(text)


FINGER = """
  <link name="{side}_finger"><collision><origin xyz="0 {out} 0.025"/><geometry>
    <box size="0.016 0.01 0.05"/></geometry></collision></link>
  <joint name="{side}_finger_joint" type="prismatic"><origin xyz="0 0 0.05"/>
    <parent link="palm"/><child link="{side}_finger"/><axis xyz="0 {sign} 0"/>
    <limit lower="0" upper="0.04" velocity="0.1" effort="40"/></joint>"""
PALM = """
  <link name="palm"><collision><origin xyz="0 0 0.025"/><geometry><box size="0.05 0.1 0.05"/>
    </geometry></collision></link>
  <joint name="palm_mount" type="fixed"><parent link="tool0"/><child link="palm"/></joint>"""


def write_irb120(folder: Path) -> None:
    """The maker's URDF with a small gripper on its tool0, and its collision meshes."""
    source = DATA / "robots" / "abb_irb120"
    text = (source / "irb120_3_58.urdf").read_text()
    text = re.sub(r"<visual>.*?</visual>", "", text, flags=re.S)
    text = text.replace("package://abb_irb120_support/meshes/irb120_3_58/collision/", "meshes/")
    hand = PALM + FINGER.format(side="left", sign=1, out=0.005)
    hand += FINGER.format(side="right", sign=-1, out=-0.005)
    (folder / "irb120.urdf").write_text(text.replace("</robot>", hand + "\n</robot>"))
    meshes = source / "abb_irb120_support" / "meshes" / "irb120_3_58" / "collision"
    shutil.copytree(meshes, folder / "meshes", dirs_exist_ok=True)
    gripper = {
        "link": "palm",
        "grasp_frame": {"xyz": [0, 0, 0.09], "rpy": [0, 0, 0]},
        "fingers": ["left_finger_joint", "right_finger_joint"],
        "opening": [0.0, 0.08],
        "pad": {"width": 0.016, "length": 0.02},
    }
    robot = {
        "handey_robot": 1,
        "name": "irb120",
        "urdf": "irb120.urdf",
        "arm": [f"joint_{i}" for i in range(1, 7)],
        "home": [0, 0, 0, 0, 0.5, 0],
        "gripper": gripper,
        "ignore_collisions": [["left_finger", "right_finger"]],
    }
    (folder / "robot.yaml").write_text(yaml.safe_dump(robot, sort_keys=False))


def box(size: list[float], xyz: list[float], yaw: float = 0.0) -> dict[str, Any]:
    """A box with its centre at xyz."""
    pose = {"xyz": xyz, "rpy": [0, 0, yaw]} if yaw else {"xyz": xyz}
    return {"box": size, "pose": pose}


def on_table(size: list[float], xy: tuple[float, float], yaw: float = 0.0) -> dict[str, Any]:
    """A box that stands on the table."""
    return box(size, [*xy, size[2] / 2], yaw)


def shapes(*boxes: dict[str, Any], at: tuple[float, float] = (0.0, 0.0)) -> dict[str, Any]:
    """One body of several boxes, whose places are seen from a point of the table."""
    return {"pose": {"xyz": [*at, 0]}, "shapes": list(boxes)}


def place(part: str, xyz: list[float], yaw: float = 0.0) -> dict[str, Any]:
    """A goal."""
    return {"place": part, "at": {"xyz": xyz, "rpy": [0, 0, yaw]}}


def model(name: str) -> dict[str, Any]:
    """The mesh of a model's part."""
    return {"mesh": str(MODELS / "parts" / f"{name}.stl"), "scale": 0.001}


def real(name: str, scale: float = 1.0) -> dict[str, Any]:
    """The mesh of a real part, from the data beside the checkout."""
    return {"mesh": str(DATA / "parts" / name), "scale": scale}
