"""A depth image as an obstacle: the space behind its pixels, as one closed surface.

Each pixel that no known body explains is a cone from its depth to `far` behind it. Pixels that were
not measured are as near as the nearest measured pixel around their hole; nothing explains them. The
surface: fronts, backs, and walls where a neighbour is empty or begins or ends elsewhere. It is in
the camera's frame.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from handey.check.cell import Cell
from handey.check.depth import group_for, joined, pooled, probes_of, surface_of
from handey.check.kinematics import forward
from handey.check.shapes import Shape, transformed
from handey.check.values import Array, fault, keys, number, pose, positive, text

__all__ = [
    "camera_solid",
    "camera_surface",
    "explained_pixels",
    "near_surface",
    "read_camera",
    "read_png",
]

EXPLAINED, FAR = 0.005, 0.3  # defaults [m]: format
MOST_PIXELS = 2**24


def read_camera(folder: Path, value: dict[str, Any], file: str, place: str, cell: Cell) -> Shape:
    """The obstacle of one `depth` entry of a cell whose fixtures, parts and robot are read."""
    value = keys(value, file, place, ("depth", "intrinsics"), ("scale", "pose", "far", "explained"))
    path = folder / text(value["depth"], file, f"{place}.depth")
    raw = _read(path, file, f"{place}.depth")
    depth = raw * positive(value.get("scale", 1.0), file, f"{place}.scale")
    lens = keys(value["intrinsics"], file, f"{place}.intrinsics", ("fx", "fy", "cx", "cy"))
    fx, fy = (positive(lens[key], file, f"{place}.intrinsics.{key}") for key in ("fx", "fy"))
    cx, cy = (number(lens[key], file, f"{place}.intrinsics.{key}") for key in ("cx", "cy"))
    far = positive(value.get("far", FAR), file, f"{place}.far")
    tolerance = number(value.get("explained", EXPLAINED), file, f"{place}.explained")
    measured = np.isfinite(depth) & (depth > 0)
    if not measured.any():
        raise fault("E_IMAGE", file, f"{place}.depth", f"{path}: no pixel is measured")
    rows, columns = np.nonzero(measured)
    z = depth[rows, columns]
    points = np.c_[(columns - cx) / fx * z, (rows - cy) / fy * z, z]
    world = transformed(pose(value.get("pose"), file, f"{place}.pose"), points)
    known = explained_pixels(world, cell, tolerance)
    filled = _holes_filled(depth, measured)
    filled[rows[known], columns[known]] = np.nan
    return camera_solid(filled, (fx, fy, cx, cy), far)


def explained_pixels(points: Array, cell: Cell, tolerance: float) -> np.ndarray:
    """Which points (n, 3) of the world are that near to a body or the robot at its start (n,)?"""
    known = [(body.pose, shape) for body in cell.fixtures + cell.parts for shape in body.shapes]
    frames = forward(cell.robot, cell.base, cell.start[None], np.array([cell.start_opening]))
    for i, link in enumerate(cell.robot.bodies):
        known += [(frames.matrix(i, 0), shape) for shape in link.shapes]
    result = np.zeros(len(points), dtype=bool)
    for X_WB, shape in sorted(known, key=lambda item: len(item[1].faces)):
        open_ = np.flatnonzero(~result)
        local = transformed(
            np.asarray(np.linalg.inv(X_WB @ shape.pose), dtype=float), points[open_]
        )
        low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
        # The triangles of round shapes lie a little inside of them.
        slack = tolerance + 1e-2 * float(max(high - low)) * (shape.kind in ("cylinder", "sphere"))
        near = np.all((local >= low - slack) & (local <= high + slack), axis=1)
        result[open_[near]] = _near_shape(local[near], shape, tolerance)
    return result


def _near_shape(points: Array, shape: Shape, tolerance: float) -> np.ndarray:
    """Which points (n, 3) of the shape's frame lie within `tolerance` of its surface (n,)."""
    if shape.kind == "mesh":
        return near_surface(points, shape.vertices[shape.faces], tolerance)
    if shape.kind == "sphere":
        beyond = (np.linalg.norm(points, axis=1) - shape.size[0])[:, None]
    elif shape.kind == "cylinder":
        across = np.linalg.norm(points[:, :2], axis=1) - shape.size[0]
        beyond = np.stack([across, np.abs(points[:, 2]) - shape.size[1] / 2], axis=1)
    else:
        beyond = np.abs(points) - np.array(shape.size) / 2
    deepest = beyond.max(axis=1) if len(beyond) else np.zeros(0)
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
    return np.asarray(np.where(deepest <= 0, -deepest, outside) <= tolerance)


def near_surface(points: Array, triangles: Array, tolerance: float) -> np.ndarray:
    """Which points (n, 3) lie within `tolerance` of some triangle (n,)."""
    order = np.argsort(points[:, 0])
    ordered = points[order]
    near = np.zeros(len(points), dtype=bool)
    low, high = triangles.min(axis=1) - tolerance, triangles.max(axis=1) + tolerance
    first = np.searchsorted(ordered[:, 0], low[:, 0])
    last = np.searchsorted(ordered[:, 0], high[:, 0], side="right")
    for t in np.flatnonzero(last > first):
        part = np.arange(first[t], last[t])
        part = part[~near[part]]
        inside = np.all((ordered[part] >= low[t]) & (ordered[part] <= high[t]), axis=1)
        part = part[inside]
        if len(part):
            near[part] = _distance(ordered[part], triangles[t]) <= tolerance
    result = np.zeros(len(points), dtype=bool)
    result[order] = near
    return result


def _distance(points: Array, triangle: Array) -> Array:
    """Of points (n, 3) from one triangle (3, 3)."""
    best = np.full(len(points), np.inf)
    for i in range(3):
        start, span = triangle[i], triangle[(i + 1) % 3] - triangle[i]
        share = np.clip((points - start) @ span / max(float(span @ span), 1e-300), 0, 1)
        best = np.minimum(best, np.linalg.norm(points - start - share[:, None] * span, axis=1))
    normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
    length = float(np.linalg.norm(normal))
    if length < 1e-14:
        return best
    normal /= length
    over = np.ones(len(points), dtype=bool)
    for i in range(3):
        inward = np.cross(normal, triangle[(i + 1) % 3] - triangle[i])
        over &= (points - triangle[i]) @ inward >= 0
    return np.where(over, np.minimum(best, np.abs((points - triangle[0]) @ normal)), best)


def _holes_filled(depth: Array, measured: np.ndarray) -> Array:
    """Pixels that were not measured get the least depth on the border of their hole."""
    index = np.arange(depth.size).reshape(depth.shape)
    inner, border = [], []
    for a, b in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        both = ~measured[a] & ~measured[b]
        inner.append(np.stack([index[a][both], index[b][both]]))
        for hole, edge in ((a, b), (b, a)):
            meet = ~measured[hole] & measured[edge]
            border.append(np.stack([index[hole][meet], index[edge][meet]]))
    label = joined(depth.size, np.hstack(inner))
    pixels, edges = np.hstack(border)
    nearest = np.full(depth.size, np.inf)
    np.minimum.at(nearest, label[pixels], depth.ravel()[edges])
    filled = np.where(measured, depth, nearest[label].reshape(depth.shape))
    return np.where(np.isfinite(filled), filled, np.nan)


def camera_solid(depth: Array, lens: tuple[float, float, float, float], far: float) -> Shape:
    """The cones behind the pixels of an image as one solid; NaN is an empty pixel."""
    fx, fy, cx, cy = lens
    where = probes_of(depth, depth + far)
    z = depth[where]
    probes = np.stack([(where[1] - 0.5 - cx) / fx * z, (where[0] - 0.5 - cy) / fy * z, z], axis=-1)

    def inside(points: Array) -> np.ndarray:
        result = points[:, 2] > 0
        ahead = points[result]
        i = np.floor(fy * ahead[:, 1] / ahead[:, 2] + cy + 0.5)
        j = np.floor(fx * ahead[:, 0] / ahead[:, 2] + cx + 0.5)
        seen = (i >= 0) & (i < depth.shape[0]) & (j >= 0) & (j < depth.shape[1])
        front = depth[i[seen].astype(int), j[seen].astype(int)]
        seen[seen] = (ahead[seen, 2] >= front) & (ahead[seen, 2] <= front + far)  # NaN: False
        result[result] = seen
        return result

    group = group_for(int(np.isfinite(depth).sum()))
    coarse = (fx / group, fy / group, (cx + 0.5) / group - 0.5, (cy + 0.5) / group - 0.5)
    picture = camera_surface(pooled(depth, group), coarse, far)
    return replace(camera_surface(depth, lens, far), inside=inside, probes=probes, picture=picture)


def camera_surface(depth: Array, lens: tuple[float, float, float, float], far: float) -> Shape:
    """The surface of the cones behind the pixels of an image; NaN is an empty pixel."""
    fx, fy, cx, cy = lens
    d = np.pad(depth, 1, constant_values=np.nan)
    quads: list[Array] = []

    def corner(u: Any, v: Any, z: Any) -> Array:
        return np.stack([(u - cx) / fx * z, (v - cy) / fy * z, z], axis=-1)

    rows, columns = np.nonzero(np.isfinite(d))
    z = d[rows, columns]
    left, up = columns - 1.5, rows - 1.5
    around = [(left, up), (left, up + 1), (left + 1, up + 1), (left + 1, up)]
    quads.append(np.stack([corner(x, y, z) for x, y in around], axis=1))  # seen from the camera
    quads.append(np.stack([corner(x, y, z + far) for x, y in reversed(around)], axis=1))
    for down in (False, True):
        a = d[:-1, :] if down else d[:, :-1]
        b = d[1:, :] if down else d[:, 1:]
        v, u = np.nonzero(np.isfinite(a) | np.isfinite(b))
        a, b = a[v, u], b[v, u]
        if down:
            ends = [(u - 0.5, v - 0.5), (u - 1.5, v - 0.5)]
        else:
            ends = [(u - 0.5, v - 1.5), (u - 0.5, v - 0.5)]
        for own, other, way in ((a, b, 1), (b, a, -1)):
            front, back = own, own + far
            empty = np.isnan(other)
            for low, high in (
                (front, np.where(empty, back, np.minimum(back, other))),
                (np.where(empty, back, np.maximum(front, other + far)), back),
            ):
                with np.errstate(invalid="ignore"):
                    some = high > low + 1e-12
                p, q = [(e[0][some], e[1][some]) for e in ends][::way]
                ring = [corner(x, y, low[some]) for x, y in (p, q)]
                ring += [corner(x, y, high[some]) for x, y in (q, p)]
                quads.append(np.stack(ring, axis=1))
    return surface_of(np.vstack(quads))


# ------------------------------------------------------------------------------------------- files


def _read(path: Path, file: str, place: str) -> Array:
    try:
        if path.suffix.lower() == ".npy":
            image = np.load(path, allow_pickle=False)
        else:
            image = read_png(path.read_bytes())
    except (OSError, ValueError, TypeError, struct.error, zlib.error) as error:
        raise fault("E_IMAGE", file, place, f"{path} cannot be read: {error}") from error
    if image.ndim != 2 or image.size == 0 or image.dtype.kind not in "uif":
        raise fault("E_IMAGE", file, place, f"{path}: expected a 2-D image of numbers")
    return np.asarray(image, dtype=float)


def read_png(content: bytes) -> np.ndarray:
    """A 16-bit grey PNG that is not interlaced (rows, columns).

    Raises:
        ValueError: for any other content.
    """
    if content[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("is no PNG")
    at, data, size = 8, b"", (0, 0)
    while at + 8 <= len(content):
        length, kind = struct.unpack(">I4s", content[at : at + 8])
        chunk = content[at + 8 : at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            columns, rows, bits, colour, _, _, interlace = struct.unpack(">IIBBBBB", chunk)
            if (bits, colour, interlace) != (16, 0, 0) or not 0 < rows * columns <= MOST_PIXELS:
                raise ValueError("expected a 16-bit grey image, not interlaced, of plausible size")
            size = (rows, columns)
        elif kind == b"IDAT":
            data += chunk
        elif kind == b"IEND":
            break
    rows, columns = size
    stride = 2 * columns
    raw = zlib.decompressobj().decompress(data, rows * (stride + 1) + 1)
    if rows == 0 or len(raw) != rows * (stride + 1):
        raise ValueError("has too few or too many bytes")
    lines = np.frombuffer(raw, np.uint8).reshape(rows, stride + 1)
    image = np.zeros((rows, stride), np.uint8)
    before = np.zeros(stride, np.uint8)
    for y in range(rows):
        before = _unfiltered(int(lines[y, 0]), lines[y, 1:], before)
        image[y] = before
    return np.ascontiguousarray(image).view(">u2").astype(np.uint16)


def _unfiltered(kind: int, line: np.ndarray, before: np.ndarray) -> np.ndarray:
    if kind == 0:
        return line
    if kind == 2:
        return np.asarray(line + before)
    if kind == 1:  # each byte of a pixel adds to that of the pixel before
        pairs = line.reshape(-1, 2).astype(np.uint64).cumsum(axis=0)
        return np.asarray((pairs & 255).astype(np.uint8).reshape(-1))
    if kind not in (3, 4):
        raise ValueError(f"unknown filter {kind}")
    result = [0, 0]
    above = [0, 0, *before.tolist()]
    for x, value in enumerate(line.tolist(), 2):
        left, up, corner = result[x - 2], above[x], above[x - 2]
        if kind == 3:
            guess = (left + up) // 2
        else:
            p = left + up - corner
            off = abs(p - left), abs(p - up), abs(p - corner)
            guess = left if off[0] <= off[1] and off[0] <= off[2] else up
            if off[2] < off[0] and off[2] < off[1]:
                guess = corner
        result.append((value + guess) & 255)
    return np.array(result[2:], np.uint8)
