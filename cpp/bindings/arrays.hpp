// Numbers from Python, strictly: strings, booleans, complex numbers and objects are a TypeError,
// NaN and wrong shapes are InvalidInput. NumPy would convert all of them without a word.
#pragma once

#include <string>
#include <vector>

#include "bindings.hpp"

namespace handey::bindings {

/// An array of real numbers of any kind and shape.
inline pybind11::array numbers(const pybind11::handle& object, const std::string& place) {
  namespace py = pybind11;
  const py::array given = py::array::ensure(object);
  if (!given) {
    PyErr_Clear();
    throw py::type_error(place + ": expected an array of real numbers");
  }
  const char kind = given.dtype().kind();
  // An empty list has kind 'f'.
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::type_error(place + ": found dtype " + std::string(py::str(given.dtype())) +
                         ", expected real numbers (float or int)");
  }
  return given;
}

/// A real, finite array of any shape, C order, a copy.
inline pybind11::array_t<double> real_array(const pybind11::handle& object,
                                            const std::string& place) {
  namespace py = pybind11;
  const py::array given = numbers(object, place);
  py::array_t<double, py::array::c_style | py::array::forcecast> values(given);
  const double* data = values.data();
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(data[i])) {
      throw InvalidInput("E_NUMBER", place,
                         "entry " + std::to_string(i) + " is not finite, expected finite numbers");
    }
  }
  return std::move(values);
}

/// An (n, Columns) array as points.
template <int Columns>
std::vector<Eigen::Matrix<double, Columns, 1>> real_rows(const pybind11::handle& object,
                                                         const std::string& place) {
  const pybind11::array_t<double> values = real_array(object, place);
  std::vector<Eigen::Matrix<double, Columns, 1>> rows;
  if (values.size() == 0) return rows;
  if (values.ndim() != 2 || values.shape(1) != Columns) {
    throw InvalidInput("E_SHAPE", place, "expected shape (n, " + std::to_string(Columns) + ")");
  }
  for (pybind11::ssize_t i = 0; i < values.shape(0); ++i) {
    rows.emplace_back(Eigen::Map<const Eigen::Matrix<double, Columns, 1>>(values.data(i, 0)));
  }
  return rows;
}

/// An array of `Size` numbers.
template <int Size>
Eigen::Matrix<double, Size, 1> real_vector(const pybind11::handle& object,
                                           const std::string& place) {
  const pybind11::array_t<double> values = real_array(object, place);
  if (values.ndim() != 1 || values.shape(0) != Size) {
    throw InvalidInput("E_SHAPE", place, "expected " + std::to_string(Size) + " numbers");
  }
  return Eigen::Map<const Eigen::Matrix<double, Size, 1>>(values.data());
}

/// A (4, 4) array as a rigid transform.
inline Pose real_pose(const pybind11::handle& object, const std::string& place) {
  const pybind11::array_t<double> values = real_array(object, place);
  if (values.ndim() != 2 || values.shape(0) != 4 || values.shape(1) != 4) {
    throw InvalidInput("E_SHAPE", place, "expected a 4 x 4 matrix");
  }
  return pose(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data()), place);
}

/// Points as an (n, Columns) array.
template <int Columns>
Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor> rows_of(
    const std::vector<Eigen::Matrix<double, Columns, 1>>& points) {
  Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor> rows(
      static_cast<Eigen::Index>(points.size()), Columns);
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return rows;
}

}  // namespace handey::bindings
