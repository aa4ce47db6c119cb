"""The article's Figure 1: no grasp serves both ends, so the part is put down and taken again.

Usage: 06_regrasp.py MODELS
"""

import sys
from pathlib import Path

import numpy as np

import handey


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell_file = models / "cells/figure_1.yaml"
    result = handey.plan(handey.load_cell(cell_file))
    if result.plan is None:
        print("\n".join(result.report.reasons))
        return False
    goal = result.report.goals[0]
    for what, count in goal.counts.items():
        print(f"{count:6} {what}")
    held = [step for step in result.plan.steps if step.action == "depart"]
    for step, words in zip(held, goal.grasp.split("; then "), strict=True):
        position = np.round(1e3 * step.part_in_grasp_frame[:3, 3], 1)
        print(f"at {step.time[0]:5.2f} s, {step.part} at {position} mm in the hand: {words}")
    checked = handey.check(cell_file, result.plan)
    for fault in checked.faults:
        print(fault)
    return bool(checked.ok) and result.report.regrasps == len(held) - 1 == 1


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
