"""What was tried, how far it got, and how long each stage took.

A planner answers with a plan or with a reason. The reason is collected here while planning: per
goal the funnel of grasps (found, spanned by the jaws, unobstructed, legal at both ends,
approached, connected) and for every attempt the stage at which it fell with the planner's own
words, which name bodies and numbers.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from handey.advice import Advice
from handey.failure_text import failure_lines
from handey.reasons import Reason, Stage, Tried

if TYPE_CHECKING:
    from handey.funnel import Funnel

__all__ = [
    "Attempt",
    "GoalReport",
    "GrossMotion",
    "LocalMotion",
    "Report",
    "Search",
    "StageClock",
]


class StageClock:
    """CPU seconds by stage, counted by `with clock("approach"):`; stages do not nest.

    Attributes:
        seconds: by stage.
        trying: what is tried now: "goal 0, grasp 3 of 12".
    """

    def __init__(self, progress: Callable[[str, str], None] | None = None) -> None:
        """`progress` is told each stage as it begins, and what of it is tried."""
        self.seconds: dict[str, float] = {}
        self.trying = ""
        self._stage, self._progress = "", progress

    def tell(self, detail: str = "") -> None:
        """Tell how far the stage is: "window 2 of 5"."""
        if self._progress is not None:
            self._progress(self._stage, ", ".join(t for t in (self.trying, detail) if t))

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        """Count the time of the block for `stage`."""
        self._stage = stage
        self.tell()
        begin = time.process_time()
        try:
            yield
        finally:
            self.seconds[stage] = self.seconds.get(stage, 0.0) + time.process_time() - begin


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


@dataclass(frozen=True)
class Search:
    """How one gross motion was found.

    Attributes:
        planner: "straight", "slices" or "RRT-Connect".
        cpu_s: CPU seconds of the search that gave it; searches before it that failed not counted.
        fallback_reason: why the slices did not give it; empty where they were not needed or did.
    """

    planner: str
    cpu_s: float
    fallback_reason: str = ""


@dataclass(frozen=True)
class GrossMotion:
    """A gross motion of the plan.

    Attributes:
        step: index in the plan's steps.
        goal: index in the task of the goal that it serves.
        action: "transit" or "transfer".
        search: how it was found.
    """

    step: int
    goal: int
    action: str
    search: Search

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        place = {"step": self.step, "goal": self.goal, "action": self.action}
        return place | vars(self.search) | {"cpu_s": round(self.search.cpu_s, 6)}


@dataclass(frozen=True)
class LocalMotion:
    """A motion near obstacles of the plan.

    Attributes:
        step: index in the plan's steps.
        goal: index in the task of the goal that it serves.
        action: "approach", "depart", "deposit" or "withdraw".
        planner: what gave it: "straight", "two straights", "quasipotential", "plane search",
            "RRT-Connect".
    """

    step: int
    goal: int
    action: str
    planner: str


@dataclass
class GoalReport:
    """How the planning of one goal went.

    Attributes:
        goal: index in the task.
        text: the goal in words.
        status: "planned", "met already", "failed", "stopped" (planning was, while it was tried) or
            "not tried".
        funnel: counts by stage, in the order of the stages.
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
    funnel: dict[str, int] = field(default_factory=dict)
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
        self.funnel, self.reasons, self.attempts, self.refusals = {}, [], [], []
        self.looked = looked

    def fail(self, reasons: list[Reason]) -> None:
        """It failed before any grasp was looked at."""
        self.funnel, self.attempts, self.status = {}, [], "failed"
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
        """Add to a count of the funnel."""
        self.funnel[stage] = self.funnel.get(stage, 0) + count

    def summary(self) -> list[str]:
        """Lines for people: why it failed, stage by stage; they fit a screen."""
        return failure_lines(self)

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return {
            "goal": self.goal,
            "text": self.text,
            "status": self.status,
            "funnel": self.funnel,
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


@dataclass
class Report:
    """How the planning of a task went.

    Attributes:
        verdict: "plan"; "infeasible" where it is proved that a goal cannot be reached, at the
            resolution that its `proof` tells; "unknown" where all that was tried failed.
        goals: one report per goal of the task.
        gross_motions: of the plan, in the order of its steps.
        local_motions: the same of the motions near obstacles.
        planners: how often each planner gave a motion near obstacles, by action; attempts that fell
            later count too.
        stages: CPU seconds by stage.
        cpu_s: CPU seconds of planning, without reading files and without the check.
        wall_s: the same by the wall clock.
        duration_s: of the planned motion; 0 without a plan.
        regrasps: times that a part is put down and taken again.
        deadline_passed: planning stopped because the deadline had passed.
        cancelled: planning stopped because it was cancelled or interrupted.
        seed: fixes every random choice.
    """

    verdict: str = "unknown"
    goals: list[GoalReport] = field(default_factory=list)
    gross_motions: list[GrossMotion] = field(default_factory=list)
    local_motions: list[LocalMotion] = field(default_factory=list)
    planners: dict[str, dict[str, int]] = field(default_factory=dict)
    stages: dict[str, float] = field(default_factory=dict)
    cpu_s: float = 0.0
    wall_s: float = 0.0
    duration_s: float = 0.0
    regrasps: int = 0
    deadline_passed: bool = False
    cancelled: bool = False
    seed: int = 0

    @property
    def stopped(self) -> bool:
        """Planning was stopped before all was tried."""
        return self.deadline_passed or self.cancelled

    @property
    def reasons(self) -> list[str]:
        """Why there is no plan, in lines for people; empty with a plan."""
        if self.verdict == "plan":
            return []
        lines = ["the deadline passed"] if self.deadline_passed else []
        lines += ["planning was cancelled"] if self.cancelled else []
        for goal in self.goals:
            if goal.status in ("failed", "stopped"):
                lines += goal.summary()
        return lines

    def as_dict(self) -> dict[str, Any]:
        """All of it as JSON values."""
        return {
            "verdict": self.verdict,
            "cpu_s": self.cpu_s,
            "wall_s": self.wall_s,
            "duration_s": self.duration_s,
            "regrasps": self.regrasps,
            "stages": self.stages,
            "seed": self.seed,
            "deadline_passed": self.deadline_passed,
            "cancelled": self.cancelled,
            "gross_motions": [motion.as_dict() for motion in self.gross_motions],
            "local_motions": [vars(motion) for motion in self.local_motions],
            "planners": self.planners,
            "goals": [goal.as_dict() for goal in self.goals],
            "reasons": self.reasons,
        }
