"""A cell and a plan made by hand, valid: what the tests of the check break."""

from __future__ import annotations

import copy

import pytest
from hand_made import pick_and_place, write_cell


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("cell")


@pytest.fixture(scope="module")
def cell(folder):
    return write_cell(folder)


@pytest.fixture(scope="module")
def valid(cell):
    return pick_and_place(cell)


@pytest.fixture
def plan(valid):
    return copy.deepcopy(valid)
