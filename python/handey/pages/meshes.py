"""What pages hold of shapes: arrays as base64, poses as WebGL has them, edges to be drawn."""

from __future__ import annotations

import base64

import numpy as np

__all__ = ["creases", "matrix", "packed", "unit_normals"]

CREASE = np.cos(np.radians(30.0))  # sharper edges are drawn


def packed(array: np.ndarray, kind: str) -> str:
    """An array as base64.

    Args:
        array: of numbers.
        kind: of its numbers in the page: "<f4", "<u4".
    """
    return base64.b64encode(np.ascontiguousarray(array, dtype=kind).tobytes()).decode("ascii")


def matrix(pose: np.ndarray) -> list[float]:
    """A pose (4, 4) column by column."""
    return [round(float(x), 9) for x in np.asarray(pose).T.ravel()]


def unit_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Of each triangle (n, 3); zero for one without area."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.asarray(normals / np.where(lengths > 0, lengths, 1.0))


def creases(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Edges where the surface bends sharply, or ends (k, 2)."""
    normals = unit_normals(vertices, triangles)
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(triangles)), 3)
    unique, index = np.unique(edges, axis=0, return_inverse=True)
    index = index.reshape(-1)
    order, count = np.argsort(index, kind="stable"), np.bincount(index)
    first = np.concatenate([[0], np.cumsum(count)[:-1]])
    a, b = owner[order[first]], owner[order[np.minimum(first + 1, len(order) - 1)]]
    bend = np.einsum("ij,ij->i", normals[a], normals[b]) < CREASE
    return np.asarray(unique[(count != 2) | bend])
