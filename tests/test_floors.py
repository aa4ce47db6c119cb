"""The C++ floors: includes go down only, and public headers see only std and Eigen.

The Python packages: imports go down only, none in a circle, and the replay shares no code with the
planner.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "cpp" / "include" / "handey"
SOURCE = ROOT / "cpp" / "src"
FLOORS = [
    "geometry",
    "kinematics",
    "world",
    "collision",
    "grasp",
    "approach",
    "cspace",
    "motion",
]
# Only one source room sees each of these libraries.
ONLY_IN = {"fcl": "collision", "ompl": "motion"}

QUOTED = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
ANGLED = re.compile(r"^\s*#\s*include\s+<([^>]+)>", re.MULTILINE)


def _files() -> list[Path]:
    headers = sorted(INCLUDE.rglob("*.hpp"))
    return headers + sorted([*SOURCE.rglob("*.cpp"), *SOURCE.rglob("*.hpp")])


def _floor(path: Path) -> str | None:
    parts = path.relative_to(INCLUDE if path.is_relative_to(INCLUDE) else SOURCE).parts
    return parts[0] if len(parts) > 1 else None


def test_there_are_floors_to_check() -> None:
    assert {_floor(path) for path in _files()} - {None} <= set(FLOORS)
    assert len(_files()) > 40


@pytest.mark.parametrize("path", _files(), ids=lambda path: str(path.relative_to(ROOT)))
def test_includes_go_down_only(path: Path) -> None:
    floor = _floor(path)
    for include in QUOTED.findall(path.read_text()):
        if not include.startswith("handey/"):
            resolved = (path.parent / include).resolve()
            assert resolved.is_file(), f"{include} is not beside {path.name}"
            assert _floor(resolved) in (floor, None), f"{include} is private to another floor"
            continue
        assert (INCLUDE.parent / include).is_file(), f"{include} does not exist"
        parts = include.split("/")
        if len(parts) == 2:
            lowest = ("handey/errors.hpp", "handey/stop.hpp")
            assert path.name == "handey.hpp" or include in lowest
        elif floor is not None:
            assert FLOORS.index(parts[1]) <= FLOORS.index(floor), f"{floor} includes {include}"


@pytest.mark.parametrize(
    "path", sorted(INCLUDE.rglob("*.hpp")), ids=lambda path: str(path.relative_to(INCLUDE))
)
def test_public_headers_see_only_std_and_eigen(path: Path) -> None:
    for include in ANGLED.findall(path.read_text()):
        is_standard = re.fullmatch(r"[a-z_]+", include) is not None
        assert is_standard or include.startswith("Eigen/"), include


@pytest.mark.parametrize("library", sorted(ONLY_IN))
def test_one_floor_sees_a_library(library: str) -> None:
    for path in _files():
        if any(include.startswith(f"{library}/") for include in ANGLED.findall(path.read_text())):
            assert _floor(path) == ONLY_IN[library], f"{path} sees {library}"


def test_only_sampling_sees_ompl() -> None:
    seeing = {
        path.name
        for path in _files()
        if any(include.startswith("ompl/") for include in ANGLED.findall(path.read_text()))
    }
    assert seeing == {"sampling.cpp"}


def test_handey_hpp_lists_every_header_in_floor_order() -> None:
    listed = QUOTED.findall((INCLUDE / "handey.hpp").read_text())
    present = {
        str(path.relative_to(INCLUDE.parent))
        for path in INCLUDE.rglob("*.hpp")
        if path.name != "handey.hpp"
    }
    assert set(listed) == present
    assert len(listed) == len(set(listed))
    floors = [include.split("/")[1] for include in listed if include.count("/") == 2]
    assert floors == sorted(floors, key=FLOORS.index)


def test_every_source_is_built() -> None:
    listing = (ROOT / "CMakeLists.txt").read_text()
    for path in SOURCE.rglob("*.cpp"):
        assert f"  {path.relative_to(ROOT)}\n" in listing, path


PYTHON = ROOT / "python"
# The packages and modules of the Python floor, top to bottom; "" is the package itself.
ORDER = [
    "__main__",
    "cli",
    "commands",
    "",
    "inspection",
    "view",
    "slices",
    "pages",
    "drawing",
    "check",
    "planner",
    "advising",
    "planning",
    "regrasp",
    "reporting",
    "motion",
    "plan",
    "cell_file",
    "cell",
    "resting",
    "placement",
    "robot_file",
    "task",
    "formats",
    "cache",
    "options",
    "errors",
    "_core",
]
# Their functions import what they need, so that each command starts without what others need, and
# a file can be read without the compiled core.
IMPORT_LATE = {
    "handey",
    "handey.cell_file",
    "handey.check.shapes",
    "handey.cli",
    "handey.commands.check",
    "handey.commands.plan",
    "handey.commands.inspect",
    "handey.placement",
    "handey.robot_file",
    "handey.commands.slice",
    "handey.commands.view",
}
# What the replay may use besides its own modules: how faults are told.
LENT_TO_CHECK = {"handey.errors"}


def _module(path: Path) -> str:
    parts = path.relative_to(PYTHON).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {_module(path): path for path in sorted((PYTHON / "handey").rglob("*.py"))}


def _imported(tree: ast.AST) -> Iterator[str]:
    """Modules of the package that are imported anywhere in it, also for types alone."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("handey"))
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("handey"):
            for alias in node.names:
                full = f"{node.module}.{alias.name}"
                is_module = full in MODULES or full == "handey._core"
                yield full if is_module else str(node.module)


@cache
def _imports() -> dict[str, set[str]]:
    trees = {name: ast.parse(path.read_text()) for name, path in MODULES.items()}
    return {name: set(_imported(tree)) - {name} for name, tree in trees.items()}


def test_imports_form_no_circle() -> None:
    # A circle is raised as an error that names the modules in it.
    order = list(TopologicalSorter(_imports()).static_order())
    assert set(order) - set(MODULES) == {"handey._core"}
    assert len(order) > 100


def _place(module: str) -> int:
    return ORDER.index(module.split(".")[1] if "." in module else "")


def test_every_package_has_its_place() -> None:
    assert {_place(name) for name in [*MODULES, "handey._core"]} == set(range(len(ORDER)))


@pytest.mark.parametrize("module", MODULES)
def test_imports_of_python_go_down_only(module: str) -> None:
    for imported in _imports()[module]:
        assert _place(imported) >= _place(module), f"{module} imports {imported}"


def test_imports_are_absolute() -> None:
    for name, path in MODULES.items():
        for node in ast.walk(ast.parse(path.read_text())):
            assert not (isinstance(node, ast.ImportFrom) and node.level), name


def test_only_named_modules_import_late() -> None:
    late = set()
    for name, path in MODULES.items():
        for function in ast.walk(ast.parse(path.read_text())):
            if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef)):
                nodes = ast.walk(function)
                if any(isinstance(node, (ast.Import, ast.ImportFrom)) for node in nodes):
                    late.add(name)
    assert late == IMPORT_LATE


def test_the_replay_shares_no_code_with_the_planner() -> None:
    for name, imported in _imports().items():
        if name.startswith("handey.check"):
            others = {other for other in imported if not other.startswith("handey.check")}
            assert others <= LENT_TO_CHECK, name
