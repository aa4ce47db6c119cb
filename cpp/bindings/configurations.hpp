// Joint vectors, numbers and lists of poses between Python and C++, checked as in arrays.hpp.
#pragma once

#include <string>
#include <vector>

#include "arrays.hpp"

namespace handey::bindings {

/// A vector of any length.
inline Eigen::VectorXd joint_vector(const pybind11::handle& object, const std::string& place) {
  const pybind11::array_t<double> reals = real_array(object, place);
  if (reals.ndim() != 1) {
    throw InvalidInput("E_TYPE", place,
                       "has " + std::to_string(reals.ndim()) + " dimensions; expected 1");
  }
  return Eigen::Map<const Eigen::VectorXd>(reals.data(), reals.size());
}

/// A finite number, not a bool.
inline double real_number(const pybind11::handle& object, const std::string& place) {
  const pybind11::array_t<double> reals = real_array(object, place);
  if (reals.ndim() != 0) throw pybind11::type_error(place + ": expected a number");
  return *reals.data();
}

/// Poses as an array of shape (n, 4, 4).
inline pybind11::array_t<double> pose_array(const std::vector<Pose>& poses) {
  pybind11::array_t<double> result(
      {static_cast<pybind11::ssize_t>(poses.size()), pybind11::ssize_t{4}, pybind11::ssize_t{4}});
  auto out = result.mutable_unchecked<3>();
  for (std::size_t n = 0; n < poses.size(); ++n) {
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        out(static_cast<pybind11::ssize_t>(n), i, j) = poses[n].matrix()(i, j);
      }
    }
  }
  return result;
}

}  // namespace handey::bindings
