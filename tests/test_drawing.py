"""Pictures: what is drawn is where it belongs, and equal content gives equal bytes."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from handey.drawing import Axis, Figure, Panel
from handey.drawing.figure import extent, folded
from handey.drawing.marks import Area, Cells, Line, Marker, Note, Paint, number, wrapped
from handey.errors import InvalidInput

SVG = "{http://www.w3.org/2000/svg}"
UNIT = (1.0, 1.0)


def panel(width: float = 100.0, height: float | None = 200.0) -> Panel:
    return Panel("p", Axis("x", 0, 10), Axis("y", 0, 20), width, height)


def parsed(figure: Figure) -> ElementTree.Element:
    return ElementTree.fromstring(figure.svg())


def covered(path: str, shape: tuple[int, int], scale: float = 10.0) -> np.ndarray:
    """How often the rectangles of a raster's path cover each cell of (rows, columns), y up."""
    count = np.zeros(shape, dtype=int)
    for entry in re.findall(r"M([\d.]+) ([\d.]+)H([\d.]+)V([\d.]+)", path):
        left, top, right, bottom = (round(float(value) / scale) for value in entry)
        count[shape[0] - bottom : shape[0] - top, left:right] += 1
    return count


@pytest.mark.parametrize("seed", range(5))
def test_a_raster_covers_each_cell_of_a_kind_once(seed: int) -> None:
    kinds = np.random.default_rng(seed).integers(0, 3, size=(20, 10))
    paints = [Paint(), Paint("#111111"), Paint("#222222")]
    drawn = Cells(kinds, (0, 0), UNIT, paints).svg(panel().to_picture)
    assert len(drawn) == 2  # the first kind has no colour
    for kind, path in enumerate(drawn, start=1):
        assert np.array_equal(covered(path, kinds.shape), kinds == kind)


def test_equal_rows_are_merged_into_one_rectangle() -> None:
    drawn = Cells(np.ones((20, 10), dtype=int), (0, 0), UNIT, [Paint(), Paint("#111111")])
    (path,) = drawn.svg(panel().to_picture)
    assert path.count("M") == 1 and "M0 0H100V200H0z" in path


def test_y_grows_upwards_and_equal_scales_give_the_height() -> None:
    shown = panel(height=None)
    assert shown.frame == (100.0, 200.0)
    assert shown.to_picture(np.array([[0.0, 0.0], [10.0, 20.0]])).tolist() == [[0, 200], [100, 0]]


def test_ticks_lie_within_the_axis_and_do_not_crowd() -> None:
    for lower, upper in ((-160, 160), (-225, 45), (-3, 4), (-1000, 1000)):
        ticks = Axis("a", lower, upper).ticks(240)
        assert 2 <= len(ticks) <= 1 + 240 / 34
        assert lower <= min(ticks) and max(ticks) <= upper
    metres = Axis("m", 0.0, 0.66, degrees=False)
    assert np.allclose(metres.ticks(160), [0.0, 0.2, 0.4, 0.6])
    assert [metres.written(v) for v in (0.30000000000000004, -0.0)] == ["0.3", "0"]
    assert Axis("a", -90, 90).written(-45) == "\u221245\u00b0"


def test_the_legend_has_each_label_once_and_no_kind_that_is_not_there() -> None:
    shown = panel()
    blocked, free = Paint("#111111", label="blocked"), Paint("#ffffff", label="free")
    shown.add(Cells(np.zeros((2, 2), dtype=int), (0, 0), UNIT, [blocked, free]))
    path = Paint(stroke="#0000ff", label="path")
    shown.add(Line([np.eye(2)], path), Line([np.eye(2)], path), Marker((1, 1), "cross", Paint()))
    texts = [element.text for element in parsed(Figure([[shown, shown]])).iter(f"{SVG}text")]
    assert texts.count("blocked") == 1 and texts.count("path") == 1 and "free" not in texts


def test_words_from_a_file_cannot_break_the_picture() -> None:
    name = "<a & 'b'> \x1b[31m \x00"
    shown = Panel(name, Axis(name, 0, 1), Axis(name, 0, 1))
    shown.add(Note((0, 0), name), Marker((0, 0), "circle", Paint("#111111", label=name)))
    root = parsed(Figure([[shown]], caption=name, title=name))
    assert root.find(f"{SVG}title").text == "<a & 'b'> ?[31m ?"


def test_shared_axes_are_lettered_at_the_left_and_below_only() -> None:
    rows = [[panel(), panel()], [panel()]]
    texts = [t.text for t in parsed(Figure(rows, shared_axes=True)).iter(f"{SVG}text")]
    assert texts.count("y") == 2 and texts.count("x") == 2
    texts = [t.text for t in parsed(Figure(rows)).iter(f"{SVG}text")]
    assert texts.count("y") == 3 and texts.count("x") == 3


def test_equal_content_gives_equal_bytes_and_the_file_is_whole(tmp_path: Path) -> None:
    def figure() -> Figure:
        shown = panel()
        rng = np.random.default_rng(1)
        shown.add(Cells(rng.integers(0, 2, (20, 10)), (0, 0), UNIT, [Paint(), Paint("#111111")]))
        shown.add(Area([rng.random((5, 2)), rng.random((4, 2))], Paint("#333333")))
        shown.add(Marker((1, 2), "diamond", Paint("#444444")), Note((1, 2), "here"))
        return Figure([[shown]], "words of a caption " * 10)

    figure().save(tmp_path / "a.svg")
    assert (tmp_path / "a.svg").read_text() == figure().svg()
    with pytest.raises(InvalidInput, match="there is no folder"):
        figure().save(tmp_path / "none/a.svg")


def test_a_folded_caption_keeps_its_words_and_its_width() -> None:
    words = "three slices of the configuration space of an arm " * 5
    lines = folded(words, 200, 11.5)
    assert " ".join(lines).split() == words.split()
    assert len(lines) > 1 and all(extent(line, 11.5) <= 200 for line in lines)
    assert folded("", 200, 11.5) == []


def test_numbers_are_short() -> None:
    values = (-0.001, 1.0, 2.346, 0.1 + 0.2, 100, -7.5)
    assert [number(v) for v in values] == ["0", "1", "2.35", "0.3", "100", "-7.5"]


def test_a_line_is_cut_where_it_goes_round() -> None:
    # From 170 degrees on past 180 to 190, while the other axis does not wrap.
    pieces = wrapped(np.array([[170.0, 0.0], [190.0, 20.0]]), (-180, -180), (360, 0))
    assert [piece.tolist() for piece in pieces] == [
        [[170.0, 0.0], [180.0, 10.0]],
        [[-180.0, 10.0], [-170.0, 20.0]],
    ]


def test_a_line_that_does_not_go_round_is_one_piece() -> None:
    line = np.array([[0.0, 0.0], [50.0, 10.0], [170.0, -20.0]])
    (piece,) = wrapped(line, (-180, -180), (360, 360))
    assert np.array_equal(piece, line)
    (far,) = wrapped(line + np.array([720, -360]), (-180, -180), (360, 360))
    assert np.allclose(far, line)


@pytest.mark.parametrize("seed", range(5))
def test_a_line_on_the_torus_keeps_its_length_and_its_places(seed: int) -> None:
    line = np.cumsum(np.random.default_rng(seed).normal(0, 150, size=(12, 2)), axis=0)
    pieces = wrapped(line, (0, 0), (360, 360))
    length = sum(np.linalg.norm(np.diff(piece, axis=0), axis=1).sum() for piece in pieces)
    assert np.isclose(length, np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
    for piece in pieces:
        assert piece.min() >= -1e-9 and piece.max() <= 360 + 1e-9
    for before, after in pairwise(pieces):
        turns = (after[0] - before[-1]) / 360
        assert np.allclose(turns, np.round(turns))
