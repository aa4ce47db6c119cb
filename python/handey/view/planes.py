"""Which grasp planes the page shows: of each approach of a plan, or of the best grasp that fell."""

from __future__ import annotations

import html

import numpy as np

from handey import _core
from handey.cell_file import load_cell
from handey.check.carries import find_carries
from handey.check.cell import Cell
from handey.check.kinematics import forward
from handey.check.plan_data import PlanData, Step
from handey.errors import InvalidInput
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import STAGES, Tried
from handey.reporting.report_file import ToldReport
from handey.view.grasp_plane import HandPose, PlanePicture, plane_picture
from handey.view.scene import ends_of

__all__ = ["grasp_planes"]

MOST_POSES = 40  # of the hand on its way
MOST_PLANES = 12  # Choice: more approaches than anyone compares
CLEARANCE = 0.008  # of the pads on both sides, where the opening is not told [m]


def grasp_planes(cell: Cell, plan: PlanData | None, report: ToldReport | None) -> dict[int, str]:
    """Figures as HTML, by goal; empty where the planner's own reading refuses the cell."""
    try:
        core = load_cell(cell.file).cell
    except InvalidInput:
        return {}
    if plan is not None:
        return _of_plan(core, cell, plan)
    return {} if report is None else _of_failure(core, cell, report)


def _of_plan(core: _core.Cell, cell: Cell, plan: PlanData) -> dict[int, str]:
    _, world = find_carries(plan, cell) if plan.steps else (None, None)
    names, figures = cell.part_names(), dict[int, str]()
    approaches = [step for step in plan.steps if step.action == "approach"][:MOST_PLANES]
    for step in approaches:
        held = next((s.part for s in plan.steps[step.index :] if s.part is not None), None)
        if world is None or held not in names:
            continue
        there = core
        for name, pose in world.standing[step.index].items():
            there = there.with_part_at(names.index(name), pose)
        opening = float(step.opening[-1])
        picture = plane_picture(there, names.index(held), opening, _way(cell, step))
        if picture is not None:
            title = f"Approach to {held}"
            figure = _figure(picture, title, "follows the time line", step.index)
            figures[step.goal] = figures.get(step.goal, "") + figure
    return figures


def _way(cell: Cell, step: Step) -> list[HandPose]:
    rows = np.unique(np.linspace(0, len(step.time) - 1, MOST_POSES).round().astype(int))
    frames = forward(cell.robot, cell.base, step.q[rows], step.opening[rows])
    return [
        HandPose(float(step.time[row]), frames.matrix(cell.robot.hand, k, cell.robot.grasp_frame))
        for k, row in enumerate(rows)
    ]


def _of_failure(core: _core.Cell, cell: Cell, report: ToldReport) -> dict[int, str]:
    figures = {}
    for goal in report.goals:
        best, ends = _best(goal), ends_of(cell, None, goal)
        if goal.status == "planned" or best is None or ends is None:
            continue
        part, origin, _ = ends
        there = core.with_part_at(part, origin)
        poses = [HandPose(0.0, origin @ np.array(best.X_PH))]
        picture = plane_picture(there, part, _opening(core, best), poses)
        if picture is not None:
            title = "The grasp that came farthest, at the origin"
            figures[goal.goal] = _figure(picture, title, f"fell at: {best.stage}", None)
    return figures


def _best(goal: GoalReport) -> Tried | None:
    """Of those that came farthest the first that fell by the cause, or else the first."""
    order = list(STAGES)
    usable = [pose for pose in goal.tried if pose.X_PH and pose.stage in order]
    told = "" if goal.cause is None else goal.cause.text
    return max(usable, key=lambda p: (order.index(p.stage), p.text == told), default=None)


def _opening(core: _core.Cell, tried: Tried) -> float:
    gripper = core.robot.gripper
    wanted = tried.opening or tried.width + 2 * CLEARANCE
    return float(np.clip(wanted, gripper.min_opening, gripper.max_opening))


def _figure(picture: PlanePicture, title: str, more: str, step: int | None) -> str:
    touching = f"{picture.touching} of {picture.lines} bump lines touch"
    caption = (
        f"{more}; seen along the closing axis. Grey: cells of 4 mm filled by what is beside a "
        f"finger (faint: beside the palm only). Bump lines stand 6 mm off the hand: at the grasp "
        f"{touching}."
    )
    if picture.off_plane > 1e-3:
        caption += f" The hand leaves the plane by {1e3 * picture.off_plane:.0f} mm."
    attribute = "" if step is None else f' data-step="{step}"'
    words = html.escape(caption[0].upper() + caption[1:])
    return (
        f'<figure class="plane"{attribute}><h3>{html.escape(title)}</h3>{picture.svg}'
        f"<figcaption>{words}</figcaption></figure>"
    )
