"""Every Python example runs and finds what it says; each has its C++ twin."""

from __future__ import annotations

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = sorted((ROOT / "python/examples").glob("[0-9]*.py"))
FIGURES = sorted((ROOT / "python/examples").glob("figure_*.py"))


def run(example: Path, argument: Path) -> None:
    pytest.importorskip("handey._core")
    path = os.pathsep.join([str(ROOT / "python"), os.environ.get("PYTHONPATH", "")])
    ran = subprocess.run(
        [sys.executable, example, argument],
        env={**os.environ, "PYTHONPATH": path, "HANDEY_CACHE": ""},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert ran.stdout and not ran.stderr


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_the_example_runs(example: Path) -> None:
    run(example, ROOT / "models")


@pytest.mark.parametrize("figure", FIGURES, ids=lambda path: path.stem)
def test_the_figure_of_the_article_is_drawn(figure: Path, tmp_path: Path) -> None:
    picture = tmp_path / "picture.svg"
    run(figure, picture)
    root = ElementTree.parse(picture).getroot()
    assert root.tag.endswith("svg")
    assert len(list(root.iter())) > 50


def test_examples_are_numbered_pairs() -> None:
    twins = sorted(path.stem for path in (ROOT / "cpp/examples").glob("[0-9]*.cpp"))
    assert [path.stem for path in EXAMPLES] == twins
    assert [int(name[:2]) for name in twins] == list(range(1, len(twins) + 1))
