// The only source that sees FCL.
#include "mesh_distance.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "handey/errors.hpp"
#include "handey/stop.hpp"

// The layout of Eigen's fixed-size types must be the one that libfcl was built with.
static_assert(std::is_same_v<ccd_real_t, double>, "libccd must be built in double precision");
static_assert(alignof(fcl::Transform3d) == 16, "vector extensions would change Eigen's alignment");

namespace handey::collision {

class SurfaceModel {
 public:
  fcl::BVHModel<fcl::OBBRSSd> hierarchy;
};

namespace {

/// Fits boxes as FCL does, and looks whether it is to stop.
class BoxFitter : public fcl::detail::BVFitter<fcl::OBBRSSd> {
 public:
  fcl::OBBRSSd fit(unsigned int* primitives, int count) override {
    throw_if_stopped();
    return fcl::detail::BVFitter<fcl::OBBRSSd>::fit(primitives, count);
  }
};

/// FCL checks nothing: a wrong index is a wild read, a NaN a silent "no collision".
void require_sound(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidInput("E_MESH_EMPTY", "mesh", "has no triangles");
  const int count = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite())
      throw InvalidInput("E_NUMBER", "mesh", "has a vertex that is not finite");
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= count) {
      throw InvalidInput(
          "E_INDEX", "mesh",
          "has a triangle with a vertex index outside 0.." + std::to_string(count - 1));
    }
  }
}

}  // namespace

std::shared_ptr<const SurfaceModel> make_surface_model(const TriangleMesh& mesh) {
  require_sound(mesh);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  std::shared_ptr<SurfaceModel> model = std::make_shared<SurfaceModel>();
  model->hierarchy.bv_fitter = std::make_shared<BoxFitter>();
  const bool built = model->hierarchy.beginModel() == fcl::BVH_OK &&
                     model->hierarchy.addSubModel(mesh.vertices, triangles) == fcl::BVH_OK &&
                     model->hierarchy.endModel() == fcl::BVH_OK;
  if (!built) throw InvalidInput("E_MESH_DEGENERATE", "mesh", "cannot be put into a hierarchy");
  model->hierarchy.computeLocalAABB();
  return model;
}

double surface_distance(const SurfaceModel& a, const Pose& X_WA, const SurfaceModel& b,
                        const Pose& X_WB, double horizon) {
  fcl::DistanceRequestd request;
  request.enable_nearest_points = false;
  request.enable_signed_distance = false;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::DistanceResultd result(horizon);  // What is not nearer than this is not descended into.
  const double distance = fcl::distance(&a.hierarchy, X_WA, &b.hierarchy, X_WB, request, result);
  return std::max(0.0, std::min(distance, std::min(result.min_distance, horizon)));
}

}  // namespace handey::collision
