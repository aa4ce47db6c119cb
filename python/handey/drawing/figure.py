"""Pictures of slices and sections as SVG: panels side by side, axes, legend, caption.

A panel holds marks in its own units (degrees or metres); the figure lays panels out in rows and
columns and collects the legend from the marks. The same content gives the same bytes. Not a
plotting library: what these pictures need, and no more.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from handey.drawing.marks import INK, Mark, Paint, escaped, number, sign, text
from handey.formats.output import write_whole

__all__ = ["Axis", "Figure", "Panel"]

FONT = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
TICK, GAP, LINE = 4.0, 26.0, 15.0  # length of a tick, between panels, between lines of text
LEFT = 62.0  # of the first frame: room for an axis' letters
MINUS = "\u2212"


@dataclass(frozen=True)
class Axis:
    """One axis of a panel.

    Attributes:
        label: what it shows.
        lower: least value shown.
        upper: greatest value shown.
        degrees: ticks are marked in degrees, else as plain numbers.
        tick: distance between ticks; None to choose one.
    """

    label: str
    lower: float
    upper: float
    degrees: bool = True
    tick: float | None = None

    def ticks(self, length: float, apart: float = 34.0) -> list[float]:
        """Values of the ticks, no nearer than `apart` picture units on an axis of this length."""
        step = self.tick or self._step(length, apart)
        first, last = math.ceil(self.lower / step - 1e-9), math.floor(self.upper / step + 1e-9)
        return [step * index for index in range(first, last + 1)]

    def _step(self, length: float, apart: float) -> float:
        least = apart * (self.upper - self.lower) / length
        if self.degrees:
            return next((s for s in (1, 2, 5, 10, 15, 30, 45, 90, 180) if s >= least), 360.0)
        decade = 10.0 ** math.floor(math.log10(least))
        return next(decade * s for s in (1, 2, 5, 10) if decade * s >= least)

    def written(self, value: float) -> str:
        """A tick's text."""
        shown = f"{value:.10g}" if abs(value) > 1e-9 else "0"
        return shown.replace("-", MINUS) + ("\u00b0" if self.degrees else "")


@dataclass
class Panel:
    """Axes and what is drawn in them.

    Attributes:
        title: above the panel.
        x: axis across.
        y: axis upwards.
        width: of the frame [picture units].
        height: of the frame; None where both axes are to have the same scale.
        marks: drawn in this order.
        framed: with its frame and axes.
    """

    title: str
    x: Axis
    y: Axis
    width: float = 240.0
    height: float | None = 240.0
    marks: list[Mark] = field(default_factory=list)
    framed: bool = True

    def add(self, *marks: Mark) -> None:
        """Draw these over what is there."""
        self.marks += marks

    @property
    def frame(self) -> tuple[float, float]:
        """Width and height [picture units]."""
        if self.height is not None:
            return self.width, self.height
        scale = (self.y.upper - self.y.lower) / (self.x.upper - self.x.lower)
        return self.width, self.width * scale

    def to_picture(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) in the axes' units to places in the frame, y down."""
        width, height = self.frame
        across = (points[:, 0] - self.x.lower) / (self.x.upper - self.x.lower)
        up = (points[:, 1] - self.y.lower) / (self.y.upper - self.y.lower)
        return np.column_stack([width * across, height * (1.0 - up)])

    def svg(self, left: float, top: float, outer: tuple[bool, bool]) -> list[str]:
        """The panel with its frame's corner at a place; axes are lettered where `outer` (x, y)."""
        width, height = self.frame
        size = f'width="{number(width)}" height="{number(height)}"'
        written = [f'<svg x="{number(left)}" y="{number(top)}" {size}>']  # clips what sticks out
        for mark in self.marks:
            written += mark.svg(self.to_picture)
        written.append("</svg>")
        written.append(text(left + width / 2, top - 8, self.title, 11.5, "middle"))
        if not self.framed:
            return written
        place = f'x="{number(left)}" y="{number(top)}"'
        written.append(f'<rect {place} {size} fill="none" stroke="{INK}" stroke-width="0.8"/>')
        return written + self._x_axis(left, top, outer[0]) + self._y_axis(left, top, outer[1])

    def _x_axis(self, left: float, top: float, lettered: bool) -> list[str]:
        width, height = self.frame
        ticks = self.x.ticks(width, 46.0)  # labels side by side
        base, written, path = top + height, [], ""
        for value in ticks:
            x = left + width * (value - self.x.lower) / (self.x.upper - self.x.lower)
            path += f"M{number(x)} {number(base)}v{number(TICK)}"
            if lettered:
                written.append(text(x, base + TICK + 11, self.x.written(value), 10, "middle"))
        if lettered:
            written.append(text(left + width / 2, base + TICK + 28, self.x.label, 11.5, "middle"))
        return [f'<path fill="none" stroke="{INK}" stroke-width="0.8" d="{path}"/>', *written]

    def _y_axis(self, left: float, top: float, lettered: bool) -> list[str]:
        _, height = self.frame
        ticks = self.y.ticks(height)
        written, path = [], ""
        for value in ticks:
            y = top + height * (1 - (value - self.y.lower) / (self.y.upper - self.y.lower))
            path += f"M{number(left)} {number(y)}h{number(-TICK)}"
            if lettered:
                written.append(text(left - TICK - 3, y + 3.5, self.y.written(value), 10, "end"))
        if lettered:
            x, y = left - TICK - 44, top + height / 2
            turn = f'transform="rotate(-90 {number(x)} {number(y)})"'
            written.append(text(x, y, self.y.label, 11.5, "middle", turn))
        return [f'<path fill="none" stroke="{INK}" stroke-width="0.8" d="{path}"/>', *written]


@dataclass
class Figure:
    """Panels in rows, a legend of what they show, and a caption.

    Attributes:
        rows: of panels; those of one column are as wide as the widest.
        caption: below.
        title: of the file, for those who cannot see the picture.
        shared_axes: axes are lettered only at the left and below the lowest row.
        row_titles: at the left of each row; none, or one for each row.
    """

    rows: Sequence[Sequence[Panel]]
    caption: str = ""
    title: str = "figure"
    shared_axes: bool = False
    row_titles: Sequence[str] = ()

    def svg(self) -> str:
        """The whole file."""
        columns = max(len(row) for row in self.rows)
        widths = [max(r[c].frame[0] for r in self.rows if c < len(r)) for c in range(columns)]
        heights = [max(panel.frame[1] for panel in row) for row in self.rows]
        margin = LEFT + (22.0 if self.row_titles else 0.0)
        inner = GAP if self.shared_axes else GAP + 50.0
        lefts = [margin + sum(widths[:c]) + c * inner for c in range(columns)]
        total = lefts[-1] + widths[-1] + 20.0
        written, top = [], 30.0
        for number_of_row, (row, height) in enumerate(zip(self.rows, heights, strict=True)):
            for column, panel in enumerate(row):
                outer = self._is_lettered(number_of_row, column)
                written += panel.svg(lefts[column], top, outer)
            if self.row_titles:
                written.append(_upright(14.0, top + height / 2, self.row_titles[number_of_row]))
            is_last = number_of_row == len(self.rows) - 1
            top += height + (40.0 if is_last else 34.0 if self.shared_axes else 72.0)
        lines, top = self._legend(LEFT, top + 18.0, total - LEFT - 20.0)
        written += lines
        lines, top = self._caption(LEFT, top + 4.0, total - LEFT - 20.0)
        return self._file(written + lines, total, top)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file, whole or not at all.

        Raises:
            InvalidInput: E_OUTPUT if it cannot be written.
        """
        write_whole(path, self.svg())

    def _is_lettered(self, row: int, column: int) -> tuple[bool, bool]:
        if not self.shared_axes:
            return True, True
        below = self.rows[row + 1] if row + 1 < len(self.rows) else []
        return column >= len(below), column == 0

    def _file(self, written: list[str], width: float, height: float) -> str:
        size = f'width="{number(width)}" height="{number(height)}"'
        box = f'viewBox="0 0 {number(width)} {number(height)}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" role="img" {size} {box} fill="{INK}"'
        return "\n".join(
            [
                f'{head} font-family="{FONT}">',
                f"<title>{escaped(self.title)}</title>",
                f'<rect {size} fill="#ffffff"/>',
                *written,
                "</svg>\n",
            ]
        )

    def _legend(self, left: float, top: float, width: float) -> tuple[list[str], float]:
        entries: dict[str, tuple[str, Paint]] = {}
        for row in self.rows:
            for panel in row:
                for mark in panel.marks:
                    for kind, paint in mark.legend():
                        if paint.label:
                            entries.setdefault(paint.label, (kind, paint))
        written, x, y = [], left, top
        for label, (kind, paint) in entries.items():
            length = 26.0 + extent(label, 11) + 18.0
            if x > left and x + length > left + width:
                x, y = left, y + 19.0
            written += [_swatch(kind, x, y - 4.0, paint), text(x + 26.0, y, label, 11)]
            x += length
        return written, y + (22.0 if entries else -18.0)

    def _caption(self, left: float, top: float, width: float) -> tuple[list[str], float]:
        lines = folded(self.caption, width, 11.5)
        written = [text(left, top + i * LINE, line, 11.5) for i, line in enumerate(lines)]
        return written, top + len(lines) * LINE + 4.0


def _swatch(kind: str, x: float, y: float, paint: Paint) -> str:
    if kind == "area":
        border = paint if paint.stroke != "none" else Paint(paint.fill, "#8a8a8a", 0.6)
        place = f'x="{number(x)}" y="{number(y - 5)}" width="20" height="10"'
        return f"<rect {border.attributes()} {place}/>"
    if kind == "line":
        return f'<path {paint.attributes()} d="M{number(x)} {number(y)}h20"/>'
    return sign(kind, x + 10, y, 4.5, paint)


def _upright(x: float, y: float, words: str) -> str:
    turn = f'transform="rotate(-90 {number(x)} {number(y)})" font-weight="bold"'
    return text(x, y, words, 11.5, "middle", turn)


def extent(words: str, size: float) -> float:
    """About how wide a text is, rather too wide; the font is the reader's."""
    wide, narrow = set("mwMW@%"), set("iljftrI.,:;'|!()[] ")
    share = sum(0.95 if c in wide else 0.36 if c in narrow else 0.62 for c in words)
    return size * share


def folded(words: str, width: float, size: float) -> list[str]:
    """The lines of a text that is to be no wider than `width`."""
    lines: list[str] = []
    for word in words.split():
        if lines and extent(f"{lines[-1]} {word}", size) <= width:
            lines[-1] = f"{lines[-1]} {word}"
        else:
            lines.append(word)
    return lines
