"""A whole pick-and-place: a cell file planned, checked by the replay, printed step by step.

Usage: 05_pick_and_place.py MODELS
"""

import sys
from pathlib import Path

import handey


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell_file = models / "cells/figure_4.yaml"
    result = handey.plan(handey.load_cell(cell_file))
    if result.plan is None:
        print("\n".join(result.report.reasons))
        return False
    for step in result.plan.steps:
        print(f"{step.action:9} {len(step.time):4} rows, until {step.time[-1]:6.2f} s")
    checked = handey.check(cell_file, result.plan)
    for fault in checked.faults:
        print(fault)
    return bool(checked.ok)


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
