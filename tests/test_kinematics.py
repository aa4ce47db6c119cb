"""The compiled kinematics: against an independent library, at its border, on the Puma model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from handey import _core
from handey.errors import InvalidInput
from handey.robot_file import load_robot

ROOT = Path(__file__).resolve().parent.parent
PUMA = ROOT / "models" / "robots" / "puma560"
IRB120 = ROOT.parent / "shared" / "data" / "robots" / "abb_irb120"


@pytest.fixture(scope="module")
def puma() -> _core.Robot:
    robot, warnings = load_robot(PUMA / "robot.yaml")
    assert warnings == []
    return robot


def configurations(robot: _core.Robot, count: int, seed: int = 0) -> np.ndarray:
    lower = [joint.limit.lower for joint in robot.joints]
    upper = [joint.limit.upper for joint in robot.joints]
    return np.random.default_rng(seed).uniform(lower, upper, (count, robot.dof))


def pinocchio_model(urdf: Path):
    pinocchio = pytest.importorskip("pinocchio", reason="pinocchio (PyPI: pin) is not installed")
    model = pinocchio.buildModelFromUrdf(str(urdf))
    return pinocchio, model, model.createData()


def test_the_puma_model_says_what_the_robot_file_says(puma):
    assert puma.name == "puma560"
    assert puma.joint_names == [f"joint{i}" for i in range(1, 7)]
    assert np.allclose(puma.home, [0, 1.5708, -1.5708, 0, 0, 0], atol=0)
    assert (puma.gripper.min_opening, puma.gripper.max_opening) == (0.0, 0.1)
    assert (puma.gripper.pad_width, puma.gripper.pad_length) == (0.02, 0.03)
    velocities = np.degrees([joint.limit.velocity for joint in puma.joints])
    assert np.allclose(velocities, [100, 95, 100, 150, 130, 110])
    assert [joint.limit.acceleration for joint in puma.joints] == [5.0] * 6
    assert puma.bodies[6].links == ["link6", "gripper"]


def test_forward_kinematics_equals_pinocchios(puma):
    pinocchio, model, data = pinocchio_model(PUMA / "puma560.urdf")
    assert list(model.names)[1:] == [*puma.joint_names, "left_finger_joint", "right_finger_joint"]
    for q in configurations(puma, 500):
        opening = 0.1 * abs(np.sin(q[0]))
        pinocchio.forwardKinematics(model, data, np.r_[q, opening / 2, opening / 2])
        pinocchio.updateFramePlacements(model, data)
        poses = _core.body_poses(puma, _core.Configuration(q, opening))
        for body, pose in zip(puma.bodies, poses, strict=True):
            expected = data.oMf[model.getFrameId(body.name)].homogeneous
            assert np.abs(pose - expected).max() < 1e-9, body.name
        hand = data.oMf[model.getFrameId("gripper")].homogeneous
        hand = hand @ np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.125], [0, 0, 0, 1]])
        assert np.abs(_core.hand_pose(puma, q) - hand).max() < 1e-9


def test_pinocchio_agrees_that_every_inverse_solution_reaches_the_pose(puma):
    pinocchio, model, data = pinocchio_model(PUMA / "puma560.urdf")
    solver = _core.SphericalWristSolver(puma)
    for q in configurations(puma, 100, seed=1):
        target = _core.hand_pose(puma, q)
        result = solver.solve(target)
        assert result.status == _core.InverseStatus.Solved and result.reason == ""
        assert min(np.abs(solution.q - q).max() for solution in result.solutions) < 1e-7
        for solution in result.solutions:
            pinocchio.forwardKinematics(model, data, np.r_[solution.q, 0, 0])
            pinocchio.updateFramePlacements(model, data)
            reached = data.oMf[model.getFrameId("gripper")] * pinocchio.SE3(
                np.eye(3), np.array([0, 0, 0.125])
            )
            assert np.abs(reached.homogeneous - target).max() < 1e-9


def test_the_hand_looks_straight_up_at_home(puma):
    hand = _core.hand_pose(puma, puma.home)
    height = 0.67183 + 0.4318 + 0.4318 + 0.05625 + 0.125
    assert np.allclose(hand[:3, 3], [0.0203, -0.15005, height], atol=1e-4)
    assert np.allclose(hand[:3, 2], [0, 0, 1], atol=1e-4)


def irb120_with_gripper(folder: Path) -> Path:
    """The manufacturer's URDF with two fingers on its tool0, beside its package."""
    source = IRB120 / "irb120_3_58.urdf"
    if not source.is_file():
        pytest.skip("no ../shared/data: the IRB 120 is not here")
    finger = """
  <link name="{side}"><collision><geometry><box size="0.02 0.01 0.06"/></geometry></collision>
  </link>
  <joint name="{side}_joint" type="prismatic"><origin xyz="0 0 0.05"/><parent link="tool0"/>
    <child link="{side}"/><axis xyz="0 {sign} 0"/>
    <limit lower="0" upper="0.04" velocity="0.1" effort="10"/></joint>"""
    fingers = finger.format(side="left", sign=1) + finger.format(side="right", sign=-1)
    urdf = folder / "irb120.urdf"
    urdf.write_text(source.read_text().replace("</robot>", fingers + "\n</robot>"))
    return urdf


def test_a_manufacturers_arm_with_a_gripper_loads_and_inverts(tmp_path):
    description = _core.RobotDescription(
        name="irb120",
        arm=[f"joint_{i}" for i in range(1, 7)],
        home=[0, 0, 0, 0, 0.5, 0],
        gripper_link="tool0",
        X_LH=np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.08], [0, 0, 0, 1.0]]),
        fingers=["left_joint", "right_joint"],
        max_opening=0.08,
        packages={"abb_irb120_support": str(IRB120 / "abb_irb120_support")},
    )
    urdf = irb120_with_gripper(tmp_path)
    robot = _core.load_robot(str(urdf), description).robot
    pinocchio, model, data = pinocchio_model(urdf)
    solver = _core.SphericalWristSolver(robot)
    for q in configurations(robot, 200):
        pinocchio.forwardKinematics(model, data, np.r_[q, 0, 0])
        pinocchio.updateFramePlacements(model, data)
        tool = data.oMf[model.getFrameId("tool0")] * pinocchio.SE3(np.eye(3), np.r_[0, 0, 0.08])
        hand = _core.hand_pose(robot, q)
        assert np.abs(hand - tool.homogeneous).max() < 1e-9
        assert min(np.abs(s.q - q).max() for s in solver.solve(hand).solutions) < 1e-7


def test_a_package_that_is_not_named_is_an_error_that_lists_the_known_ones(tmp_path):
    urdf = irb120_with_gripper(tmp_path)
    description = _core.RobotDescription(
        arm=[f"joint_{i}" for i in range(1, 7)],
        home=[0] * 6,
        gripper_link="tool0",
        fingers=["left_joint", "right_joint"],
        max_opening=0.08,
    )
    with pytest.raises(InvalidInput) as error:
        _core.load_robot(str(urdf), description)
    assert {fault.code for fault in error.value.faults} == {"E_PATH"}
    assert len(error.value.faults) == 7
    assert "known are" in error.value.faults[0].message


def test_a_path_of_hand_poses_is_followed(puma):
    solver = _core.SphericalWristSolver(puma)
    start = np.array([0.1, 0.8, -3.0, 0.2, 0.8, 0.3])
    poses = np.repeat(_core.hand_pose(puma, start)[None], 30, axis=0)
    poses[:, 2, 3] -= np.linspace(0, 0.1, 30)
    result = _core.follow_hand_path(solver, poses, start)
    assert result.complete, result.reason
    assert result.path.shape == (30, 6)
    assert np.allclose(_core.hand_pose(puma, result.path[-1]), poses[-1], atol=1e-9)
    options = _core.HandPathOptions(largest_jump=1e-4)
    stopped = _core.follow_hand_path(solver, poses, start, options)
    assert not stopped.complete and len(stopped.path) < 30 and "jump" in stopped.reason


@pytest.mark.parametrize(
    "bad", [["a"] * 6, [True] * 6, [1j] * 6, [None] * 6, "abcdef", [object()] * 6]
)
def test_arrays_of_another_kind_are_type_errors(puma, bad):
    with pytest.raises(TypeError):
        _core.Configuration(bad)
    with pytest.raises(TypeError):
        _core.hand_pose(puma, bad)


def test_numbers_that_are_not_finite_and_wrong_shapes_are_value_errors(puma):
    for bad in ([np.nan] + [0] * 5, [0] * 5, [0] * 7, np.zeros((1, 6)), [np.inf] * 6):
        with pytest.raises(ValueError):
            _core.hand_pose(puma, bad)
    with pytest.raises(ValueError):
        _core.Configuration([0] * 6, np.nan)
    with pytest.raises(TypeError):
        _core.Configuration([0] * 6, True)
    with pytest.raises(TypeError):
        _core.Configuration([0] * 6, "0.1")
    solver = _core.SphericalWristSolver(puma)
    for bad in (np.eye(3), np.full((4, 4), np.nan), 2 * np.eye(4), np.diag([1, 1, -1, 1])):
        with pytest.raises(ValueError):
            solver.solve(bad)


def test_unknown_keywords_are_type_errors():
    with pytest.raises(TypeError):
        _core.HandPathOptions(biggest_jump=0.1)
    with pytest.raises(TypeError):
        _core.RobotDescription(arm=[], home=[], gripper_link="", fingers=["", ""], colour="red")


def test_arrays_are_copies(puma):
    home = puma.home
    home[0] = 99.0
    assert puma.home[0] == 0.0
    configuration = _core.Configuration([0.0] * 6)
    configuration.q[0] = 5.0
    assert configuration.q[0] == 0.0
    configuration.q = [1, 2, 3, 4, 5, 6]
    assert configuration.q.tolist() == [1, 2, 3, 4, 5, 6]


def test_a_wrong_urdf_lists_every_fault_with_its_line(tmp_path):
    text = (PUMA / "puma560.urdf").read_text()
    text = text.replace('velocity="1.7453292519943295" effort="100"', 'velocity="0" effort="100"')
    text = text.replace('<axis xyz="0 -1 0"/>', '<axis xyz="0 nan 0"/>')
    (tmp_path / "puma560.urdf").write_text(text)
    (tmp_path / "robot.yaml").write_text((PUMA / "robot.yaml").read_text())
    with pytest.raises(InvalidInput) as error:
        load_robot(tmp_path / "robot.yaml")
    codes = [fault.code for fault in error.value.faults]
    assert codes.count("E_LIMIT") == 1 and codes.count("E_NUMBER") == 1
    assert codes.count("E_PATH") == 9  # the meshes are not there
    assert all(fault.file.endswith("puma560.urdf") for fault in error.value.faults)
