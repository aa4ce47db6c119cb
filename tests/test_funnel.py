"""The funnel of a goal: how many pairs, hand poses and grasps fell at which stage, and why."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

import handey
from handey import _core
from handey.reporting.failure_text import failure_lines
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import KINDS, STAGES, Reason, merged

ROBOT = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560" / "robot.yaml"
TABLE = "  table: {box: [2.6, 2.0, 0.05], pose: {xyz: [0.55, 0, -0.025]}}\n"
BLOCK = "  block: {box: [0.04, 0.06, 0.05], pose: {xyz: [0.50, 0.20, 0.025]}}\n"
GOAL = "task:\n  - {place: block, at: {xyz: [0.45, -0.25, 0.025]}}\n"


def _report(
    folder: Path, *, fixtures: str = "", parts: str = BLOCK, task: str = GOAL
) -> GoalReport:
    path = folder / "cell.yaml"
    path.write_text(
        f"handey_cell: 1\nname: cell\nrobot: {{file: {ROBOT}}}\n"
        f"fixtures:\n{TABLE}{fixtures}parts:\n{parts}{task}"
    )
    report = handey.plan(handey.load_cell(path)).report
    json.dumps(report.as_dict(), allow_nan=False)
    return report.goals[0]


def _reasons(goal: GoalReport, kind: str) -> list[Reason]:
    return [reason for stage in goal.stages for reason in stage.reasons if reason.kind == kind]


def _check_sums(goal: GoalReport) -> None:
    """Stages in order; at each of them as many fell as reasons tell."""
    assert [stage.name for stage in goal.stages] == list(STAGES)
    by_name = {stage.name: stage for stage in goal.stages}
    for stage in goal.stages:
        assert 0 <= stage.passed <= stage.entered
        counts = [reason.count for reason in stage.reasons]
        assert counts == sorted(counts, reverse=True)
        assert all(reason.kind in KINDS and reason.stage == stage.name for reason in stage.reasons)
    for name in ("spanned", "unobstructed", "reachable", "approached"):
        assert sum(reason.count for reason in by_name[name].reasons) == by_name[name].fell
    assert by_name["found"].passed == by_name["spanned"].entered
    assert by_name["spanned"].passed == by_name["unobstructed"].entered
    assert by_name["reachable"].passed >= by_name["approached"].entered
    assert by_name["approached"].passed >= by_name["connected"].entered


def test_a_planned_goal_tells_its_funnel_and_no_cause(tmp_path: Path) -> None:
    goal = _report(tmp_path)
    _check_sums(goal)
    assert goal.status == "planned" and goal.cause is None
    # Three pairs of faces; the block stands on one of them.
    assert [(stage.entered, stage.passed) for stage in goal.stages[:3]] == [(3, 3), (3, 3), (3, 2)]
    assert goal.stages[-1].passed == 1
    assert [reason.bodies for reason in goal.stages[2].reasons] == [("table",)]
    assert sum(not tried.stage for tried in goal.tried) == 1, "the grasp that was planned with"


def test_a_part_wider_than_the_jaws_tells_by_how_much(tmp_path: Path) -> None:
    parts = "  block: {box: [0.099, 0.12, 0.11], pose: {xyz: [0.50, 0.20, 0.055]}}\n"
    goal = _report(tmp_path, parts=parts, task=GOAL.replace("0.025", "0.055"))
    _check_sums(goal)
    wide = _reasons(goal, "too_wide")
    assert len(wide) == 1 and wide[0].count == goal.stages[1].fell > 3
    assert wide[0].by == pytest.approx(0.003) and "3.0 mm short" in wide[0].text
    assert goal.cause == wide[0] and goal.stages[1].passed == 0


def test_what_stands_on_the_part_is_named(tmp_path: Path) -> None:
    top = "  top: {box: [0.04, 0.04, 0.04], pose: {xyz: [0.50, 0.20, 0.07]}}\n"
    goal = _report(tmp_path, parts=BLOCK + top)
    assert goal.cause is not None
    assert (goal.cause.kind, goal.cause.bodies) == ("would_fall", ("top",))
    assert goal.stages[0].reasons == [goal.cause] and goal.stages[0].entered == 0


def test_a_part_too_heavy_for_the_jaws_slips(tmp_path: Path) -> None:
    goal = _report(tmp_path, parts=BLOCK.replace("pose", "mass: 30, pose", 1))
    _check_sums(goal)
    assert goal.cause is not None and goal.cause.kind == "slips"
    assert "30.0 kg" in goal.cause.text


def test_counts_agree_with_the_engine(tmp_path: Path) -> None:
    """All hand poses of the pairs looked at, asked for one pair at a time."""
    fixtures = "  roof: {box: [0.4, 0.4, 0.02], pose: {xyz: [0.45, -0.25, 0.09]}}\n"
    path = tmp_path / "cell.yaml"
    path.write_text(
        f"handey_cell: 1\nname: cell\nrobot: {{file: {ROBOT}}}\n"
        f"fixtures:\n{TABLE}{fixtures}parts:\n{BLOCK}{GOAL}"
    )
    cell_file = handey.load_cell(path)
    options = handey.PlanOptions(denser=())
    goal = handey.plan(cell_file, options).report.goals[0]
    _check_sums(goal)
    cell, target = cell_file.cell, cell_file.goals[0].X_WP
    scene = _core.GraspScene(
        model=_core.make_collision_model(cell), cell=cell, part=0, X_WP_goal=target
    )
    solver = _core.SphericalWristSolver(cell.robot)
    tried, collides, limited = 0, {"origin": 0, "destination": 0}, 0
    for pair in _core.rank_grasps(cell, 0, target, options.ranking).ranked:
        found = _core.find_legal_grasps(scene, solver, pair, options.legality)
        tried += found.tried
        assert sum(fallen.count for fallen in found.fallen) + len(found.poses) == found.tried
        collides["origin"] += found.collides_at_origin
        collides["destination"] += found.collides_at_destination
        limited += sum(f.count for f in found.fallen if f.kind == _core.FallKind.JointLimit)
    assert goal.stages[3].entered == tried > 500
    for end, count in collides.items():
        told = [reason for reason in _reasons(goal, "collision") if reason.end == end]
        assert sum(reason.count for reason in told) == count > 0
    assert sum(reason.count for reason in _reasons(goal, "joint_limit")) == limited > 0


def test_hand_poses_kept_for_pictures_are_few_and_rigid(tmp_path: Path) -> None:
    fixtures = "  roof: {box: [0.4, 0.4, 0.02], pose: {xyz: [0.45, -0.25, 0.09]}}\n"
    goal = _report(tmp_path, fixtures=fixtures)
    assert 10 < len(goal.tried) <= 200
    assert {tried.stage for tried in goal.tried} >= {"reachable"}
    for tried in goal.tried:
        assert tried.text or not tried.stage
        rotation = [row[:3] for row in tried.X_PH[:3]]
        for row in rotation:
            assert math.isclose(sum(value * value for value in row), 1.0, abs_tol=1e-9)


def test_reasons_that_tell_the_same_are_one_with_the_nearest_miss() -> None:
    far = Reason("out_of_reach", "reachable", "far", 3, "origin", by=0.5)
    near = Reason("out_of_reach", "reachable", "near", 2, "origin", by=0.1)
    other = Reason("out_of_reach", "reachable", "elsewhere", 9, "destination", by=0.2)
    first, second = merged([far, other, near])
    assert first == other
    assert (second.text, second.count, second.by) == ("near", 5, 0.1)


ROOF = "  roof: {box: [0.5, 0.5, 0.02], pose: {xyz: [0.45, -0.25, 0.09]}}\n"
SHAFT = (
    "  shaft:\n    pose: {xyz: [0.45, -0.25, 0.2]}\n    shapes:\n"
    "      - {box: [0.02, 0.12, 0.4], pose: {xyz: [-0.035, 0, 0]}}\n"
    "      - {box: [0.02, 0.12, 0.4], pose: {xyz: [0.035, 0, 0]}}\n"
    "      - {box: [0.09, 0.02, 0.4], pose: {xyz: [0, -0.045, 0]}}\n"
    "      - {box: [0.09, 0.02, 0.4], pose: {xyz: [0, 0.045, 0]}}\n"
)


@pytest.mark.parametrize(
    ("fixtures", "kind", "body"), [(ROOF, "collision", "roof"), (SHAFT, "obstructed", "shaft")]
)
def test_the_body_that_is_in_the_way_at_one_end_only_is_the_cause(
    tmp_path: Path, fixtures: str, kind: str, body: str
) -> None:
    goal = _report(tmp_path, fixtures=fixtures)
    _check_sums(goal)
    assert goal.status == "failed" and goal.cause is not None
    cause = goal.cause
    assert (cause.kind, cause.end, cause.bodies) == (kind, "destination", (body,))
    assert "mm deep at the destination" in cause.text and cause.mover == "hand"


def test_a_goal_beyond_reach_is_the_cause_with_its_distance(tmp_path: Path) -> None:
    causes = []
    for x in (1.02, 1.10):
        goal = _report(tmp_path, task=GOAL.replace("0.45, -0.25", f"{x}, 0"))
        assert goal.cause is not None
        assert (goal.cause.kind, goal.cause.end) == ("out_of_reach", "destination")
        causes.append(goal.cause.by or 0.0)
    assert causes[1] - causes[0] == pytest.approx(0.08, abs=0.015)


def test_a_part_to_be_turned_over_without_a_support_lacks_one(tmp_path: Path) -> None:
    task = GOAL.replace("0.025]", "0.025], rpy: [3.14159265, 0, 0]")
    goal = _report(tmp_path, task=task)
    assert goal.cause is not None
    assert goal.cause.kind == "no_regrasp" and "support" in goal.cause.text
    assert goal.cause in goal.stages[-1].reasons


def test_the_text_of_a_failure_fits_a_screen_and_begins_with_the_cause(tmp_path: Path) -> None:
    for fixtures in (ROOF, SHAFT, ""):
        folder = tmp_path / str(len(fixtures))
        folder.mkdir()
        task = GOAL if fixtures else GOAL.replace("0.025]", "0.025], rpy: [3.14159265, 0, 0]")
        lines = failure_lines(_report(folder, fixtures=fixtures, task=task))
        assert len(lines) <= 20 and max(map(len, lines)) <= 98
        assert lines[0].startswith("goal 0 (block at") and lines[0].endswith("failed")
        assert lines[1].startswith("  cause: ")
        assert any("feature pairs found: " in line for line in lines)
