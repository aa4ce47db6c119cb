"""What a check found: the faults, each under the name of its clause, and the margins."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any

__all__ = ["CLAUSES", "CheckFault", "CheckReport"]

#: The clauses of 'a valid plan', by name.
CLAUSES: dict[str, str] = {
    "format": "the plan has every required key, with values of the right kind and shape",
    "grammar": "the steps come in the order {{transit} approach grasp depart {transfer} deposit "
    "release withdraw} {transit}, and the hand is empty in the end",
    "held": "part and part_in_grasp_frame are set in depart, transfer and deposit, and only there; "
    "both stay the same from depart to deposit",
    "continuity": "a step begins where the step before ends (1e-9)",
    "time": "time starts at 0 and never decreases",
    "joint-limits": "joints and opening stay within their limits",
    "velocity": "no joint exceeds its velocity limit",
    "still": "the arm stands still while the fingers close in grasp and open in release; the "
    "opening, while a part is held",
    "start": "the plan begins at the cell's start configuration and opening",
    "finish": "the arm returns to its start configuration (finish: start)",
    "collision": "no two bodies overlap by more than 0.01 mm",
    "self-collision": "the robot does not overlap itself by more than 0.01 mm",
    "contact": "allowed contacts are no deeper than 0.5 mm",
    "pads": "while a part is held both pads lie on it",
    "jump": "a part is taken where it stands; nothing jumps",
    "stability": "a part that is let go stands stably",
    "support": "between regrasps a part stands on a support",
    "moved": "only parts with a goal or may_move are moved",
    "goal": "each goal is reached, in its turn, and holds in the end",
    "placements": "placements name the moved parts and where they stand in the end",
}


@dataclass(frozen=True)
class CheckFault:
    """One broken clause.

    Attributes:
        clause: its name, a key of `CLAUSES`.
        step: index of the step; None where the fault is the whole plan's.
        time: when, as a time of the plan [s]; None where time has no part in it.
        message: the bodies and the numbers.
        action: the step's action; empty without a step.
    """

    clause: str
    step: int | None
    time: float | None
    message: str
    action: str = ""

    def __str__(self) -> str:
        where = ""
        if self.step is not None:
            where = f" step {self.step}" + (f" ({self.action})" if self.action else "")
        if self.time is not None:
            where += f" at {self.time:.4f} s"
        return f"{self.clause}:{where + ':' if where else ''} {self.message}"


@dataclass
class CheckReport:
    """The outcome of a check.

    Attributes:
        faults: what is wrong, in the order of the steps; at most one per clause, step and pair of
        bodies. least_clearance: least distance between robot or held part and the cell, contacts
        that belong to
            the work left out [m]; infinite where nothing was near. The true minimum is not more
            than 10 % + 0.05 mm smaller. Zero where something collides.
        least_clearance_between: the two bodies.
        least_clearance_time: when [s].
        least_self_clearance: the same, of the robot with itself [m].
        duration: of the plan [s].
        samples: configurations at which distances were bounded or measured.
        distance_queries: exact distances asked of the engine.
        warnings: what is odd, but breaks no clause.
    """

    faults: list[CheckFault] = field(default_factory=list)
    least_clearance: float = math.inf
    least_clearance_between: tuple[str, str] | None = None
    least_clearance_time: float | None = None
    least_self_clearance: float = math.inf
    duration: float = 0.0
    samples: int = 0
    distance_queries: int = 0
    warnings: list[str] = field(default_factory=list)

    @property
    def ok(self) -> bool:
        """True if no clause is broken."""
        return not self.faults

    def add(
        self,
        clause: str,
        message: str,
        step: int | None = None,
        time: float | None = None,
        action: str = "",
    ) -> None:
        """Note a fault."""
        if clause not in CLAUSES:
            raise KeyError(clause)
        self.faults.append(CheckFault(clause, step, time, message, action))

    def to_json(self) -> dict[str, Any]:
        """The report as JSON values; infinities become null."""
        content = asdict(self)
        content["ok"] = self.ok
        for key, value in content.items():
            if isinstance(value, float) and not math.isfinite(value):
                content[key] = None
        return content

    def __str__(self) -> str:
        if not self.ok:
            return "\n".join(str(fault) for fault in self.faults)
        clearance = "none measured"
        if self.least_clearance_between is not None and self.least_clearance_time is not None:
            a, b = self.least_clearance_between
            clearance = f"{self.least_clearance * 1e3:.2f} mm"
            clearance += f" ({a} - {b}, {self.least_clearance_time:.3f} s)"
        return f"valid: {self.duration:.2f} s, least clearance {clearance}"
