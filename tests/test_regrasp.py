"""Step 7: put down on the way and taken again, where no grasp serves both ends."""

from __future__ import annotations

import copy
import itertools
from pathlib import Path
from typing import Any

import exhaustive_regrasps
import numpy as np
import pytest
import regrasp_cells
import yaml

import handey
from handey import _core
from handey.planning.plan_options import PlanOptions
from handey.regrasp.graph import Graph, Place
from handey.regrasp.grasp_table import GraspTableOptions, grasp_table
from handey.regrasp.search import RegraspOptions

ROOT = Path(__file__).resolve().parent.parent
ROBOT = ROOT / "models" / "robots" / "puma560" / "robot.yaml"
CELLS = ROOT / "models" / "cells"

FLIP: dict[str, Any] = {
    "handey_cell": 1,
    "name": "flip",
    "robot": {"file": str(ROBOT), "start": [0, 0.7854, -3.1416, 0, -0.7854, 0]},
    "fixtures": {
        "table": {"box": [1.6, 1.4, 0.05], "pose": {"xyz": [0.55, 0, -0.025]}, "support": True}
    },
    "parts": {
        "block": {
            "box": [0.06, 0.09, 0.05],
            "mass": 0.2,
            "pose": {"xyz": [0.48, 0.26, 0.025], "rpy": [0, 0, 0.3]},
        }
    },
    "task": [
        {"place": "block", "at": {"xyz": [0.45, -0.3, 0.025], "rpy": [3.141592653589793, 0, 1.0]}}
    ],
}


def write(folder: Path, **changes: Any) -> Path:
    cell = {**copy.deepcopy(FLIP), **changes}
    path = folder / "cell.yaml"
    path.write_text(yaml.safe_dump(cell, sort_keys=False))
    return path


def planned(path: Path, options: PlanOptions | None = None) -> handey.PlanResult:
    result = handey.plan(handey.load_cell(path), options)
    assert result.plan is not None, result.report.reasons
    checked = handey.check(path, result.plan)
    assert checked.ok, [str(fault) for fault in checked.faults]
    return result


def test_a_box_is_turned_upside_down_by_one_regrasp(tmp_path: Path) -> None:
    result = planned(write(tmp_path))
    assert result.plan is not None
    assert result.report.regrasps == 1
    actions = [step.action for step in result.plan.steps if step.action != "transit"]
    turn = ["approach", "grasp", "depart", "deposit", "release", "withdraw"]
    assert [action for action in actions if action != "transfer"] == 2 * turn
    held = [step.part_in_grasp_frame for step in result.plan.steps if step.part is not None]
    assert not np.allclose(held[0], held[-1], atol=1e-3)
    goal = result.report.goals[0]
    assert goal.status == "planned"
    assert goal.counts["regrasp sequences tried"] >= 1
    assert "then" in goal.grasp
    assert "on table" in goal.grasp


def test_it_comes_out_the_same_again(tmp_path: Path) -> None:
    path = write(tmp_path)
    first, second = planned(path).plan, planned(path).plan
    assert first is not None
    assert second is not None
    assert len(first.steps) == len(second.steps)
    for a, b in zip(first.steps, second.steps, strict=True):
        assert np.array_equal(a.positions, b.positions)
        assert np.array_equal(a.time, b.time)


def test_the_least_number_by_brute_force_is_one(tmp_path: Path) -> None:
    assert exhaustive_regrasps.least(write(tmp_path), seconds=30.0) == 1


def test_where_one_grasp_serves_there_is_no_regrasp(tmp_path: Path) -> None:
    goal = {"xyz": [0.45, -0.3, 0.025], "rpy": [0, 0, 1.0]}
    result = planned(write(tmp_path, task=[{"place": "block", "at": goal}]))
    assert result.report.regrasps == 0
    assert "regrasp" not in result.report.stages


def test_without_a_support_the_reason_says_so(tmp_path: Path) -> None:
    table = {**FLIP["fixtures"]["table"], "support": False}
    result = handey.plan(handey.load_cell(write(tmp_path, fixtures={"table": table})))
    assert result.plan is None
    assert any("support" in reason for reason in result.report.reasons), result.report.reasons


def test_regrasps_can_be_forbidden(tmp_path: Path) -> None:
    options = PlanOptions(regrasp=RegraspOptions(most_regrasps=0))
    result = handey.plan(handey.load_cell(write(tmp_path)), options)
    assert result.plan is None
    assert "grasp table" not in result.report.stages


def test_the_check_wants_a_support_between_regrasps(tmp_path: Path) -> None:
    result = planned(write(tmp_path))
    assert result.plan is not None
    table = {**FLIP["fixtures"]["table"], "support": False}
    checked = handey.check(write(tmp_path, fixtures={"table": table}), result.plan)
    assert not checked.ok
    assert {fault.clause for fault in checked.faults} == {"support"}


def test_the_part_may_be_put_down_on_a_part_that_is_a_support(tmp_path: Path) -> None:
    table = {**FLIP["fixtures"]["table"], "support": False}
    stand = {"box": [0.30, 0.30, 0.08], "pose": {"xyz": [0.5, 0, 0.04]}, "support": True}
    parts = {**FLIP["parts"], "stand": stand}
    result = planned(write(tmp_path, fixtures={"table": table}, parts=parts))
    assert result.report.regrasps >= 1
    assert "on stand" in result.report.goals[0].grasp


def test_figure_1_is_put_down_once_and_the_first_grasp_is_forbidden_at_the_goal() -> None:
    result = planned(CELLS / "figure_1.yaml")
    assert result.report.regrasps == 1
    loaded = handey.load_cell(CELLS / "figure_1.yaml")
    cell, goal = loaded.cell, loaded.goals[0]
    part = cell.part_index("l_block")
    assert result.plan is not None
    first = next(step.part_in_grasp_frame for step in result.plan.steps if step.part is not None)
    X_RH = np.linalg.inv(cell.X_WR) @ goal.X_WP @ np.linalg.inv(first)
    at_goal = cell.with_part_at(part, goal.X_WP)
    checker = _core.CollisionChecker(
        _core.make_collision_model(cell), at_goal, _core.Allowance(closed_on=part)
    )
    for solution in _core.SphericalWristSolver(cell.robot).solve(X_RH).solutions:
        assert not checker.is_free(_core.Configuration(q=solution.q, opening=0.04))


def test_random_cells_of_every_kind_are_planned_and_valid(tmp_path: Path) -> None:
    regrasps = 0
    for path in regrasp_cells.regrasp_cells(5, 4, tmp_path):
        outcome = regrasp_cells.run_one(path)
        if not outcome.planned:
            assert exhaustive_regrasps.least(path, seconds=5.0) < 0, str(outcome)
            continue
        assert outcome.valid, str(outcome)
        regrasps += outcome.regrasps
    assert regrasps >= 2


# The table on disk.


def part_and_robot(tmp_path: Path) -> tuple[_core.Body, _core.Robot]:
    cell = handey.load_cell(write(tmp_path)).cell
    return cell.parts[0], cell.robot


def options_of(most: int = 6000) -> GraspTableOptions:
    ranking = _core.RankingOptions(pairs=_core.PairChoice.TwoFaces)
    return GraspTableOptions(ranking, _core.LegalityOptions(), most)


def test_a_table_is_kept_and_read_again(tmp_path: Path) -> None:
    part, robot = part_and_robot(tmp_path)
    folder = tmp_path / "tables"
    made = grasp_table(part, robot, options_of(), str(folder))
    (kept,) = folder.glob("*")
    written = kept.stat().st_mtime_ns
    read = grasp_table(part, robot, options_of(), str(folder))
    assert kept.stat().st_mtime_ns == written
    assert np.array_equal(made.rows, read.rows)
    assert np.array_equal(made.clear, read.clear)
    assert np.array_equal(made.grasps.X_PH, read.grasps.X_PH)
    assert made.clear.shape == (len(made.rests), len(made.rows))
    assert made.clear.any(axis=1).all()
    assert not made.clear.all(axis=1).any()


@pytest.mark.parametrize("damage", ["cut", "changed", "empty", "text"])
def test_a_damaged_table_is_made_again(tmp_path: Path, damage: str) -> None:
    part, robot = part_and_robot(tmp_path)
    folder = tmp_path / "tables"
    made = grasp_table(part, robot, options_of(500), str(folder))
    (kept,) = folder.glob("*")
    good = kept.read_bytes()
    changed = bytearray(good)
    changed[len(good) // 2] ^= 0x40
    contents = {"cut": good[:-100], "changed": bytes(changed), "empty": b"", "text": b"grasps"}
    kept.write_bytes(contents[damage])
    again = grasp_table(part, robot, options_of(500), str(folder))
    assert np.array_equal(made.rows, again.rows)
    assert np.array_equal(made.clear, again.clear)
    read = grasp_table(part, robot, options_of(500), str(folder))
    assert np.array_equal(made.rows, read.rows)


def test_what_a_table_depends_on_names_its_file(tmp_path: Path) -> None:
    part, robot = part_and_robot(tmp_path)
    folder = tmp_path / "tables"
    slippery = _core.Body(name="block", shapes=part.shapes, friction=0.1, mass=part.mass)
    elsewhere = _core.Body(
        name="other", shapes=part.shapes, friction=part.friction, mass=part.mass, support=True
    )
    grasp_table(part, robot, options_of(), str(folder))
    grasp_table(elsewhere, robot, options_of(), str(folder))
    assert len(list(folder.glob("*"))) == 1
    grasp_table(slippery, robot, options_of(), str(folder))
    grasp_table(part, robot, options_of(500), str(folder))
    assert len(list(folder.glob("*"))) == 3


def test_nothing_is_kept_without_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    part, robot = part_and_robot(tmp_path)
    monkeypatch.setenv("HANDEY_CACHE", "")
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    grasp_table(part, robot, options_of(500))
    assert sorted(tmp_path.rglob("*")) == before


def test_a_folder_that_cannot_be_written_does_not_matter(tmp_path: Path) -> None:
    part, robot = part_and_robot(tmp_path)
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    assert len(grasp_table(part, robot, options_of(500), str(blocked)).rows) > 0


# The graph.


def random_graph(seed: int, places: int = 4, grasps: int = 4) -> Graph:
    rng = np.random.default_rng(seed)
    nodes = []
    for i in range(places):
        rows = np.sort(rng.choice(grasps, size=int(rng.integers(1, 4)), replace=True))
        q = rng.uniform(-1, 1, (len(rows), 2))
        nodes.append(Place(str(i), np.eye(4), rows, q, rng.uniform(0, 0.3, len(rows))))
    return Graph(np.array([1.0, 2.0]), np.zeros(2), np.full(2, 0.3), nodes)


def every_sequence(graph: Graph, regrasps: int) -> list[tuple[float, tuple[int, ...]]]:
    """Costs of all sequences, with their grasps, by enumeration."""

    def time(a: np.ndarray, b: np.ndarray) -> float:
        return float(np.max(np.abs(a - b) / graph.velocity))

    found = []
    inner = range(2, len(graph.places))
    for chain in itertools.product(inner, repeat=regrasps):
        stops = [0, *chain, 1]
        if any(a == b for a, b in itertools.pairwise(stops)):
            continue
        rows = [
            [
                (i, j)
                for i, a in enumerate(graph.places[p].grasps)
                for j, b in enumerate(graph.places[q].grasps)
                if a == b
            ]
            for p, q in itertools.pairwise(stops)
        ]
        for choice in itertools.product(*rows):
            held = [
                int(graph.places[p].grasps[i]) for p, (i, _) in zip(stops, choice, strict=False)
            ]
            if any(a == b for a, b in itertools.pairwise(held)):
                continue
            cost, at = 0.0, graph.start
            for (p, q), (i, j) in zip(itertools.pairwise(stops), choice, strict=True):
                a, b = graph.places[p], graph.places[q]
                cost += time(at, a.q[i]) + a.charge[i] + time(a.q[i], b.q[j]) + b.charge[j]
                at = b.q[j]
            assert graph.end is not None
            found.append((cost + time(at, graph.end), tuple(held)))
    return sorted(found)


@pytest.mark.parametrize("regrasps", [0, 1, 2])
def test_the_cheapest_sequence_is_that_of_enumeration(regrasps: int) -> None:
    with_way = 0
    for seed in range(40):
        graph = random_graph(seed)
        every = every_sequence(graph, regrasps)
        hops = graph.cheapest(regrasps)
        assert (hops is None) == (not every), seed
        if hops is None:
            continue
        with_way += 1
        assert len(hops) == regrasps + 1
        assert (hops[0].origin, hops[-1].target) == (0, 1)
        assert tuple(hop.grasp for hop in hops) in {
            held for cost, held in every if cost <= every[0][0] + 1e-9
        }
    assert with_way >= 4


def test_what_is_refused_is_not_used_again() -> None:
    for seed in range(40):
        graph = random_graph(seed, places=5, grasps=5)
        seen: set[tuple[int, ...]] = set()
        for _ in range(200):
            hops = graph.cheapest(1)
            if hops is None:
                break
            key = tuple(v for hop in hops for v in (hop.grasp, hop.origin, hop.target))
            assert key not in seen
            seen.add(key)
            kind = len(seen) % 4
            if kind == 0:
                graph.refuse_pick(hops[0].origin, hops[0].grasp)
            elif kind == 1:
                graph.refuse_put(hops[1].target, hops[1].grasp)
            elif kind == 2:
                graph.refuse_transit(hops[1].origin, hops[0].grasp, hops[1].grasp)
            else:
                graph.refuse_transfer(hops[0].origin, hops[0].grasp, hops[0].target)
        assert graph.cheapest(1) is None
        if seen:
            graph.forgive()
            assert graph.cheapest(1) is not None
