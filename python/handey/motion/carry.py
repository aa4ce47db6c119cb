"""What carrying one part is asked with, and what comes of it: budgets, workspace, motions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.motion.gross_motion import Search
from handey.motion.stage_clock import StageClock
from handey.motion.way_out import WayOutOptions

__all__ = ["Carry", "DirectOptions", "Motion", "Workspace", "at"]


@dataclass(frozen=True)
class DirectOptions:
    """Budgets of one attempt.

    Attributes:
        approach: options of the local planner.
        retreat: options of straight lifts and withdrawals.
        departure: the same in the grasp plane, where no straight one leads out.
        roomier: the same, where a straight one does, but ends with little room. Choice: farther,
            and only what is quick.
        gross: options of the gross motions.
        most_places: configurations at the destination that are tried for one grasp.
        arm: budget of motions near obstacles by the whole arm, where the local planners give none;
            None: they are not tried.
    """

    approach: _core.ApproachOptions = field(default_factory=_core.ApproachOptions)
    retreat: _core.RetreatOptions = field(default_factory=_core.RetreatOptions)
    departure: _core.DepartureOptions = field(default_factory=_core.DepartureOptions)
    roomier: _core.DepartureOptions = field(
        default_factory=lambda: _core.DepartureOptions(most=0.16, most_slides=1, search_levels=0)
    )
    gross: _core.GrossOptions = field(default_factory=_core.GrossOptions)
    most_places: int = 4
    arm: WayOutOptions | None = None


@dataclass(frozen=True)
class Workspace:
    """What stays the same while one goal is planned.

    Attributes:
        model: collision geometry of the cell.
        scene: the cell with the part at its origin and an empty hand, and where the part is to go.
        solver: inverse kinematics of the arm.
        current: where the arm is, and the opening.
        home: configurations to return to after the goal; None to stay.
        clock: CPU seconds by stage.
        table: makes or reads maps of the arm's plane, for gross motions that are not straight.
        given: how often each planner gave a motion near obstacles, by (action, planner).
        give_up: called where the first tries fail, told whether grasps were legal; raises if it is
            proved that all must fail.
        give_part_up: called where motions with the part in the hand fail; raises if it is proved
            that it does not come to its goal.
    """

    model: _core.CollisionModel
    scene: _core.GraspScene
    solver: _core.SphericalWristSolver
    current: _core.Configuration
    home: np.ndarray | None
    clock: StageClock
    table: Callable[[], _core.ArmTable | None] = lambda: None
    given: Counter[tuple[str, str]] = field(default_factory=Counter)
    give_up: Callable[[bool], None] = lambda _: None
    give_part_up: Callable[[], None] = lambda: None


@dataclass(frozen=True)
class Motion:
    """A certified polyline that serves one action of the plan.

    Attributes:
        action: the plan's.
        path: waypoints.
        held: the part is in the hand.
        search: how it was found, of gross motions.
        planner: what gave it, of motions near obstacles.
        X_HP: the part in the grasp frame (4, 4), where it is not that of the whole carry.
    """

    action: str
    path: list[_core.Configuration]
    held: bool = False
    search: Search | None = None
    planner: str = ""
    X_HP: np.ndarray | None = None


@dataclass
class Carry:
    """How far one grasp got.

    Attributes:
        stage: the last stage reached; "done" if all of it was planned.
        reason: why it stopped.
        met: asked what stands in the way there: pairs of bodies, the most frequent first.
        motions: the whole of it when done.
        X_HP: the part in the grasp frame, shape (4, 4).
        end: where the arm is afterwards.
        regrasps: times that the part is put down on the way and taken again.
    """

    stage: str
    reason: str = ""
    motions: list[Motion] = field(default_factory=list)
    X_HP: np.ndarray = field(default_factory=lambda: np.eye(4))
    grasp: _core.GraspPose | None = None
    end: _core.Configuration | None = None
    regrasps: int = 0
    met: Callable[[], list[_core.Hit]] = field(default=list, repr=False)


def at(q: np.ndarray, opening: float) -> _core.Configuration:
    """The arm at `q` with the pads so far apart."""
    return _core.Configuration(q=q, opening=opening)
