"""The check takes a valid plan, shares no code with the planner, and no clause is untested."""

from __future__ import annotations

import json

import pytest

from handey.check import CLAUSES, check

ACTIONS = [
    "transit",
    "approach",
    "grasp",
    "depart",
    "transfer",
    "deposit",
    "release",
    "withdraw",
    "transit",
]


def test_finds_nothing_wrong_with_a_valid_plan(cell, valid):
    report = check(cell, valid)
    assert report.ok, str(report)
    assert [step["action"] for step in valid["steps"]] == ACTIONS
    assert report.duration == pytest.approx(valid["steps"][-1]["time"][-1])
    # The hand opens to 70 mm around 40 mm: 15 mm to either side.
    assert report.least_clearance == pytest.approx(0.015, abs=1e-5)
    assert set(report.least_clearance_between) & {"left_finger", "right_finger"}
    assert 0.005 < report.least_self_clearance < 0.1


def test_reads_a_plan_from_a_file_and_reports_as_json(cell, valid, tmp_path):
    path = tmp_path / "plan.json"
    path.write_text(json.dumps(valid))
    report = check(cell, path)
    assert json.loads(json.dumps(report.to_json()))["ok"] is True


def test_shares_no_code_with_the_planner():
    import ast
    from pathlib import Path

    from handey.check import report

    for source in Path(report.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(source.read_text())):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
                assert node.level == 0
                assert node.module != "handey", source
            for name in names:
                if name.split(".")[0] == "handey":
                    assert name.startswith("handey.check") or name == "handey.errors", (
                        source,
                        name,
                    )


def test_each_clause_is_broken_by_some_test():
    from pathlib import Path

    text = "".join(p.read_text() for p in Path(__file__).parent.glob("test_check*.py"))
    assert [clause for clause in CLAUSES if f'"{clause}"' not in text] == []
