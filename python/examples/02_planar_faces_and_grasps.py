"""Grasp planning, steps 1 to 3: which face pairs stay free of what stands near, at both ends.

Usage: 02_planar_faces_and_grasps.py MODELS
"""

import sys
from pathlib import Path

from puma560 import at, box, table_cell

from handey import _core


def main(models: Path) -> bool:
    """Run the example; true if it found what it says."""
    loaded = _core.load_mesh(models / "parts/bracket.stl", scale=0.001, must_be_closed=True)
    shape = _core.Shape(geometry=_core.MeshShape(mesh=loaded.mesh, solid=True))
    bracket = _core.Body(name="bracket", shapes=[shape], X_WB=at(0.48, 0.2, 0.0, 0.3))
    # A wall close beside the place where the bracket is to go.
    wall = box("wall", [0.3, 0.02, 0.12], at(0.45, -0.30, 0.06))
    cell = table_cell(models, fixtures=[wall], parts=[bracket])

    features = _core.find_feature_pairs(bracket, cell.robot.gripper)
    print(f"{len(features.faces)} planar faces, {len(features.pairs)} pairs that the jaws can take")
    for pair in features.pairs:
        print(f"  {pair}: {1e3 * pair.width:.1f} mm apart, ", end="")
        print(f"overlap {1e6 * pair.area:.0f} mm2")

    ranking = _core.rank_grasps(cell, 0, at(0.45, -0.25, 0.0))
    print("ranked by the area that stays unobstructed at both ends:")
    for kind, pairs in (("", ranking.ranked), (" dropped,", ranking.obstructed)):
        for ranked in pairs:
            print(f"  {ranked.pair}:{kind}", end=" ")
            print(
                f"{ranked.share:4.0%} (at the origin alone {ranked.share_at_origin:4.0%})", end=" "
            )
            print(", ".join(ranked.obstructing))
    return bool(ranking.ranked) and all(r.share <= r.share_at_origin + 1e-9 for r in ranking.ranked)


if __name__ == "__main__":
    sys.exit(not main(Path(sys.argv[1] if len(sys.argv) > 1 else "models")))
