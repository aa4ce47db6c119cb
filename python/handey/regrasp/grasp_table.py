"""Grasps and resting poses of a part and which of them go together on a bare table: kept on disk.

They depend on the part and the gripper alone, so they are made once: hand poses in the part frame
that hold it, the poses in which it stands stably, and for each of these the grasps at which the
hand stays above what it stands on. The file is named by a digest of all that they depend on; one
that is damaged, or of another version, is made again. Article: "Regrasping", the tables of grasps
and placements.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from handey import _core
from handey.cache import table_directory
from handey.options import with_fields

__all__ = ["GraspTable", "GraspTableOptions", "grasp_table", "joined"]

FORMAT = 2  # raised when the meaning of a kept table changes
ROW = 10  # numbers of a grasp
MOST_BYTES = 1 << 28  # a longer file is not one of these


@dataclass(frozen=True)
class GraspTableOptions:
    """How many grasps are looked at, and what they must hold.

    Attributes:
        ranking: of the feature pairs of the part alone.
        legality: directions, spacing, contact and hold of the sampled grasps.
        most: grasps of one part.
    """

    ranking: _core.RankingOptions
    legality: _core.LegalityOptions
    most: int = 6000

    def ranking_of(self, faces: bool) -> _core.RankingOptions:
        """The ranking of the pairs of two faces alone, or of all the others."""
        choice = _core.PairChoice.TwoFaces if faces else _core.PairChoice.BeyondFaces
        return with_fields(self.ranking, pairs=choice)


@dataclass(frozen=True)
class GraspTable:
    """What a part and a gripper can do together.

    Attributes:
        options: that it was made with.
        grasps: hand poses in the part frame.
        rows: the same as numbers, see `PartGrasps.rows`, shape (n, 10).
        rests: stable resting poses of the part.
        clear: at which grasps the hand stays above a plane on which the part rests, (rests, n).
    """

    options: GraspTableOptions
    grasps: _core.PartGrasps
    rows: np.ndarray
    rests: list[_core.RestingPose]
    clear: np.ndarray

    @property
    def merit(self) -> np.ndarray:
        """Of the grasps: contact, lever, direction along an edge, shape (n,)."""
        return np.asarray(self.rows[:, 9])


def joined(a: GraspTable, b: GraspTable) -> GraspTable:
    """The grasps of two tables of one part."""
    rows = np.concatenate([a.rows, b.rows])
    X_PH = np.concatenate([np.asarray(a.grasps.X_PH), np.asarray(b.grasps.X_PH)])
    grasps = _core.PartGrasps(rows=rows, X_PH=X_PH)
    return GraspTable(a.options, grasps, rows, a.rests, np.concatenate([a.clear, b.clear], axis=1))


def grasp_table(
    part: _core.Body, robot: _core.Robot, options: GraspTableOptions, directory: str | None = None
) -> GraspTable:
    """Read the table of a part or make it, and keep it.

    Args:
        part: its pose does not count.
        robot: with its gripper.
        options: of the samples.
        directory: of the kept tables; None: as the environment says; empty: nothing is kept.
    """
    directory = table_directory() if directory is None else directory
    rests = list(_core.resting_poses(part))
    path = Path(directory) / f"grasps-{_key(part, robot, options)}.npz" if directory else None
    arrays = _read(path, len(rests)) if path else None
    if arrays is None:
        arrays = _make(part, robot, options, rests)
        if path is not None:
            _write(path, arrays)
    grasps = _core.PartGrasps(rows=arrays["rows"], X_PH=arrays["X_PH"])
    return GraspTable(options, grasps, arrays["rows"], rests, arrays["clear"])


def _make(
    part: _core.Body,
    robot: _core.Robot,
    options: GraspTableOptions,
    rests: list[_core.RestingPose],
) -> dict[str, np.ndarray]:
    legality = options.legality
    grasps = _core.sample_part_grasps(
        part, robot, ranking=options.ranking, legality=legality, most=options.most
    )
    clear = [_core.clears_plane(robot, grasps, rest.X_SP, legality) for rest in rests]
    count = len(grasps)
    return {
        "rows": np.asarray(grasps.rows).reshape(count, ROW),
        "X_PH": np.asarray(grasps.X_PH).reshape(count, 4, 4),
        "clear": np.array(clear, dtype=bool).reshape(len(rests), count),
    }


def _read(path: Path, rests: int) -> dict[str, np.ndarray] | None:
    """The arrays of a kept table; None if there is none, or it is damaged."""
    try:
        if path.stat().st_size > MOST_BYTES:
            return None
        with np.load(path, allow_pickle=False) as kept:
            arrays = {name: kept[name] for name in ("rows", "X_PH", "clear", "digest")}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    digest = arrays.pop("digest")
    rows, X_PH, clear = arrays["rows"], arrays["X_PH"], arrays["clear"]
    count = len(rows) if rows.ndim == 2 else -1
    fits = (
        rows.shape == (count, ROW)
        and X_PH.shape == (count, 4, 4)
        and clear.shape == (rests, count)
        and (rows.dtype, X_PH.dtype, clear.dtype) == (float, float, bool)
    )
    return arrays if fits and str(digest) == _digest(arrays) else None


def _write(path: Path, arrays: dict[str, np.ndarray]) -> None:
    """Keep a table, whole or not at all; what cannot be written is not kept."""
    aside = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".part", delete=False) as file:
            aside = file.name
            np.savez(file, digest=np.array(_digest(arrays)), **arrays)  # type: ignore[arg-type]
        os.replace(aside, path)
    except OSError:
        pass
    finally:  # on Ctrl-C too
        if aside is not None:
            Path(aside).unlink(missing_ok=True)


def _digest(arrays: dict[str, np.ndarray]) -> str:
    total = hashlib.sha256()
    for name in ("rows", "X_PH", "clear"):
        total.update(np.ascontiguousarray(arrays[name]).tobytes())
    return total.hexdigest()


def _key(part: _core.Body, robot: _core.Robot, options: GraspTableOptions) -> str:
    """A digest of all that a table depends on."""
    total = hashlib.sha256(f"{FORMAT} {_core.__version__}".encode())
    for item in _contents(part, robot, options):
        if isinstance(item, np.ndarray):
            total.update(repr(item.shape).encode() + np.ascontiguousarray(item).tobytes())
        else:
            total.update(repr(item).encode())
    return total.hexdigest()[:32]


def _contents(
    part: _core.Body, robot: _core.Robot, options: GraspTableOptions
) -> Iterator[np.ndarray | object]:
    yield from (part.mass, part.density, part.friction, options.most)
    yield from _shapes(part.shapes)
    gripper = robot.gripper
    yield from (gripper.max_opening, gripper.min_opening, gripper.pad_length, gripper.pad_width)
    yield np.array(gripper.X_BH)
    for finger in gripper.fingers:
        yield from (np.array(finger.X_PJ), np.array(finger.axis))
        yield from _shapes(robot.bodies[finger.child].shapes)
    yield from _shapes(robot.bodies[gripper.body].shapes)
    for values in (options.ranking.features, options.ranking, options.legality):
        for name in sorted(vars(type(values))):
            value = getattr(values, name)
            if isinstance(value, (bool, int, float)):
                yield (name, value)
    yield ("pairs", options.ranking.pairs.name)


def _shapes(shapes: list[_core.Shape]) -> Iterator[np.ndarray | object]:
    for shape in shapes:
        yield np.array(shape.X_BS)
        geometry = shape.geometry
        yield type(geometry).__name__
        if isinstance(geometry, _core.Box):
            yield np.array(geometry.size)
        elif isinstance(geometry, _core.Cylinder):
            yield (geometry.radius, geometry.length)
        elif isinstance(geometry, _core.Sphere):
            yield geometry.radius
        else:
            yield np.asarray(geometry.mesh.vertices)
            yield np.asarray(geometry.mesh.triangles)
