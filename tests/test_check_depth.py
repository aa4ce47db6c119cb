"""Depth maps as the check reads them: solids, images, hits."""

from __future__ import annotations

import numpy as np
import pytest
from hand_made import clauses, write_cell

from handey.check import check


def volume(shape):
    a, b, c = np.moveaxis(shape.triangles(), 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def test_columns_are_solid_and_closed():
    from handey.check.depth import column_surface
    from handey.check.solids import _inside

    random = np.random.default_rng(2)
    heights = random.choice([0.0, 0.01, 0.02, 0.05], (7, 9))
    shape = column_surface(heights, 0.01)
    assert volume(shape) == pytest.approx(heights.sum() * 1e-4)
    for _ in range(300):
        x, y, z = random.uniform([-0.02, -0.02, -0.01], [0.10, 0.08, 0.06])
        j, i = round(x / 0.01), round(y / 0.01)
        expected = 0 <= i < 7 and 0 <= j < 9 and 0 < z < heights[i, j]
        assert _inside(shape.triangles(), np.array([x, y, z])) == expected


def test_cones_behind_pixels_are_solid_and_closed():
    from handey.check.camera import camera_surface
    from handey.check.solids import _inside

    random = np.random.default_rng(4)
    depth = random.choice([np.nan, 0.5, 0.6, 0.85], (6, 8))
    fx, fy, cx, cy, far = 20.0, 25.0, 3.5, 2.0, 0.3
    shape = camera_surface(depth, (fx, fy, cx, cy), far)
    near, d = depth[np.isfinite(depth)], far
    expected = (((near + d) ** 3 - near**3) / 3 / (fx * fy)).sum()
    assert volume(shape) == pytest.approx(expected)
    for _ in range(300):
        z = random.uniform(0.4, 1.2)
        u, v = random.uniform([-1, -1], [8.5, 6.5])
        i, j = round(v), round(u)
        inside = 0 <= i < 6 and 0 <= j < 8 and depth[i, j] < z < depth[i, j] + far
        point = np.array([(u - cx) / fx * z, (v - cy) / fy * z, z])
        assert _inside(shape.triangles(), point) == bool(inside)


def png16(image, kinds):
    """A 16-bit grey PNG, its lines filtered by these kinds in turn."""
    import struct
    import zlib

    rows, columns = image.shape
    plain = image.astype(">u2").view(np.uint8).reshape(rows, -1).astype(int)
    lines = b""
    for y in range(rows):
        kind = kinds[y % len(kinds)]
        up = plain[y - 1] if y else np.zeros_like(plain[0])
        left, corner = (np.r_[0, 0, line[:-2]] for line in (plain[y], up))
        p = left + up - corner
        off = np.array([abs(p - left), abs(p - up), abs(p - corner)])
        paeth = np.choose(off.argmin(axis=0), [left, up, corner])
        guess = [0 * up, left, up, (left + up) // 2, paeth][kind]
        lines += bytes([kind]) + ((plain[y] - guess) & 255).astype(np.uint8).tobytes()

    def chunk(kind, data):
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    head = struct.pack(">IIBBBBB", columns, rows, 16, 0, 0, 0, 0)
    body = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + body


def test_reads_png_of_all_filters():
    import zlib

    from handey.check.camera import read_png

    image = np.random.default_rng(1).integers(0, 65536, (23, 17)).astype(np.uint16)
    assert np.array_equal(read_png(png16(image, [0, 1, 2, 3, 4])), image)
    for broken in (b"", png16(image, [0])[:200], b"\x89PNG\r\n\x1a\n"):
        with pytest.raises((ValueError, zlib.error)):
            read_png(broken)


def test_finds_hits_of_a_map_of_heights(valid, tmp_path):
    heights = np.zeros((30, 30))
    heights[:, 15] = 0.2
    np.save(tmp_path / "heights.npy", heights)
    for x, fine in ((0.4, False), (0.9, True)):
        map_ = {"heights": "heights.npy", "cell": 0.005, "pose": {"xyz": [x, 0.0, 0.0]}}
        report = check(write_cell(tmp_path, depth_maps={"heap": map_}), valid)
        assert report.ok is fine, str(report)
        assert fine or "heap" in str(report)


def test_finds_hits_of_what_a_camera_saw_and_nothing_explains(valid, tmp_path):
    # Looking down from 1 m: the table explains its pixels, nothing explains a pile 0.15 m high.
    image = np.full((60, 80), 1000, np.uint16)
    image[30, 40:43] = 850
    (tmp_path / "depth.png").write_bytes(png16(image, [4]))
    lens = {"fx": 100, "fy": 100, "cx": 40, "cy": 30}
    look_down = {"xyz": [0.5, 0.0, 1.0], "rpy": [np.pi, 0, 0]}
    seen = {
        "depth": "depth.png",
        "scale": 0.001,
        "intrinsics": lens,
        "pose": look_down,
        "far": 0.15,
    }
    report = check(write_cell(tmp_path, depth_maps={"camera": seen}), valid)
    assert clauses(report) == {"collision"} and "camera" in str(report)
    away = {**seen, "pose": {"xyz": [0.5, -0.9, 1.0], "rpy": [np.pi, 0, 0]}, "far": 0.01}
    image[:] = 1000
    (tmp_path / "depth.png").write_bytes(png16(image, [1]))
    away["explained"] = (
        0.06  # the blocks stand out of the table, and the picture does not show them
    )
    assert check(write_cell(tmp_path, depth_maps={"camera": away}), valid).ok
