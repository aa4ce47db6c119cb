// Mass properties of bodies.
#include "handey/world/body.hpp"

#include "handey/errors.hpp"

namespace handey {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Volume {
  double size = 0.0;  // [m3]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

Volume volume_of(const Shape& shape) {
  if (const Box* box = std::get_if<Box>(&shape.geometry)) {
    return {box->size.prod(), shape.X_BS.translation()};
  }
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    return {kPi * cylinder->radius * cylinder->radius * cylinder->length, shape.X_BS.translation()};
  }
  if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
    return {4.0 / 3.0 * kPi * sphere->radius * sphere->radius * sphere->radius,
            shape.X_BS.translation()};
  }
  const SurfaceReport report = inspect_surface(*std::get<MeshShape>(shape.geometry).mesh);
  return {report.volume, shape.X_BS * report.centroid};
}

}  // namespace

Eigen::Vector3d centre_of_mass(const Body& body) {
  if (body.shapes.empty()) throw InvalidInput("E_EMPTY", body.name, "has no shapes");
  double total = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Shape& shape : body.shapes) {
    require_valid(shape, body.name);
    const Volume volume = volume_of(shape);
    total += volume.size;
    moment += volume.size * volume.centre;
  }
  if (!(total > 0.0))
    throw InvalidInput("E_NOT_CLOSED", body.name,
                       "encloses no volume, so it has no centre of mass");
  return moment / total;
}

}  // namespace handey
