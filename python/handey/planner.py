"""The seven steps of the article as one loop: what to try next, and when to stop.

Steps 1 to 3 rank the grasps from the part's geometry with an eye on the destination, step 4 brings
the hand in, steps 5 and 6 are the gross motions, step 7 puts the part down and takes it again.
Python decides what to try next; the compiled core answers whether it is possible, and how.
Same input, version and seed: the same plan. Not guaranteed: completeness; the report says what was
covered. Article: "Task-level planning of pick-and-place robot motions", Handey's planning steps.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

from handey import _core
from handey.advising.find_advice import PATIENCE, find_advice
from handey.cache import table_directory
from handey.cell_file import CellFile
from handey.errors import Fault, InvalidInput, Stopped
from handey.motion.carry import Carry, Workspace
from handey.motion.stage_clock import StageClock
from handey.placement import TOUCHING, carried_by, examine_standing
from handey.plan import Plan
from handey.planning.coverage import tell_coverage
from handey.planning.explain import diagnose, explain
from handey.planning.grasps import Grasps
from handey.planning.in_the_way import unstable, would_fall
from handey.planning.moves import Hands
from handey.planning.order import plan_order
from handey.planning.plan_options import PlanOptions
from handey.planning.proofs import Proofs, Proved
from handey.planning.regrasp import Regrasp
from handey.planning.timed_steps import TimedSteps
from handey.planning.tries import Tries, planned
from handey.reporting.goal_report import GoalReport
from handey.reporting.reasons import Reason
from handey.reporting.report import Interrupted, Report
from handey.task import PlaceAt

__all__ = ["PlanOptions", "PlanResult", "plan"]

QUICK = 0.8  # Choice: what planning takes beyond this is taken off the time for advice [s]


@dataclass(frozen=True)
class PlanResult:
    """A plan, or None, and the report that says why."""

    plan: Plan | None
    report: Report


def plan(
    cell_file: CellFile,
    options: PlanOptions | None = None,
    *,
    cancel: _core.CancelToken | None = None,
    progress: Callable[[str, str], None] | None = None,
) -> PlanResult:
    """Plan the task of a cell.

    Args:
        cell_file: the cell and its task, from `handey.load_cell`.
        options: budgets and seed.
        cancel: ends planning when another thread cancels it; the core looks at it all the time.
        progress: told where planning is: the stage ("transfer"), and what of it ("goal 0, grasp 3
            of 12, window 2 of 5"). In the thread that plans; what it raises ends planning.

    Returns:
        The plan with its report; without a plan the report's `reasons` say what stood in the way.

    Raises:
        InvalidInput: if the cell has what this version cannot plan for.
        Interrupted: on Ctrl-C; a KeyboardInterrupt with the report so far.
    """
    options = options or PlanOptions()
    _refuse_unsupported(cell_file)
    begin_wall, begin_cpu = time.perf_counter(), time.process_time()
    clock = StageClock(progress)
    report = Report(
        goals=[GoalReport(i, str(g)) for i, g in enumerate(cell_file.goals)], seed=options.seed
    )
    steps = TimedSteps(cell_file.cell)
    interrupt = None
    try:
        reached = _core.run_within(
            lambda: _reach_goals(cell_file, options, steps, clock, report),
            cancel=cancel,
            deadline=options.deadline,
            progress=None if progress is None else clock.tell,
        )
    except Stopped as stopped:
        reached = False
        report.deadline_passed = stopped.cause == "deadline"
        report.cancelled = stopped.cause == "cancelled"
    except KeyboardInterrupt as error:
        interrupt, reached, report.cancelled = error, False, True
    if report.stopped:
        for goal in report.goals:
            if goal.status == "not tried" and goal.counts:
                goal.status = "stopped"
    explain(report)
    tell_coverage(report, options)
    report.stages = {stage: round(seconds, 6) for stage, seconds in clock.seconds.items()}
    report.cpu_s = round(time.process_time() - begin_cpu, 6)
    report.wall_s = round(time.perf_counter() - begin_wall, 6)
    if interrupt is not None:
        raise Interrupted(report) from interrupt
    if not reached:
        # Every goal must be reached: one that cannot be is enough.
        proved = any(goal.exhausted for goal in report.goals)
        report.verdict = "infeasible" if proved else "unknown"
        if options.advice and not report.stopped:
            _advise(cell_file, options, clock, report, cancel)
        return PlanResult(None, report)
    report.verdict = "plan"
    result = Plan(
        cell=cell_file.name,
        joints=tuple(joint.name for joint in cell_file.cell.robot.joints),
        steps=tuple(steps.steps),
        placements=steps.placements(),
    )
    report.duration_s = round(steps.clock, 6)
    return PlanResult(replace(result, report=report.as_dict()), report)


def _time_for_advice(wanted: float, spent: float) -> float:
    """Less where it took long to find no plan, so that the answer does not take much longer [s]."""
    return min(wanted, max(0.45 * wanted, wanted + QUICK - spent))


def _advise(
    cell_file: CellFile,
    options: PlanOptions,
    clock: StageClock,
    report: Report,
    cancel: _core.CancelToken | None,
) -> None:
    """Look for the nearest change that plans, within what is left of the time; never an error."""
    left = _time_for_advice(options.advice_seconds, report.cpu_s)
    longest = PATIENCE * left
    if options.deadline is not None:
        longest = min(longest, options.deadline - report.wall_s)
        left = min(left, longest)
    if left <= 0:
        return
    begin_wall, begin_cpu = time.perf_counter(), time.process_time()
    wanted = replace(options, advice_seconds=left)
    try:
        with clock("advice"):
            _core.run_within(
                lambda: find_advice(cell_file, wanted, report, plan),
                cancel=cancel,
                deadline=longest,
            )
    except Stopped:
        pass  # what was found so far is not certain
    except KeyboardInterrupt as error:
        raise Interrupted(report) from error
    finally:
        report.stages["advice"] = round(clock.seconds.get("advice", 0.0), 6)
        report.cpu_s = round(report.cpu_s + time.process_time() - begin_cpu, 6)
        report.wall_s = round(report.wall_s + time.perf_counter() - begin_wall, 6)


def _reach_goals(
    cell_file: CellFile,
    options: PlanOptions,
    steps: TimedSteps,
    clock: StageClock,
    report: Report,
) -> bool:
    """Plan all goals, and take the motions over as steps."""
    with clock("model"):
        model = _core.make_collision_model(cell_file.cell, cell_file.model)
        solver = _core.SphericalWristSolver(cell_file.cell.robot)
    proofs = Proofs(cell_file, model, solver)
    hands = Hands(
        model,
        solver,
        cache(lambda: _arm_table(cell_file.cell.robot)),
        clock,
        _plan_goal,
        proofs if options.prove else None,
    )
    try:
        if options.prove:
            with clock("proofs"):
                proved = proofs.at_once()
            if proved is not None:
                _tell_grasps(cell_file, options, hands, report.goals[proved.goal])
                raise proved
        moves = plan_order(cell_file, options, hands, report)
    except Proved as end:
        report.goals[end.goal].prove(end.proof.text, end.proof.cause)
        moves = None
    if moves is None and options.diagnosis:
        diagnose(report, options, clock)
    for move in moves or []:
        with clock("timing"):
            steps.append(move, report)
    return moves is not None


def _refuse_unsupported(cell_file: CellFile) -> None:
    faults = []
    if not _core.SphericalWristSolver.is_supported(cell_file.cell.robot):
        faults.append(
            Fault(
                "E_KINEMATICS",
                "robot.file",
                "planning needs six joints, axes 2 and 3 parallel, and a spherical wrist",
            )
        )
    if faults:
        raise InvalidInput([replace(fault, file=str(cell_file.file or "")) for fault in faults])


def _arm_table(robot: _core.Robot) -> _core.ArmTable | None:
    options = _core.ArmTableOptions(directory=table_directory())
    return _core.make_arm_table(robot, options)[0]


def _plan_goal(work: Workspace, options: PlanOptions, report: GoalReport) -> Carry | None:
    """Steps 1 to 7 for one goal: the first grasp that can be carried through, or several."""
    refused = _unstable(work)
    if refused is not None:
        report.fail([refused])
        return None
    tries = Tries(work, report, options)
    grasps = Grasps(work, options, report)
    regrasp = Regrasp(work, options)
    first = grasps.first(regrasp.is_needed, lambda: work.give_up(False))
    carry = tries.reach_any(first) or regrasp.run(0, tries.regrasps_worth(0))
    if carry is None and regrasp.was_needed:
        # The tables are samples: what they have not may be found where all is looked at.
        carry = tries.reach_any(grasps.remaining())
    if carry is None:
        work.give_up(True)
    for round_ in range(1, len(options.sampling_rounds)):
        carry = carry or tries.again(round_) or tries.reach_any(grasps.rest())
        carry = carry or regrasp.run(round_, tries.regrasps_worth(round_))
    regrasp.tell(report)
    if carry is not None:
        return planned(report, regrasp.words, carry) if carry.regrasps else carry
    report.status = "failed"
    return None


def _tell_grasps(
    cell_file: CellFile, options: PlanOptions, hands: Hands, report: GoalReport
) -> None:
    """A quick look at the grasps of a goal that is proved infeasible: where they fall."""
    goal, cell = cell_file.goals[report.goal], cell_file.cell
    part = cell.part_index(goal.part)
    X_WP_goal = goal.X_WP if isinstance(goal, PlaceAt) else cell.parts[part].X_WB
    scene = _core.GraspScene(model=hands.model, cell=cell, part=part, X_WP_goal=X_WP_goal)
    work = Workspace(hands.model, scene, hands.solver, cell.start, None, hands.clock)
    for _ in Grasps(work, replace(options, denser=()), report).first():
        return


def _unstable(work: Workspace) -> Reason | None:
    """What would fall if the part were brought to its goal now; None if nothing."""
    scene = work.scene
    name = scene.cell.parts[scene.part].name
    carried = [scene.cell.parts[i].name for i in carried_by(work.model, scene.cell, scene.part)]
    if carried:
        reason = would_fall(carried, name)
        return replace(reason, text=f"{reason.text}; an earlier goal may clear it")
    # With `order: any` its goal may be on a part that is not there yet.
    there = scene.cell.with_part_at(scene.part, scene.X_WP_goal)
    near = _core.touching_bodies(work.model, there, scene.part, TOUCHING)
    standing = examine_standing(scene.cell, scene.part, scene.X_WP_goal, near)
    return None if standing.stable else unstable(name, standing.reason)
