"""Proofs that there is no plan: of each kind, and never where there is one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import hard_cells
import pytest
import solvable_cells
import yaml

import handey
from handey import _core
from handey.planning.proofs import Proofs

ROOT = Path(__file__).resolve().parent.parent
CELLS = ROOT / "models" / "cells"
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
TABLE = {"box": [3.0, 1.6, 0.05], "pose": {"xyz": [1.2, 0, -0.025]}, "support": True}


def cell(folder: Path, **changes: object) -> Path:
    """A block on a table that goes from one side to the other."""
    path = folder / "cell.yaml"
    path.write_text(
        yaml.safe_dump(
            {
                "handey_cell": 1,
                "name": "cell",
                "robot": {"file": str(ROBOT)},
                "fixtures": {"table": TABLE},
                "parts": {"block": block(0.5, 0.2)},
                "task": [{"place": "block", "at": {"xyz": [0.5, -0.2, 0.025]}}],
                **changes,
            }
        )
    )
    return path


def block(x: float, y: float, size: tuple[float, float, float] = (0.04, 0.06, 0.05)) -> dict:
    return {"box": list(size), "pose": {"xyz": [x, y, size[2] / 2]}}


def failed(path: Path, goal: int = 0) -> handey.PlanResult:
    result = handey.plan(handey.load_cell(path))
    assert result.plan is None
    assert result.report.goals[goal].status == "failed"
    return result


def test_a_part_wider_than_the_jaws_is_proved_with_both_widths() -> None:
    report = failed(CELLS / "impossible_too_wide.yaml").report
    goal = report.goals[0]
    assert report.verdict == "infeasible"
    assert "ball of 120.0 mm" in goal.proof and "100.0 mm" in goal.proof
    assert goal.cause is not None and goal.cause.kind == "too_wide" and goal.cause.proved


@pytest.mark.parametrize("end", ["origin", "destination"])
def test_what_is_out_of_reach_is_proved_with_end_and_distance(end: str, tmp_path: Path) -> None:
    far, near = [1.6, 0.0, 0.025], [0.5, 0.2, 0.025]
    start, goal = (far, near) if end == "origin" else (near, far)
    parts = {"block": {"box": [0.04, 0.06, 0.05], "pose": {"xyz": start}}}
    path = cell(tmp_path, parts=parts, task=[{"place": "block", "at": {"xyz": goal}}])
    report = failed(path).report
    assert report.verdict == "infeasible"
    cause = report.goals[0].cause
    assert cause is not None and (cause.kind, cause.end, cause.proved) == (
        "out_of_reach",
        end,
        True,
    )
    assert cause.by is not None and 0.3 < cause.by < 0.8
    assert end in report.goals[0].proof
    # The distance is along the line to the shoulder, which is higher: nearer by more than that,
    # there is no such proof any more.
    far[0] -= 1.5 * cause.by
    parts = {"block": {"box": [0.04, 0.06, 0.05], "pose": {"xyz": start}}}
    path = cell(tmp_path, parts=parts, task=[{"place": "block", "at": {"xyz": goal}}])
    nearer = handey.plan(handey.load_cell(path)).report.goals[0]
    assert "beyond the arm's reach" not in nearer.proof


def test_one_goal_that_is_infeasible_makes_the_task_infeasible(tmp_path: Path) -> None:
    parts = {"near": block(0.5, 0.2), "block": block(0.4, 0.35)}
    task = [
        {"place": "near", "at": {"xyz": [0.5, -0.2, 0.025]}},
        {"place": "block", "at": {"xyz": [1.7, 0.0, 0.025]}},
    ]
    for order in ("given", "any"):
        result = failed(cell(tmp_path, parts=parts, task=task, order=order), goal=1)
        assert result.report.verdict == "infeasible"
        assert result.report.goals[0].status == "not tried"


def test_a_far_part_that_need_not_move_proves_nothing(tmp_path: Path) -> None:
    parts = {"block": block(0.5, 0.2), "far": block(1.7, 0.0)}
    task = [
        {"place": "far", "at": {"xyz": [1.7, 0.0, 0.025]}},
        {"place": "block", "at": {"xyz": [0.5, -0.2, 0.025]}},
    ]
    assert handey.plan(handey.load_cell(cell(tmp_path, parts=parts, task=task))).plan is not None


def test_proofs_can_be_left_out(tmp_path: Path) -> None:
    path = CELLS / "impossible_out_of_reach.yaml"
    report = handey.plan(handey.load_cell(path), handey.PlanOptions(prove=False)).report
    assert (report.verdict, report.goals[0].proof) == ("unknown", "")


def test_a_part_in_a_closed_box_is_proved_with_the_resolution_and_the_box(tmp_path: Path) -> None:
    report = failed(CELLS / "impossible_closed_box.yaml").report
    goal = report.goals[0]
    assert report.verdict == "infeasible"
    assert "at the origin" in goal.proof and "6 mm and 5 degrees" in goal.proof
    assert "in box" in goal.proof and "9 feature pairs" in goal.proof


def box_round(x: float, y: float, height: float = 0.16) -> dict:
    walls = [
        {"box": [0.02, 0.2, height], "pose": {"xyz": [side * 0.09, 0, height / 2]}}
        for side in (-1, 1)
    ]
    walls += [
        {"box": [0.16, 0.02, height], "pose": {"xyz": [0, side * 0.09, height / 2]}}
        for side in (-1, 1)
    ]
    lid = {"box": [0.2, 0.2, 0.02], "pose": {"xyz": [0, 0, height + 0.01]}}
    return {"pose": {"xyz": [x, y, 0]}, "shapes": [*walls, lid]}


def test_a_box_round_the_goal_is_proved_for_the_destination(tmp_path: Path) -> None:
    path = cell(tmp_path, fixtures={"table": TABLE, "box": box_round(0.5, -0.2)})
    report = failed(path).report
    assert report.verdict == "infeasible"
    assert "at the destination" in report.goals[0].proof


def test_a_box_that_may_be_moved_proves_nothing(tmp_path: Path) -> None:
    lidless = box_round(0.5, 0.2)
    parts = {"block": block(0.5, 0.2), "box": lidless | {"mass": 0.5, "may_move": True}}
    loaded = handey.load_cell(cell(tmp_path, parts=parts))
    report = handey.plan(loaded, replace(handey.PlanOptions(), deadline=5.0, advice=False)).report
    assert report.verdict != "infeasible"
    fixed = {"block": block(0.5, 0.2), "box": lidless | {"mass": 0.5}}
    assert failed(cell(tmp_path, parts=fixed)).report.verdict == "infeasible"


def test_without_a_support_one_grasp_must_serve_both_ends(tmp_path: Path) -> None:
    def lane(x: float, y: float, along_x: bool) -> dict:
        size = [0.4, 0.02, 0.07] if along_x else [0.02, 0.4, 0.07]
        shapes = []
        for side in (-1, 1):
            at = [0, side * 0.041, 0.035] if along_x else [side * 0.031, 0, 0.035]
            shapes.append({"box": list(size), "pose": {"xyz": at}})
        return {"pose": {"xyz": [x, y, 0]}, "shapes": shapes}

    fixtures = {"lane": lane(0.5, 0.2, True), "cross": lane(0.5, -0.3, False)}
    task = [{"place": "block", "at": {"xyz": [0.5, -0.3, 0.025]}}]
    bare = {**TABLE, "support": False}
    path = cell(tmp_path, fixtures={"table": bare, **fixtures}, task=task)
    report = failed(path).report
    assert report.verdict == "infeasible"
    assert "no support" in report.goals[0].proof
    path = cell(tmp_path, fixtures={"table": TABLE, **fixtures}, task=task)
    assert handey.plan(handey.load_cell(path)).plan is not None


def test_nothing_is_proved_of_random_cells_that_have_a_plan(tmp_path: Path) -> None:
    outcomes = [solvable_cells.look(path) for path in solvable_cells.cells(3, 20, tmp_path)]
    assert [outcome for outcome in outcomes if outcome.is_false] == []
    assert sum(outcome.verdict == "unknown" for outcome in outcomes) >= 5


CAGED = [-0.021, 1.269, -1.091, 2.234, -0.729, -2.159]  # folded above the base


def test_an_arm_in_a_cage_is_proved_walled_off_by_name(tmp_path: Path) -> None:
    shapes = [{"box": [0.04, 0.72, 2.2], "pose": {"xyz": [s * 0.34, 0, 1.1]}} for s in (-1, 1)]
    shapes += [{"box": [0.72, 0.04, 2.2], "pose": {"xyz": [0, s * 0.34, 1.1]}} for s in (-1, 1)]
    path = cell(
        tmp_path,
        robot={"file": str(ROBOT), "start": CAGED},
        fixtures={"cage": {"shapes": shapes}, "table": TABLE},
        parts={"block": block(0.75, 0.1)},
        task=[{"place": "block", "at": {"xyz": [0.7, -0.2, 0.025]}}],
    )
    report = failed(path).report
    assert report.verdict == "infeasible"
    goal = report.goals[0]
    assert "walled off" in goal.proof and "cage" in goal.proof
    assert goal.cause is not None and goal.cause.bodies == ("cage",) and goal.cause.proved


@pytest.mark.parametrize("end", ["origin", "destination"])
def test_a_part_shut_in_is_proved_so_by_name(end: str, tmp_path: Path) -> None:
    x, y = 0.5, 0.2 if end == "origin" else -0.2
    long = [
        {"box": [0.30, 0.01, 0.15], "pose": {"xyz": [x, y + s * 0.145, 0.075]}} for s in (-1, 1)
    ]
    wide = [
        {"box": [0.01, 0.28, 0.15], "pose": {"xyz": [x + s * 0.145, y, 0.075]}} for s in (-1, 1)
    ]
    # Bars with 23 mm between them: through which no ball of 40 mm comes.
    bars = [
        {"box": [0.004, 0.28, 0.004], "pose": {"xyz": [x + 0.027 * k, y, 0.152]}}
        for k in range(-5, 6)
    ]
    path = cell(
        tmp_path,
        fixtures={"cage": {"shapes": [*long, *wide, *bars]}, "table": TABLE},
    )
    file = handey.load_cell(path)
    model = _core.make_collision_model(file.cell)
    proofs = Proofs(file, model, _core.SphericalWristSolver(file.cell.robot))
    proof = proofs.shut_in(0)
    assert proof is not None and proof.cause is not None and proof.cause.proved
    assert (proof.cause.kind, proof.cause.end) == ("transfer", end)
    assert proof.cause.bodies[0] == "cage" and "ball of 40.0 mm" in proof.text


def test_what_is_not_proved_tells_what_was_covered() -> None:
    result = handey.plan(
        handey.load_cell(CELLS / "impossible_tetrahedron.yaml"), handey.PlanOptions(advice=False)
    )
    goal = result.report.goals[0]
    assert (result.report.verdict, goal.proof) == ("unknown", "")
    assert any("feature pairs" in line for line in goal.covered)
    assert goal.covered[-1] == "all budgets are spent; nothing is proved"


def test_a_deadline_is_told_among_what_was_covered(tmp_path: Path) -> None:
    path = hard_cells.write_cell("parted", tmp_path)
    options = handey.PlanOptions(advice=False, deadline=1.0)
    report = handey.plan(handey.load_cell(path), options).report
    assert (report.verdict, report.deadline_passed) == ("unknown", True)
    assert any("deadline" in line for line in report.goals[0].covered)
