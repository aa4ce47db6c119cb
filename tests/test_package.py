"""What the package offers by name."""

from __future__ import annotations

import importlib
import types

import pytest

import handey


def test_functions_keep_their_names_when_the_modules_of_these_names_load():
    module = importlib.import_module("handey.plan")
    assert isinstance(module, types.ModuleType)
    assert callable(handey.plan) and not isinstance(handey.plan, types.ModuleType)
    assert handey.Plan is module.Plan


@pytest.mark.parametrize("name", [*handey.__all__, "__version__"])
def test_every_name_offered_is_found(name: str) -> None:
    assert getattr(handey, name) is not None


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'plam'"):
        handey.plam  # noqa: B018


def test_every_fault_is_a_value_error_with_its_place():
    fault = handey.Fault("E_TYPE", "parts.a", "expected a number", "cell.yaml")
    error = handey.InvalidInput([fault, fault])
    assert isinstance(error, ValueError) and isinstance(error, handey.HandeyError)
    assert str(error).splitlines() == ["cell.yaml: parts.a: expected a number"] * 2
