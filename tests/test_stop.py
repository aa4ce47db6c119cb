"""Deadlines, cancel tokens and Ctrl-C: planning ends soon, tells what it tried, and can go again.

How soon is measured by tests/deadline_cells.py; the bounds here only tell an end from a hang.
"""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import sys
import threading
import time

import hard_cells
import numpy as np
import pytest

import handey
from handey import _core
from handey.errors import Stopped

SOON = 5.0  # generous: other work may be going on [s]
NAMES = [*hard_cells.CELLS]
# Where even the report comes too late.
WHY_LATE = "handey: parted.yaml: the deadline of 1.5 s passed"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("hard")


@pytest.fixture(scope="module")
def cells(folder):
    return {name: handey.load_cell(hard_cells.write_cell(name, folder)) for name in NAMES}


@pytest.fixture(scope="module")
def easy():
    return handey.load_cell(hard_cells.ROBOT.parents[2] / "cells" / "open_table.yaml")


def content(result):
    """All of a plan but for the timings in the report."""
    assert result.plan is not None
    return [
        (s.action, np.asarray(s.time).tobytes(), np.asarray(s.positions).tobytes())
        for s in result.plan.steps
    ]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("seconds", [0.001, 0.05, 0.5])
def test_planning_ends_at_the_deadline_with_what_it_tried(cells, easy, name, seconds):
    before = content(handey.plan(easy))
    start = time.perf_counter()
    result = handey.plan(cells[name], handey.PlanOptions(deadline=seconds))
    assert time.perf_counter() - start < seconds + SOON
    report = result.report
    proved = any(goal.proof for goal in report.goals)
    if report.deadline_passed:
        assert result.plan is None and not report.cancelled
        assert report.verdict == ("infeasible" if proved else "unknown")
        assert report.reasons[0] == "the deadline passed"
        assert report.as_dict()["deadline_passed"] is True
        assert all(goal.status in ("stopped", "failed", "not tried") for goal in report.goals)
    else:
        assert proved or seconds == 0.5, "ended before a deadline of a few milliseconds"
    assert content(handey.plan(easy)) == before


def test_a_report_tells_the_attempts_made_until_then(cells):
    attempts = []

    def progress(stage, detail):
        if "grasp 3 of" in detail:
            token.cancel()
        attempts.append(detail)

    token = handey.CancelToken()
    result = handey.plan(cells["parted"], cancel=token, progress=progress)
    assert result.plan is None and result.report.cancelled
    goal = result.report.goals[0]
    assert goal.status == "stopped" and goal.counts["legal grasp poses"] > 0
    assert goal.attempts, "two grasps fell before the third was tried"
    assert any("goal 0" in line and "stopped" in line for line in result.report.reasons)
    assert "grasp 3 of" in attempts[-1]


@pytest.mark.parametrize("name", NAMES)
def test_another_thread_cancels(cells, name):
    token = handey.CancelToken()
    begun, asked = threading.Event(), threading.Event()

    def cancel():
        begun.wait(SOON)
        token.cancel()
        asked.set()

    def progress(stage, detail):
        if stage == "rank grasps":
            begun.set()
            asked.wait(SOON)

    canceller = threading.Thread(target=cancel)
    canceller.start()
    result = handey.plan(cells[name], cancel=token, progress=progress)
    canceller.join()
    assert result.plan is None and result.report.cancelled
    assert result.report.verdict == "unknown" and not result.report.deadline_passed
    assert result.report.reasons[0] == "planning was cancelled"


def test_a_token_that_is_cancelled_already_plans_nothing(easy):
    token = handey.CancelToken()
    token.cancel()
    result = handey.plan(easy, cancel=token)
    assert result.plan is None and result.report.cancelled
    assert handey.plan(easy).plan is not None


def test_the_deadline_of_a_token_is_a_deadline(easy):
    result = handey.plan(easy, cancel=handey.CancelToken.after(0.0))
    assert result.report.deadline_passed and not result.report.cancelled


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), float("inf")])
def test_a_token_refuses_what_is_no_time(seconds):
    with pytest.raises(handey.InvalidInput, match="seconds"):
        handey.CancelToken.after(seconds)


def test_a_token_tells_its_state():
    token = handey.CancelToken()
    assert (token.cancelled, token.stop_requested, token.remaining) == (False, False, None)
    token.cancel()
    assert (token.cancelled, token.stop_requested) == (True, True)
    late = handey.CancelToken.after(0.0)
    assert (late.cancelled, late.stop_requested) == (False, True) and late.remaining <= 0.0


def test_a_token_in_time_changes_nothing(easy):
    free = handey.plan(easy)
    watched = handey.plan(
        easy,
        handey.PlanOptions(deadline=3600.0),
        cancel=handey.CancelToken(),
        progress=lambda *_: None,
    )
    assert content(watched) == content(free)


def test_other_threads_run_while_planning(cells):
    done, ticks = threading.Event(), 0

    def plan():
        handey.plan(cells["parted"], handey.PlanOptions(deadline=0.5))
        done.set()

    thread = threading.Thread(target=plan)
    thread.start()
    while not done.wait(0.002):
        ticks += 1
    thread.join()
    assert ticks > 10


def test_two_threads_are_stopped_each_by_its_own_token(cells, easy):
    token, results = handey.CancelToken(), {}

    def plan(name, cell, cancel):
        results[name] = handey.plan(cell, cancel=cancel)

    token.cancel()
    threads = [
        threading.Thread(target=plan, args=("stopped", cells["crowded"], token)),
        threading.Thread(target=plan, args=("free", easy, handey.CancelToken())),
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results["stopped"].report.cancelled and results["free"].plan is not None


def test_what_progress_raises_comes_out(easy):
    def progress(stage, detail):
        raise LookupError(stage)

    with pytest.raises(LookupError, match="model"):
        handey.plan(easy, progress=progress)
    assert handey.plan(easy).plan is not None


def test_progress_tells_stages_and_grasps(easy):
    told = []
    handey.plan(easy, progress=lambda stage, detail: told.append((stage, detail)))
    stages = [stage for stage, _ in told]
    assert stages[0] == "model" and "rank grasps" in stages and "transfer" in stages
    assert any(detail.startswith("goal 0, grasp 1 of ") for _, detail in told)


def test_a_stage_called_by_itself_is_stopped_too(easy):
    token = handey.CancelToken()
    token.cancel()
    with pytest.raises(Stopped) as stopped:
        _core.run_within(lambda: _core.make_collision_model(easy.cell), cancel=token)
    assert stopped.value.cause == "cancelled"
    with pytest.raises(Stopped) as stopped:
        _core.run_within(lambda: _core.make_collision_model(easy.cell), deadline=0.0)
    assert stopped.value.cause == "deadline"
    _core.throw_if_stopped()
    assert _core.run_within(lambda: 3) == 3


LIBRARY = """
import sys, handey
try:
    handey.plan(sys.argv[1], progress=lambda *told: print(*told, flush=True))
except handey.Interrupted as interrupted:
    print("verdict", interrupted.report.verdict, interrupted.report.cancelled, flush=True)
    assert handey.plan(sys.argv[2]).plan is not None
    print("planned", flush=True)
"""


def test_ctrl_c_ends_planning_in_a_program_and_leaves_it_usable(folder, cells):
    easy = hard_cells.ROBOT.parents[2] / "cells" / "open_table.yaml"
    program = [sys.executable, "-c", LIBRARY, str(folder / "parted.yaml"), str(easy)]
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as process:
        line = ""
        while "legal grasps" not in line:
            line = process.stdout.readline()
            assert line, "ended before it was interrupted"
        process.send_signal(signal.SIGINT)
        told = process.stdout.read()
    assert "verdict unknown True" in told and "planned" in told
    assert process.returncode == 0


def run_on_terminal(arguments, until, folder):
    """Run the command with a terminal as standard error; SIGINT once `until` was seen there."""
    try:
        ours, theirs = pty.openpty()
    except OSError:
        pytest.skip("this machine has no pseudo-terminals")
    command = [sys.executable, "-m", "handey.cli", *arguments]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=theirs, text=True, cwd=folder
    ) as process:
        os.close(theirs)
        shown, sent, end = "", False, time.monotonic() + 60
        while time.monotonic() < end:
            if select.select([ours], [], [], 0.5)[0]:
                try:
                    piece = os.read(ours, 4096).decode()
                except OSError:  # the other end is closed
                    break
                shown += piece
            if not sent and until is not None and until in shown:
                process.send_signal(signal.SIGINT)
                sent = True
        out = process.stdout.read()
    os.close(ours)
    return process.returncode, out, shown


def test_ctrl_c_on_the_command_line_tells_the_report_so_far(folder, cells):
    before = sorted(os.listdir(folder))
    status, out, shown = run_on_terminal(["plan", "parted.yaml"], "goal 0, ", folder)
    assert status == 130
    assert "handey: interrupted" in shown
    assert "parted: no plan found (unknown)" in out and "planning was cancelled" in out
    assert sorted(os.listdir(folder)) == before


def test_progress_is_shown_on_a_terminal_and_wiped(folder, cells):
    arguments = ["plan", "parted.yaml", "--deadline", "1.5", "-o", "none.json"]
    status, _, shown = run_on_terminal(arguments, None, folder)
    assert status in (3, 124)  # a quick machine finds out sooner that there is no plan
    assert re.search(r"\r\x1b\[K\w[\w ]*: goal 0, grasp \d+ of \d+", shown)
    assert shown.split("\x1b[K")[-1].replace("\r\n", "") in ("", WHY_LATE)


@pytest.mark.parametrize("silent", ["--quiet", "--json"])
def test_no_progress_is_shown_where_it_is_not_wanted(folder, cells, silent):
    arguments = ["plan", "parted.yaml", "--deadline", "1.5", "-o", "none.json", silent]
    _, _, shown = run_on_terminal(arguments, None, folder)
    assert "\x1b" not in shown


def test_the_command_ends_at_its_deadline(folder, cells):
    before = sorted(os.listdir(folder))
    command = [sys.executable, "-m", "handey.cli", "plan", "parted.yaml", "--deadline", "0.5"]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=60)
    assert ended.returncode == 124
    assert "the deadline" in ended.stdout + ended.stderr and "passed" in ended.stdout + ended.stderr
    assert sorted(os.listdir(folder)) == before
