"""What can be drawn in a panel of a picture: cells, areas, lines, markers, notes.

Each mark turns itself into SVG elements, given the map from the panel's units to picture units.
Numbers are written with two digits after the point, so equal data give equal bytes.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

__all__ = ["Area", "Cells", "Line", "Mark", "Marker", "Note", "Paint", "wrapped"]

ToPicture = Callable[[np.ndarray], np.ndarray]
INK = "#222222"


@dataclass(frozen=True)
class Paint:
    """How a mark looks, and its name in the legend.

    Attributes:
        fill: colour, "none" for none.
        stroke: colour of lines and borders.
        width: of lines [picture units].
        dash: as SVG writes it: "4 3"; empty for a whole line.
        opacity: 0 to 1.
        label: in the legend; empty for no entry.
    """

    fill: str = "none"
    stroke: str = "none"
    width: float = 1.0
    dash: str = ""
    opacity: float = 1.0
    label: str = ""

    def attributes(self) -> str:
        """As attributes of an SVG element."""
        written = [f'fill="{self.fill}"']
        if self.stroke != "none":
            written.append(f'stroke="{self.stroke}" stroke-width="{number(self.width)}"')
            written.append('stroke-linejoin="round" stroke-linecap="round"')
        if self.dash:
            written.append(f'stroke-dasharray="{self.dash}"')
        if self.opacity < 1.0:
            written.append(f'opacity="{number(self.opacity)}"')
        return " ".join(written)

    def unnamed(self) -> Paint:
        """The same without an entry in the legend."""
        return replace(self, label="")


def number(value: float) -> str:
    """A number as short as two digits after the point allow."""
    written = f"{float(value):.2f}".rstrip("0").rstrip(".")
    return "0" if written == "-0" else written


def text(
    x: float, y: float, content: str, size: float = 11, anchor: str = "start", more: str = ""
) -> str:
    """A line of text at its baseline."""
    place = f'x="{number(x)}" y="{number(y)}" font-size="{number(size)}"'
    anchored = f' text-anchor="{anchor}"' if anchor != "start" else ""
    return f"<text {place}{anchored}{' ' + more if more else ''}>{escaped(content)}</text>"


def escaped(content: str) -> str:
    """Text as XML holds it; characters that it cannot hold become '?'."""
    return html.escape("".join(c if c.isprintable() else "?" for c in content))


@dataclass(frozen=True)
class Cells:
    """A raster of equal cells, each of one of a few kinds.

    Attributes:
        kinds: (rows, columns) of indices into `paints`; row along +y, column along +x.
        lower: corner of cell [0, 0].
        size: of a cell.
        paints: by kind; kinds with fill "none" are not drawn.
    """

    kinds: np.ndarray
    lower: tuple[float, float]
    size: tuple[float, float]
    paints: Sequence[Paint]

    def legend(self) -> list[tuple[str, Paint]]:
        """Entries of the kinds that occur."""
        present = set(np.unique(self.kinds).tolist())
        return [("area", paint) for kind, paint in enumerate(self.paints) if kind in present]

    def svg(self, to_picture: ToPicture) -> list[str]:
        """One path for each kind, of rectangles as large as rows of equal runs allow."""
        written = []
        for kind, paint in enumerate(self.paints):
            if paint.fill == "none":
                continue
            corners = []
            for row0, row1, column0, column1 in _rectangles(self.kinds == kind):
                low = np.add(self.lower, np.multiply((column0, row0), self.size))
                high = np.add(self.lower, np.multiply((column1, row1), self.size))
                (x0, y1), (x1, y0) = to_picture(np.array([low, high]))
                # Absolute, so that neighbours end at the very same numbers: no seams.
                left, right = number(x0), number(x1)
                corners.append(f"M{left} {number(y0)}H{right}V{number(y1)}H{left}z")
            if corners:
                crisp = 'shape-rendering="crispEdges"'
                written.append(f'<path {paint.attributes()} {crisp} d="{"".join(corners)}"/>')
        return written


def _rectangles(mask: np.ndarray) -> list[tuple[int, int, int, int]]:
    """Rectangles (row0, row1, column0, column1) that tile a mask: runs, merged over equal rows."""
    done, open_runs = [], {}  # type: ignore[var-annotated]
    for row in range(mask.shape[0] + 1):
        line = mask[row] if row < mask.shape[0] else np.zeros(mask.shape[1], dtype=bool)
        steps = np.flatnonzero(np.diff(np.concatenate(([0], line.astype(np.int8), [0]))))
        runs = set(zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True))
        for run in sorted(open_runs.keys() - runs):
            done.append((open_runs.pop(run), row, *run))
        for run in runs - open_runs.keys():
            open_runs[run] = row
    return done


@dataclass(frozen=True)
class Area:
    """A region: outer loops and holes, by the even-odd rule; loops are (n, 2)."""

    loops: Sequence[np.ndarray]
    paint: Paint

    def legend(self) -> list[tuple[str, Paint]]:
        """Its entry."""
        return [("area", self.paint)]

    def svg(self, to_picture: ToPicture) -> list[str]:
        """One path."""
        drawn = "".join(_trace(to_picture(np.asarray(loop))) + "z" for loop in self.loops)
        return [f'<path {self.paint.attributes()} fill-rule="evenodd" d="{drawn}"/>']


@dataclass(frozen=True)
class Line:
    """Polylines, each (n, 2), drawn as one."""

    pieces: Sequence[np.ndarray]
    paint: Paint

    def legend(self) -> list[tuple[str, Paint]]:
        """Its entry."""
        return [("line", self.paint)]

    def svg(self, to_picture: ToPicture) -> list[str]:
        """One path."""
        drawn = "".join(_trace(to_picture(np.asarray(p))) for p in self.pieces if len(p) > 1)
        return [f'<path {self.paint.attributes()} d="{drawn}"/>'] if drawn else []


def _trace(points: np.ndarray) -> str:
    places = [f"{number(x)} {number(y)}" for x, y in points]
    return "M" + "L".join(places)


@dataclass(frozen=True)
class Marker:
    """A sign at a point: "circle", "square", "diamond" or "cross"."""

    point: tuple[float, float]
    kind: str
    paint: Paint
    radius: float = 4.5

    def legend(self) -> list[tuple[str, Paint]]:
        """Its entry."""
        return [(self.kind, self.paint)]

    def svg(self, to_picture: ToPicture) -> list[str]:
        """One element."""
        ((x, y),) = to_picture(np.array([self.point], dtype=float))
        return [sign(self.kind, x, y, self.radius, self.paint)]


def sign(kind: str, x: float, y: float, radius: float, paint: Paint) -> str:
    """The element of a marker, at a place of the picture."""
    if kind == "circle":
        place = f'cx="{number(x)}" cy="{number(y)}" r="{number(radius)}"'
        return f"<circle {paint.attributes()} {place}/>"
    outlines = {
        "square": [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        "diamond": [(0, -1.25), (1.25, 0), (0, 1.25), (-1.25, 0)],
        "cross": [(-0.8, -0.8), (0.8, 0.8), (0, 0), (0.8, -0.8), (-0.8, 0.8), (0, 0)],
    }
    outline = np.array([x, y]) + radius * np.array(outlines[kind])
    return f'<path {paint.attributes()} d="{_trace(outline)}z"/>'


@dataclass(frozen=True)
class Note:
    """A word or two beside a point; `shift` is in picture units, y down."""

    point: tuple[float, float]
    words: str
    shift: tuple[float, float] = (6.0, -5.0)
    anchor: str = "start"
    colour: str = INK

    def legend(self) -> list[tuple[str, Paint]]:
        """None."""
        return []

    def svg(self, to_picture: ToPicture) -> list[str]:
        """Twice: a light border first, so that it can be read on any ground."""
        ((x, y),) = to_picture(np.array([self.point], dtype=float))
        x, y = x + self.shift[0], y + self.shift[1]
        halo = 'fill="#ffffff" stroke="#ffffff" stroke-width="2.5" stroke-linejoin="round"'
        ink = f'fill="{self.colour}"'
        return [text(x, y, self.words, 10.5, self.anchor, more) for more in (halo, ink)]


Mark = Cells | Area | Line | Marker | Note


def wrapped(
    points: np.ndarray, lower: tuple[float, float], period: tuple[float, float]
) -> list[np.ndarray]:
    """A polyline laid into one period of axes that wrap around, cut where it leaves it.

    Args:
        points: (n, 2), not wrapped: each edge is the motion that is meant.
        lower: least value of each axis in the picture.
        period: of each axis; 0 for one that does not wrap.

    Returns:
        Pieces (m, 2) within lower and lower + period.
    """
    pieces: list[np.ndarray] = []
    turns = np.where(np.array(period) > 0, period, np.inf)
    for a, b in pairwise(points):
        cuts = {0.0, 1.0}
        for axis in range(2):
            if not np.isfinite(turns[axis]) or a[axis] == b[axis]:
                continue
            first, last = sorted((c[axis] - lower[axis]) / turns[axis] for c in (a, b))
            for turn in range(int(np.floor(first)), int(np.floor(last)) + 1):
                share = (lower[axis] + turn * turns[axis] - a[axis]) / (b[axis] - a[axis])
                if 0.0 < share < 1.0:
                    cuts.add(float(share))
        shares = sorted(cuts)
        for s0, s1 in pairwise(shares):
            ends = np.array([a + s0 * (b - a), a + s1 * (b - a)])
            turn = np.floor((ends.mean(axis=0) - lower) / turns)
            laid = ends - np.where(turn == 0, 0.0, turn * np.where(turn == 0, 1.0, turns))
            if pieces and np.allclose(pieces[-1][-1], laid[0], atol=1e-12):
                pieces[-1] = np.vstack([pieces[-1], laid[1]])
            else:
                pieces.append(laid)
    return pieces
