"""Lengths, directions and lists in words, and lines of a label and what it tells.

Lengths in millimetres; lines are at most 80 wide but for names and reasons.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

__all__ = [
    "WIDTH",
    "direction",
    "extent",
    "folded",
    "labelled",
    "listed",
    "millimetres",
    "more_line",
    "span",
    "warning_lines",
]

WIDTH = 80


def millimetres(lengths: Iterable[float]) -> str:
    """Lengths in mm, with one digit after the point."""
    return ", ".join(f"{1e3 * value + 0.0:.1f}".replace("-0.0", "0.0") for value in lengths)


def span(lengths: Sequence[float]) -> str:
    """From the least to the greatest length in mm, once where they are the same."""
    low, high = millimetres([min(lengths)]), millimetres([max(lengths)])
    return low if low == high else f"{low} to {high}"


def extent(size: np.ndarray) -> str:
    """Three lengths in mm: "40.0 x 60.0 x 50.0"."""
    return " x ".join(f"{1e3 * x:.1f}" for x in size)


def direction(vector: np.ndarray) -> str:
    """A unit vector: an axis by its name, else three numbers."""
    vector = np.asarray(vector, dtype=float)
    axis = int(np.argmax(np.abs(vector)))
    if abs(vector[axis]) > 1 - 1e-6:
        return f"{'+' if vector[axis] > 0 else '-'}{'xyz'[axis]}"
    return "(" + ", ".join(f"{0.0 if abs(x) < 0.005 else x:.2f}" for x in vector) + ")"


def listed(names: Sequence[str], width: int, first: str) -> list[str]:
    """Names after a heading, folded; further lines are indented as far."""
    lines, rest = [], list(names) or ["none"]
    line = first
    for i, name in enumerate(rest):
        word = name + ("," if i + 1 < len(rest) else "")
        if len(line) > len(first) and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = " " * len(first)
        line += (" " if line.strip() and line != first else "") + word
    return [*lines, line]


def labelled(label: str, text: str) -> str:
    """One line: a label, and what it tells."""
    return f"  {label:<10}{text}"


def folded(label: str, words: str) -> list[str]:
    """Running text beside a label."""
    lines = [""]
    for word in words.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > WIDTH - 12:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return [labelled(label if i == 0 else "", line) for i, line in enumerate(lines)]


def warning_lines(warnings: Iterable[str]) -> list[str]:
    """Each warning, folded."""
    return [line for warning in warnings for line in folded("warning", warning)]


def more_line(hidden: int, what: str) -> list[str]:
    """How many are not told; no line if all are."""
    return [labelled("", f"and {hidden} more {what} (--verbose)")] if hidden > 0 else []
