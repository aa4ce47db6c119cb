"""Changes of how the part is held: jaws that open wider or close more, pads that slip less.

Jaws: the robot file's opening and, where a finger could not go so far, its limit in the URDF,
whose place is an XPath: "joint[@name='left_finger_joint']/limit/@upper".
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from handey import _core
from handey.advising.change import Change, Family
from handey.advising.situation import Situation
from handey.reporting.advice import Edit
from handey.robot_file import read_robot

__all__ = ["closer_jaws", "frictions", "wider_jaws"]

ROOM = 0.017  # Choice: as much as the hand likes to come in with, on both sides [m]
MOST_WIDER = 0.06  # Choice: more would be another gripper [m]
WIDEST = 0.5  # Choice: no jaw opens farther [m]
JAW_STEP, FRICTION_STEP = 0.0005, 0.01
FRICTIONS = (0.6, 0.8, 1.0, 0.5)


def wider_jaws(here: Situation) -> Iterator[Family]:
    """Jaws that open wide enough for feature pairs that are too wide now."""
    robot = here.cell.robot
    widths = _widths(here)
    if not widths:
        return
    file = here.cell_file.entry.robot.file
    entry = read_robot(file)
    least, greatest = entry.gripper.opening
    limits = _finger_limits(entry.urdf, entry.gripper.fingers)

    def make(size: float) -> Change | None:
        opening = round(greatest + size, 4)
        if opening > 1.0 or size > MOST_WIDER:
            return None
        edits = [Edit(os.fspath(file), "gripper.opening", [least, opening])]
        for finger, limit in limits.items():
            if opening / 2 > limit:
                place = f"joint[@name='{finger}']/limit/@upper"
                edits.append(Edit(os.fspath(entry.urdf), place, opening / 2))
        words = f"let the jaws open by {1e3 * size:.1f} mm more, to {1e3 * opening:.1f} mm"
        return Change("jaws", words, tuple(edits), size, robot=robot.with_jaws(opening))

    cause = here.report.cause
    short = [width + ROOM - greatest for width in widths]
    if cause is not None and cause.kind == "too_wide" and cause.by is not None:
        short.insert(0, cause.by)
    sizes = [max(JAW_STEP, float(JAW_STEP * np.ceil(size / JAW_STEP - 1e-6))) for size in short]
    yield Family("jaws", make, tuple(dict.fromkeys(sizes))[:4], step=JAW_STEP)


def closer_jaws(here: Situation) -> Iterator[Family]:
    """Jaws that close to as little as a feature pair is wide that is too thin now."""
    robot, file = here.cell.robot, here.cell_file.entry.robot.file
    short = [r.by for r in here.reasons if r.kind == "too_thin" and r.by is not None]
    if not short:
        return
    least, greatest = read_robot(file).gripper.opening

    def make(size: float) -> Change | None:
        opening = round(max(least - size, 0.0), 4)
        if opening >= least:
            return None
        words = f"let the jaws close by {1e3 * size:.1f} mm more, to {1e3 * opening:.1f} mm"
        edit = Edit(os.fspath(file), "gripper.opening", [opening, greatest])
        return Change("jaws", words, (edit,), size, robot=robot.with_jaws(greatest, opening))

    first = float(JAW_STEP * np.ceil(min(short) / JAW_STEP - 1e-6))
    yield Family("jaws", make, tuple(dict.fromkeys((first, least))), step=JAW_STEP)


def _widths(here: Situation) -> list[float]:
    """Of feature pairs that are wider than the jaws open, ascending [m]."""
    robot = here.cell.robot
    wide = robot.with_jaws(WIDEST)
    ranking = _core.rank_part_alone(here.cell.parts[here.part], wide, _core.RankingOptions())
    found = {round(pair.pair.width, 4) for pair in ranking.ranked}
    return sorted(width for width in found if width > robot.gripper.max_opening - 0.002)


def _finger_limits(urdf: Path, fingers: tuple[str, ...]) -> dict[str, float]:
    """How far each finger goes, as the URDF says [m]."""
    found = {}
    for joint in ElementTree.parse(urdf).getroot().iterfind("joint"):
        limit = joint.find("limit")
        if joint.get("name") in fingers and limit is not None:
            found[str(joint.get("name"))] = float(limit.get("upper", "inf"))
    return found


def frictions(here: Situation) -> Iterator[Family]:
    """Pads that slip less on the part."""
    part = here.cell.parts[here.part]
    now = float(part.friction)

    def make(size: float) -> Change:
        friction = round(now + size, 3)
        edit = Edit(here.file, f"parts.{part.name}.friction", friction)
        words = f"raise the friction of {part.name} from {now:g} to {friction:g}"
        return Change("friction", words, (edit,), size)

    sizes = tuple(round(value - now, 3) for value in FRICTIONS if value > now + 1e-6)
    yield Family("friction", make, sizes, step=FRICTION_STEP)
