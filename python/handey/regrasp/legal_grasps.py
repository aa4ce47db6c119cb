"""Which grasps of a table are legal where the part stands, or may be put down?

Hand poses below a wide face under the part are told without a look at the arm; the core tests the
others, many at many places at once. Article: "Regrasping".
"""

from __future__ import annotations

import numpy as np

from handey import _core
from handey.motion.carry import Workspace
from handey.regrasp.grasp_table import GraspTable

__all__ = ["clears_ground", "compatible"]

# Choice: the hand is within so far of the part, level; a face wider than that all round is a plane
# that the hand cannot get below [m].
HAND_REACH = 0.35


def compatible(
    work: Workspace, table: GraspTable, groups: list[list[int]], places: np.ndarray, most: int
) -> list[_core.CompatibleGrasps]:
    """Which grasps of a table are legal at some places (n, 4, 4); of each group `most`, 0: all."""
    scene, legality = work.scene, table.options.legality
    return list(
        _core.find_compatible_grasps(
            work.model,
            scene.cell,
            scene.part,
            work.solver,
            table.grasps,
            groups,
            places,
            open_clearance=legality.open_clearance,
            clearance=legality.clearance,
            most=most,
        )
    )


def clears_ground(work: Workspace, table: GraspTable, X_WP: np.ndarray) -> np.ndarray:
    """At which grasps the hand stays above a wide face that the part stands on, shape (n,).

    All of them, if there is no such face: only sure collisions are told.
    """
    scene = work.scene
    clear = np.ones(len(table.rows), dtype=bool)
    there = scene.cell.with_part_at(scene.part, X_WP)
    for touched in _core.touching_bodies(work.model, there, scene.part):
        for face in _core.support_faces(there.body(touched)):
            X_SP = np.linalg.inv(face.X_WS) @ X_WP
            point = X_SP[:2, 3]
            if _holds(face.region, point) and _stands_on(scene.cell.parts[scene.part], X_SP):
                clear &= _core.clears_plane(
                    scene.cell.robot, table.grasps, X_SP, table.options.legality
                )
    return clear


def _holds(region: _core.Region, point: np.ndarray) -> bool:
    """Does the region hold all that is within the hand's reach of the point?"""
    return region.contains(point) and _core.boundary_distance(region, point) > HAND_REACH


def _stands_on(part: _core.Body, X_SP: np.ndarray) -> bool:
    lowest = min(
        float(((X_SP[:3, :3] @ np.asarray(_core.hull_points(shape)).T).T + X_SP[:3, 3])[:, 2].min())
        for shape in part.shapes
    )
    return abs(lowest) < 1e-3
