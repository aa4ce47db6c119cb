"""Gross motion and timing: from one side of a wall to the other, proved, then timed.

Usage: 04_gross_motion.py MODELS
"""

import sys
from pathlib import Path

from puma560 import at, box, table_cell

from handey import _core


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell = table_cell(models, fixtures=[box("wall", [0.5, 0.02, 0.8], at(0.75, 0.0, 0.4))])
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)

    # The arm stretched out level, at the height of its shoulder, to either side of the wall.
    def stretched(joint1: float) -> _core.Configuration:
        return _core.Configuration(q=[joint1, 0, -1.5708, 0, 0, 0], opening=cell.start.opening)

    goals = [stretched(-1.2), stretched(-0.9)]
    motion = _core.plan_gross_motion(checker, stretched(0.9), goals)
    if not motion:
        print("no way:", motion.reason)
        return False
    print(
        f"{motion.planner}: {len(motion.path)} waypoints to goal {motion.goal + 1} of 2, ", end=""
    )
    print(f"{motion.iterations} states sampled")
    timed = _core.time_path(cell.robot, motion.path)
    print(f"{timed.duration:.2f} s in {len(timed)} rows")
    return _core.certify_path(checker, motion.path).is_free and motion.goal == 1


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
