"""Resting poses against another library, and the stream of placements."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from scipy import spatial

import handey
from handey import _core
from handey.placement import examine_standing
from handey.resting import PlacementOptions, Sought, placements, same_rest

ROOT = Path(__file__).resolve().parent.parent
MODELS = ROOT / "models"
PARTS = sorted((MODELS / "parts").glob("*.stl"))
ROBOT = str(MODELS / "robots" / "puma560" / "robot.yaml")


def part_of(path: Path) -> _core.Body:
    mesh = _core.load_mesh(path, scale=0.001, must_be_closed=True).mesh
    return _core.Body(name=path.stem, shapes=[_core.Shape(_core.MeshShape(mesh=mesh))])


def cell_of(fixtures: dict, parts: dict) -> handey.CellFile:
    table = {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
    return handey.parse_cell(
        {
            "handey_cell": 1,
            "name": "resting",
            "robot": {"file": ROBOT},
            "fixtures": {"table": table, **fixtures},
            "parts": parts,
            "task": [],
        }
    )


BLOCK = {"box": [0.04, 0.06, 0.03], "pose": {"xyz": [0.5, 0.1, 0.015]}}
TRAY = {
    "pose": {"xyz": [0.5, -0.25, 0]},
    "shapes": [
        {"box": [0.2, 0.3, 0.005], "pose": {"xyz": [0, 0, 0.0025]}},
        {"box": [0.2, 0.01, 0.04], "pose": {"xyz": [0, 0.145, 0.02]}},
        {"box": [0.2, 0.01, 0.04], "pose": {"xyz": [0, -0.145, 0.02]}},
        {"box": [0.01, 0.28, 0.04], "pose": {"xyz": [0.095, 0, 0.02]}},
        {"box": [0.01, 0.28, 0.04], "pose": {"xyz": [-0.095, 0, 0.02]}},
    ],
}


def some(cell_file: handey.CellFile, count: int, part: int = 0, **asked):
    model = _core.make_collision_model(cell_file.cell)
    return list(itertools.islice(placements(cell_file.cell, model, part, **asked), count))


def stable_faces(part: _core.Body) -> list[tuple[np.ndarray, float, float]]:
    """Outward normal, height and margin of each hull face that holds the centre of mass."""
    points = np.vstack([_core.tessellate(shape, 64).vertices for shape in part.shapes])
    centre = np.asarray(_core.centre_of_mass(part))
    hull = spatial.ConvexHull(points - centre)
    found: list[tuple[np.ndarray, float, float]] = []
    for normal, offset in zip(hull.equations[:, :3], hull.equations[:, 3], strict=True):
        if any(normal @ other > 1 - 1e-9 for other, *_ in found):
            continue
        on_face = hull.points[np.abs(hull.points @ normal + offset) < 2e-6]
        u = np.linalg.svd(normal[None])[2][1:]
        flat = spatial.ConvexHull(on_face @ u.T)
        found.append((normal, -offset, float(np.min(-flat.equations[:, 2]))))
    return [face for face in found if face[2] >= 0.0]


@pytest.mark.parametrize("path", PARTS, ids=lambda path: path.stem)
def test_the_resting_poses_of_real_parts_are_the_faces_of_their_hulls(path: Path) -> None:
    part = part_of(path)
    ours = _core.resting_poses(part)
    assert sum(rest.probability for rest in ours) == pytest.approx(1.0)
    faces = stable_faces(part)
    for normal, height, margin in faces:
        close = [rest for rest in ours if rest.X_SP[2, :3] @ -normal > 1 - 1e-7]
        if not close and np.arctan2(margin, height) < 0.1:
            # On a round side: it rolls, and a neighbour stands for it.
            close = [rest for rest in ours if rest.X_SP[2, :3] @ -normal > np.cos(0.4)]
            assert close or np.arctan2(margin, height) < 0.011
            continue
        assert len(close) == 1, f"face {normal}, margin {margin}"
        assert close[0].height == pytest.approx(height, abs=1e-6)
        assert close[0].margin == pytest.approx(margin, abs=1e-5)
    for rest in ours:
        assert any(rest.X_SP[2, :3] @ -normal > 1 - 1e-7 for normal, *_ in faces)


def test_placements_stand_on_supports_only_and_stably() -> None:
    post = {"box": [0.1, 0.1, 0.2], "pose": {"xyz": [0.6, 0.3, 0.1]}}
    base = {"box": [0.2, 0.2, 0.1], "pose": {"xyz": [0.5, -0.3, 0.05]}, "support": True}
    cell_file = cell_of({"post": post}, {"block": BLOCK, "base": base})
    found = some(cell_file, 80)
    assert len(found) == 80
    assert {place.on for place in found} == {"table", "base"}
    assert len({place.rest for place in found}) > 2
    for place in found:
        standing = examine_standing(cell_file.cell, 0, place.X_WP)
        assert standing.stable and standing.on == (place.on,)


def test_a_named_body_carries_parts_without_being_a_support() -> None:
    post = {"box": [0.1, 0.1, 0.2], "pose": {"xyz": [0.6, 0.3, 0.1]}}
    found = some(cell_of({"post": post}, {"block": BLOCK}), 10, on=["post"])
    assert {place.on for place in found} == {"post"}
    with pytest.raises(handey.InvalidInput, match="no body 'shelf'"):
        some(cell_of({}, {"block": BLOCK}), 1, on=["shelf"])


def test_placements_near_a_point_come_first() -> None:
    near = np.array([0.4, -0.3])
    cell_file = cell_of({}, {"block": BLOCK})
    for place in some(cell_file, 10, near=near):
        assert np.linalg.norm(place.X_WP[:2, 3] - near) < 0.1


def test_within_the_walls_of_a_tray_there_is_room_for_few_rests() -> None:
    cell_file = cell_of({"tray": TRAY}, {"block": BLOCK})
    found = some(cell_file, 40, on=["tray"], inside=True)
    assert len(found) == 40
    for place in found:
        local = place.X_WP[:3, 3] - [0.5, -0.25, 0.0]
        assert abs(local[0]) < 0.09 - 0.015 and abs(local[1]) < 0.14 - 0.015
        assert local[2] < 0.04


def test_the_same_rest_stays_where_it_is_asked_for() -> None:
    lying = {
        "cylinder": {"radius": 0.02, "length": 0.1},
        "pose": {"xyz": [0.5, 0.1, 0.02], "rpy": [1.5707963267948966, 0.3, 0]},
    }
    cell_file = cell_of({}, {"peg": lying})
    part = cell_file.cell.parts[0]
    found = some(cell_file, 20, rests=same_rest(part, part.X_WB))
    assert len(found) == 20
    for place in found:
        assert place.X_WP[2, :3] @ part.X_WB[2, :3] > np.cos(1e-6)
        assert place.X_WP[2, 3] == pytest.approx(0.02, abs=3e-5)  # of the polyhedron


def test_the_stream_is_repeatable_and_another_seed_gives_another() -> None:
    cell_file = cell_of({}, {"block": BLOCK})
    once, again = some(cell_file, 30), some(cell_file, 30)
    assert all(np.array_equal(a.X_WP, b.X_WP) for a, b in zip(once, again, strict=True))
    other = some(cell_file, 30, options=PlacementOptions(seed=1))
    assert not np.array_equal(once[0].X_WP, other[0].X_WP)


def test_where_nothing_fits_the_reason_says_what_was_met() -> None:
    lid = {"box": [1.6, 1.4, 0.02], "pose": {"xyz": [0.55, 0, 0.05]}}
    slab = {"box": [0.1, 0.1, 0.08], "pose": {"xyz": [0.5, 0, 0.1]}}
    cell_file = cell_of({"lid": lid}, {"slab": slab})
    sought = Sought()
    options = PlacementOptions(rounds=2)
    assert some(cell_file, 1, on=["table"], sought=sought, options=options) == []
    assert "not clear" in sought.reason() and "lid" in sought.reason()
