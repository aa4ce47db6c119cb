"""Cells that are odd but legal: a plan that the check finds valid, or a reason that is true."""

from __future__ import annotations

import dataclasses
import math
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import handey
from handey.planner import PlanOptions

ROBOT = Path(__file__).resolve().parent.parent / "models" / "robots" / "puma560" / "robot.yaml"
BLOCK = "block: {box: [0.04, 0.06, 0.03], pose: {xyz: [0.5, 0.2, 0.015]}}"
GOAL = "{place: block, at: {xyz: [0.45, -0.25, 0.015]}}"
TURN = 0.7  # of a wall along a turned block [rad]


def box(name: str, size: str, xyz: str, more: str = "") -> str:
    return f"{name}: {{box: {size}, pose: {{xyz: {xyz}{more}}}}}"


def at(name: str, xyz: str, more: str = "") -> str:
    return f"{{place: {name}, at: {{xyz: {xyz}{more}}}}}"


def cell(
    folder: Path,
    parts: tuple[str, ...] = (BLOCK,),
    goals: tuple[str, ...] = (GOAL,),
    fixtures: tuple[str, ...] = (),
    robot: str = "",
    more: str = "",
) -> Path:
    table = box("table", "[1.6, 1.4, 0.05]", "[0.55, 0, -0.025]")
    lines = ["handey_cell: 1", "name: odd", f"robot: {{file: {ROBOT}{robot}}}", "fixtures:"]
    lines += [f"  {each}" for each in (table, *fixtures)]
    lines += [
        "parts:",
        *(f"  {each}" for each in parts),
        "task:",
        *(f"  - {each}" for each in goals),
    ]
    path = folder / "cell.yaml"
    path.write_text("\n".join([*lines, more]))
    return path


def subdivided(n: int) -> str:
    """The block as an OBJ mesh with n x n squares on each side."""
    vertices, faces = [], []
    for axis, side in ((axis, side) for axis in range(3) for side in (0, 1)):
        first = len(vertices)
        for i in range(n + 1):
            for j in range(n + 1):
                point = [0.0, 0.0, 0.0]
                point[axis], point[axis - 2], point[axis - 1] = side - 0.5, i / n - 0.5, j / n - 0.5
                vertices.append(
                    f"v {0.04 * point[0]:.9g} {0.06 * point[1]:.9g} {0.03 * point[2]:.9g}"
                )
        for i in range(n):
            for j in range(n):
                a = first + i * (n + 1) + j
                square = (a, a + n + 1, a + n + 2, a + 1)[:: 1 if side else -1]
                faces.append("f " + " ".join(str(index + 1) for index in square))
    return "\n".join([*vertices, *faces]) + "\n"


A, B = (
    box(name, "[0.04, 0.06, 0.03]", f"[0.5, {y}, 0.015]") for name, y in (("a", 0.2), ("b", -0.2))
)
LOW = box("low", "[0.1, 0.09, 0.04]", "[0.5, 0.2, 0.02]")
TOP = box("top", "[0.04, 0.06, 0.03]", "[0.5, 0.2, 0.055]")
BESIDE = f"{0.5 - math.sin(TURN) * 0.04:.9f}, {0.2 + math.cos(TURN) * 0.04:.9f}"
TURNED = f"[{BESIDE}, 0.075], rpy: [0, 0, {TURN}]"
POSSIBLE = {
    "a wall at the origin": {"fixtures": (box("w", "[0.3, 0.02, 0.25]", "[0.5, 0.24, 0.125]"),)},
    "a wall in front": {"fixtures": (box("w", "[0.02, 0.2, 0.1]", "[0.53, 0.2, 0.05]"),)},
    "a wall at the goal": {"fixtures": (box("w", "[0.3, 0.02, 0.25]", "[0.45, -0.29, 0.125]"),)},
    "a turned wall": {
        "parts": (
            box("block", "[0.04, 0.06, 0.03]", "[0.5, 0.2, 0.015]", f", rpy: [0, 0, {TURN}]"),
        ),
        "fixtures": (f"w: {{box: [0.2, 0.02, 0.15], pose: {{xyz: {TURNED}}}}}",),
    },
    "a round wall": {"fixtures": ("w: {sphere: {radius: 0.05}, pose: {xyz: [0.5, 0.28, 0.015]}}",)},
    "a low corner at both ends": {
        "fixtures": tuple(
            box(name, size, xyz)
            for name, size, xyz in (
                ("a", "[0.2, 0.02, 0.01]", "[0.5, 0.24, 0.005]"),
                ("b", "[0.02, 0.2, 0.01]", "[0.53, 0.2, 0.005]"),
                ("c", "[0.2, 0.02, 0.01]", "[0.45, -0.29, 0.005]"),
                ("d", "[0.02, 0.2, 0.01]", "[0.48, -0.25, 0.005]"),
            )
        )
    },
    "a neighbour that the goal touches": {
        "parts": (BLOCK, box("other", "[0.04, 0.06, 0.03]", "[0.45, -0.19, 0.015]"))
    },
    "partly over the edge": {
        "fixtures": (box("shelf", "[0.2, 0.2, 0.04]", "[0.45, -0.15, 0.02]"),),
        "goals": (at("block", "[0.45, -0.24, 0.055]"),),
    },
    "the top of a stack": {"parts": (LOW, TOP), "goals": (at("top", "[0.45, -0.25, 0.015]"),)},
    "off, moved, and on again": {
        "parts": (LOW, TOP),
        "goals": (
            at("top", "[0.45, -0.25, 0.015]"),
            at("low", "[0.6, -0.05, 0.02]"),
            at("top", "[0.6, -0.05, 0.055]"),
        ),
    },
    "two that change places": {
        "parts": (A, B),
        "goals": (
            at("a", "[0.6, 0, 0.015]"),
            at("b", "[0.5, 0.2, 0.015]"),
            at("a", "[0.5, -0.2, 0.015]"),
        ),
        "more": "order: any\n",
    },
    "there and back": {"goals": (GOAL, at("block", "[0.5, 0.2, 0.015]"))},
    "the same goal twice": {"goals": (GOAL, GOAL)},
    "a turned, raised base": {"robot": ", base: {xyz: [0.1, 0, 0.1], rpy: [0, 0, 2.5]}"},
    "a tilted base": {"robot": ", base: {xyz: [-0.1, 0, 0.3], rpy: [0, 0.3, 0]}"},
    "a small opening": {"robot": ", start_opening: 0.02"},
    "finish anywhere": {"more": "finish: anywhere\n"},
    "a micrometre": {"goals": (at("block", "[0.500001, 0.2, 0.015]"),)},
    "a millimetre": {"goals": (at("block", "[0.501, 0.2, 0.015]"),)},
    "many turns": {"goals": (at("block", "[0.45, -0.25, 0.015]", ", rpy: [0, 0, 100]"),)},
    "upside down at both ends": {
        "parts": (
            box(
                "block",
                "[0.04, 0.06, 0.03]",
                "[0.5, 0.2, 0.015]",
                ", rpy: [3.141592653589793, 0, 0]",
            ),
        ),
        "goals": (at("block", "[0.45, -0.25, 0.015]", ", rpy: [3.141592653589793, 0, 1]"),),
    },
    "a quaternion": {"goals": (at("block", "[0.45, -0.25, 0.015]", ", quat_xyzw: [0, 0, -1, 0]"),)},
    "numbers of all forms": {
        "parts": (
            "block: {box: [4e-2, 6E-2, +.03], mass: 1e-1, density: 7800, friction: 0.2,"
            " may_move: true, pose: {xyz: [5e-1, 0.2, 1.5e-2]}}",
        ),
    },
    "a cylinder": {
        "parts": (
            "block: {cylinder: {radius: 0.02, length: 0.03}, pose: {xyz: [0.5, 0.2, 0.015]}}",
        )
    },
    "several shapes": {
        "parts": (
            "block: {pose: {xyz: [0.5, 0.2, 0.015]}, shapes: [{box: [0.08, 0.08, 0.03]},"
            " {cylinder: {radius: 0.01, length: 0.06}, pose: {xyz: [0, 0, 0.04]}}]}",
        )
    },
}


@pytest.mark.parametrize("name", POSSIBLE)
def test_an_odd_cell_is_planned_and_the_plan_is_valid(name, tmp_path):
    path = cell(tmp_path, **POSSIBLE[name])
    result = handey.plan(handey.load_cell(path))
    assert result.plan is not None, "\n".join(result.report.reasons)
    checked = handey.check(path, result.plan)
    assert checked.ok, "\n".join(map(str, checked.faults))


def test_a_part_of_twenty_thousand_triangles_is_planned_as_the_block_that_it_is(tmp_path):
    (tmp_path / "fine.obj").write_text(subdivided(41))
    part = "block: {mesh: fine.obj, pose: {xyz: [0.5, 0.2, 0.015]}}"
    path = cell(tmp_path, parts=(part,))
    result = handey.plan(handey.load_cell(path))
    assert result.plan is not None and handey.check(path, result.plan).ok
    assert result.report.goals[0].counts["faces"] == 6


IMPOSSIBLE = {
    "a sphere": (
        {"parts": ("block: {sphere: {radius: 0.015}, pose: {xyz: [0.5, 0.2, 0.015]}}",)},
        "no flat face of 25 mm2 or more",
    ),
    "a grain": (
        {
            "parts": (box("block", "[0.002, 0.002, 0.002]", "[0.5, 0.2, 0.001]"),),
            "goals": (at("block", "[0.45, -0.25, 0.001]"),),
        },
        "no flat face of 25 mm2 or more",
    ),
    "between two walls that it touches": (
        {
            "fixtures": (
                box("left", "[0.2, 0.02, 0.02]", "[0.5, 0.24, 0.01]"),
                box("right", "[0.2, 0.02, 0.02]", "[0.5, 0.16, 0.01]"),
            )
        },
        "it fits too closely to be moved out",
    ),
    "no free place to change over": (
        {
            "parts": (A, B),
            "goals": (at("a", "[0.5, -0.2, 0.015]"), at("b", "[0.5, 0.2, 0.015]")),
            "more": "order: any\n",
        },
        "b is where a is to go\n  b could not be moved aside: no fixture has 'support: true'",
    ),
}


@pytest.mark.parametrize("name", IMPOSSIBLE)
def test_an_odd_cell_without_a_plan_gets_its_true_reason(name, tmp_path):
    changes, words = IMPOSSIBLE[name]
    result = handey.plan(handey.load_cell(cell(tmp_path, **changes)))
    assert result.plan is None
    assert words in "\n".join(result.report.reasons)


# Options


@pytest.mark.parametrize("deadline", [0, -1, float("nan"), float("inf")])
def test_a_deadline_that_is_no_time_is_refused(deadline):
    with pytest.raises(handey.InvalidInput, match="deadline: expected a finite number of seconds"):
        PlanOptions(deadline=deadline)


@pytest.mark.parametrize("seed", [-1, 2**64])
def test_a_seed_out_of_range_is_refused(seed):
    with pytest.raises(handey.InvalidInput, match="seed: expected a whole number from 0 to"):
        PlanOptions(seed=seed)


@pytest.mark.parametrize(
    "options",
    [{"seed": None}, {"seed": 1.5}, {"seed": True}, {"deadline": "1"}, {"deadline": True}],
)
def test_an_option_that_is_no_number_is_a_type_error(options):
    with pytest.raises(TypeError, match=f"{next(iter(options))}: expected a"):
        PlanOptions(**options)


def test_a_budget_that_would_never_end_is_refused():
    for options in ({"poses_per_round": 0}, {"sampling_rounds": ()}, {"sampling_rounds": (0,)}):
        with pytest.raises(handey.InvalidInput) as caught:
            PlanOptions(**options)
        assert [fault.code for fault in caught.value.faults] == ["E_RANGE"]


def test_threads_that_plan_one_cell_get_the_same_plan(tmp_path):
    loaded = handey.load_cell(cell(tmp_path))
    with ThreadPoolExecutor(4) as pool:
        plans = [result.plan for result in pool.map(lambda _: handey.plan(loaded), range(8))]
    texts = {dataclasses.replace(plan, report={}).to_json() for plan in plans if plan is not None}
    assert len(plans) == 8 and len(texts) == 1
