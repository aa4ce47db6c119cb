"""Why grasps and motions of a goal fell: typed reasons, stage by stage of the funnel.

The funnel is the planner's own order: feature pairs are found, those wider than the jaws fall, then
those that neighbours cover; hand poses on the rest fall where arm or hand is illegal at an end; the
grasps that are left are approached, then connected by gross motions. A reason tells how many fell
at one of these stages by one cause, the bodies that caused it, and by how much the nearest missed.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

__all__ = ["KINDS", "STAGES", "Reason", "Stage", "Tried", "merged"]

# The stages of the funnel, and what each counts.
STAGES = {
    "found": "feature pairs",
    "spanned": "feature pairs",
    "unobstructed": "feature pairs",
    "reachable": "hand poses",
    "approached": "grasps",
    "connected": "grasps",
}

# The causes, by the first stage at which they count.
KINDS = {
    "would_fall": "found",  # something stands on the part that is to be moved
    "unstable": "found",  # the part would not stand at its goal
    "in_the_way": "found",  # a part is where this one is to go
    "no_place": "found",  # no clear, stable placement for `on` or `inside`
    "no_features": "found",  # no two features are opposite to each other
    "too_wide": "spanned",  # by, metres: how much the jaws lack
    "too_thin": "spanned",  # by, metres: how much farther the jaws would have to close
    "little_overlap": "spanned",  # by, square metres: how much the two faces lack
    "obstructed": "unobstructed",  # neighbours cover the features; by, 0..1: the share
    "little_contact": "reachable",  # pads would lie on too little of the features
    "slips": "reachable",  # friction does not hold the part's weight
    "turns": "reachable",  # by, metres: the part's weight would turn it in the jaws
    "out_of_reach": "reachable",  # by, metres: the wrist centre beyond (too close to) the arm
    "joint_limit": "reachable",  # joint; by, radians: how far past its limit
    "collision": "reachable",  # mover hits bodies; by, metres: how deep the least of them
    "approach": "approached",  # the hand does not come in to the part, or does not close
    "departure": "approached",  # the held part does not come away from where it stands
    "deposit": "approached",  # the held part does not come in to its goal
    "withdrawal": "approached",  # the open hand does not come out at the goal
    "transit": "connected",  # no gross motion of the empty hand
    "transfer": "connected",  # no gross motion with the part
    "home": "connected",  # no gross motion to where the arm rests
    "no_regrasp": "connected",  # no chain of regrasps; no support to put the part down on
}


@dataclass(frozen=True)
class Reason:
    """One cause for which some of a stage fell.

    Attributes:
        kind: of `KINDS`.
        stage: of `STAGES`.
        text: for people, with names and numbers, without the count: "forearm hits post_2, 7.0 mm
            deep, at the destination".
        count: how many of what the stage counts fell by it; 1 where it holds for the whole goal.
        end: "origin", "destination", or empty where it is neither or both.
        bodies: what stood in the way: names of fixtures, parts or the robot's links, the most
            frequent first.
        mover: the robot's link, or "held NAME", that met them.
        joint: that is past its limit.
        by: how much the nearest of them missed, in the unit that `KINDS` says; None if unknown.
        proved: it is certain for every grasp, not only for those looked at.
    """

    kind: str
    stage: str
    text: str
    count: int = 1
    end: str = ""
    bodies: tuple[str, ...] = ()
    mover: str = ""
    joint: str = ""
    by: float | None = None
    proved: bool = False

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return vars(self) | {"bodies": list(self.bodies)}

    def __str__(self) -> str:
        return self.text


def merged(reasons: Iterable[Reason]) -> list[Reason]:
    """Reasons that tell the same as one, with the words of the nearest; most frequent first."""
    found: dict[tuple[object, ...], Reason] = {}
    for reason in reasons:
        key = reason.kind, reason.stage, reason.end, reason.bodies, reason.mover, reason.joint
        known = found.get(key)
        if known is None:
            found[key] = reason
            continue
        nearer = known.by is None or (reason.by is not None and reason.by < known.by)
        kept = reason if nearer and reason.by is not None else known
        found[key] = replace(kept, count=known.count + reason.count)
    return sorted(found.values(), key=lambda reason: -reason.count)


@dataclass
class Stage:
    """One stage of the funnel.

    Attributes:
        name: of `STAGES`.
        entered: how many came to it, of what `STAGES` says.
        passed: how many passed it.
        reasons: why the others fell, most frequent first.
    """

    name: str
    entered: int = 0
    passed: int = 0
    reasons: list[Reason] = field(default_factory=list)

    @property
    def fell(self) -> int:
        """How many fell at it."""
        return self.entered - self.passed

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return {
            "stage": self.name,
            "of": STAGES[self.name],
            "entered": self.entered,
            "passed": self.passed,
            "fell": self.fell,
            "reasons": [reason.as_dict() for reason in self.reasons],
        }


@dataclass(frozen=True)
class Tried:
    """A hand pose that was looked at: for pictures of what was tried.

    Attributes:
        X_PH: grasp frame in the part, 4 rows of 4 [m].
        opening: of the jaws as they come [m].
        width: of the jaws closed on the part [m].
        stage: of `STAGES`, at which it fell; empty for the grasp that was planned with.
        text: why, as in `Reason.text`.
    """

    X_PH: list[list[float]]
    opening: float
    width: float
    stage: str
    text: str = ""
