"""`handey slice`: layers tell the truth, the picture shows them, the command is as the others."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import handey
from handey import _core, cli
from handey.slices.layers import BLOCKED, FREE, NOT_PROVED, Layer, make_layers, wrist_range
from handey.slices.legs import Leg, legs_of
from handey.slices.picture import default_angles, slice_figure

CELLS = Path(__file__).resolve().parent.parent / "models/cells"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(autouse=True)
def keep_no_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    """The user's cache is left alone."""
    monkeypatch.setenv("HANDEY_CACHE", "")


@pytest.fixture(scope="module")
def plan_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    plan = handey.plan(handey.load_cell(CELLS / "shelf.yaml")).plan
    assert plan is not None
    path = tmp_path_factory.mktemp("plan") / "shelf.plan.json"
    plan.save(path)
    return path


@pytest.fixture(scope="module")
def leg(plan_file: Path) -> Leg:
    """A part is carried out of a shelf."""
    legs = legs_of(handey.load_cell(CELLS / "shelf.yaml"), handey.Plan.load(plan_file))
    return next(leg for leg in legs if leg.held)


def centre(leg: Leg, layer: Layer, row: int, column: int, wrist: np.ndarray) -> np.ndarray:
    theta2 = layer.lower[0] + (column + 0.5) * layer.size[0]
    theta3 = layer.lower[1] + (row + 0.5) * layer.size[1]
    return np.array([layer.theta1, theta2, theta3, *wrist])


@pytest.mark.parametrize("name", ["start", "range", "goal"])
def test_cells_proved_free_are_free_for_every_wrist_value_of_the_slice(name: str) -> None:
    cell = handey.load_cell(CELLS / "demo.yaml").cell
    rows = np.array([[0.2, 1.0, -2.5, -0.1, -0.7, -0.2], [0.7, 0.5, -3.0, 0.2, -0.4, 0.3]])
    leg, angle = Leg(0, "transit", cell, rows, 0.05), 0.45
    (layer,) = make_layers(leg, [angle], (name,))
    lower, upper = wrist_range(leg)
    if name != "range":
        lower = upper = leg.positions[0 if name == "start" else -1][3:]
    free = np.argwhere(layer.kinds == FREE)
    assert len(free) > 0.2 * layer.kinds.size
    checker = _core.CollisionChecker(_core.make_collision_model(leg.cell), leg.cell)
    random = np.random.default_rng(3)
    for row, column in free[random.integers(0, len(free), 3000)]:
        q = centre(leg, layer, row, column, random.uniform(lower, upper))
        q[1:3] += random.uniform(-0.5, 0.5, 2) * layer.size
        assert checker.is_free(_core.Configuration(q=q, opening=leg.opening), 0.0)


def test_a_wrist_range_without_room_is_told_with_its_reason(leg: Leg) -> None:
    rows = leg.positions[[0, -1]].copy()
    rows[:, 3:] = [[-1.8, -1.7, 0.0], [2.9, 1.7, 0.0]]  # the hand folds back into the forearm
    wide = replace(leg, positions=rows)
    (layer,) = make_layers(wide, [float(rows[0, 0])], ("range",))
    assert layer.reason and not (layer.kinds == FREE).any()
    assert layer.reason in slice_figure(wide, [layer], "shelf").caption


def test_what_is_not_proved_is_told_from_collisions_at_the_centre(leg: Leg) -> None:
    (layer,) = make_layers(leg, [float(leg.positions[-1, 0])], ("goal",))
    wrist = leg.positions[-1][3:]
    checker = _core.CollisionChecker(_core.make_collision_model(leg.cell), leg.cell)
    random = np.random.default_rng(4)
    for kind, expected in ((NOT_PROVED, True), (BLOCKED, False)):
        cells = np.argwhere(layer.kinds == kind)
        right = 0
        for row, column in cells[random.integers(0, len(cells), 300)]:
            q = centre(leg, layer, row, column, wrist)
            right += checker.is_free(_core.Configuration(q=q, opening=leg.opening)) == expected
        assert right > 250  # the layer's own waist angle is that of the middle of a cell
    assert sum(layer.counts().values()) == layer.kinds.size


def test_the_angles_are_those_of_start_half_way_and_goal() -> None:
    cell = handey.load_cell(CELLS / "demo.yaml").cell

    def angles(*theta1: float) -> list[float]:
        rows = np.zeros((len(theta1), 6))
        rows[:, 0] = theta1
        return default_angles(Leg(0, "transit", cell, rows, 0.05))

    assert angles(0.0, 0.9, 0.4) == [0.0, 0.2, 0.4]
    assert angles(0.1, 0.5, 0.1) == [0.1]
    assert len(angles(0.0, 0.05)) == 2
    assert angles(0.3) == [0.3]


def test_the_picture_has_a_row_for_each_slice_and_a_column_for_each_angle(leg: Leg) -> None:
    layers = make_layers(leg, [0.2, 0.9], ("start", "goal"))
    figure = slice_figure(leg, layers, "shelf")
    assert [len(row) for row in figure.rows] == [2, 2]
    texts = [t.text or "" for t in ElementTree.fromstring(figure.svg()).iter(f"{SVG}text")]
    assert "wrist as at the start" in texts and "wrist as at the goal" in texts
    assert any(text.startswith("\u03b8\u2081 = 11.5\u00b0") for text in texts)
    for label in ("proved free", "path", "free at the cell's centre, not proved"):
        assert label in texts
    assert figure.svg() == slice_figure(leg, layers, "shelf").svg()


def test_the_command_writes_a_picture_of_the_first_gross_motion(
    tmp_path: Path, plan_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    cell = str(CELLS / "shelf.yaml")
    assert cli.main(["slice", cell, "--plan", str(plan_file)]) == 0
    out, err = capsys.readouterr()
    lines = out.splitlines()
    assert err == "" and lines[0] == "shelf: slices of the transit of step 0"
    assert lines[-1] == "picture: shelf.slice.svg"
    pattern = r"  (start|range|goal) at -?[\d.]+ degrees: [\d.]+ % free, [\d.]+ % not proved, "
    assert len(lines) > 4 and all(re.match(pattern, line) for line in lines[1:-1])
    first = (tmp_path / "shelf.slice.svg").read_bytes()
    assert cli.main(["slice", cell, "-o", "again.svg", "--quiet"]) == 0  # plans the same motion
    assert capsys.readouterr().out == ""
    assert (tmp_path / "again.svg").read_bytes() == first


def test_step_angles_and_wrist_can_be_chosen(
    tmp_path: Path, plan_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments = ["slice", str(CELLS / "shelf.yaml"), "--plan", str(plan_file), "-o", "s.svg"]
    chosen = ["--step", "4", "--theta1", "-20", "35.5", "--wrist", "goal", "start", "--json"]
    assert cli.main([*arguments, *chosen]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["step"], told["action"], told["output"]) == (4, "transfer", "s.svg")
    assert [(layer["slice"], layer["theta1_deg"]) for layer in told["layers"]] == [
        ("start", -20.0),
        ("start", 35.5),
        ("goal", -20.0),
        ("goal", 35.5),
    ]
    for layer in told["layers"]:
        assert min(layer["free"], layer["not_proved"], layer["blocked"]) > 0


def test_a_task_without_motion_is_drawn_at_its_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.main(["slice", str(CELLS / "already_met.yaml"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["step"] is None and [layer["slice"] for layer in told["layers"]] == ["start"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--step", "1"], "--step: step 1 is no gross motion of the plan; those are: 0, 4, 8"),
        (["--theta1", "170"], "--theta1: 170 is outside the limits of joint 1, -160 to 160"),
        (["-o", "none/s.svg"], "none/s.svg: cannot be written: there is no folder"),
        (["--plan", "none.json"], "none.json: cannot be read"),
    ],
)
def test_wrong_input_is_one_line_and_nothing_is_written(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    plan_file: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture,
) -> None:
    monkeypatch.chdir(tmp_path)
    plan = ["--plan", str(plan_file)]
    assert cli.main(["slice", str(CELLS / "shelf.yaml"), *plan, *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("handey: ") and err.count("\n") == 1
    assert words in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", [["--theta1", "x"], ["--wrist", "middle"], ["--step", "a"]])
def test_wrong_usage_is_told_in_one_line(
    arguments: list[str], capsys: pytest.CaptureFixture
) -> None:
    with pytest.raises(SystemExit) as caught:
        cli.main(["slice", "cell.yaml", *arguments])
    assert caught.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_an_input_is_not_replaced_by_the_picture(
    tmp_path: Path, plan_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    before = plan_file.read_bytes()
    plan = ["--plan", str(plan_file)]
    assert cli.main(["slice", str(CELLS / "shelf.yaml"), *plan, "-o", str(plan_file)]) == 2
    assert plan_file.read_bytes() == before


def test_a_cell_without_a_plan_ends_with_its_reasons(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.main(["slice", str(CELLS / "impossible_too_wide.yaml")]) == 3
    assert "no plan found (infeasible)" in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == []
