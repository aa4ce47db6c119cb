"""What a cell engineer asks before there is a task, of a part, a robot or a cell.

A part: is its surface closed, which faces has it, what can jaws hold, how does it rest. A robot:
what its inverse kinematics supports, where its hand gets. A cell: what stands on what, what can be
held where it stands, which goals are within reach. Each report is a value, with `as_dict` for
programs; `text` makes lines of it and `page` a page. Nothing is planned here: a grasp that is legal
where a part stands can still have no way to it.
"""

from handey.inspection.cell import CellReport, inspect_cell
from handey.inspection.part import PartReport, inspect_body, inspect_mesh
from handey.inspection.robot import RobotReport, inspect_robot

__all__ = [
    "CellReport",
    "PartReport",
    "RobotReport",
    "inspect_body",
    "inspect_cell",
    "inspect_mesh",
    "inspect_robot",
]
