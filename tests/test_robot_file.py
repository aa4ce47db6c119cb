"""Robot files with their URDF."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from handey.errors import InvalidInput
from handey.robot_file import load_robot, read_robot

MODELS = Path(__file__).resolve().parents[1] / "models"
PUMA = MODELS / "robots" / "puma560" / "robot.yaml"


@pytest.fixture
def puma(tmp_path) -> Path:
    """A copy of the Puma's folder, to be spoilt."""
    shutil.copytree(PUMA.parent, tmp_path / "puma560")
    return tmp_path / "puma560" / "robot.yaml"


def spoil(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_the_entries_are_what_the_file_says():
    entry = read_robot(PUMA)
    assert entry.name == "puma560" and entry.urdf.name == "puma560.urdf"
    assert len(entry.arm) == len(entry.home) == 6
    assert entry.gripper.opening[0] < entry.gripper.opening[1]


def test_the_robot_has_the_joints_in_the_order_of_the_file():
    pytest.importorskip("handey._core")
    entry = read_robot(PUMA)
    robot, warnings = load_robot(PUMA)
    assert tuple(joint.name for joint in robot.joints) == entry.arm
    assert np.array_equal(robot.home, entry.home)
    gripper = robot.gripper
    assert (gripper.min_opening, gripper.max_opening) == entry.gripper.opening
    assert (gripper.pad_width, gripper.pad_length) == entry.gripper.pad
    assert tuple(finger.name for finger in gripper.fingers) == entry.gripper.fingers
    if entry.acceleration:
        assert tuple(joint.limit.acceleration for joint in robot.joints) == entry.acceleration
    assert warnings == []


def test_a_fault_of_the_urdf_names_the_urdf_and_the_line(puma):
    pytest.importorskip("handey._core")
    urdf = puma.parent / "puma560.urdf"
    spoil(urdf, 'velocity="', 'velocity="-')
    with pytest.raises(InvalidInput) as caught:
        load_robot(puma)
    (fault,) = caught.value.faults
    assert fault.code == "E_LIMIT" and fault.file == str(urdf)
    assert fault.place.startswith("line ")


def test_a_name_that_the_urdf_does_not_have_is_refused(puma):
    pytest.importorskip("handey._core")
    arm = read_robot(puma).arm
    spoil(puma, arm[2], arm[2] + "x")
    with pytest.raises(InvalidInput) as caught:
        load_robot(puma)
    (fault,) = [fault for fault in caught.value.faults if fault.code == "E_REF"]
    assert (fault.file, fault.place) == (str(puma), "arm")
    assert f"'{arm[2]}x'" in fault.message and f"'{arm[2]}'" in fault.message


def test_an_ignored_pair_of_links_that_do_not_exist_is_refused(puma):
    pytest.importorskip("handey._core")
    text = puma.read_text().partition("ignore_collisions:")[0]
    puma.write_text(text + "ignore_collisions: [[no_such_link, nor_this]]\n")
    with pytest.raises(InvalidInput) as caught:
        load_robot(puma)
    assert [fault.code for fault in caught.value.faults] == ["E_REF", "E_REF"]
    assert all(fault.file == str(puma) for fault in caught.value.faults)
