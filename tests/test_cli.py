"""The command line: what it prints, where, and with which exit status it ends.

Planner, check and page are stood in for by small functions here, so that each way a command can end
is met.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
import types
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

import handey.cell_file
from handey import cli
from handey.errors import Fault, InvalidInput
from handey.motion.gross_motion import Search
from handey.plan import ACTIONS, Plan, Step
from handey.reporting.report import GrossMotion, LocalMotion
from handey.task import PlaceOn


@dataclass
class StandInReport:
    verdict: str = "plan"
    reasons: list = field(default_factory=list)
    cpu_s: float = 0.5
    wall_s: float = 0.6
    duration_s: float = 8.0
    regrasps: int = 0
    deadline_passed: bool = False
    cancelled: bool = False
    stages: dict = field(default_factory=lambda: {"grasp": 0.2, "approach": 0.3})
    gross_motions: list = field(
        default_factory=lambda: [
            GrossMotion(0, 0, "transit", Search("slices", 0.0012)),
            GrossMotion(4, 0, "transfer", Search("RRT-Connect", 0.034, "no free cell at the goal")),
        ]
    )

    local_motions: list = field(
        default_factory=lambda: [
            LocalMotion(1, 0, "approach", "plane search"),
            LocalMotion(3, 0, "depart", "straight"),
        ]
    )
    planners: dict = field(
        default_factory=lambda: {
            "approach": {"quasipotential": 2, "plane search": 1},
            "depart": {"straight": 1},
        }
    )

    def __post_init__(self):
        tried = types.SimpleNamespace(grasp="faces 1/2", stage="approach", reason="meets a wall")
        self.goals = [
            types.SimpleNamespace(
                goal=0, grasp="faces 0/3", attempts=[tried], reasons=[], aside=[], advice=None
            )
        ]

    def as_dict(self):
        motions = [motion.as_dict() for motion in self.gross_motions]
        return {"verdict": self.verdict, "attempts": 3, "gross_motions": motions}


@dataclass
class StandInCheck:
    ok: bool = True
    faults: list = field(default_factory=list)
    least_clearance: float = 0.0031

    def to_json(self):
        return {"least_clearance": self.least_clearance, "faults": self.faults}


@dataclass
class StandInCell:
    name: str = "test"
    goals: tuple = (PlaceOn("block", "table"),)
    warnings: tuple = ()


def some_plan() -> Plan:
    steps = []
    for index, action in enumerate(ACTIONS):
        held = action in ("depart", "transfer", "deposit")
        part, X_HP = ("block", np.eye(4)) if held else (None, None)
        time = [float(index), index + 1.0]
        steps.append(Step(action, 0, part, X_HP, time, [[0.0], [1.0]], [0.1, 0.03]))
    return Plan("test", ("a",), tuple(steps), {"block": np.eye(4)}, {"wall_s": 0.6})


@pytest.fixture
def workshop(tmp_path, monkeypatch):
    """A folder with a cell file, and stand-ins for what the commands call."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cell.yaml").write_text("handey_cell: 1\n")
    bench = types.SimpleNamespace(
        cell=StandInCell(),
        plan=some_plan(),
        report=StandInReport(),
        checked=StandInCheck(),
        options=None,
        before_planning=lambda: None,
        pages=[],
    )

    def plan(cell, options, **_):
        bench.options = options
        bench.before_planning()
        return types.SimpleNamespace(plan=bench.plan, report=bench.report)

    def module(name, **content):
        made = types.ModuleType(f"handey.{name}")
        made.__dict__.update(content)
        monkeypatch.setitem(sys.modules, f"handey.{name}", made)
        monkeypatch.setattr(handey, name, made, raising=False)

    module("planner", plan=plan, PlanOptions=types.SimpleNamespace)
    module("check", check=lambda cell, plan: bench.checked)
    module("view", write_page=lambda *given: bench.pages.append(given))
    monkeypatch.setattr(handey.cell_file, "load_cell", lambda path: bench.cell)
    return bench


def test_a_plan_found_is_written_and_told(workshop, capsys, tmp_path):
    assert cli.main(["plan", "cell.yaml"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "goal 0: block on table" in out
    assert "grasp: faces 0/3; jaws closed to 30.0 mm" in out and "meets a wall" not in out
    assert "motion: 8.00 s in 8 steps, regrasps: 0" in out
    assert "500 ms CPU (grasp 200.0, approach 300.0)" in out and "least clearance: 3.10 mm" in out
    assert "plan: cell.plan.json" in out
    assert Plan.load(tmp_path / "cell.plan.json").joints == ("a",)
    assert (workshop.options.seed, workshop.options.deadline) == (0, None)


def test_the_plan_goes_where_it_is_told(workshop, tmp_path):
    (tmp_path / "out").mkdir()
    assert cli.main(["plan", "cell.yaml", "-o", "out/my.json", "--quiet", "--seed", "7"]) == 0
    assert os.listdir(tmp_path / "out") == ["my.json"]
    assert workshop.options.seed == 7


def test_verbose_tells_every_grasp_that_was_tried(workshop, capsys):
    assert cli.main(["plan", "cell.yaml", "--verbose"]) == 0
    assert "goal 0, try 0: faces 1/2: approach: meets a wall" in capsys.readouterr().out


def test_json_is_one_object_with_the_figures_asked_for(workshop, capsys):
    assert cli.main(["plan", "cell.yaml", "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["verdict"] == "plan"
    assert (summary["cpu_s"], summary["wall_s"], summary["duration_s"]) == (0.5, 0.6, 8.0)
    assert summary["regrasps"] == 0 and summary["stages"] == {"grasp": 0.2, "approach": 0.3}
    assert summary["attempts"] == 3 and summary["output"] == "cell.plan.json"


def test_planner_and_time_of_each_gross_motion_are_told(workshop, capsys):
    assert cli.main(["plan", "cell.yaml"]) == 0
    lines = capsys.readouterr().out.splitlines()
    told = "    gross motions: step 0 transit slices 1.2 ms, step 4 transfer RRT-Connect 34.0 ms"
    assert lines[lines.index(told) + 1] == (
        "    step 4: not through slices: no free cell at the goal"
    )
    assert sum("not through slices" in line for line in lines) == 1
    assert cli.main(["plan", "cell.yaml", "--json"]) == 0
    first, second = json.loads(capsys.readouterr().out)["gross_motions"]
    assert first == {
        "step": 0,
        "goal": 0,
        "action": "transit",
        "planner": "slices",
        "cpu_s": 0.0012,
        "fallback_reason": "",
    }
    assert second["fallback_reason"] == "no free cell at the goal"


def test_planners_of_motions_near_obstacles_are_told_and_how_often_each_was_needed(
    workshop, capsys
):
    assert cli.main(["plan", "cell.yaml"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "    motions near obstacles: approach plane search, depart straight" in lines
    assert "  planners: approach quasipotential 2, plane search 1; depart straight 1" in lines


@pytest.mark.parametrize("verdict", ["infeasible", "unknown"])
def test_no_plan_is_told_with_its_reasons_and_nothing_is_written(
    verdict, workshop, capsys, tmp_path
):
    workshop.plan = None
    workshop.report = StandInReport(verdict=verdict, reasons=["grasp: block is 2.0 mm too wide"])
    assert cli.main(["plan", "cell.yaml"]) == 3
    out = capsys.readouterr().out
    assert f"no plan found ({verdict})" in out and "grasp: block is 2.0 mm too wide" in out
    assert cli.main(["plan", "cell.yaml", "--json"]) == 3
    summary = json.loads(capsys.readouterr().out)
    assert summary["verdict"] == verdict and summary["duration_s"] is None
    assert summary["reasons"] == ["grasp: block is 2.0 mm too wide"]
    assert os.listdir(tmp_path) == ["cell.yaml"]


def test_a_plan_that_fails_the_check_is_not_written(workshop, capsys, tmp_path):
    workshop.checked.ok, workshop.checked.faults = False, ["step 3: block meets table"]
    assert cli.main(["plan", "cell.yaml", "--json"]) == 3
    out, err = capsys.readouterr()
    assert json.loads(out)["verdict"] == "unknown"
    assert "handey: step 3: block meets table" in err.splitlines()
    assert os.listdir(tmp_path) == ["cell.yaml"]


def test_a_plan_that_fails_the_check_leaves_the_old_plan(workshop, tmp_path):
    (tmp_path / "cell.plan.json").write_text("old")
    workshop.checked.ok = False
    assert cli.main(["plan", "cell.yaml"]) == 3
    assert (tmp_path / "cell.plan.json").read_text() == "old"


def test_the_deadline_ends_a_planner_that_does_not_look_at_the_clock(workshop, capsys, tmp_path):
    end = threading.Event()
    workshop.before_planning = end.wait
    start = time.monotonic()
    assert cli.main(["plan", "cell.yaml", "--deadline", "0.2", "--json"]) == 124
    end.set()
    assert time.monotonic() - start < 5
    summary = json.loads(capsys.readouterr().out)
    assert summary["verdict"] == "unknown" and summary["wall_s"] >= 0.2
    assert 0 < workshop.options.deadline <= 0.2
    assert os.listdir(tmp_path) == ["cell.yaml"]


def test_a_planner_that_gives_up_at_the_deadline_tells_why(workshop, capsys):
    workshop.plan = None
    reasons = ["approach: 3 grasps tried"]
    workshop.report = StandInReport(verdict="unknown", reasons=reasons, deadline_passed=True)
    assert cli.main(["plan", "cell.yaml", "--deadline", "9"]) == 124
    assert "approach: 3 grasps tried" in capsys.readouterr().out
    assert 8.5 < workshop.options.deadline < 9


@pytest.mark.parametrize(
    "arguments",
    [
        ["plan", "cell.yaml", "--deadline", "0"],
        ["plan", "cell.yaml", "--deadline", "nan"],
        ["plan", "cell.yaml", "--deadline", "-1"],
        ["plan", "cell.yaml", "--deadline", "1,5"],
        ["plan", "cell.yaml", "--seed", "-1"],
        ["plan", "cell.yaml", "--seed", "1.5"],
        ["plan", "cell.yaml", "--seed", str(2**64)],
        ["plan", "cell.yaml", "--see", "1"],
        ["plan", "cell.yaml", "--quiet", "--verbose"],
        ["plan"],
        ["plam", "cell.yaml"],
        [],
    ],
)
def test_wrong_usage_is_told_in_one_line(arguments, workshop, capsys, tmp_path):
    with pytest.raises(SystemExit) as caught:
        cli.main(arguments)
    assert caught.value.code == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("handey: ") and err.count("\n") == 1
    assert os.listdir(tmp_path) == ["cell.yaml"]


def test_every_fault_of_an_input_is_one_line(workshop, monkeypatch, capsys):
    def refuse(path):
        faults = [Fault("E_TYPE", "parts.a\nb", "expected 3 numbers", "cell.yaml")]
        raise InvalidInput([*faults, Fault("E_REF", "task[0]", "no \x1b[31m 'c'", "cell.yaml")])

    monkeypatch.setattr(handey.cell_file, "load_cell", refuse)
    for command in ("plan", "view"):
        assert cli.main([command, "cell.yaml"]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.splitlines() == [
            "handey: cell.yaml: parts.a b: expected 3 numbers",
            "handey: cell.yaml: task[0]: no \\x1b[31m 'c'",
        ]


def test_an_output_that_cannot_be_written_is_told_before_planning(workshop, capsys):
    workshop.before_planning = lambda: pytest.fail("planned all the same")
    assert cli.main(["plan", "cell.yaml", "-o", "none/p.json"]) == 2
    assert "none/p.json: cannot be written: there is no folder" in capsys.readouterr().err
    assert cli.main(["plan", "cell.yaml", "-o", "/dev/null"]) == 2


def test_an_input_is_never_overwritten(workshop, tmp_path, capsys):
    assert cli.main(["plan", "cell.yaml", "-o", "./cell.yaml"]) == 2
    workshop.plan.save("p.json")
    assert cli.main(["view", "cell.yaml", "p.json", "-o", "p.json"]) == 2
    assert "needs another name" in capsys.readouterr().err
    assert (tmp_path / "cell.yaml").read_text() == "handey_cell: 1\n"


def test_check_tells_valid_from_not_valid(workshop, capsys):
    workshop.plan.save("p.json")
    assert cli.main(["check", "cell.yaml", "p.json"]) == 0
    assert capsys.readouterr().out.splitlines() == ["p.json: valid", "  least clearance: 3.10 mm"]
    workshop.checked.ok, workshop.checked.faults = False, ["step 1: too fast", "step 2: collides"]
    assert cli.main(["check", "cell.yaml", "p.json"]) == 1
    assert capsys.readouterr().out.splitlines()[1:] == ["step 1: too fast", "step 2: collides"]
    assert cli.main(["check", "cell.yaml", "p.json", "--json"]) == 1
    assert json.loads(capsys.readouterr().out)["valid"] is False
    assert cli.main(["check", "cell.yaml", "none.json"]) == 2
    assert "none.json: cannot be read" in capsys.readouterr().err


def test_an_infinite_clearance_is_null_in_json(workshop, capsys):
    workshop.plan.save("p.json")
    workshop.checked.least_clearance = float("inf")
    assert cli.main(["check", "cell.yaml", "p.json", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["least_clearance"] is None


def test_view_writes_a_page_of_a_plan_or_plans_first(workshop, capsys):
    workshop.plan.save("p.json")
    assert cli.main(["view", "cell.yaml", "--seed", "7"]) == 0
    assert workshop.options.seed == 7
    assert cli.main(["view", "cell.yaml", "p.json", "-o", "my.html"]) == 0
    (_, planned, page, report, _), (_, plan, named) = workshop.pages
    assert planned["cell"] == workshop.plan.cell and report is workshop.report
    assert plan == "p.json" and (page, named) == (Path("cell.html"), Path("my.html"))
    assert capsys.readouterr().out == "page: cell.html\npage: my.html\n"


def test_view_shows_the_reason_where_there_is_no_plan(workshop, capsys):
    workshop.plan = None
    assert cli.main(["view", "cell.yaml"]) == 0
    ((_, plan, _, report, notes),) = workshop.pages
    assert plan is None and report is workshop.report and not notes


def test_view_says_in_the_page_that_a_robot_cannot_be_planned_for(workshop, capsys):
    def refuse():
        raise InvalidInput(Fault("E_KINEMATICS", "robot.file", "needs a spherical wrist"))

    workshop.before_planning = refuse
    assert cli.main(["view", "cell.yaml"]) == 0
    ((_, plan, _, report, notes),) = workshop.pages
    assert plan is None and report is None
    assert notes == ["No planning for this robot: needs a spherical wrist"]
    assert "needs a spherical wrist" in capsys.readouterr().err


def test_view_refuses_what_is_neither_plan_nor_report(workshop, tmp_path, capsys):
    (tmp_path / "p.json").write_text('{"handey_report": 2, "goals": [{"goal": "a"}]}')
    assert cli.main(["view", "cell.yaml", "p.json"]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(": ")[:3] for line in lines] == [
        ["handey", "p.json", "handey_report"],
        ["handey", "p.json", "goals[0].goal"],
    ]
    assert workshop.pages == []


def test_a_report_is_written_with_a_plan_and_without(workshop, tmp_path, capsys):
    assert cli.main(["plan", "cell.yaml", "--report", "r.json"]) == 0
    assert json.loads((tmp_path / "r.json").read_text())["handey_report"] == 1
    workshop.plan = None
    capsys.readouterr()
    assert cli.main(["plan", "cell.yaml", "--report", "out.json"]) == 3
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == "to see it: handey view cell.yaml out.json"
    assert json.loads((tmp_path / "out.json").read_text())["handey_report"] == 1
    assert cli.main(["plan", "cell.yaml", "--report", "cell.yaml"]) == 2
    assert cli.main(["plan", "cell.yaml", "-o", "a.json", "--report", "a.json"]) == 2


def test_warnings_go_to_standard_error_unless_quiet(workshop, capsys):
    workshop.cell.warnings = ("block does not stand stably",)
    assert cli.main(["plan", "cell.yaml"]) == 0
    assert capsys.readouterr().err == "handey: warning: block does not stand stably\n"
    assert cli.main(["plan", "cell.yaml", "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_a_fault_of_handey_itself_is_no_bad_input(workshop, capsys):
    def fail():
        raise ZeroDivisionError("x")

    workshop.before_planning = fail
    assert cli.main(["plan", "cell.yaml"]) == 70
    assert "internal error: ZeroDivisionError: x" in capsys.readouterr().err
    with pytest.raises(ZeroDivisionError):
        cli.main(["plan", "cell.yaml", "--verbose"])


def test_an_interrupt_ends_with_130(workshop):
    def interrupt():
        raise KeyboardInterrupt

    workshop.before_planning = interrupt
    assert cli.main(["plan", "cell.yaml"]) == 130


def handey_process(*arguments: str, **options) -> subprocess.CompletedProcess:
    folder = str(Path(handey.__file__).resolve().parents[1])
    environment = os.environ | {"PYTHONPATH": folder}
    command = [sys.executable, "-m", "handey.cli", *arguments]
    return subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=60, **options
    )


def test_the_command_ends_with_the_status_of_its_faults(tmp_path):
    (tmp_path / "cell.yaml").write_text("handey_cell: 1\nname: a\nrobt: {}\ntask: []\n")
    done = handey_process("plan", "cell.yaml", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.splitlines() == [
        "handey: cell.yaml: robot: key 'robot' is missing (line 1)",
        "handey: cell.yaml: robt: unknown key 'robt'; did you mean 'robot'? legal: "
        "depth_maps, finish, fixtures, handey_cell, name, order, parts, robot, task (line 3)",
    ]
    assert os.listdir(tmp_path) == ["cell.yaml"]


def test_help_needs_no_heavy_imports():
    code = (
        "import sys; from handey import cli\ntry: cli.main(['--help'])\nexcept SystemExit: pass\n"
    )
    code += "print(sorted({'yaml', 'trimesh', 'coal', 'handey._core'} & set(sys.modules)))"
    folder = str(Path(handey.__file__).resolve().parents[1])
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": folder},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout.splitlines()[-1] == "[]", done.stderr


def test_the_package_itself_can_be_run():
    command = [sys.executable, "-m", "handey", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == f"handey {handey.__version__}"
