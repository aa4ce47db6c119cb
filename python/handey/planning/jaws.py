"""Is a part too wide for the jaws, whichever way it is turned?

For a convex part the answer can be a proof: it is nowhere narrower than a ball inside it, and both
pads of a parallel jaw lie on supporting planes of a convex part.
Not guaranteed: that a part of which this is not proved can be held.
"""

from __future__ import annotations

import numpy as np

from handey import _core

__all__ = ["wider_than_jaws"]


def wider_than_jaws(part: _core.Body, gripper: _core.Gripper) -> float:
    """By how much a ball that a convex part holds is wider than the jaws open [m].

    Zero or less where it is not proved that the part is too wide.
    """
    if len(part.shapes) != 1:
        return 0.0
    mesh = _core.tessellate(part.shapes[0], outer=False)
    if np.ptp(np.asarray(mesh.vertices), axis=0).min() <= gripper.max_opening:
        return 0.0  # no such ball fits into its box
    if not _core.is_convex(mesh):
        return 0.0
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    centre = _core.inspect_surface(mesh).centroid
    radius = np.min(np.sum((corners[:, 0] - centre) * normals, axis=1))
    return float(2 * radius - gripper.max_opening)
