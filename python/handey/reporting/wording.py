"""Why something fell, in words and typed: from what the compiled core tells of it.

Texts are for people: names as in the cell, links of the robot without "_link", millimetres and
degrees. What programs need is in the fields beside the text.
"""

from __future__ import annotations

import math

from handey import _core
from handey.motion.carry import Carry
from handey.reporting.reasons import KINDS, Reason

__all__ = [
    "ENDS",
    "Names",
    "at_end",
    "of_carry",
    "of_fallen",
    "of_obstacle",
    "of_obstructed",
    "of_rejected",
    "plain",
]

_REJECTED = {"TooWide": "too_wide", "TooThin": "too_thin", "LittleOverlap": "little_overlap"}
_FALLEN = {
    "LittleContact": "little_contact",
    "Slips": "slips",
    "Turns": "turns",
    "OutOfReach": "out_of_reach",
    "JointLimit": "joint_limit",
    "Collision": "collision",
}
ENDS = {"Both": "", "Origin": "origin", "Destination": "destination"}
# Stages of a carry: the reason's kind, and the end at which it is.
_CARRY = {
    "approach": ("approach", "origin"),
    "depart": ("departure", "origin"),
    "deposit": ("deposit", "destination"),
    "withdraw": ("withdrawal", "destination"),
    "transit": ("transit", ""),
    "transfer": ("transfer", ""),
    "home": ("home", ""),
}

_FAILED = {
    "approach": "no way in to the part",
    "departure": "no way off with the part",
    "deposit": "no way in to the goal with the part",
    "withdrawal": "no way out for the open hand at the goal",
    "transit": "no motion of the empty hand to the part",
    "transfer": "no motion with the part to its goal",
    "home": "no motion back to where the arm rests",
}


def plain(link: str) -> str:
    """A link's name for people: "forearm" for "forearm_link"."""
    held = "held "
    if link.startswith(held):
        return link
    return link.removesuffix("_link").replace("_", " ")


def at_end(end: str) -> str:
    """How a reason tells of its end; empty for none or both."""
    return f" at the {end}" if end else ""


class Names:
    """Names of a robot in reasons: its fingers and what carries them are the hand."""

    def __init__(self, robot: _core.Robot) -> None:
        self.joints = [joint.name for joint in robot.joints]
        bodies, gripper = robot.bodies, robot.gripper
        self.links = {name for body in bodies for name in (body.name, *body.links)}
        hand = [gripper.body, *(finger.child for finger in gripper.fingers)]
        self._hand = {name for i in hand for name in (bodies[i].name, *bodies[i].links)}

    def mover(self, link: str) -> str:
        """What of the robot met something: "hand", or the link."""
        return "hand" if link in self._hand else link

    def body(self, name: str) -> str:
        """What was met, for people: a body of the cell keeps its name."""
        return plain(self.mover(name)) if name in self.links else name

    def hits(self, mover: str, body: str, depth: float | None) -> str:
        """As in: forearm hits post_2, 7.0 mm deep."""
        mover, body = self.pair(mover, body)
        deep = "" if depth is None else f", {1e3 * depth:.1f} mm deep"
        return f"{plain(mover)} hits {self.body(body)}{deep}"

    def pair(self, mover: str, body: str) -> tuple[str, str]:
        """What met what; the hand, where a link of the robot is the other, is what moved."""
        mover, body = self.mover(mover), self.mover(body)
        return (body, mover) if body == "hand" else (mover, body)

    def past(self, joint: int, by: float) -> str:
        """As in: joint5 is 11.4 degrees past its limit."""
        return f"{self.joints[joint]} is {math.degrees(by):.1f} degrees past its limit"


def of_rejected(pair: _core.RejectedPair) -> Reason:
    """A pair that the jaws cannot take."""
    kind = _REJECTED[pair.kind.name]
    return Reason(kind, "spanned", f"{pair}: {pair.reason}", by=float(pair.by))


def of_obstructed(ranked: _core.RankedPair) -> Reason:
    """A pair of which too little is free; of the end that takes more."""
    at_origin, at_destination = ranked.obstructing_at_origin, ranked.obstructing_at_destination
    taken_first, taken = 1 - ranked.share_at_origin, 1 - ranked.share
    if at_destination and taken - taken_first > taken_first:
        end, bodies = "destination", at_destination
    elif at_origin:
        end, bodies = "origin", at_origin
    else:
        end, bodies = "", at_destination
    names = ", ".join(bodies) or "the part itself"
    text = f"{ranked.pair}: {100 * taken:.0f} % obstructed by {names}{at_end(end)}"
    return Reason("obstructed", "unobstructed", text, end=end, bodies=tuple(bodies), by=taken)


def _at_least(by: float, unit: str) -> str:
    """By how much the nearest of many missed, where that tells something."""
    return f", by {by:.1f} {unit} at least" if by >= 0.1 else ""


def of_fallen(fallen: _core.Fallen, names: Names) -> Reason:
    """Hand poses that fell alike."""
    kind, end = _FALLEN[fallen.kind.name], ENDS[fallen.end.name]
    by = None if fallen.least is None else float(fallen.least)
    text, mover, joint = fallen.text, "", ""
    bodies: tuple[str, ...] = ()
    if kind == "joint_limit":
        joint = names.joints[fallen.joint]
        text = f"{joint} past its limit{_at_least(math.degrees(by or 0.0), 'degrees')}"
    elif kind == "out_of_reach":
        side = "beyond reach" if "beyond" in fallen.text else "too close to an axis"
        text = f"wrist centre {side}{_at_least(1e3 * (by or 0.0), 'mm')}"
    elif kind == "collision":
        mover, body = names.pair(fallen.mover, fallen.body)
        bodies = (body,)
        text = names.hits(fallen.mover, fallen.body, by)
    if kind in ("joint_limit", "out_of_reach"):  # the number comes last
        what, comma, more = text.partition(",")
        text = f"{what}{at_end(end)}{comma}{more}"
    else:
        text += at_end(end)
    return Reason(kind, "reachable", text, fallen.count, end, bodies, mover, joint, by)


def of_obstacle(obstacle: _core.GraspObstacle, names: Names) -> Reason:
    """What stands in the way of hand poses."""
    end, least = ENDS[obstacle.end.name], float(obstacle.least)
    by = None if least < 0.0 else least
    kind = _FALLEN.get(obstacle.kind.name, "too_wide")
    stage, joint, mover = KINDS[kind], "", ""
    bodies: tuple[str, ...] = ()
    if kind == "joint_limit":
        joint, text = names.joints[obstacle.joint], names.past(obstacle.joint, least)
    elif kind == "collision":
        mover, body = names.pair(obstacle.mover, obstacle.body)
        bodies = (body,)
        text = names.hits(obstacle.mover, obstacle.body, by)
    elif kind == "out_of_reach":
        text = f"the wrist's centre is {1e3 * least:.0f} mm out of reach"
    elif kind == "too_wide":
        text = f"the part is {1e3 * least:.1f} mm too wide for the jaws"
    elif kind == "turns":
        text = f"the part would turn in the jaws, held {1e3 * least:.0f} mm off its balance"
    else:
        text = "the part would slip: the jaws do not hold its weight by friction"
    count = max(obstacle.alone, obstacle.in_fewest)
    return Reason(kind, stage, text + at_end(end), count, end, bodies, mover, joint, by)


def of_carry(carry: Carry, hit: _core.Hit | None, names: Names) -> Reason:
    """A grasp that could not be carried through, with what stood most in its way, if known."""
    kind, end = _CARRY[carry.stage]
    if hit is None:
        return Reason(kind, KINDS[kind], carry.reason, end=end)
    mover, body = names.pair(hit.a, hit.b)
    text = f"{_FAILED[kind]}: {names.hits(hit.a, hit.b, None)} ({carry.reason})"
    return Reason(kind, KINDS[kind], text, end=end, bodies=(body,), mover=mover)
