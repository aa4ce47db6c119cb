// One bind_<floor>(module) per floor, called in floor order by core.cpp.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "handey/errors.hpp"
#include "handey/geometry/pose.hpp"

namespace handey::bindings {

void bind_stop(pybind11::module_& m);
void bind_geometry(pybind11::module_& m);
void bind_kinematics(pybind11::module_& m);
void bind_world(pybind11::module_& m);
void bind_depth_map(pybind11::module_& m);  // part of world
void bind_placing(pybind11::module_& m);    // parts of world and collision
void bind_collision(pybind11::module_& m);
void bind_grasp(pybind11::module_& m);
void bind_legality(pybind11::module_& m);  // part of grasp
void bind_diagnosis(pybind11::module_& m);  // part of grasp
void bind_regrasp(pybind11::module_& m);      // part of grasp
void bind_proofs(pybind11::module_& m);       // parts of grasp and cspace
void bind_grasp_plane(pybind11::module_& m);  // part of approach
void bind_approach(pybind11::module_& m);
void bind_departure(pybind11::module_& m);  // part of approach
void bind_cspace(pybind11::module_& m);
void bind_layer(pybind11::module_& m);       // part of cspace
void bind_free_space(pybind11::module_& m);  // part of cspace
void bind_motion(pybind11::module_& m);

/// A pose as a 4 x 4 matrix and back. @throws InvalidInput unless rigid
inline Eigen::Matrix4d matrix(const Pose& pose) { return pose.matrix(); }
inline Pose pose(const Eigen::Matrix4d& matrix, const std::string& place) {
  Pose result;
  result.matrix() = matrix;
  require_rigid(result, place);
  return result;
}

}  // namespace handey::bindings
