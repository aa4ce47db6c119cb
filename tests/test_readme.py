"""What the README shows runs as it stands there."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def test_the_python_example_plans_and_checks(tmp_path: Path) -> None:
    shutil.copytree(ROOT / "models", tmp_path / "models")
    example = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert example is not None
    run = subprocess.run(
        [sys.executable, "-c", example[1]], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert run.stdout.splitlines()[-1] == "valid"
    assert (tmp_path / "plan.json").exists()


def test_every_file_that_the_readme_names_is_there() -> None:
    named = re.findall(r"`((?:models|cpp|docs)/[\w./]+)`", (ROOT / "README.md").read_text())
    assert named
    assert all((ROOT / name).exists() for name in named), named
