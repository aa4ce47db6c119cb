"""What stands at the destination: it rules out grasps, or, as in the article, ways in as well."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import handey
from handey import _core
from handey.motion.carry import DirectOptions

CELLS = Path(__file__).resolve().parent.parent / "models" / "cells"
TWO_DOORS = CELLS / "two_doors.yaml"


def plan(path: Path, as_the_article: bool) -> handey.PlanResult:
    """All budgets are the same; only what the approach keeps off differs."""
    approach = _core.ApproachOptions(destination_obstacles_join=as_the_article)
    options = handey.PlanOptions(direct=DirectOptions(approach=approach))
    return handey.plan(handey.load_cell(path), options)


def test_a_cell_that_obstacles_moved_to_the_origin_lose_and_those_at_their_place_do_not(
    tmp_path: Path,
) -> None:
    result = plan(TWO_DOORS, as_the_article=False)
    assert result.plan is not None, result.report.reasons
    out = tmp_path / "plan.json"
    result.plan.save(out)
    checked = handey.check(TWO_DOORS, out)
    assert checked.ok, checked.faults
    lost = plan(TWO_DOORS, as_the_article=True)
    assert lost.plan is None
    # Without the wall at the destination it plans (below). No grasp was lacking, and every way in
    # was asked for: in the plane, then by the whole arm.
    goal = lost.report.goals[0]
    assert goal.counts["legal grasp poses"] > 0 and not goal.counts.get("approached")
    assert {attempt.stage for attempt in goal.attempts} == {"approach"}


def test_the_article_plans_the_same_cell_without_the_wall_that_it_moves(tmp_path: Path) -> None:
    lines = TWO_DOORS.read_text().replace("../robots", str(CELLS.parent / "robots")).splitlines()
    path = tmp_path / "cell.yaml"
    path.write_text("\n".join(line for line in lines if not line.startswith("  wall:")) + "\n")
    result = plan(path, as_the_article=True)
    assert result.plan is not None, result.report.reasons
    out = tmp_path / "plan.json"
    result.plan.save(out)
    checked = handey.check(path, out)
    assert checked.ok, checked.faults


def test_copies_of_what_stands_at_the_destination_concern_the_hand_alone(tmp_path: Path) -> None:
    path = tmp_path / "cell.yaml"
    path.write_text(f"""handey_cell: 1
name: tower
robot: {{file: {CELLS.parent}/robots/puma560/robot.yaml}}
fixtures:
  table: {{box: [1.6, 1.4, 0.05], pose: {{xyz: [0.55, 0, -0.025]}}}}
  tower: {{box: [0.1, 0.1, 0.8], pose: {{xyz: [0.6, -0.5, 0.4]}}}}
parts:
  block: {{box: [0.04, 0.06, 0.05], pose: {{xyz: [0.5, 0.2, 0.025]}}}}
task:
  - {{place: block, at: {{xyz: [0.5, -0.25, 0.025]}}}}
""")
    cell = handey.load_cell(path).cell
    goal = np.eye(4)
    goal[:3, 3] = 0.5, -0.25, 0.025
    scene = _core.GraspScene(
        model=_core.make_collision_model(cell), cell=cell, part=0, X_WP_goal=goal
    )
    joined = _core.join_destination(scene)
    copies = [joined.cell.fixtures[copy.index] for copy in joined.copies]
    assert [copy.name for copy in copies] == ["table (destination)", "tower (destination)"]
    # T moves by -0.45 m along y: the copy comes to stand beside the block as the tower will.
    assert np.allclose(copies[1].X_WB[:3, 3], [0.6, -0.05, 0.4])
    checker, plain = joined.checker(), _core.CollisionChecker(joined.model, joined.cell)
    rng, met = np.random.default_rng(3), {"arm": 0, "hand": 0}
    for _ in range(4000):
        q = cell.start.q + rng.uniform(-1.5, 1.5, 6)
        at = _core.Configuration(q=q, opening=0.05)
        hit = plain.find_hit(at)
        if hit is None or hit.b != "tower (destination)":
            continue
        by_hand = hit.a in ("link6", "left_finger", "right_finger")
        met["hand" if by_hand else "arm"] += 1
        again = checker.find_hit(at)
        if by_hand:
            assert again is not None
        else:
            assert again is None or (again.a, again.b) != (hit.a, hit.b)
    assert met["arm"] > 20 and met["hand"] > 5, met
