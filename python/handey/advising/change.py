"""One change of a cell: the edits, in words, how large it is, and what it costs to make.

Changes of unlike kinds are compared by their cost, on one rough scale: moving something by 10 mm
costs 1. A family is one thing that may be done by more or less.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from handey import _core
from handey.reporting.advice import Edit

__all__ = ["COSTS", "Change", "Family", "edited", "with_edits", "written"]

# Choice: what a change costs, in shifts of 10 mm: so much at all, and per metre, radian or unit.
COSTS = {
    "goal shifted": (0.0, 100.0),
    "part shifted": (0.5, 100.0),
    "goal turned": (1.0, 4.0),  # 15 degrees cost as much as 20 mm
    "part turned": (1.5, 4.0),
    "fixture moved": (1.0, 100.0),
    "part moved": (1.0, 100.0),
    "jaws": (2.0, 500.0),
    "friction": (2.0, 20.0),
    "finish": (3.0, 0.0),
    "order": (4.0, 0.0),
    "support": (4.0, 0.0),
    "may move": (5.0, 0.0),
    "joint limit": (5.0, 20.0),
    "robot start": (5.0, 0.0),
    "region": (5.0, 20.0),
    "earlier goal": (8.0, 0.0),
    "other fixture": (10.0, 0.0),
    "robot moved": (10.0, 50.0),
    "support added": (12.0, 0.0),
    "other goal": (15.0, 0.0),
    "removed": (40.0, 0.0),
}


MOVED_ALONG = 4.0  # Choice: what each thing costs that is moved along with another


@dataclass(frozen=True)
class Change:
    """Edits of the files of a cell, that belong together.

    Attributes:
        kind: of `COSTS`.
        words: "move wall by 60 mm along +y".
        edits: what to set.
        size: in metres, radians or the value's own unit.
        robot: of the cell, where the edits change its files.
        regrasps: the part may have to be put down on the way.
        load: how many things are moved along.
        awkward: what it costs besides: it leaves something in the air.
    """

    kind: str
    words: str
    edits: tuple[Edit, ...]
    size: float = 0.0
    robot: _core.Robot | None = None
    regrasps: bool = False
    load: int = 0
    awkward: float = 0.0

    @property
    def cost(self) -> float:
        """On the scale of all changes."""
        least, slope = COSTS[self.kind]
        return least + slope * abs(self.size) + MOVED_ALONG * self.load + self.awkward


@dataclass(frozen=True)
class Family:
    """One thing that may be done by more or less.

    Attributes:
        kind: of `COSTS`.
        make: the change of a size; None where there is none of this size.
        sizes: in the order to try them.
        rank: how plausible it is that it helps: less is more.
        wave: as much less plausible is each further size.
        step: sizes are multiples of it; 0 where all but `sizes` are meaningless.
        body: that is taken to be in the way: if the goal does not plan without it, all of the
            family is in vain.
    """

    kind: str
    make: Callable[[float], Change | None]
    sizes: tuple[float, ...] = (0.0,)
    rank: float = 0.0
    wave: float = 4.0
    step: float = 0.0
    body: str = ""


def with_edits(value: Any, edits: Sequence[Edit]) -> Any:
    """The content of a file with values set: a new one; what is not changed is shared.

    Args:
        value: mappings, lists and values, as the file holds them.
        edits: all of this file.
    """
    for edit in edits:
        value = edited(value, edit.place, edit.value)
    return value


def edited(value: Any, place: str, new: Any) -> Any:
    """The content of a file with one value set, or taken out where `new` is None.

    Mappings on the way to it are made where they are missing.
    """
    if not place:
        return new
    if isinstance(value, list):
        index = int(place[1 : place.index("]")])
        rest = place[place.index("]") + 1 :].removeprefix(".")
        return [edited(it, rest, new) if i == index else it for i, it in enumerate(value)]
    entries = dict(value or {})
    key = _first_key(entries, place)
    rest = place[len(key) :].removeprefix(".")
    found = edited(entries.get(key), rest, new)
    if found is None:
        entries.pop(key, None)
    else:
        entries[key] = found
    return entries


def _first_key(entries: dict[str, Any], place: str) -> str:
    """The key that a place begins with; names may hold dots."""
    known = [key for key in entries if re.match(re.escape(key) + r"($|[.\[])", place)]
    return max(known, key=len) if known else re.split(r"[.\[]", place, maxsplit=1)[0]


def written(value: Any) -> str:
    """A value in words: short numbers."""
    if isinstance(value, float):
        return f"{value:.4f}".rstrip("0").rstrip(".") or "0"
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(written(it) for it in value)}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {written(it)}" for key, it in value.items()) + "}"
    return str(value).lower() if isinstance(value, bool) else str(value)
