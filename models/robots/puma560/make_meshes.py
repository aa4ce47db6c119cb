#!/usr/bin/env python3
"""Writes the convex pieces of the Puma 560's links as OBJ files into meshes/.

Every piece is a right prism that contains the real link: a polygon in two axes of the link's
standard DH frame (Paul and Corke's signs), drawn out along the third. Pieces that are boxes stand
in the URDF itself. The dimensions are measurements of the real arm [m]. Run it again after
changing a figure; it has no options and needs no packages.
"""

from __future__ import annotations

from pathlib import Path

Point = tuple[float, float]


def octagon(radius: float, corner: float, centre: Point = (0.0, 0.0)) -> list[Point]:
    """A regular octagon about the circle `radius`; `corner` is radius * tan(22.5 deg)."""
    x, y = centre
    signs = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    points = [(sx * radius, sy * corner) for sx, sy in signs]
    points += [(sx * corner, sy * radius) for sx, sy in signs]
    return [(x + px, y + py) for px, py in points]


# A half octagon about axis 5, and the width of the housing that carries it.
PRONG = [
    (0.0407, 0.01686), (0.01686, 0.0407), (-0.01686, 0.0407), (-0.0407, 0.01686),
    (-0.01686, -0.0407), (0.01686, -0.0407),
    (-0.0446, -0.038), (-0.0446, -0.0376), (0.0446, -0.038), (0.0446, -0.0376),
]  # fmt: skip

# name: (axis of the prism, its least and greatest coordinate, polygon in the two other axes in x,
#     y, z order)
PIECES: dict[str, tuple[int, float, float, list[Point]]] = {
    "base_cable_post": (2, 0.111, 0.252, octagon(0.0515, 0.02133, (-0.173, 0.0))),
    "base_column": (2, 0.0, 0.5957, octagon(0.086, 0.03562)),
    "link1_drum": (2, -0.1001, 0.1846, octagon(0.0765, 0.03169)),
    "link2_upper_arm": (2, 0.1844, 0.2862, [
        (0.06351, 0.03114), (0.01927, 0.07539), (-0.38121, 0.1524), (-0.60219, 0.1524),
        (-0.62664, 0.13188), (-0.65965, 0.04145), (-0.65965, -0.04145), (-0.62664, -0.13188),
        (-0.60219, -0.1524), (-0.3812, -0.1524), (0.02251, -0.07476), (0.06351, -0.03376),
    ]),
    "link2_hub": (2, 0.1505, 0.1845, [
        (-0.30483, 0.05214), (-0.37969, 0.127), (-0.48389, 0.127), (-0.55877, 0.05211),
        (-0.55877, -0.05236), (-0.48248, -0.12866), (-0.32698, -0.12866), (-0.30483, -0.10651),
    ]),
    "link3_forearm": (1, -0.0458, 0.0458, [
        (0.04445, 0.36195), (-0.04445, 0.36195), (-0.07547, -0.10329), (-0.05822, -0.12792),
        (-0.02256, -0.14851), (0.02243, -0.14851), (0.0583, -0.1278), (0.07547, -0.10328),
    ]),
    "link4_prong_low": (2, -0.0446, -0.0147, PRONG),
    "link4_prong_high": (2, 0.0147, 0.0446, PRONG),
    "link6_flange": (2, 0.0458, 0.05625, octagon(0.0255, 0.01056)),
}  # fmt: skip


def convex_hull(points: list[Point]) -> list[Point]:
    """The hull, counter-clockwise (Andrew's monotone chain)."""

    def chain(ordered: list[Point]) -> list[Point]:
        hull: list[Point] = []
        for x, y in ordered:
            while len(hull) >= 2:
                (ax, ay), (bx, by) = hull[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0:
                    break
                hull.pop()
            hull.append((x, y))
        return hull[:-1]

    return chain(sorted(points)) + chain(sorted(points, reverse=True))


def prism(axis: int, low: float, high: float, points: list[Point]) -> str:
    """The prism as OBJ text: triangles counter-clockwise seen from outside."""
    polygon = convex_hull(points)
    n = len(polygon)
    lines = []
    for level in (low, high):
        for point in polygon:
            coordinates = list(point)
            coordinates.insert(axis, level)
            lines.append("v " + " ".join(f"{c:.9g}" for c in coordinates))
    faces = [(0, i + 1, i) for i in range(1, n - 1)]
    faces += [(n, n + i, n + i + 1) for i in range(1, n - 1)]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, n + j), (i, n + j, n + i)]
    mirrored = axis == 1  # (x, z) drawn along y is a left-handed order
    for a, b, c in faces:
        lines.append(f"f {a + 1} {c + 1} {b + 1}" if mirrored else f"f {a + 1} {b + 1} {c + 1}")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write all files."""
    folder = Path(__file__).resolve().parent / "meshes"
    folder.mkdir(exist_ok=True)
    for name, piece in PIECES.items():
        (folder / f"{name}.obj").write_text(prism(*piece), encoding="ascii")


if __name__ == "__main__":
    main()
