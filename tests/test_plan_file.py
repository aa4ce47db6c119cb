"""The plan file: what is written is read back bit for bit; what is wrong is refused."""

from __future__ import annotations

import copy
import json
import locale
import os
import stat

import numpy as np
import pytest

from handey.errors import InvalidInput
from handey.formats.pose import pose_from_xyz_rpy
from handey.formats.strict_json import MOST_BYTES
from handey.plan import ACTIONS, Plan, Step


def some_plan() -> Plan:
    random = np.random.default_rng(3)
    X_HP = pose_from_xyz_rpy(random.normal(size=3), random.normal(size=3))
    steps = []
    for action in ACTIONS:
        held = action in ("depart", "transfer", "deposit")
        steps.append(
            Step(
                action,
                0,
                "block" if held else None,
                X_HP if held else None,
                np.cumsum([0, *random.random(4)]),
                random.normal(size=(5, 3)) * 10.0 ** random.integers(-9, 1),
                random.random(5) * 0.1,
            )
        )
    placements = {"block": pose_from_xyz_rpy(random.normal(size=3), random.normal(size=3))}
    return Plan("figure-1", ("a", "b", "c"), tuple(steps), placements, {"tries": [1, 2.5, "x"]})


def written(tmp_path) -> tuple[Plan, dict]:
    plan = some_plan()
    plan.save(tmp_path / "p.json")
    return plan, json.loads((tmp_path / "p.json").read_text())


def test_what_is_written_is_read_back_bit_for_bit(tmp_path):
    plan, _ = written(tmp_path)
    read = Plan.load(tmp_path / "p.json")
    assert (read.cell, read.joints, read.report) == (plan.cell, plan.joints, plan.report)
    assert len(read.steps) == len(plan.steps)
    for ours, theirs in zip(plan.steps, read.steps, strict=True):
        assert (ours.action, ours.goal, ours.part) == (theirs.action, theirs.goal, theirs.part)
        for name in ("time", "positions", "opening"):
            assert np.array_equal(getattr(ours, name), getattr(theirs, name))
        if ours.part_in_grasp_frame is not None:
            assert np.abs(ours.part_in_grasp_frame - theirs.part_in_grasp_frame).max() < 1e-14
    assert np.abs(read.placements["block"] - plan.placements["block"]).max() < 1e-14
    assert read.duration_s == plan.duration_s


def test_the_file_has_the_keys_of_the_format_in_their_order(tmp_path):
    _, content = written(tmp_path)
    assert list(content) == ["handey_plan", "cell", "joints", "steps", "placements", "report"]
    assert list(content["steps"][3]) == [
        "action",
        "goal",
        "part",
        "part_in_grasp_frame",
        "time",
        "positions",
        "opening",
    ]
    assert list(content["steps"][3]["part_in_grasp_frame"]) == ["xyz", "quat_xyzw"]
    assert content["steps"][0]["part_in_grasp_frame"] is None


def test_the_same_plan_gives_the_same_bytes(tmp_path):
    some_plan().save(tmp_path / "a.json")
    some_plan().save(tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_the_decimal_sign_does_not_follow_the_locale(tmp_path):
    try:
        before = locale.setlocale(locale.LC_ALL)
        locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
    except locale.Error:
        pytest.skip("no German locale here")
    try:
        some_plan().save(tmp_path / "german.json")
        read = Plan.load(tmp_path / "german.json")
    finally:
        locale.setlocale(locale.LC_ALL, before)
    assert np.array_equal(read.steps[0].positions, some_plan().steps[0].positions)


def test_a_plan_without_steps_is_written_and_read(tmp_path):
    Plan("c", ("a",), (), {}).save(tmp_path / "p.json")
    assert Plan.load(tmp_path / "p.json").steps == ()


def test_a_regrasp_is_one_more_grasp_for_the_same_goal():
    plan = some_plan()
    assert plan.regrasps == 0
    assert Plan("c", plan.joints, plan.steps * 3, {}).regrasps == 2


MUTATIONS = {
    "version": ("handey_plan", 2, "E_VERSION", "handey_plan"),
    "cell": ("cell", 3, "E_TYPE", "cell"),
    "joints": ("joints", ["a", "b"], "E_DOF", "steps[0].positions[0]"),
    "unknown key": ("stepz", [], "E_UNKNOWN_KEY", "stepz"),
    "steps": ("steps", {}, "E_TYPE", "steps"),
    "action": ("steps.0.action", "move", "E_TYPE", "steps[0].action"),
    "goal": ("steps.0.goal", -1, "E_RANGE", "steps[0].goal"),
    "goal is true": ("steps.0.goal", True, "E_TYPE", "steps[0].goal"),
    "goal is null": ("steps.0.goal", None, "E_TYPE", "steps[0].goal"),
    "part alone": ("steps.0.part", "block", "E_TYPE", "steps[0].part_in_grasp_frame"),
    "frame lost": ("steps.3.part_in_grasp_frame", None, "E_TYPE", "steps[3].part_in_grasp_frame"),
    "row too long": ("steps.1.positions.2", [1, 2, 3, 4], "E_DOF", "steps[1].positions[2]"),
    "row of texts": ("steps.1.positions.2", ["1", 2, 3], "E_TYPE", "steps[1].positions[2][0]"),
    "row of truth": ("steps.1.positions.2", [True, 2, 3], "E_TYPE", "steps[1].positions[2][0]"),
    "no row": ("steps.1.positions.2", 5, "E_TYPE", "steps[1].positions[2]"),
    "NaN": ("steps.1.positions.2.1", float("nan"), "E_NUMBER", "steps[1].positions[2][1]"),
    "infinite": ("steps.1.time.2", float("inf"), "E_NUMBER", "steps[1].time[2]"),
    "huge": ("steps.1.time.2", 10**400, "E_NUMBER", "steps[1].time[2]"),
    "short": ("steps.1.opening", [0.1], "E_TYPE", "steps[1].opening"),
    "empty": ("steps.1.time", [], "E_TYPE", "steps[1].time"),
    "placement": (
        "placements.block.quat_xyzw",
        [0, 0, 0, 2],
        "E_QUATERNION",
        "placements.block.quat_xyzw",
    ),
    "report": ("report", [], "E_TYPE", "report"),
}


def mutated(content: dict, path: str, value) -> dict:
    content = copy.deepcopy(content)
    *steps, last = [int(step) if step.isdigit() else step for step in path.split(".")]
    target = content
    for step in steps:
        target = target[step]
    target[last] = value
    return content


@pytest.mark.parametrize("name", MUTATIONS)
def test_a_wrong_plan_file_is_refused_at_its_place(name, tmp_path):
    path, value, code, place = MUTATIONS[name]
    _, content = written(tmp_path)
    file = tmp_path / "wrong.json"
    file.write_text(json.dumps(mutated(content, path, value)))
    with pytest.raises(InvalidInput) as caught:
        Plan.load(file)
    assert (code, place) in [(fault.code, fault.place) for fault in caught.value.faults]
    assert all(fault.file == str(file) for fault in caught.value.faults)


@pytest.mark.parametrize("key", ["handey_plan", "cell", "joints", "steps", "placements"])
def test_every_key_but_the_report_is_required(key, tmp_path):
    _, content = written(tmp_path)
    del content[key]
    (tmp_path / "p.json").write_text(json.dumps(content))
    with pytest.raises(InvalidInput) as caught:
        Plan.load(tmp_path / "p.json")
    assert [(fault.code, fault.place) for fault in caught.value.faults] == [("E_MISSING", key)]
    content = written(tmp_path)[1]
    del content["report"]
    (tmp_path / "p.json").write_text(json.dumps(content))
    assert Plan.load(tmp_path / "p.json").report == {}


def test_all_faults_are_told_together(tmp_path):
    _, content = written(tmp_path)
    content["cell"], content["steps"][2]["goal"], content["steps"][4]["time"] = 1, "x", 2
    (tmp_path / "p.json").write_text(json.dumps(content))
    with pytest.raises(InvalidInput) as caught:
        Plan.load(tmp_path / "p.json")
    places = [fault.place for fault in caught.value.faults]
    assert places == ["cell", "steps[2].goal", "steps[4].time"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", "E_JSON"),
        ("{", "E_JSON"),
        ('{"a": 1, "a": 2}', "E_DUP"),
        ("[" * 100_000, "E_JSON"),
        ('{"a":' * 100_000, "E_JSON"),
        ("1" * 10_000, "E_JSON"),
        ("[]", "E_TYPE"),
        ("null", "E_TYPE"),
        (" " * (MOST_BYTES + 1), "E_TOO_BIG"),
        ('{"handey_plan": 1}\n{}', "E_JSON"),
    ],
)
def test_what_is_no_plan_is_refused(text, code, tmp_path):
    (tmp_path / "p.json").write_text(text)
    with pytest.raises(InvalidInput) as caught:
        Plan.load(tmp_path / "p.json")
    assert caught.value.faults[0].code == code


def test_steps_of_wrong_shape_cannot_be_made():
    good = {"time": [0.0, 1.0], "positions": [[0.0], [1.0]], "opening": [0.1, 0.1]}
    Step("transit", 0, None, None, **good)
    for name, value in [("positions", [0.0, 1.0]), ("opening", [0.1]), ("time", [0.0, np.nan])]:
        with pytest.raises(InvalidInput):
            Step("transit", 0, None, None, **(good | {name: value}))
    with pytest.raises(InvalidInput):
        Step("move", 0, None, None, **good)
    with pytest.raises(InvalidInput):
        Step("transfer", 0, "block", None, **good)
    with pytest.raises(InvalidInput):
        Plan("c", ("a", "b"), (Step("transit", 0, None, None, **good),), {})


# Writing


def refused(path, plan=None) -> str:
    with pytest.raises(InvalidInput) as caught:
        (plan or some_plan()).save(path)
    assert caught.value.faults[0].code == "E_OUTPUT"
    return str(caught.value)


def test_a_missing_folder_is_told(tmp_path):
    assert "there is no folder" in refused(tmp_path / "none" / "p.json")


def test_what_is_no_file_is_never_replaced(tmp_path):
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "folder").mkdir()
    for path in (tmp_path / "fifo", tmp_path / "folder", "/dev/null", "/dev/full"):
        assert "not a regular file" in refused(path)
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


def test_a_read_only_folder_is_told(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may write everywhere
    assert "read-only" in refused(tmp_path / "p.json")


def test_a_full_disk_leaves_the_old_file_as_it_was(tmp_path, monkeypatch):
    path = tmp_path / "p.json"
    path.write_text("old")

    def full(_descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    assert "No space left" in refused(path)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["p.json"]


def test_a_report_that_json_cannot_hold_writes_nothing(tmp_path):
    for report in ({"a": float("nan")}, {"a": object()}):
        with pytest.raises(InvalidInput):
            Plan("c", ("a",), (), {}, report).save(tmp_path / "p.json")
    assert os.listdir(tmp_path) == []


def test_a_new_file_has_the_rights_that_the_umask_gives(tmp_path):
    before = os.umask(0o022)
    try:
        some_plan().save(tmp_path / "p.json")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "p.json").stat().st_mode) == 0o644
