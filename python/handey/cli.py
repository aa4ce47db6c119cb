"""The command `handey`: plan a cell's task, check a plan, show one, draw slices, inspect.

Results go to standard output, faults and warnings to standard error. Exit status: 0 done; 1 the
plan is not valid; 2 bad input, each fault one line `handey: FILE: PLACE: what is wrong`; 3 no plan
found; 70 a fault of handey itself; 124 the deadline passed; 130 interrupted. Nothing heavy is
imported before it is needed.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import sys
import threading
from collections.abc import Sequence
from typing import Any, NoReturn

from handey.commands.check import check_command
from handey.commands.ending import BAD_INPUT, INTERNAL, INTERRUPTED, OK
from handey.commands.inspect import inspect_command
from handey.commands.plan import plan_command
from handey.commands.slice import slice_command
from handey.commands.terminal import complain
from handey.commands.view import view_command
from handey.errors import InvalidInput

__all__ = ["main", "run"]

MOST_FAULTS = 100  # Choice: more than anyone reads at once
GREATEST_SEED = 2**64 - 1


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command line.

    Args:
        arguments: without the program's name; those of the process by default.

    Returns:
        The exit status.
    """
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            # A name that the terminal cannot show must not be a crash.
            stream.reconfigure(errors="backslashreplace")
    options = parser().parse_args(arguments)
    try:
        status: int = options.run(options)
        sys.stdout.flush()
    except InvalidInput as error:
        for fault in error.faults[:MOST_FAULTS]:
            complain(str(fault))
        if len(error.faults) > MOST_FAULTS:
            complain(f"{len(error.faults) - MOST_FAULTS} more faults are not shown")
        return BAD_INPUT
    except KeyboardInterrupt:
        complain("interrupted")
        return INTERRUPTED
    except (
        BrokenPipeError
    ):  # whoever reads the output has enough; spare the interpreter the same error
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except Exception as error:
        if getattr(options, "verbose", False):
            raise
        complain(f"internal error: {type(error).__name__}: {error} (--verbose shows where)")
        return INTERNAL
    return status


def run() -> NoReturn:
    """Entry point of the installed command: ends the process at once.

    A planner that a deadline or an interrupt has overtaken is not waited for.
    """
    try:
        status = main()
    except SystemExit as error:  # argparse: help, version, wrong usage
        status = error.code if isinstance(error.code, int) else BAD_INPUT
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError):
            stream.flush()
    os._exit(status)


def parser() -> argparse.ArgumentParser:
    """The command line."""
    top = _Parser(
        prog="handey", description="Plans pick-and-place motions from a task.", allow_abbrev=False
    )
    top.add_argument("--version", action=_Version, nargs=0, help="show the version and exit")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    plan = commands.add_parser("plan", help="plan the task of a cell", allow_abbrev=False)
    plan.add_argument("cell", metavar="CELL", help="cell file (YAML)")
    plan.add_argument(
        "-o", "--output", metavar="PLAN", help="plan file (default: name of CELL + .plan.json)"
    )
    plan.add_argument(
        "--report", metavar="JSON", help="write how planning went, with a plan or without"
    )
    _add_planning(plan)
    _add_advice(plan)
    plan.set_defaults(run=plan_command)

    check = commands.add_parser(
        "check", help="replay a plan and look for faults", allow_abbrev=False
    )
    check.add_argument("cell", metavar="CELL", help="cell file (YAML)")
    check.add_argument("plan", metavar="PLAN", help="plan file (JSON)")
    check.set_defaults(run=check_command)

    slices = commands.add_parser(
        "slice", help="draw slices of the configuration space of a motion", allow_abbrev=False
    )
    slices.add_argument("cell", metavar="CELL", help="cell file (YAML)")
    slices.add_argument(
        "-o", "--output", metavar="SVG", help="picture (default: name of CELL + .slice.svg)"
    )
    slices.add_argument(
        "--plan", metavar="PLAN", help="plan file (JSON) of the motion (default: plan the task)"
    )
    slices.add_argument(
        "--step", type=int, metavar="N", help="the gross motion (default: the first of the plan)"
    )
    slices.add_argument(
        "--theta1",
        type=_angle,
        nargs="+",
        metavar="DEG",
        help="waist angles (default: of the start, half way, of the goal)",
    )
    slices.add_argument(
        "--wrist",
        choices=("start", "range", "goal"),
        nargs="+",
        help="wrist as at the start, anywhere between, as at the goal (default: all three)",
    )
    _add_planning(slices)
    slices.set_defaults(run=slice_command)

    view = commands.add_parser(
        "view",
        help="write a page that plays a plan, or shows why there is none",
        allow_abbrev=False,
    )
    view.add_argument("cell", metavar="CELL", help="cell file (YAML)")
    view.add_argument(
        "plan",
        metavar="PLAN",
        nargs="?",
        help="plan file, or the file of plan --report (JSON; default: plan the task)",
    )
    view.add_argument("-o", "--output", metavar="HTML", help="page (default: name of CELL + .html)")
    view.add_argument(
        "--serve",
        action="store_true",
        help="serve the page on 127.0.0.1; it comes anew when a file of the cell is saved",
    )
    view.add_argument(
        "--port", type=_port, metavar="N", help="with --serve (default: one that is free)"
    )
    _add_planning(view)
    _add_advice(view)
    view.set_defaults(run=view_command, json=False)

    inspect = commands.add_parser(
        "inspect", help="tell what a part, a robot or a cell is", allow_abbrev=False
    )
    inspect.add_argument(
        "file",
        metavar="PART|ROBOT|CELL",
        help="mesh (STL, OBJ, PLY), robot file or URDF, cell file; CELL:NAME is a part of a cell",
    )
    inspect.add_argument("--part", metavar="NAME", help="the part of a cell file")
    inspect.add_argument(
        "--scale", type=_scale, metavar="S", help="metres per unit of a mesh (default 1)"
    )
    inspect.add_argument(
        "--robot", metavar="ROBOT", help="robot file whose jaws are to hold the part"
    )
    inspect.add_argument("-o", "--output", metavar="HTML", help="write a page with pictures too")
    inspect.set_defaults(run=inspect_command)

    for command in (plan, check, slices, view, inspect):
        if command is not view:
            command.add_argument(
                "--json", action="store_true", help="print the summary as one JSON object"
            )
        loudness = command.add_mutually_exclusive_group()
        loudness.add_argument("--quiet", action="store_true", help="print nothing but errors")
        loudness.add_argument(
            "--verbose", action="store_true", help="print more, and where an error arose"
        )
    return top


def _add_planning(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--seed", type=_seed, default=0, metavar="N", help="of every random choice (default 0)"
    )
    command.add_argument("--deadline", type=_deadline, metavar="S", help="give up after S seconds")


def _add_advice(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--no-advice",
        action="store_true",
        help="where no plan is found, do not look for the nearest change with which there is one",
    )


def _angle(text: str) -> float:
    try:
        degrees = float(text)
    except ValueError:
        degrees = math.nan
    if not math.isfinite(degrees):
        raise argparse.ArgumentTypeError(f"expected a number of degrees, found '{text}'")
    return degrees


def _scale(text: str) -> float:
    try:
        scale = float(text)
    except ValueError:
        scale = math.nan
    if not (math.isfinite(scale) and scale > 0):
        raise argparse.ArgumentTypeError(f"expected a number greater than 0, found '{text}'")
    return scale


def _seed(text: str) -> int:
    try:
        seed = int(text)
    except ValueError:
        seed = -1
    if not 0 <= seed <= GREATEST_SEED:
        raise argparse.ArgumentTypeError(
            f"expected a whole number from 0 to {GREATEST_SEED}, found '{text}'"
        )
    return seed


def _port(text: str) -> int:
    try:
        port = int(text)
    except ValueError:
        port = -1
    if not 1 <= port <= 65535:
        raise argparse.ArgumentTypeError(f"expected a port from 1 to 65535, found '{text}'")
    return port


def _deadline(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not (math.isfinite(seconds) and seconds > 0):
        raise argparse.ArgumentTypeError(
            f"expected a number of seconds greater than 0, found '{text}'"
        )
    return min(seconds, threading.TIMEOUT_MAX)


class _Parser(argparse.ArgumentParser):
    """Tells wrong usage in the form of all other faults."""

    def error(self, message: str) -> NoReturn:
        complain(f"{message} ('{self.prog} --help' lists what is legal)")
        sys.exit(BAD_INPUT)


class _Version(argparse.Action):
    """Shows the version, which only the compiled core knows."""

    def __call__(self, *_: Any) -> NoReturn:
        from handey import _core

        print(f"handey {_core.__version__}")
        sys.exit(OK)


if __name__ == "__main__":
    run()
