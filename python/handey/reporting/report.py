"""How the planning of a task went: its verdict, its goals, the motions of the plan, and the times.

A planner answers with a plan or with a reason; the reasons are those of the goals.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from handey.motion.gross_motion import Search
from handey.reporting.failure_text import failure_lines
from handey.reporting.goal_report import GoalReport

__all__ = ["GrossMotion", "Interrupted", "LocalMotion", "Report"]


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
                lines += failure_lines(goal)
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


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while planning.

    Attributes:
        report: what was tried so far.
    """

    def __init__(self, report: Report) -> None:
        self.report = report
        super().__init__()
