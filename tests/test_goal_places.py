"""Goals that leave the pose open: planner and check must mean the same by them."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
import yaml

import handey
from handey import _core
from handey.check.cell_reader import read_cell
from handey.check.goals import goal_fault
from handey.planning import moves
from handey.planning.goal_places import Places, is_met, places_for
from handey.resting import Sought
from handey.task import PlaceAt

ROOT = Path(__file__).resolve().parent.parent
ROBOT = str(ROOT / "models" / "robots" / "puma560" / "robot.yaml")
TABLE = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}


def tray(x: float, y: float, height: float, pose: dict, open_side: bool = False) -> dict:
    """Walls 6 mm thick around a floor x by y, 4 mm high; the one at +x may be missing."""
    walls = [
        {"box": [x + 0.012, 0.006, height], "pose": {"xyz": [0, s * (y + 0.006) / 2, height / 2]}}
        for s in (-1, 1)
    ]
    walls += [
        {"box": [0.006, y, height], "pose": {"xyz": [s * (x + 0.006) / 2, 0, height / 2]}}
        for s in ((-1,) if open_side else (-1, 1))
    ]
    floor = {"box": [x + 0.012, y + 0.012, 0.004], "pose": {"xyz": [0, 0, 0.002]}}
    return {"pose": pose, "shapes": [floor, *walls]}


AT = {"xyz": [0.5, -0.25, 0], "rpy": [0, 0, 0.4]}
BLOCK = {"box": [0.04, 0.06, 0.03], "pose": {"xyz": [0.5, 0.2, 0.015]}}


def write(folder: Path, goal: dict, fixtures: dict | None = None, part: dict | None = None) -> Path:
    content = {
        "handey_cell": 1,
        "name": "open-goals",
        "robot": {"file": ROBOT},
        "fixtures": {"table": TABLE, **(fixtures or {})},
        "parts": {"part": part or BLOCK},
        "task": [{"place": "part", **goal}],
    }
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(content, sort_keys=False))
    return path


class Judges:
    """Planner and check, asked whether a goal is met with the part at a pose."""

    def __init__(self, path: Path) -> None:
        self.file, self.other = handey.load_cell(path), read_cell(path)
        self.goal, self.cell = self.file.goals[0], self.file.cell
        self.model = _core.make_collision_model(self.cell)
        self.solver = _core.SphericalWristSolver(self.cell.robot)

    def planner(self, X_WP) -> bool:
        return is_met(self.goal, self.cell.with_part_at(0, X_WP), self.model, self.cell)

    def check(self, X_WP) -> bool:
        start = {part.name: part.pose for part in self.other.parts}
        places = {**start, "part": X_WP}
        return goal_fault(self.other, self.other.task[0], places, start) is None

    def places(self, count: int, sought: Sought | None = None) -> list[np.ndarray]:
        stream = places_for(self.goal, self.cell, self.model, self.solver, self.cell, sought=sought)
        return [target.X_WP for target in itertools.islice(stream, count)]


GOALS = {
    "on": ({"on": "table"}, {}),
    "in a region": ({"on": "table", "region": [[0.3, -0.3], [0.42, -0.15]]}, {}),
    "on the same face": ({"on": "table", "resting": "same"}, {}),
    "on a pedestal smaller than the part": (
        {"on": "post"},
        {"post": {"box": [0.03, 0.03, 0.1], "pose": {"xyz": [0.5, -0.2, 0.05]}}},
    ),
    "inside": ({"inside": "tray"}, {"tray": tray(0.15, 0.12, 0.03, AT)}),
    "inside a tight one": ({"inside": "tray"}, {"tray": tray(0.064, 0.045, 0.03, AT)}),
    "inside a shallow one": ({"inside": "tray"}, {"tray": tray(0.15, 0.12, 0.008, AT)}),
}


@pytest.mark.parametrize("name", GOALS)
def test_the_places_of_a_goal_meet_it_by_both_judges(tmp_path, name) -> None:
    goal, fixtures = GOALS[name]
    judges = Judges(write(tmp_path, goal, fixtures))
    places = judges.places(12)
    assert len(places) == 12
    for X_WP in places:
        assert judges.planner(X_WP) and judges.check(X_WP)
        there = judges.cell.with_part_at(0, X_WP)
        assert _core.find_overlaps(judges.model, there, 1e-4) == []


@pytest.mark.parametrize("name", GOALS)
def test_both_judges_say_the_same_of_places_near_the_limits(tmp_path, name) -> None:
    goal, fixtures = GOALS[name]
    judges = Judges(write(tmp_path, goal, fixtures))
    random = np.random.default_rng(5)
    told = set()
    for X_WP in judges.places(12):
        for i in range(12):
            moved = X_WP.copy()
            moved[:2, 3] += random.uniform(-0.04, 0.04, 2) * (i / 11) ** 2
            moved[2, 3] += random.choice([0.0, 0.0, 0.01])
            # What overlaps a wall is refused for that; only one of them looks at it here.
            if _core.find_overlaps(judges.model, judges.cell.with_part_at(0, moved)):
                continue
            assert judges.planner(moved) == judges.check(moved), moved[:3, 3]
            told.add(judges.planner(moved))
    assert told == {True, False}


def test_no_inside_has_a_tray_with_an_open_side(tmp_path) -> None:
    fixtures = {"tray": tray(0.15, 0.12, 0.03, AT, open_side=True)}
    judges = Judges(write(tmp_path, {"inside": "tray"}, fixtures))
    sought = Sought()
    assert judges.places(1, sought) == []
    X_WP = np.eye(4)
    X_WP[:3, 3] = [0.5, -0.25, 0.019]
    assert not judges.planner(X_WP) and not judges.check(X_WP)


def test_a_part_on_the_rim_or_beside_is_not_inside(tmp_path) -> None:
    fixtures = {"tray": tray(0.05, 0.05, 0.03, {"xyz": [0.5, -0.25, 0]})}
    judges = Judges(write(tmp_path, {"inside": "tray"}, fixtures))
    for xyz in ([0.5, -0.25, 0.045], [0.5, 0.0, 0.015], [0.5, -0.15, 0.015]):
        X_WP = np.eye(4)
        X_WP[:3, 3] = xyz
        assert not judges.planner(X_WP) and not judges.check(X_WP), xyz


def test_the_face_that_the_part_stands_on_comes_first(tmp_path) -> None:
    judges = Judges(write(tmp_path, {"on": "table"}))
    assert all(X_WP[2, 2] > 0.999 for X_WP in judges.places(8))
    assert any(abs(X_WP[2, 2]) < 0.1 for X_WP in judges.places(40))


def test_a_plan_puts_the_part_where_its_open_goal_allows(tmp_path) -> None:
    for goal, fixtures in GOALS.values():
        path = write(tmp_path, goal, fixtures)
        result = handey.plan(handey.load_cell(path))
        if goal["on" if "on" in goal else "inside"] == "table" and "region" not in goal:
            assert result.report.goals[0].status == "met already"
            continue
        assert result.plan is not None, "\n".join(result.report.reasons)
        out = tmp_path / "plan.json"
        result.plan.save(out)
        assert handey.check(path, out).ok


def test_round_parts_keep_the_side_on_which_they_lie(tmp_path) -> None:
    lying = {
        "cylinder": {"radius": 0.02, "length": 0.1},
        "pose": {"xyz": [0.5, 0.2, 0.02], "rpy": [1.5707963267948966, 0.3, 0]},
    }
    ball = {"sphere": {"radius": 0.02}, "pose": {"xyz": [0.5, 0.2, 0.02], "rpy": [0.5, 0.3, 0]}}
    fixtures = {"tray": tray(0.15, 0.15, 0.03, AT)}
    for part in (lying, ball):
        path = write(tmp_path, {"inside": "tray"}, fixtures, part)
        judges = Judges(path)
        up = judges.cell.parts[0].X_WB[2, :3]
        for X_WP in judges.places(8):
            assert X_WP[2, :3] @ up > 0.9999
            assert judges.planner(X_WP) and judges.check(X_WP)
    result = handey.plan(handey.load_cell(write(tmp_path, {"inside": "tray"}, fixtures, lying)))
    assert result.plan is not None, "\n".join(result.report.reasons)


def tray_mesh(path: Path, draft: float) -> None:
    """A tray as one mesh, its walls leaning outwards by `draft` over their height."""
    trimesh = pytest.importorskip("trimesh")

    def ring(x: float, y: float, z: float) -> list[list[float]]:
        return [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]]

    rings = [
        ring(0.09, 0.07, 0.0),
        ring(0.09 + draft, 0.07 + draft, 0.04),
        ring(0.08 + draft, 0.06 + draft, 0.04),
        ring(0.08, 0.06, 0.006),
    ]
    corners = np.array([corner for one in rings for corner in one])
    faces = [[0, 2, 1], [0, 3, 2], [12, 13, 14], [12, 14, 15]]
    for level in range(3):
        for i in range(4):
            a, b = 4 * level + i, 4 * level + (i + 1) % 4
            faces += [[a, b, b + 4], [a, b + 4, a + 4]]
    mesh = trimesh.Trimesh(corners, faces, process=False)
    assert mesh.is_watertight and mesh.volume > 0
    mesh.export(path)


@pytest.mark.parametrize("draft", [0.0, 0.015])
def test_a_tray_may_be_a_mesh_with_leaning_walls(tmp_path, draft) -> None:
    tray_mesh(tmp_path / "tray.stl", draft)
    fixtures = {"tray": {"mesh": "tray.stl", "pose": AT}}
    path = write(tmp_path, {"inside": "tray"}, fixtures)
    judges = Judges(path)
    random = np.random.default_rng(3)
    for X_WP in judges.places(12):
        assert judges.planner(X_WP) and judges.check(X_WP)
        assert X_WP[2, 3] == pytest.approx(0.006 + np.abs(X_WP[2, :3]) @ [0.02, 0.03, 0.015])
        moved = X_WP.copy()
        moved[:2, 3] += random.uniform(-0.1, 0.1, 2)
        if not _core.find_overlaps(judges.model, judges.cell.with_part_at(0, moved)):
            assert judges.planner(moved) == judges.check(moved)
    result = handey.plan(handey.load_cell(path))
    assert result.plan is not None, "\n".join(result.report.reasons)
    result.plan.save(tmp_path / "plan.json")
    assert handey.check(path, tmp_path / "plan.json").ok


@pytest.mark.parametrize(
    ("goal", "fixtures", "words"),
    [
        ({"inside": "post"}, {"post": {"box": [0.1, 0.1, 0.1], "pose": AT}}, "no walls of post"),
        ({"on": "table", "region": [[5, 5], [6, 6]]}, {}, "outside the region"),
        ({"on": "ball"}, {"ball": {"sphere": {"radius": 0.1}, "pose": AT}}, "no upward horizontal"),
    ],
)
def test_the_reason_tells_what_a_fixture_lacks(tmp_path, goal, fixtures, words) -> None:
    judges = Judges(write(tmp_path, goal, fixtures))
    sought = Sought()
    assert judges.places(1, sought) == []
    assert words in sought.reason()


def test_where_no_place_is_free_the_reason_says_so(tmp_path) -> None:
    fixtures = {"tray": tray(0.03, 0.03, 0.02, AT)}
    result = handey.plan(handey.load_cell(write(tmp_path, {"inside": "tray"}, fixtures)))
    assert result.plan is None
    reasons = "\n".join(result.report.reasons)
    assert "part inside tray" in reasons and "no place found" in reasons


def test_places_are_looked_for_when_asked_for_and_once() -> None:
    targets = [PlaceAt("part", np.eye(4)) for _ in range(3)]
    looked_for = []

    def stream():
        for target in targets:
            looked_for.append(target)
            yield target

    places = Places(stream(), Sought())
    assert places.at(1) is targets[1] and len(looked_for) == 2
    assert [places.at(number) for number in range(5)] == [*targets, None, None]
    assert len(looked_for) == 3


def test_a_greater_effort_looks_for_no_place_again(tmp_path, monkeypatch) -> None:
    fixtures = {"tray": tray(0.03, 0.03, 0.02, AT)}
    asked = []
    monkeypatch.setattr(
        moves,
        "places_for",
        lambda *args, **more: asked.append(args[0]) or places_for(*args, **more),
    )
    options = handey.PlanOptions(advice=False)
    result = handey.plan(handey.load_cell(write(tmp_path, {"inside": "tray"}, fixtures)), options)
    assert result.plan is None and len(asked) == 1


def test_a_goal_on_a_part_is_no_goal(tmp_path) -> None:
    with pytest.raises(handey.InvalidInput, match="is a part; expected a fixture"):
        handey.load_cell(write(tmp_path, {"on": "part"}))
