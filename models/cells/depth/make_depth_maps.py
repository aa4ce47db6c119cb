"""Makes the depth maps of ../depth_map.yaml: what a camera and a height scanner would measure.

On the table stand things that the cell does not know: boxes, a can and a ball near the part and
near its goal, and a heap of stones between them. The camera sees all of them, the known part too;
the scanner sees the heap from above. Depths are noisy and rounded to 1 mm; beside the tall things
the camera saw nothing (0).
Run: python make_depth_maps.py
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROWS, COLUMNS, FOCAL = 240, 320, 300.0  # pixels
EYE, LOOKS_AT = np.array([0.98, 0.0, 0.95]), np.array([0.48, 0.0, 0.0])
NOISE = 1.5e-3  # [m]
HEAP_CELL, HEAP_ORIGIN, HEAP_SIDE = 0.004, np.array([0.40, -0.08]), 40
# Boxes: centre and size; upright cans: centre of the base, radius, height; balls: centre, radius.
BOXES = [
    ([0.590, 0.235, 0.045], [0.03, 0.11, 0.09]),
    ([0.480, 0.295, 0.030], [0.10, 0.025, 0.06]),
    ([0.405, 0.190, 0.020], [0.05, 0.05, 0.04]),
    ([0.585, -0.250, 0.040], [0.04, 0.09, 0.08]),
]
CANS = [([0.440, -0.330, 0.0], 0.033, 0.11), ([0.62, 0.02, 0.0], 0.03, 0.12)]
BALLS = [([0.370, -0.200, 0.03], 0.03)]
STONES = [
    ([0.450, -0.020, 0.020], 0.045),
    ([0.500, 0.030, 0.015], 0.040),
    ([0.500, -0.030, 0.050], 0.040),
    ([0.445, 0.035, 0.000], 0.035),
    ([0.530, -0.015, 0.000], 0.030),
]
PART = HERE / ".." / ".." / "parts" / "l_block.stl"  # millimetres
PART_AT = np.array([0.48, 0.22, 0.0])


def camera() -> np.ndarray:
    """The camera in the world (4, 4): z forward, x right, y down."""
    z = (LOOKS_AT - EYE) / np.linalg.norm(LOOKS_AT - EYE)
    x = np.cross(z, [0.0, 0.0, 1.0])
    x /= np.linalg.norm(x)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    pose[:3, 3] = EYE
    return pose


def nearest_hit(rays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Depth along rays (n, 3) from the eye, and whether the ray meets the part."""
    best = hit_plane(rays)
    for centre, size in BOXES:
        best = np.minimum(best, hit_box(rays, np.array(centre), np.array(size)))
    for base, radius, height in CANS:
        best = np.minimum(best, hit_can(rays, np.array(base), radius, height))
    for centre, radius in BALLS + STONES:
        best = np.minimum(best, hit_ball(rays, np.array(centre), radius))
    part = np.min([hit_triangle(rays, t) for t in triangles(PART) + PART_AT], axis=0)
    return np.minimum(best, part), part < best


def hit_plane(rays: np.ndarray) -> np.ndarray:
    """The table's top, z = 0."""
    return np.where(rays[:, 2] < 0, -EYE[2] / np.minimum(rays[:, 2], -1e-9), np.inf)


def hit_box(rays: np.ndarray, centre: np.ndarray, size: np.ndarray) -> np.ndarray:
    """A box with sides along the axes."""
    safe = np.where(np.abs(rays) < 1e-12, 1e-12, rays)
    ends = np.stack([(centre - size / 2 - EYE) / safe, (centre + size / 2 - EYE) / safe])
    enter, leave = ends.min(axis=0).max(axis=1), ends.max(axis=0).min(axis=1)
    return np.where((enter <= leave) & (enter > 0), enter, np.inf)


def hit_ball(rays: np.ndarray, centre: np.ndarray, radius: float) -> np.ndarray:
    """A ball."""
    a, b = np.sum(rays**2, axis=1), rays @ (EYE - centre)
    root = b**2 - a * (np.sum((EYE - centre) ** 2) - radius**2)
    return np.where(root > 0, (-b - np.sqrt(np.maximum(root, 0))) / a, np.inf)


def hit_can(rays: np.ndarray, base: np.ndarray, radius: float, height: float) -> np.ndarray:
    """An upright can on its base."""
    flat, offset = rays[:, :2], EYE[:2] - base[:2]
    a, b = np.sum(flat**2, axis=1), flat @ offset
    root = b**2 - a * (offset @ offset - radius**2)
    side = (-b - np.sqrt(np.maximum(root, 0))) / a
    z = EYE[2] + side * rays[:, 2]
    side = np.where((root > 0) & (z >= 0) & (z <= height), side, np.inf)
    top = (height - EYE[2]) / rays[:, 2]
    inside = np.sum((EYE[:2] + top[:, None] * flat - base[:2]) ** 2, axis=1) <= radius**2
    return np.minimum(side, np.where(inside & (top > 0), top, np.inf))


def hit_triangle(rays: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Moeller and Trumbore."""
    ab, ac, to_eye = corners[1] - corners[0], corners[2] - corners[0], EYE - corners[0]
    p, q = np.cross(rays, ac), np.cross(to_eye, ab)
    scale = p @ ab
    safe = np.where(np.abs(scale) < 1e-15, 1e-15, scale)
    u, v, t = (p @ to_eye) / safe, (rays @ q) / safe, (ac @ q) / safe
    return np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)


def triangles(path: Path) -> np.ndarray:
    """Of a binary STL in millimetres (n, 3, 3) [m]."""
    content = path.read_bytes()
    count = struct.unpack("<I", content[80:84])[0]
    rows = np.frombuffer(content, np.dtype("<12f4,<u2"), count, 84)
    return rows["f0"].reshape(count, 4, 3)[:, 1:].astype(float) / 1000


def depth_image() -> np.ndarray:
    """Depths in millimetres (rows, columns), 0 where nothing was measured."""
    v, u = np.mgrid[:ROWS, :COLUMNS]
    x, y = (u - COLUMNS / 2) / FOCAL, (v - ROWS / 2) / FOCAL
    rays = np.stack([x, y, np.ones_like(x)], axis=-1).reshape(-1, 3) @ camera()[:3, :3].T
    depth, is_part = (field.reshape(ROWS, COLUMNS) for field in nearest_hit(rays))
    random = np.random.default_rng(1)
    noisy = depth + NOISE * random.uniform(-1, 1, depth.shape)
    # The projector beside the camera throws shadows: a few columns at each step away from it.
    lost = np.zeros(depth.shape, dtype=bool)
    step = depth[:, 1:] - depth[:, :-1] > 0.03
    for k in range(1, 4):
        lost[:, k:] |= step[:, : COLUMNS - k]
    near_part = is_part.copy()
    for _ in range(4):
        grown = np.pad(near_part, 1)
        near_part = grown[1:-1, 1:-1] | grown[:-2, 1:-1] | grown[2:, 1:-1]
        near_part |= grown[1:-1, :-2] | grown[1:-1, 2:]
    lost &= ~near_part & ~is_part
    return np.where(lost, 0, np.round(1000 * noisy)).astype(np.uint16)


def heap_heights() -> np.ndarray:
    """The upper side of the stones [m]; NaN where the scanner lost them."""
    index = np.arange(HEAP_SIDE)
    x, y = np.meshgrid(HEAP_ORIGIN[0] + HEAP_CELL * index, HEAP_ORIGIN[1] + HEAP_CELL * index)
    heights = np.zeros_like(x)
    for centre, radius in STONES:
        root = radius**2 - (x - centre[0]) ** 2 - (y - centre[1]) ** 2
        heights = np.maximum(heights, np.where(root > 0, centre[2] + np.sqrt(np.abs(root)), 0.0))
    random = np.random.default_rng(2)
    measured = np.round(heights + np.where(heights > 0, 1e-3 * random.normal(size=x.shape), 0), 4)
    measured[18:20, 27:30] = np.nan
    return measured.astype(np.float32)


def write_png(path: Path, image: np.ndarray) -> None:
    """A 16-bit grey PNG; each row is filtered by the row above (2)."""
    rows, columns = image.shape
    raw = image.astype(">u2").tobytes()
    lines = np.frombuffer(raw, np.uint8).reshape(rows, 2 * columns)
    filtered = np.vstack([lines[:1], lines[1:] - lines[:-1]])
    data = np.hstack([np.full((rows, 1), 2, np.uint8), filtered]).tobytes()

    def chunk(kind: bytes, body: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + check

    header = struct.pack(">IIBBBBB", columns, rows, 16, 0, 0, 0, 0)
    content = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + content)


def main() -> None:
    """Writes both files and prints the pose of the camera."""
    write_png(HERE / "camera.png", depth_image())
    np.save(HERE / "heap.npy", heap_heights())
    pose = camera()
    roll = np.arctan2(pose[2, 1], pose[2, 2])
    pitch, yaw = -np.arcsin(pose[2, 0]), np.arctan2(pose[1, 0], pose[0, 0])
    print("camera: xyz", EYE.tolist(), "rpy", np.round([roll, pitch, yaw], 6).tolist())


if __name__ == "__main__":
    main()
