"""Where the hand is at a configuration, and all configurations that bring it there.

Usage: 01_forward_inverse_kinematics.py MODELS
"""

import sys
from pathlib import Path

import numpy as np
from puma560 import at, table_cell

from handey import _core


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    robot = table_cell(models).robot
    q = np.array([0.3, 0.6, -0.4, 0.5, 0.7, -0.2])
    X_RH = _core.hand_pose(robot, q)
    print("hand at", X_RH[:3, 3].round(4), "m in the robot frame")

    solver = _core.SphericalWristSolver(robot)
    solutions = solver.solve(X_RH).solutions
    print(len(solutions), "configurations bring it there:")
    for solution in solutions:
        print(f"  branch {solution.branch}: {solution.q.round(3)} rad")
    worst = max(abs(_core.hand_pose(robot, s.q) - X_RH).max() for s in solutions)
    print(f"largest error of any of them: {worst:.1e}")

    far = solver.solve(at(2.0, 0.0, 0.5))
    print("2 m away there is none:", far.reason)
    return any(np.allclose(s.q, q, atol=1e-6) for s in solutions) and worst < 1e-9


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
