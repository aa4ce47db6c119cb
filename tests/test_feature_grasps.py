"""Parts without parallel sides, from the cell file to the check: held by edges and corners."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest
import random_cells

import handey
from handey import _core
from handey.planner import PlanOptions

MODELS = random_cells.ROOT / "models"
sys.path.insert(0, str(MODELS / "parts"))
import make_parts  # noqa: E402


def regular(corners: int, radius: float, height: float) -> np.ndarray:
    angles = 2 * np.pi * np.arange(corners) / corners
    return make_parts.prism(radius * np.column_stack([np.cos(angles), np.sin(angles)]), height)


def frustum(corners: int, below: float, above: float, height: float) -> np.ndarray:
    angles = 2 * np.pi * np.arange(corners) / corners
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.vstack(
        [
            np.column_stack([below * ring, np.zeros(corners)]),
            np.column_stack([above * ring, np.full(corners, height)]),
        ]
    )
    i = np.arange(corners)
    j = (i + 1) % corners
    sides = np.column_stack([i, j, j + corners, i + corners]).tolist()
    return make_parts.hull_solid(points, [i.tolist(), (i + corners).tolist(), *sides])


def cell_with(folder: Path, solid: np.ndarray, **more: object) -> Path:
    """The solid, in millimetres, on a table, to be moved across."""
    make_parts.write_stl(folder / "part.stl", solid)
    part = {"mesh": "part.stl", "scale": 0.001, "pose": {"xyz": [0.5, 0.2, 0], "rpy": [0, 0, 0.3]}}
    cell = {
        "handey_cell": 1,
        "name": "part",
        "robot": {"file": str(random_cells.ROBOT)},
        "fixtures": {"table": random_cells.TABLE},
        "parts": {"part": {**part, **more}},
        "task": [{"place": "part", "at": {"xyz": [0.45, -0.22, 0], "rpy": [0, 0, -0.4]}}],
    }
    path = folder / "cell.yaml"
    path.write_text(json.dumps(cell))
    return path


@pytest.mark.parametrize(
    ("solid", "kind"),
    [
        pytest.param(regular(3, 20, 40), "face", id="triangle"),
        pytest.param(regular(5, 12, 30), "face", id="pentagon"),
        pytest.param(regular(7, 20, 40), "face", id="heptagon"),
        pytest.param(regular(9, 10, 8), "face", id="flat nonagon"),
        pytest.param(regular(31, 20, 50), "face", id="cylinder of 31 facets"),
        pytest.param(regular(32, 20, 50), "faces", id="cylinder of 32 facets"),
        pytest.param(regular(31, 3, 40), "edges", id="rod of 31 facets"),
        pytest.param(regular(64, 5, 40), "edges", id="rod of 64 facets"),
        pytest.param(frustum(32, 15, 25, 40), "face", id="cone that widens upwards"),
        pytest.param(make_parts.toothed(20, 19, 23, 12), "edges", id="gear of 20 teeth"),
        pytest.param(make_parts.toothed(17, 19, 23, 12), "edges", id="gear of 17 teeth"),
    ],
)
def test_part_without_parallel_sides_is_held_by_its_edges(
    solid: np.ndarray, kind: str, tmp_path: Path
) -> None:
    path = cell_with(tmp_path, solid)
    result = handey.plan(path)
    assert result.plan is not None, "\n".join(result.report.reasons)
    goal = result.report.goals[0]
    assert goal.grasp.split()[0] == kind
    assert ("edges" in goal.counts) == (kind != "faces"), "asked for only where faces do not serve"
    checked = handey.check(path, result.plan)
    assert checked.ok, "\n".join(map(str, checked.faults))


def test_a_peg_given_as_a_thin_cylinder_is_held_across_its_diameter(tmp_path: Path) -> None:
    path = cell_with(tmp_path, regular(4, 10, 10))
    cell = json.loads(path.read_text())
    peg = {"cylinder": {"radius": 0.003, "length": 0.04}}
    cell["parts"] = {"part": {**peg, "pose": {"xyz": [0.5, 0.2, 0.02]}}}
    cell["task"][0]["at"]["xyz"][2] = 0.02
    path.write_text(json.dumps(cell))
    result = handey.plan(path)
    assert result.plan is not None, "\n".join(result.report.reasons)
    assert result.report.goals[0].jaws["closed"] == pytest.approx(0.006)
    assert handey.check(path, result.plan).ok, str(handey.check(path, result.plan))


def test_a_cone_that_narrows_upwards_is_refused_with_what_is_in_the_way(tmp_path: Path) -> None:
    result = handey.plan(cell_with(tmp_path, frustum(32, 25, 15, 40)))
    assert result.plan is None
    assert "face 2 / edge" in "\n".join(result.report.goals[0].reasons)
    assert "obstructed by table" in "\n".join(result.report.reasons)


def test_a_crown_of_small_corners_is_held_on_a_corner(tmp_path: Path) -> None:
    """A face on one side, a pyramid on the other: only its tip is opposite to the face."""
    points = [[-15, y, z] for y, z in ((-20, 20), (20, 20), (20, 60), (-20, 60))]
    points += [[15, 0, 40]]
    faces = [[0, 1, 2, 3], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    stem = make_parts.prism([[-14.9, -15], [5, -15], [5, 15], [-14.9, 15]], 25)
    solid = np.vstack([make_parts.hull_solid(points, faces), stem])
    path = cell_with(tmp_path, solid)
    options = PlanOptions(ranking=_core.RankingOptions(pairs=_core.PairChoice.BeyondFaces))
    result = handey.plan(path, options)
    assert result.plan is not None, "\n".join(result.report.reasons)
    checked = handey.check(path, result.plan)
    assert checked.ok, "\n".join(map(str, checked.faults))


@pytest.mark.parametrize("pairs", ["TwoFaces", "BeyondFaces"])
def test_kinds_of_pairs_can_be_asked_for(pairs: str, tmp_path: Path) -> None:
    path = cell_with(tmp_path, regular(4, 20, 40))
    ranking = _core.RankingOptions(pairs=getattr(_core.PairChoice, pairs))
    result = handey.plan(path, PlanOptions(ranking=ranking))
    assert result.plan is not None, "\n".join(result.report.reasons)
    word = "faces" if pairs == "TwoFaces" else "edges"
    assert result.report.goals[0].grasp.startswith(word)
    assert handey.check(path, result.plan).ok, str(handey.check(path, result.plan))


@pytest.mark.parametrize(("mass", "words"), [(8.0, "would slip: it weighs 8.0 kg"), (0.2, "")])
def test_a_part_too_heavy_for_the_jaws_says_so(mass: float, words: str, tmp_path: Path) -> None:
    solid = make_parts.prism([[-15, -30], [15, -30], [15, 30], [-15, 30]], 40)
    result = handey.plan(cell_with(tmp_path, solid, mass=mass))
    assert (result.plan is None) == bool(words)
    assert words in "\n".join(result.report.reasons)


def test_a_hold_far_from_the_centre_of_mass_is_passed_over(tmp_path: Path) -> None:
    """A heavy block with a thin handle far out: the jaws span the handle alone."""
    block = make_parts.grid_solid(
        [-60, 60], [-60, 60, 66, 160], [0, 40, 48], lambda x, y, z: y < 60 and z < 40
    )
    handle = make_parts.grid_solid([-4, 4], [59, 160], [5, 35], lambda x, y, z: True)
    result = handey.plan(cell_with(tmp_path, np.vstack([block, handle]), density=2700))
    assert result.plan is None
    assert any("would turn in the jaws" in reason for reason in result.report.goals[0].reasons)
