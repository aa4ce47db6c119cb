"""What `handey inspect` does: tells what a part, a robot or a cell is, as lines, JSON and a page.

The end of the file's name, and in YAML its first key, tell which of the three it is. Nothing heavy
is imported before it is needed.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

from handey.commands.ending import OK
from handey.commands.terminal import tell, warn
from handey.errors import Fault, InvalidInput
from handey.formats.output import keep_inputs, require_writable

if TYPE_CHECKING:
    from handey import _core
    from handey.cell_file import CellFile
    from handey.inspection import CellReport, PartReport, RobotReport

__all__ = ["inspect_command"]

YAML = (".yaml", ".yml")
URDF = (".urdf", ".xacro")


def inspect_command(options: argparse.Namespace) -> int:
    """Tells what a part, a robot or a cell is."""
    file, part = _named(options.file, options.part)
    if options.output is not None:
        require_writable(options.output)
        keep_inputs([file, options.robot], Path(options.output))
    report = _report(options, file, part)
    summary, lines = report.as_dict() | {"file": file}, _lines(report, options.verbose)
    if options.output is not None:
        from handey.inspection.page import write_page

        write_page(report, options.output)
        summary["output"] = str(options.output)
        lines.append(f"page: {options.output}")
    tell(options, summary, lines)
    return OK


def _named(file: str, part: str | None) -> tuple[str, str | None]:
    """The file, and the part of a cell that is meant: `CELL:NAME` says both."""
    if part is None and ":" in file and not os.path.exists(file):
        cell, _, name = file.rpartition(":")
        if name and Path(cell).suffix.lower() in YAML:
            return cell, name
    return file, part


def _report(
    options: argparse.Namespace, file: str, part: str | None
) -> PartReport | RobotReport | CellReport:
    suffix = Path(file).suffix.lower()
    kind = _yaml_kind(file) if suffix in YAML else "urdf" if suffix in URDF else "mesh"
    _refuse(part is not None and kind != "cell", "--part", "belongs to a cell file", file)
    _refuse(options.scale is not None and kind != "mesh", "--scale", "belongs to a mesh file", file)
    wants_jaws = kind == "mesh" or part is not None
    _refuse(options.robot is not None and not wants_jaws, "--robot", "belongs to a part", file)
    if kind == "mesh":
        from handey.inspection import inspect_mesh

        return inspect_mesh(file, 1.0 if options.scale is None else options.scale, _robot(options))
    if kind == "robot":
        from handey.inspection import inspect_robot
        from handey.robot_file import load_robot

        robot, said = load_robot(file)
        return inspect_robot(robot, said, picture=options.output is not None)
    if kind == "urdf":
        from handey.inspection.bare_urdf import load_bare_urdf
        from handey.inspection.robot import inspect_robot

        bare = load_bare_urdf(file)
        return inspect_robot(bare.robot, bare.warnings, options.output is not None, bare.has_jaws)
    from handey.cell_file import load_cell

    cell = load_cell(file)
    if part is not None:
        return _cell_part(options, cell, part, file)
    from handey.inspection import inspect_cell

    return inspect_cell(cell)


def _cell_part(options: argparse.Namespace, cell: CellFile, name: str, file: str) -> PartReport:
    """One part of a cell, with the jaws of the cell's robot or of another one."""
    from handey.inspection import inspect_body

    bodies = {body.name: body for body in cell.cell.parts}
    if name not in bodies:
        there = ", ".join(bodies) or "none"
        message = f"no part '{name}'; the cell has: {there}"
        raise InvalidInput(Fault("E_REF", "parts", message, file))
    robot = _robot(options)
    return inspect_body(bodies[name], cell.cell.robot if robot is None else robot)


def _robot(options: argparse.Namespace) -> _core.Robot | None:
    """The robot whose jaws are to hold the part, if one is named."""
    if options.robot is None:
        return None
    from handey.robot_file import load_robot

    if Path(options.robot).suffix.lower() in YAML:
        found = _yaml_kind(options.robot)
        _refuse(found == "cell", "--robot", "expected a robot file, found a cell", options.robot)
    robot, said = load_robot(options.robot)
    warn(options, said)
    return robot


def _refuse(wrong: bool, place: str, message: str, file: str) -> None:
    if wrong:
        raise InvalidInput(Fault("E_UNKNOWN_KEY", place, message, file))


def _yaml_kind(file: str) -> str:
    """Which of the two YAML formats a file has."""
    from handey.formats.strict_yaml import read_yaml

    value = read_yaml(file).value
    keys = value if isinstance(value, dict) else {}
    for kind in ("cell", "robot"):
        if f"handey_{kind}" in keys:
            return kind
    message = "expected a cell file (key 'handey_cell') or a robot file (key 'handey_robot')"
    raise InvalidInput(Fault("E_VERSION", "", message, file))


def _lines(report: PartReport | RobotReport | CellReport, verbose: bool) -> list[str]:
    from handey.inspection import PartReport, RobotReport
    from handey.inspection.cell_text import cell_lines
    from handey.inspection.part_text import part_lines
    from handey.inspection.robot_text import robot_lines

    if isinstance(report, PartReport):
        return part_lines(report, verbose)
    return (
        robot_lines(report, verbose)
        if isinstance(report, RobotReport)
        else cell_lines(report, verbose)
    )
