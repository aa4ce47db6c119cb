"""Where is a surface not closed?

An edge of an odd number of triangles, most often one, is open; open edges that share a vertex are
one hole. An edge of more than two is overfull: pieces that touch there, or a wall without
thickness. Vertices are taken as they are: the reader has welded them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from handey import _core

__all__ = ["Hole", "Surface", "inspect_triangles"]

MOST_OVERFULL = 20  # Choice: so many places are named


@dataclass(frozen=True)
class Hole:
    """Open edges that hang together.

    Attributes:
        edges: how many.
        length: of all of them [m].
        lower, upper: box about them (3,) [m].
        segments: the edges (edges, 2, 3) [m].
    """

    edges: int
    length: float
    lower: np.ndarray
    upper: np.ndarray
    segments: np.ndarray

    @property
    def centre(self) -> np.ndarray:
        """Of the box (3,) [m]."""
        return np.asarray((self.lower + self.upper) / 2)

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "edges": self.edges,
            "length_m": self.length,
            "centre_m": self.centre.tolist(),
            "lower_m": self.lower.tolist(),
            "upper_m": self.upper.tolist(),
        }


@dataclass(frozen=True)
class Surface:
    """What a triangle mesh is as the surface of a solid.

    Attributes:
        closed: no edge is open.
        manifold: no edge has more than two triangles.
        oriented: neighbours agree which side is out.
        pieces: not connected by an edge.
        triangles: how many.
        holes: longest first.
        overfull: middles of edges with more than two triangles (n, 3) [m].
    """

    closed: bool
    manifold: bool
    oriented: bool
    pieces: int
    triangles: int
    holes: tuple[Hole, ...]
    overfull: np.ndarray

    @property
    def open_edges(self) -> int:
        """How many."""
        return sum(hole.edges for hole in self.holes)

    def as_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "closed": self.closed,
            "manifold": self.manifold,
            "consistently_oriented": self.oriented,
            "pieces": self.pieces,
            "triangles": self.triangles,
            "open_edges": self.open_edges,
            "holes": [hole.as_dict() for hole in self.holes],
            "overfull_edges": len(self.overfull),
            "overfull_at_m": self.overfull[:MOST_OVERFULL].tolist(),
        }


def inspect_triangles(mesh: _core.TriangleMesh) -> Surface:
    """What the surface of a mesh is, and where it is open."""
    report = _core.inspect_surface(mesh)
    vertices, triangles = np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, count = np.unique(sides, axis=0, return_counts=True)
    return Surface(
        closed=report.closed,
        manifold=report.manifold,
        oriented=report.consistently_oriented,
        pieces=report.components,
        triangles=len(triangles),
        holes=_holes(vertices, edges[count % 2 == 1]),
        overfull=vertices[edges[count > 2]].mean(axis=1).reshape(-1, 3),
    )


def _holes(vertices: np.ndarray, edges: np.ndarray) -> tuple[Hole, ...]:
    """Open edges by what hangs together."""
    leader: dict[int, int] = {}

    def find(vertex: int) -> int:
        while leader.setdefault(vertex, vertex) != vertex:
            leader[vertex] = leader[leader[vertex]]
            vertex = leader[vertex]
        return vertex

    for a, b in edges.tolist():
        leader[find(a)] = find(b)
    together: dict[int, list[int]] = {}
    for index, (a, _) in enumerate(edges.tolist()):
        together.setdefault(find(a), []).append(index)
    holes = []
    for members in together.values():
        segments = vertices[edges[members]]
        lengths = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
        points = segments.reshape(-1, 3)
        holes.append(
            Hole(len(members), float(lengths.sum()), points.min(0), points.max(0), segments)
        )
    return tuple(sorted(holes, key=lambda hole: -hole.length))
