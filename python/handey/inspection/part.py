"""What is this part, what of it can jaws hold, and how does it rest?

Faces and feature pairs are those that planning looks at, by the same names; the jaws are those of
a robot, without which no pair can be told. Ways to rest are those of the convex hull on a plane,
with the probabilities of the core. What needs a solid is left out where the surface is open.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from handey import _core
from handey.inspection.surface import Surface, inspect_triangles

__all__ = ["FaceFigures", "PartReport", "inspect_body", "inspect_mesh", "kind_words"]

LEAST_FACE = 25e-6  # of FeatureOptions: a smaller face is none to hold [m2]
LONG, SHORT = 1.0, 1e-3  # Choice: parts outside of this are probably in another unit [m]
UNITS = {"millimetres": 1e-3, "metres": 1.0, "centimetres": 1e-2, "inches": 0.0254}
LIKELY = (0.01, 0.5)  # Choice: what a jaw can take is most often as long [m]
GREATEST_SIZE = 1e5  # a mesh in the wrong unit is to be told of, not refused [m]

# Warnings of the reader that are told here with more figures.
_TOLD_BETTER = ("the surface is open", "the mesh is smaller")

_WORDS = {
    "FaceFace": "two faces",
    "FaceEdge": "face and edge",
    "ParallelEdges": "parallel edges",
    "FaceVertex": "face and vertex",
    "CrossedEdges": "crossed edges",
}


def kind_words(kind: _core.PairKind) -> str:
    """A pair's kind, for people."""
    return _WORDS[kind.name]


@dataclass(frozen=True)
class FaceFigures:
    """A flat face of the part.

    Attributes:
        area: [m2].
        normal: outward, in the part (3,).
        origin: a point of its plane (3,) [m].
    """

    area: float
    normal: np.ndarray
    origin: np.ndarray


@dataclass(frozen=True)
class PartReport:
    """What was found out about a part; lengths in its own frame.

    Attributes:
        name: of the part, or its file.
        scale: metres per unit of the file; None for a part of a cell.
        lower, upper: bounding box (3,) [m].
        volume: [m3]; None where the surface is open. Of several shapes, the sum.
        centre: of mass, uniform density (3,) [m]; None where the surface is open.
        mass: [kg], if the cell tells it.
        surfaces: of its shapes.
        faces: of LEAST_FACE or more, in the order that the names of pairs count; all of the solid.
        smaller_faces: how many there are besides, of each shape by itself.
        gripper: the jaws that are to hold it, if there are any.
        robot: name of the robot that has them.
        features: its pairs for these jaws.
        rests: ways to stand on a plane, the most probable first.
        warnings: for people.
        vertices, triangles: of all shapes, for pictures (n, 3) [m], (m, 3).
    """

    name: str
    scale: float | None
    lower: np.ndarray
    upper: np.ndarray
    volume: float | None
    centre: np.ndarray | None
    mass: float | None
    surfaces: tuple[Surface, ...]
    faces: tuple[FaceFigures, ...]
    smaller_faces: int
    gripper: _core.Gripper | None
    robot: str
    features: _core.FeaturePairs | None
    rests: tuple[_core.RestingPose, ...]
    warnings: tuple[str, ...]
    vertices: np.ndarray = field(repr=False)
    triangles: np.ndarray = field(repr=False)

    @property
    def size(self) -> np.ndarray:
        """Of the bounding box (3,) [m]."""
        return np.asarray(self.upper - self.lower)

    @property
    def closed(self) -> bool:
        """All of its surfaces are."""
        return all(surface.closed for surface in self.surfaces)

    @property
    def pairs(self) -> list[_core.FeaturePair]:
        """That the jaws can hold, two faces first."""
        return [] if self.features is None else self.features.pairs

    @property
    def rejected(self) -> list[_core.RejectedPair]:
        """That the jaws cannot hold, those of two faces first, then by how little they fail."""
        if self.features is None:
            return []
        return sorted(
            self.features.rejected,
            key=lambda pair: (str(pair.a)[:4] != "face" or str(pair.b)[:4] != "face", pair.width),
        )

    def short(self, pair: _core.RejectedPair) -> float | None:
        """By how much the jaws open too little, with their clearance [m]; None if not too wide."""
        if self.gripper is None or pair.kind != _core.Rejection.TooWide:
            return None
        return float(pair.width + 2 * CLEARANCE - self.gripper.max_opening)

    def kinds(self) -> dict[str, int]:
        """How many pairs of each kind, the best kind first."""
        counts = Counter(pair.kind.name for pair in self.pairs)
        return {words: counts[name] for name, words in _WORDS.items() if counts[name]}

    def as_dict(self) -> dict[str, Any]:
        """For JSON: metres, radians."""
        return {
            "kind": "part",
            "name": self.name,
            "scale": self.scale,
            "size_m": self.size.tolist(),
            "lower_m": self.lower.tolist(),
            "upper_m": self.upper.tolist(),
            "volume_m3": self.volume,
            "centre_of_mass_m": None if self.centre is None else self.centre.tolist(),
            "mass_kg": self.mass,
            "closed": self.closed,
            "surfaces": [surface.as_dict() for surface in self.surfaces],
            "faces": [
                {"index": i, "area_m2": face.area, "normal": face.normal.tolist()}
                for i, face in enumerate(self.faces)
            ],
            "smaller_faces": self.smaller_faces,
            "jaws": None if self.gripper is None else jaws_dict(self.robot, self.gripper),
            "pairs": [_pair_dict(pair) for pair in self.pairs],
            "pairs_by_kind": self.kinds(),
            "beyond_faces": 0 if self.features is None else self.features.beyond_faces,
            "rejected": [
                {
                    "features": str(pair),
                    "width_m": pair.width,
                    "short_m": self.short(pair),
                    "reason": pair.reason,
                }
                for pair in self.rejected
            ],
            "placements": [_rest_dict(rest) for rest in self.rests],
            "warnings": list(self.warnings),
        }


CLEARANCE = float(_core.FeatureOptions().jaw_clearance)  # each side [m]


def jaws_dict(robot: str, gripper: _core.Gripper) -> dict[str, Any]:
    """What jaws there are, for JSON."""
    return {
        "robot": robot,
        "opening_m": [gripper.min_opening, gripper.max_opening],
        "pad_m": [gripper.pad_width, gripper.pad_length],
        "clearance_m": CLEARANCE,
    }


def _pair_dict(pair: _core.FeaturePair) -> dict[str, Any]:
    return {
        "features": str(pair),
        "kind": kind_words(pair.kind),
        "width_m": pair.width,
        "overlap_m2": pair.area,
        "closing_axis": np.asarray(pair.X_PG)[:3, 2].tolist(),
        "centre_m": np.asarray(pair.X_PG)[:3, 3].tolist(),
    }


def _rest_dict(rest: _core.RestingPose) -> dict[str, Any]:
    X_SP = np.asarray(rest.X_SP)
    return {
        "probability": rest.probability,
        "tip_angle_rad": rest.tip_angle,
        "margin_m": rest.margin,
        "height_m": rest.height,
        "top_m": rest.top,
        "up": X_SP[2, :3].tolist(),
        "pose": X_SP.tolist(),
    }


def inspect_mesh(
    path: str | os.PathLike[str],
    scale: float = 1.0,
    robot: _core.Robot | None = None,
) -> PartReport:
    """What the part in a mesh file is.

    Args:
        path: STL, OBJ or PLY.
        scale: metres per unit of the file.
        robot: whose jaws are to hold it; None: no pairs are told.

    Raises:
        InvalidInput: if the file cannot be read.
    """
    loaded = _core.load_mesh(path, scale=scale, greatest_size=GREATEST_SIZE)
    mesh, surface = loaded.mesh, loaded.surface
    said = [words for words in loaded.warnings if not words.startswith(_TOLD_BETTER)]
    said = _unit_warnings(np.asarray(surface.upper - surface.lower), scale) + said
    name = os.path.basename(os.fspath(path))
    found = inspect_triangles(mesh)
    if surface.closed and _encloses(surface):
        shape = _core.Shape(_core.MeshShape(mesh, True))
        body = _core.Body(name=name, shapes=[shape])
        return _solid(body, name, scale, [mesh], robot, said)
    if surface.closed:
        said.insert(0, "the surface encloses no volume: a sheet, no solid")
    faces, smaller = _faces([mesh])
    return PartReport(
        name, scale, np.asarray(surface.lower), np.asarray(surface.upper), None, None, None,
        (found,), faces, smaller, None if robot is None else robot.gripper,
        "" if robot is None else robot.name, None, (), tuple(said),
        np.asarray(mesh.vertices), np.asarray(mesh.triangles),
    )  # fmt: skip


def inspect_body(body: _core.Body, robot: _core.Robot | None = None) -> PartReport:
    """What a part of a cell is, with the jaws of a robot.

    Raises:
        InvalidInput: if it has no shape.
    """
    meshes = [_core.tessellate(shape) for shape in body.shapes]
    said = []
    if len(meshes) > 1:
        said.append("made of several shapes: where they overlap, volume is counted twice")
    return _solid(body, body.name, None, meshes, robot, said)


def _encloses(surface: _core.SurfaceReport) -> bool:
    size = float((np.asarray(surface.upper) - surface.lower).max())
    return abs(surface.volume) > 1e-9 * size**3


def _solid(
    body: _core.Body,
    name: str,
    scale: float | None,
    meshes: Sequence[_core.TriangleMesh],
    robot: _core.Robot | None,
    said: list[str],
) -> PartReport:
    surfaces = tuple(inspect_triangles(mesh) for mesh in meshes)
    features = None if robot is None else _core.find_feature_pairs(body, robot.gripper)
    faces, smaller = _faces(meshes)
    if features is not None:
        faces = tuple(_figures(face) for face in features.faces)
    vertices, triangles = _joined(meshes)
    rests = sorted(_core.resting_poses(body), key=lambda rest: -round(rest.probability, 9))
    if not rests and max(vertices.max(0) - vertices.min(0)) >= SHORT:
        said.append("it rests on no face: every way to put it down tips over or rolls")
    return PartReport(
        name, scale, vertices.min(0), vertices.max(0),
        sum(abs(_core.inspect_surface(mesh).volume) for mesh in meshes),
        np.asarray(_core.centre_of_mass(body)), body.mass, surfaces, faces, smaller,
        None if robot is None else robot.gripper, "" if robot is None else robot.name,
        features, tuple(rests), tuple(said), vertices, triangles,
    )  # fmt: skip


def _figures(face: _core.PlanarFace) -> FaceFigures:
    return FaceFigures(face.area, np.asarray(face.normal), np.asarray(face.origin))


def _faces(meshes: Sequence[_core.TriangleMesh]) -> tuple[tuple[FaceFigures, ...], int]:
    """The faces of LEAST_FACE or more, largest first, and how many smaller ones there are."""
    found = [_figures(face) for mesh in meshes for face in _core.planar_faces(mesh)]
    large = [face for face in found if face.area >= LEAST_FACE]
    return tuple(sorted(large, key=lambda face: -face.area)), len(found) - len(large)


def _joined(meshes: Sequence[_core.TriangleMesh]) -> tuple[np.ndarray, np.ndarray]:
    """All meshes as one."""
    vertices = [np.asarray(mesh.vertices) for mesh in meshes]
    first = np.cumsum([0, *[len(part) for part in vertices]])
    triangles = [
        np.asarray(mesh.triangles) + offset for mesh, offset in zip(meshes, first, strict=False)
    ]
    return np.concatenate(vertices), np.concatenate(triangles)


def _unit_warnings(size: np.ndarray, scale: float) -> list[str]:
    """A part as long as a room, or as short as a grain, is probably in another unit."""
    longest = float(size.max())
    if SHORT <= longest <= LONG:
        return []
    in_file = longest / scale
    for unit, factor in UNITS.items():
        if factor != scale and LIKELY[0] <= in_file * factor <= LIKELY[1]:
            return [
                f"{_long(longest)} long at scale {scale:g}: the file is probably in {unit}; "
                f"--scale {factor:g} makes it {_long(in_file * factor)}"
            ]
    return [f"{_long(longest)} long at scale {scale:g}: is the unit of the file known?"]


def _long(length: float) -> str:
    return f"{length:.4g} m" if length >= 1 else f"{1e3 * length:.4g} mm"
