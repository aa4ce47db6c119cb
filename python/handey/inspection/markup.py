"""Sections, tables and facts of a page, as HTML."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence

__all__ = [
    "escaped",
    "fact_list",
    "remark",
    "section",
    "shows",
    "table",
    "warning_notes",
    "words_cell",
]


def escaped(words: object) -> str:
    """Words with what HTML would read as markup escaped."""
    return html.escape(str(words))


def section(title: str, *content: str) -> str:
    """A heading and what is under it; the content is HTML already."""
    return f"<section><h2>{escaped(title)}</h2>\n" + "\n".join(content) + "\n</section>"


def fact_list(rows: Iterable[tuple[str, str]]) -> str:
    """Names and what they are; the second is HTML already."""
    return "<dl>" + "".join(f"<dt>{escaped(a)}</dt><dd>{b}</dd>" for a, b in rows) + "</dl>"


def warning_notes(warnings: Iterable[str]) -> str:
    """A paragraph for each warning."""
    return "".join(f'<p class="warning">{escaped(warning)}</p>' for warning in warnings)


def remark(words: str) -> str:
    """A paragraph beside the matter."""
    return f'<p class="remark">{escaped(words)}</p>'


def table(head: Sequence[str], rows: Sequence[tuple[Sequence[str], str]]) -> str:
    """A table; a heading that ends in a space is of numbers; each row has further attributes."""
    number = [' class="number"' if name.endswith(" ") else "" for name in head]
    titles = "".join(f"<th{n}>{escaped(t.strip())}</th>" for t, n in zip(head, number, strict=True))
    body = []
    for cells, more in rows:
        told = "".join(f"<td{n}>{cell}</td>" for cell, n in zip(cells, number, strict=True))
        body.append(f"<tr{' ' + more if more else ''}>{told}</tr>")
    return (
        f'<div class="scroll"><table><thead><tr>{titles}</tr></thead><tbody>'
        + "\n".join(body)
        + "</tbody></table></div>"
    )


def words_cell(text: str) -> str:
    """Running text in a cell of a table."""
    return f'<div class="words">{escaped(text)}</div>' if text else ""


def shows(what: str, words: str, first: bool = False) -> str:
    """Attributes of a row that the picture can show."""
    mark = ' data-first="1"' if first else ""
    return f'data-show="{escaped(what)}" data-words="{escaped(words)}"{mark}'
