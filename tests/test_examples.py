"""Every Python example runs and finds what it says; each has its C++ twin."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = sorted((ROOT / "python/examples").glob("[0-9]*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_the_example_runs(example: Path) -> None:
    pytest.importorskip("handey._core")
    path = os.pathsep.join([str(ROOT / "python"), os.environ.get("PYTHONPATH", "")])
    ran = subprocess.run(
        [sys.executable, example, ROOT / "models"],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert ran.stdout and not ran.stderr


def test_examples_are_numbered_pairs() -> None:
    twins = sorted(path.stem for path in (ROOT / "cpp/examples").glob("[0-9]*.cpp"))
    assert [path.stem for path in EXAMPLES] == twins
    assert [int(name[:2]) for name in twins] == list(range(1, len(twins) + 1))
