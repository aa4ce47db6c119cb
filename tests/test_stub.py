"""The committed stub `_core.pyi` tells what the compiled module holds: no name more, none less."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path

import pytest

import handey
from handey import _core

STUB = ast.parse((Path(handey.__file__).parent / "_core.pyi").read_text())
CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name for node in STUB.body if isinstance(node, ast.FunctionDef)}


def public(names: object) -> set[str]:
    return {name for name in names if not name.startswith("_")}  # type: ignore[attr-defined]


def test_the_stub_names_each_class_and_function_of_the_module() -> None:
    real_classes = {name for name, value in vars(_core).items() if inspect.isclass(value)}
    real_functions = {name for name, value in vars(_core).items() if inspect.isbuiltin(value)}
    assert set(CLASSES) == public(real_classes)
    assert public(real_functions) == FUNCTIONS


def test_all_of_the_stub_is_all_of_the_module() -> None:
    listed = next(
        ast.literal_eval(node.value)
        for node in STUB.body
        if isinstance(node, ast.AnnAssign) and ast.unparse(node.target) == "__all__" and node.value
    )
    assert set(listed) == public(vars(_core))


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_the_stub_names_each_member(name: str) -> None:
    members = set()
    for node in CLASSES[name].body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            members.add(node.name)
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            members.add(node.target.id)
    assert public(members) == public(vars(getattr(_core, name)))


@pytest.mark.parametrize("name", sorted(CLASSES) + sorted(FUNCTIONS))
def test_everything_has_a_docstring(name: str) -> None:
    assert inspect.getdoc(getattr(_core, name)), name
