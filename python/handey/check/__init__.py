"""Is a plan valid? An independent replay of a plan file against its cell.

Every clause of 'a valid plan' is checked by name, collision in continuous time. Nothing here is
shared with the planner: the files are read anew, the kinematics is its own, and collision is asked
of another engine (coal). So a mistake of the planner cannot hide behind the same mistake here.

Not guaranteed: what the files do not say (flexing links, slipping parts) and overlaps of up to
0.015 mm.
"""

from handey.check.replay import check
from handey.check.report import CLAUSES, CheckFault, CheckReport

__all__ = ["CLAUSES", "CheckFault", "CheckReport", "check"]
