"""Is a part too wide for the jaws, whichever way it is turned?

For a convex part the answer can be a proof: it is nowhere narrower than a ball inside it, and both
pads of a parallel jaw lie on supporting planes of a convex part.
Not guaranteed: that a part of which this is not proved can be held.
"""

from __future__ import annotations

import numpy as np

from handey import _core

__all__ = ["is_wider_than_jaws"]


def is_wider_than_jaws(part: _core.Body, gripper: _core.Gripper) -> bool:
    """True if the part is convex and holds a ball wider than the jaws open."""
    if len(part.shapes) != 1:
        return False
    mesh = _core.tessellate(part.shapes[0], outer=False)
    if not _core.is_convex(mesh):
        return False
    corners = np.asarray(mesh.vertices)[np.asarray(mesh.triangles)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    centre = _core.inspect_surface(mesh).centroid
    radius = np.min(np.sum((corners[:, 0] - centre) * normals, axis=1))
    return bool(2 * radius > gripper.max_opening)
