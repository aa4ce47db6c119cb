"""The closest pair at a configuration, and the proof that a straight motion in joint space is free.

Usage: 03_certified_edge.py MODELS
"""

import sys
from pathlib import Path

from puma560 import at, box, table_cell

from handey import _core


def report(motion: str, edge: _core.EdgeResult) -> bool:
    """Print what an edge check found."""
    if edge.is_free:
        print(f"{motion}: free, proved with {edge.evaluations} configurations")
    else:
        print(f"{motion}: {edge.hit.a} meets {edge.hit.b} at {edge.at:.0%} of the way")
    return edge.is_free


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    # A thin blade: an edge check in steps of a degree would jump over it.
    cell = table_cell(models, fixtures=[box("blade", [0.6, 0.001, 0.8], at(0.75, 0.0, 0.4))])
    checker = _core.CollisionChecker(_core.make_collision_model(cell), cell)

    def turned(joint1: float, joint2: float) -> _core.Configuration:
        q = cell.start.q
        q[:2] = joint1, joint2
        return _core.Configuration(q=q, opening=cell.start.opening)

    left, right = turned(0.9, 0.0), turned(-0.9, 0.0)
    closest = checker.closest(left)
    print(f"closest at the left: {closest.a} and {closest.b}, {1e3 * closest.distance:.1f} mm")
    bound = _core.motion_bound(checker, left, right)
    print(f"no point moves farther than {bound:.2f} m from left to right")

    up = report("up from the left", _core.certify_edge(checker, left, turned(0.9, 1.0)))
    across = report("across the blade", _core.certify_edge(checker, left, right))
    return up and not across


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
