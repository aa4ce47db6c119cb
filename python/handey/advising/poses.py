"""Changes of where things are: a body moved, an end of the part's way shifted or turned.

A fixture takes along what stands on it: parts, and goals. The goal, or the start of the part, is
shifted level and turned about the vertical. Not guaranteed: that a part stands at its new place;
that is asked when the change is tried.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from handey.advising.change import Change, Family
from handey.advising.situation import Blame, Situation
from handey.reporting.advice import Edit
from handey.task import PlaceAt

__all__ = ["lowered", "moved_bodies", "removed", "shifts", "swings", "turns"]

# Choice: sizes in the order to try them: likely ones first [m, rad].
MOVES = (0.06, 0.02, 0.3)
LOADED = 6.0  # Choice: as much less plausible is it to move what carries something
HAND, LEAST_GUESS = 0.1, 0.05  # Choice: room for the hand; less is not moved at first [m]
SHIFTS = (0.12, 0.25, 0.05, 0.02)  # what succeeds is made smaller; what fails takes longer
HANGS, HANGS_RANK = 15.0, 3.0  # Choice: as much dearer and less plausible is it to lift something
TOUCHES = 0.002  # of what stands on another body [m]
BEYOND = (0.03, 0.08, 0.0, 0.2)  # where it is known how much is missing
TURNS = tuple(np.radians((30.0, 90.0, 60.0, 180.0)))
STEP, TURN_STEP = 0.005, float(np.radians(5.0))
ALIKE = 0.95  # Choice: cosine between directions of which one is enough
HIGH = 0.5  # Choice: over the robot's base, what is out of reach comes nearer lowered [m]
AXES = {
    "+x": (1, 0, 0),
    "-x": (-1, 0, 0),
    "+y": (0, 1, 0),
    "-y": (0, -1, 0),
    "+z": (0, 0, 1),
    "-z": (0, 0, -1),
}


def _rounded(values: np.ndarray) -> list[float]:
    return [round(float(value), 6) + 0.0 for value in values]


def moved_bodies(here: Situation, blame: Blame) -> Iterator[Family]:
    """A fixture, or another part, moved away from the part along an axis of the world.

    A fixture takes along all that stands on it.
    """
    name = blame.name
    is_part = here.is_part(name)
    load = here.loads.get(name, [])
    if name not in here.content.get("parts" if is_part else "fixtures", {}):
        return
    if is_part and (load or any(goal.part == name for goal in here.cell_file.goals)):
        return
    # A part that is lifted would stand on nothing.
    axes = [it for it in _away(here, blame) if not (is_part and it[0] == "+z")]

    def lifts(axis: str) -> bool:
        return axis == "+z" and _stands(here, name)

    for order, (axis, clear) in enumerate(axes):
        guess = STEP * round(min(max(clear + HAND, LEAST_GUESS), MOVES[-1]) / STEP)
        yield Family(
            "part moved" if is_part else "fixture moved",
            _mover(here, name, axis),
            tuple(dict.fromkeys((round(guess, 4), *MOVES))),
            rank=0.7 * order + (LOADED if load else 0.0) + (HANGS_RANK if lifts(axis) else 0.0),
            step=STEP,
            body="" if load else name,
        )


def lowered(here: Situation, end: str, least: float | None) -> Iterator[Family]:
    """What carries an end that is too high, lowered or raised with all that stands on it.

    Args:
        here: the goal that failed.
        end: which of both.
        least: how far it is out of reach; None where that is not why it fails: nothing is tried.
    """
    index = here.index if end == "destination" else -1
    if least is None:
        return
    first = STEP * np.ceil(least / STEP)
    sizes = tuple(round(float(first) + more, 4) for more in BEYOND)
    rise = float(here.middle(end)[2] - here.robot_at[2])
    axis = "-z" if rise > HIGH else "+z"
    for name, load in here.loads.items():
        if (here.goal.part, index) in load and name in here.content.get("fixtures", {}):
            yield Family("fixture moved", _mover(here, name, axis), sizes, wave=0.5, step=STEP)


def _mover(here: Situation, name: str, axis: str) -> Callable[[float], Change]:
    is_part = here.is_part(name)
    places: list[tuple[str, Any]] = [("parts" if is_part else "fixtures", name)]
    also = []
    for part, index in here.loads.get(name, []):
        if index < 0:
            places.append(("parts", part))
            also.append(part)
        elif isinstance(here.cell_file.goals[index], PlaceAt):
            places.append(("task", index))
            also.append(f"the goal of {part}")
    awkward = HANGS if axis == "+z" and _stands(here, name) else 0.0
    load = f" with {' and '.join(dict.fromkeys(also))} on it" if also else ""

    def make(size: float) -> Change:
        by = size * np.array(AXES[axis], dtype=float)
        edits = [_shifted(here, place, by) for place in places]
        words = f"move {name}{load} by {1e3 * size:.0f} mm along {axis}"
        kind = "part moved" if is_part else "fixture moved"
        return Change(kind, words, tuple(edits), size, load=len(edits) - 1, awkward=awkward)

    return make


def _stands(here: Situation, name: str) -> bool:
    """Does a body stand on another, so that it would hang in the air if it were lifted?"""
    low, high = here.boxes[name]
    return any(
        abs(low[2] - other_high[2]) < TOUCHES
        and (low[:2] < other_high[:2]).all()
        and (high[:2] > other_low[:2]).all()
        for other, (other_low, other_high) in here.boxes.items()
        if other != name
    )


def _pose(here: Situation, place: tuple[str, Any]) -> tuple[str, dict[str, Any]]:
    """Where the file gives the pose of a body or goal, and what it gives."""
    kind, key = place
    entry = here.content[kind][key]
    if kind == "task":
        return f"task[{key}].at", entry["at"]
    return f"{kind}.{key}.pose", entry.get("pose") or {}


def _shifted(here: Situation, place: tuple[str, Any], by: np.ndarray) -> Edit:
    """The edit that shifts a pose by so much (3,) [m]."""
    where, pose = _pose(here, place)
    xyz = np.array(pose.get("xyz", [0.0, 0.0, 0.0]), dtype=float) + by
    return Edit(here.file, f"{where}.xyz", _rounded(xyz))


def _away(here: Situation, blame: Blame) -> list[tuple[str, float]]:
    """Axes of the world along which a body comes away from the part, the likeliest first.

    With how far it must go until it is beside the part [m].
    """
    low, high = here.boxes[blame.name]
    ends = [blame.end] if blame.end in here.ends else list(here.ends)
    scores: dict[str, float] = {}
    for axis, direction in AXES.items():
        if axis == "-z":
            continue
        along = np.array(direction, dtype=float)
        i, sign = int(np.argmax(np.abs(along))), float(along.sum())
        best = np.inf
        for end in ends:
            point = here.middle(end)[i]
            best = min(best, sign * point - (low[i] if sign > 0 else -high[i]))
        scores[axis] = best
    return sorted(scores.items(), key=lambda it: it[1])


def removed(here: Situation, name: str) -> Change | None:
    """The cell without a fixture, or a part that no goal names."""
    is_part = here.is_part(name)
    kind = "parts" if is_part else "fixtures"
    kind = "depth_maps" if here.is_measured(name) else kind
    carries = here.loads.get(name)
    if carries or (is_part and any(goal.part == name for goal in here.cell_file.goals)):
        return None
    if name not in here.content.get(kind, {}):
        return None
    words = f"take {name} out" + (" or measure it anew" if kind == "depth_maps" else "")
    return Change("removed", words, (Edit(here.file, f"{kind}.{name}", None),))


def shifts(here: Situation, end: str, away: list[str], least: float | None) -> Iterator[Family]:
    """The goal, or the start of the part, shifted level; away from some bodies first.

    Args:
        here: the goal that failed.
        end: which of both.
        away: names of bodies.
        least: less is not enough, as far as known [m].
    """
    if not _is_free(here, end):
        return
    place, kind, what = _of(here, end)
    sizes: tuple[float, ...] = SHIFTS
    gap, wave = (0.7, 2.5) if least is None else (2.0, 0.5)
    if least is not None:
        first = STEP * np.ceil((least + 0.5 * STEP) / STEP)
        sizes = tuple(round(float(first) + more, 4) for more in BEYOND)
    for order, (words, direction) in enumerate(_directions(here, end, away)):

        def make(size: float, words: str = words, direction: np.ndarray = direction) -> Change:
            text = f"shift {what} by {1e3 * size:.0f} mm {words}"
            return Change(kind, text, (_shifted(here, place, size * direction),), size)

        yield Family(kind, make, sizes, rank=gap * order, wave=wave, step=STEP)


def swings(here: Situation, end: str, least: float | None) -> Iterator[Family]:
    """The goal, or the start of the part, shifted about the axis of the arm's first joint.

    Args:
        here: the goal that failed.
        end: which of both.
        least: how much less the joint must turn, as far as known [rad]; None: nothing is tried.
    """
    if least is None or not _is_free(here, end):
        return
    place, kind, what = _of(here, end)
    arm = here.middle(end) - here.robot_at
    radius = float(np.hypot(*arm[:2]))
    # Less far round from straight ahead of the robot.
    ahead = here.cell.X_WR[:2, 0]
    sign = -np.sign(ahead[0] * arm[1] - ahead[1] * arm[0])

    def make(size: float) -> Change:
        angle = sign * size / radius
        c, s = np.cos(angle), np.sin(angle)
        by = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]) @ arm - arm
        text = f"shift {what} by {1e3 * size:.0f} mm about the robot's first axis"
        return Change(kind, text, (_shifted(here, place, by),), size)

    first = STEP * np.ceil(least * radius / STEP)
    sizes = tuple(round(float(first) + more, 4) for more in BEYOND)
    yield Family(kind, make, sizes, wave=0.5, step=STEP)


def turns(here: Situation, end: str) -> Iterator[Family]:
    """The goal, or the start of the part, turned about the vertical through its centre of mass."""
    if not _is_free(here, end):
        return
    place, shifted, what = _of(here, end)
    kind = shifted.replace("shifted", "turned")
    for order, sign in enumerate((1.0, -1.0)):

        def make(size: float, sign: float = sign) -> Change:
            text = f"turn {what} by {sign * np.degrees(size):+.0f} degrees about the vertical"
            return Change(kind, text, _turned(here, end, place, sign * size), size)

        sizes = TURNS if sign > 0 else TURNS[:-1]
        yield Family(kind, make, sizes, rank=0.7 * order, step=TURN_STEP)


def _of(here: Situation, end: str) -> tuple[tuple[str, Any], str, str]:
    """Place in the file, kind of a shift, and name of an end."""
    if end == "destination":
        return ("task", here.index), "goal shifted", f"the goal of {here.goal.part}"
    return ("parts", here.goal.part), "part shifted", f"the start of {here.goal.part}"


def _is_free(here: Situation, end: str) -> bool:
    """May this end be chosen otherwise?"""
    if end not in here.ends or here.loads.get(here.goal.part):
        return False
    earlier = here.cell_file.goals[: here.index]
    return end == "destination" or all(goal.part != here.goal.part for goal in earlier)


def _directions(here: Situation, end: str, away: list[str]) -> list[tuple[str, np.ndarray]]:
    """Ways to shift an end level, the likeliest first."""
    point = here.middle(end)
    found: list[tuple[str, np.ndarray]] = []
    inward = here.robot_at - point
    inward[2] = 0.0
    if np.linalg.norm(inward) > 1e-3:
        inward /= np.linalg.norm(inward)
    scores = {}
    for axis in ("+x", "-x", "+y", "-y"):
        direction = np.array(AXES[axis], dtype=float)
        score = 0.5 * float(direction @ inward)
        for name in away:
            low, high = here.boxes[name]
            nearest = point - np.clip(point, low, high)
            nearest[2] = 0.0
            gap = float(np.linalg.norm(nearest))
            if gap > 1e-6:
                score += float(direction @ nearest) / gap
        scores[axis] = score
    level = sorted(scores, key=lambda axis: -scores[axis])
    found += [(f"along {axis}", np.array(AXES[axis], dtype=float)) for axis in level]
    if not away and np.linalg.norm(inward) > 0:
        found = [it for it in found if abs(float(it[1] @ inward)) < ALIKE]
        found = [("towards the robot", inward), *found, ("away from the robot", -inward)]
    return found


def _turned(here: Situation, end: str, place: tuple[str, Any], angle: float) -> tuple[Edit, ...]:
    """Edits of a pose of the file that turn it about the vertical through the centre of mass."""
    where, pose = _pose(here, place)
    X_WP, middle = here.ends[end], here.middle(end)
    c, s = np.cos(angle), np.sin(angle)
    xyz = middle + np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]) @ (X_WP[:3, 3] - middle)
    edits = []
    if np.linalg.norm(xyz - X_WP[:3, 3]) > 1e-4:
        edits.append(Edit(here.file, f"{where}.xyz", _rounded(xyz)))
    if "quat_xyzw" in pose:
        x, y, z, w = pose["quat_xyzw"]
        c, s = np.cos(angle / 2), np.sin(angle / 2)
        turned = [c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z]
        edits.append(Edit(here.file, f"{where}.quat_xyzw", _rounded(np.array(turned))))
    else:
        # The yaw comes last in the file's order: a turn about the vertical adds to it.
        roll, pitch, yaw = (float(value) for value in pose.get("rpy", [0.0, 0.0, 0.0]))
        edits.append(Edit(here.file, f"{where}.rpy", [roll, pitch, round(yaw + angle, 6)]))
    return tuple(edits)
