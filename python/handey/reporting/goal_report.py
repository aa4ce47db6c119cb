"""How the planning of one goal went: grasp by grasp when tried, by stages once explained."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from handey.reporting.advice import Advice
from handey.reporting.funnel import Funnel
from handey.reporting.reasons import Reason, Stage, Tried

__all__ = ["Attempt", "GoalReport"]


@dataclass
class Attempt:
    """One grasp that was tried.

    Attributes:
        grasp: which one: "faces 3/7, 40.0 mm, from above".
        stage: the stage that it reached last: approach, depart, deposit, withdraw, transit,
            transfer, home, done.
        reason: why it went no farther; empty when done.
    """

    grasp: str
    stage: str
    reason: str = ""


@dataclass
class GoalReport:
    """How the planning of one goal went.

    Attributes:
        goal: index in the task.
        text: the goal in words.
        status: "planned", "met already", "failed", "stopped" (planning was, while it was tried) or
            "not tried".
        counts: of what was looked at and what came of it, by name, in the order met.
        reasons: why grasps fell before they were tried, most frequent first.
        attempts: the grasps that were tried, in order.
        grasp: the grasp chosen, in words; empty without one.
        jaws: distance between the pads [m] as the hand comes ("open") and on the part ("closed");
            empty without a grasp.
        exhausted: it is proved that the goal cannot be reached: `proof` says why.
        aside: names of parts moved aside for it, in order.
        stages: the funnel, stage by stage, with typed reasons.
        cause: the reason that explains the failure best; None without a failure.
        tried: some of the hand poses looked at, for pictures: all approached, samples of others.
        proof: why there is certainly no plan, at which resolution; empty where that is not known.
        covered: what was looked at, in lines for people.
        advice: the nearest change with which the goal plans; None if none was sought or found.
        refusals: what was in the way without a look at any grasp; in `stages` once it is explained.
        looked: what became of pairs and grasps, until it is explained.
    """

    goal: int
    text: str
    status: str = "not tried"
    counts: dict[str, int] = field(default_factory=dict)
    reasons: list[str] = field(default_factory=list)
    attempts: list[Attempt] = field(default_factory=list)
    grasp: str = ""
    jaws: dict[str, float] = field(default_factory=dict)
    exhausted: bool = False
    aside: list[str] = field(default_factory=list)
    stages: list[Stage] = field(default_factory=list)
    cause: Reason | None = None
    tried: list[Tried] = field(default_factory=list)
    proof: str = ""
    covered: list[str] = field(default_factory=list)
    advice: Advice | None = None
    refusals: list[Reason] = field(default_factory=list)
    looked: Funnel | None = field(default=None, repr=False, compare=False)

    def begin(self, looked: Funnel) -> None:
        """A goal may be tried again from another state of the cell: only the last try is told."""
        self.counts, self.reasons, self.attempts, self.refusals = {}, [], [], []
        self.looked = looked

    def fail(self, reasons: list[Reason]) -> None:
        """It failed before any grasp was looked at."""
        self.counts, self.attempts, self.status = {}, [], "failed"
        self.reasons, self.refusals, self.looked = [r.text for r in reasons], list(reasons), None

    def prove(self, text: str, cause: Reason | None) -> None:
        """It is certain that it cannot be reached."""
        self.status, self.proof, self.exhausted, self.cause = "failed", text, True, cause
        self.reasons.insert(0, text)

    def note(self, reason: Reason) -> None:
        """Add a reason, once."""
        if reason not in self.refusals:
            self.refusals.append(reason)
            self.reasons.append(reason.text)

    def add(self, stage: str, count: int) -> None:
        """Add to a count."""
        self.counts[stage] = self.counts.get(stage, 0) + count

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return {
            "goal": self.goal,
            "text": self.text,
            "status": self.status,
            "counts": self.counts,
            "reasons": self.reasons,
            "grasp": self.grasp,
            "jaws": self.jaws,
            "aside": self.aside,
            "attempts": [vars(attempt) for attempt in self.attempts],
            "stages": [stage.as_dict() for stage in self.stages],
            "cause": None if self.cause is None else self.cause.as_dict(),
            "tried": [vars(tried) for tried in self.tried],
            "proof": self.proof,
            "covered": self.covered,
            "advice": None if self.advice is None else self.advice.as_dict(),
        }
