// How far apart are two triangle surfaces? FCL's hierarchies of oriented boxes find the nearest
// triangles; the distance of two triangles is then closed form. Only surfaces: a body wholly inside
// another is far from it here. FCL is used for this alone. Its iterative solvers and its continuous
// collision are not used: on Debian's 0.7 they returned distances millimetres too large and stepped
// through thin walls.
#pragma once

#include <memory>

#include "handey/geometry/polyhedron.hpp"
#include "handey/geometry/pose.hpp"

namespace handey::collision {

/// A hierarchy over the triangles of one mesh. Immutable, shared between threads.
class SurfaceModel;
/// @throws InvalidInput (E_MESH_EMPTY, E_INDEX, E_NUMBER) for a mesh that has no triangle or wrong
/// ones
std::shared_ptr<const SurfaceModel> make_surface_model(const TriangleMesh& mesh);

/// Distance of the surfaces, 0 where they cross; `horizon` if they are not nearer than that [m].
double surface_distance(const SurfaceModel& a, const Pose& X_WA, const SurfaceModel& b,
                        const Pose& X_WB, double horizon);

}  // namespace handey::collision
