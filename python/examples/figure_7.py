"""The three slices of a gross motion of a Puma 560, and the path through them.

Near the start the wrist stands as at the start, near the goal as at the goal: narrow slices of one
degree, looked at in windows. Between them it may stand anywhere between: a coarse slice for the
whole range of the wrist. The path leads from the first through the second to the third.
Article: "Global planning", Figure 7.
Usage: figure_7.py [SVG [MODELS]]
"""

import sys
from pathlib import Path

import numpy as np

import handey
from handey.drawing import Figure
from handey.slices.layers import make_layers
from handey.slices.legs import legs_of
from handey.slices.picture import default_angles, slice_panel

AROUND = np.radians(50.0)  # shown on each side of the path


def main(picture: Path, models: Path) -> bool:
    """Run the example; true if it found what it says."""
    cell_file = handey.load_cell(models / "cells/demo.yaml")
    plan = handey.plan(cell_file).plan
    if plan is None:
        print("no plan")
        return False
    leg = next(leg for leg in legs_of(cell_file, plan) if leg.action == "transfer")
    angles, way = default_angles(leg), leg.positions[:, 1:3]
    window = np.array([way.min(axis=0) - AROUND, way.max(axis=0) + AROUND])
    panels, free = [], []
    for name, letter, title, theta1 in (
        ("start", "a", "wrist as at the start", angles[0]),
        ("range", "b", "wrist anywhere between", angles[len(angles) // 2]),
        ("goal", "c", "wrist as at the goal", angles[-1]),
    ):
        (layer,) = make_layers(leg, [theta1], (name,))
        panel = slice_panel(leg, layer, window, 250.0)
        panel.title = f"({letter}) {title}, {panel.title}"
        panels.append(panel)
        free.append(layer.counts()["free"] / layer.kinds.size)
        print(f"{name}: {layer.kinds.shape[1]} x {layer.kinds.shape[0]} cells, ", end="")
        print(f"{100 * free[-1]:.0f} % proved free")
    caption = (
        f"A Puma 560 carries the {leg.held} past a wall: three slices of its configuration space. "
        "(a), (c) The wrist stands as at the start, as at the goal; cells of one degree. (b) The "
        "wrist may stand anywhere between; cells of eight degrees. White cells are proved free for "
        "every configuration in them and, in (b), for every value of the wrist."
    )
    Figure([panels], caption, "three slices of a gross motion").save(picture)
    return min(free) > 0.0


if __name__ == "__main__":
    given = [Path(argument) for argument in sys.argv[1:]]
    models_there = Path(__file__).parents[2] / "models"
    sys.exit(not main(*(given + [Path("figure_7.svg"), models_there][len(given) :])))
