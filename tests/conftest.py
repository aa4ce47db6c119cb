"""What the tests of the check break: a valid cell and plan; and what those of `inspect` look at."""

from __future__ import annotations

import copy
import signal

import pytest
from hand_made import pick_and_place, write_cell
from inspected import CELLS, MM, PARTS, ROBOT

from handey.cell_file import load_cell
from handey.inspection import inspect_cell, inspect_mesh
from handey.robot_file import load_robot

# A shell's background jobs start with Ctrl-C ignored, and so would the programs that tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)


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


@pytest.fixture(scope="module")
def robot():
    return load_robot(ROBOT)[0]


@pytest.fixture(scope="module")
def bracket(robot):
    return inspect_mesh(PARTS / "bracket.stl", MM, robot)


@pytest.fixture(scope="module")
def demo():
    return inspect_cell(load_cell(CELLS / "demo.yaml"))
