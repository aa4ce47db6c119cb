// Axis-aligned bounding boxes of shapes and bodies in any frame.
#pragma once

#include <Eigen/Geometry>
#include <variant>

#include "handey/geometry/shape.hpp"
#include "handey/world/body.hpp"

namespace handey::grasp {

/// Box of a shape along the axes of G; exact. X_GB: the shape's body in G.
inline Eigen::AlignedBox3d bounding_box(const Shape& shape, const Pose& X_GB) {
  const Pose X_GS = X_GB * shape.X_BS;
  const Eigen::Matrix3d& R = X_GS.linear();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  if (const Box* box = std::get_if<Box>(&shape.geometry)) {
    half = R.cwiseAbs() * (0.5 * box->size);
  } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    const Eigen::Array3d axis = R.col(2).array();
    half = (0.5 * cylinder->length * axis.abs() +
            cylinder->radius * (1.0 - axis.square()).max(0.0).sqrt())
               .matrix();
  } else if (const Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) {
    half.setConstant(sphere->radius);
  } else {
    Eigen::AlignedBox3d result;
    for (const Eigen::Vector3d& vertex : std::get<MeshShape>(shape.geometry).mesh->vertices) {
      result.extend(X_GS * vertex);
    }
    return result;
  }
  return {X_GS.translation() - half, X_GS.translation() + half};
}

inline Eigen::AlignedBox3d bounding_box(const Body& body, const Pose& X_GB) {
  Eigen::AlignedBox3d result;
  for (const Shape& shape : body.shapes) result.extend(bounding_box(shape, X_GB));
  return result;
}

}  // namespace handey::grasp
