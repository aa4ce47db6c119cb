"""The local planners through Python: grid, bump lines, slide, and what the calls refuse."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from handey import _core
from handey.errors import InvalidInput
from handey.robot_file import load_robot

PUMA = Path(__file__).parents[1] / "models" / "robots" / "puma560" / "robot.yaml"

CELL = 0.004


def rectangle(x0: float, y0: float, x1: float, y1: float) -> list[list[float]]:
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]


def small_hand() -> _core.GripperOutline:
    """30 mm wide, 50 mm long, the finger grasp point 5 mm behind the tip."""
    return _core.GripperOutline([_core.OutlinePiece(rectangle(-0.045, -0.015, 0.005, 0.015))])


def planar_pose(x: float, y: float, theta: float) -> _core.PlanarPose:
    return _core.PlanarPose(x=x, y=y, theta=theta)


def grid_with(*rectangles: tuple[float, float, float, float]) -> _core.MotionGrid:
    grid = _core.MotionGrid([0, 0], 0.2, CELL, 1)
    for corners in rectangles:
        grid.fill(0, _core.Region([rectangle(*corners)]))
    return grid


def test_a_grid_fills_the_cells_that_a_region_touches():
    grid = _core.MotionGrid(centre=[0.0, 0.0], half_size=0.05, cell=0.01, layers=2)
    grid.fill(1, _core.Region([rectangle(0.001, 0.011, 0.029, 0.019)]))
    assert not grid.filled(0).any()
    cells = grid.filled(1)
    assert cells.shape == (10, 10)
    assert np.argwhere(cells).tolist() == [[6, 5], [6, 6], [6, 7]]  # row along y, column along x
    assert grid.touches(1, [-0.04, 0.015], [0.04, 0.015])
    assert not grid.touches(1, [-0.04, 0.005], [0.04, 0.005])
    assert not grid.touches(0, [-0.04, 0.015], [0.04, 0.015])


def test_bump_lines_stand_off_the_gripper():
    lines = _core.bump_lines(small_hand(), clearance=0.006)
    assert len(lines) == 4
    assert sorted(line.normal.round(12).tolist() for line in lines) == [
        [-1, 0],
        [0, -1],
        [0, 1],
        [1, 0],
    ]
    front = next(line for line in lines if line.normal[0] > 0.5)
    assert front.a[0] == pytest.approx(0.011)


def test_a_slide_ends_on_its_target_and_asks_before_each_step():
    asked = []
    result = _core.slide_to_target(
        grid_with((-0.2, 0.04, 0.06, 0.08)),
        small_hand(),
        planar_pose(-0.15, 0.0, 0.0),
        [0.16, 0.08],
        lambda pose: asked.append(pose) or True,
    )
    assert result.status == _core.SlideStatus.Reached
    assert (result.path[-1].x, result.path[-1].y) == (0.16, 0.08)
    assert len(asked) == len(result.path)
    steps = [
        math.hypot(b.x - a.x, b.y - a.y) for a, b in zip(result.path, result.path[1:], strict=False)
    ]
    assert max(steps) <= CELL + 1e-12


def test_a_slide_into_a_trap_stalls():
    trap = grid_with((0.0, 0.06, 0.1, 0.07), (0.0, -0.07, 0.1, -0.06), (0.09, -0.07, 0.1, 0.07))
    result = _core.slide_to_target(trap, small_hand(), planar_pose(-0.1, 0.0, 0.0), [0.16, 0.0])
    assert result.status == _core.SlideStatus.Stalled
    assert 0.06 < result.path[-1].x < 0.09


def test_what_the_reach_test_raises_comes_out_of_the_slide():
    class NoArm(Exception):
        pass

    def reachable(pose):
        if pose.x > 0:
            raise NoArm("here")
        return True

    with pytest.raises(NoArm, match="here"):
        _core.slide_to_target(
            grid_with(), small_hand(), planar_pose(-0.1, 0, 0), [0.1, 0], reachable
        )


def at(x: float, y: float, z: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, 3] = [x, y, z]
    return pose


def box(name: str, size: list[float], pose: np.ndarray) -> _core.Body:
    return _core.Body(name=name, shapes=[_core.Shape(_core.Box(size))], X_WB=pose)


def test_the_puma_comes_in_to_a_block_lifts_it_and_every_edge_is_free():
    robot, _ = load_robot(PUMA)
    cell = _core.Cell(
        robot=robot,
        start=_core.Configuration(robot.home, robot.gripper.max_opening),
        fixtures=[box("table", [1.6, 1.4, 0.05], at(0.55, 0, -0.025))],
        parts=[box("block", [0.04, 0.06, 0.05], at(0.5, 0.2, 0.025))],
    )
    model = _core.make_collision_model(cell)
    goal = at(0.5, -0.2, 0.025)
    scene = _core.GraspScene(model=model, cell=cell, part=0, X_WP_goal=goal)
    solver = _core.SphericalWristSolver(robot)
    pair = _core.rank_grasps(cell, 0, goal).ranked[0]
    aim = _core.find_legal_grasps(scene, solver, pair).poses[0]
    approach = _core.plan_approach(scene, solver, pair, aim, aim.q_pick[0])
    assert approach.found, approach.reason
    end = approach.path[-1]
    assert np.array_equal(end.q, approach.grasp.q_pick[0])
    assert _core.certify_path(_core.CollisionChecker(model, cell), approach.path).is_free

    holding = cell.with_held(0, np.linalg.inv(approach.grasp.X_PH))
    clear = _core.CollisionChecker(model, holding)
    table = _core.BodyRef(_core.BodyRef.Kind.Fixture, 0)
    in_contact = _core.CollisionChecker(model, holding, _core.Allowance(held_touches=[table]))
    start = _core.Configuration(end.q, approach.grasp.width)
    lift = _core.plan_retreat(in_contact, clear, solver, start, [0, 0, 1])
    assert lift.found, lift.reason
    assert _core.certify_path(clear, lift.path[1:]).is_free
    down = _core.plan_retreat(in_contact, clear, solver, start, [0, 0, -1])
    assert not down.found
    assert "table" in down.reason


def test_options_are_keywords_and_unknown_ones_are_refused():
    options = _core.ApproachOptions(run_in=0.08, slide=_core.QuasipotentialOptions(clearance=0.01))
    assert options.run_in == 0.08
    assert options.slide.clearance == 0.01
    assert _core.RetreatOptions().contact_travel == 0.0015
    for kind in (_core.ApproachOptions, _core.RetreatOptions, _core.QuasipotentialOptions):
        with pytest.raises(TypeError):
            kind(no_such_option=1)


@pytest.mark.parametrize("target", [["0", "0"], [True, False], [0j, 1j], None])
def test_what_is_no_number_is_a_type_error(target):
    with pytest.raises(TypeError):
        _core.slide_to_target(grid_with(), small_hand(), planar_pose(0, 0, 0), target)


@pytest.mark.parametrize("target", [[math.nan, 0], [0, 0, 0], [5.0, 0.0]])
def test_numbers_that_make_no_target_are_invalid_input(target):
    with pytest.raises(InvalidInput):
        _core.slide_to_target(grid_with(), small_hand(), planar_pose(0, 0, 0), target)


def test_sizes_that_make_no_grid_are_invalid_input():
    for arguments in ([0, 0], -0.1, 0.01, 1), ([0, 0], 0.1, 0.0, 1), ([0, 0], 0.1, 0.01, 0):
        with pytest.raises(InvalidInput):
            _core.MotionGrid(*arguments)
    with pytest.raises(InvalidInput):
        _core.bump_lines(small_hand(), 0.0)
