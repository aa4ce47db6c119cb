// The floor cspace: one layer of a slice, looked at as a whole.
#include "handey/cspace/layer.hpp"

#include <algorithm>
#include <cstdint>

#include "bindings.hpp"
#include "handey/cspace/arm_table.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {

void bind_layer(py::module_& m) {
  py::enum_<CellKind>(m, "CellKind", "What is known of a cell.")
      .value("Free", CellKind::Free)
      .value("NotProved", CellKind::NotProved)
      .value("Collides", CellKind::Collides);
  py::class_<SliceLayer>(m, "SliceLayer", "The cells of a slice at one waist angle.")
      .def_readonly("theta1", &SliceLayer::theta1, "Middle of the layer [rad].")
      .def_property_readonly(
          "kinds",
          [](const SliceLayer& layer) {
            py::array_t<std::uint8_t> kinds({layer.rows, layer.columns});
            std::transform(layer.kinds.begin(), layer.kinds.end(), kinds.mutable_data(),
                           [](CellKind kind) { return static_cast<std::uint8_t>(kind); });
            return kinds;
          },
          "(cells of theta3, cells of theta2) of the values of CellKind.");
  py::class_<LayerOptions>(m, "LayerOptions", "Options of prove_layer.")
      .def(py::init([](int level, double clearance) {
             return LayerOptions{level, clearance};
           }),
           py::kw_only(), py::arg("level") = LayerOptions().level,
           py::arg("clearance") = LayerOptions().clearance)
      .def_readwrite("level", &LayerOptions::level, "Of the lattice: 3 is 1 degree.")
      .def_readwrite("clearance", &LayerOptions::clearance, "Least distance proved [m].");
  m.def("prove_layer", &prove_layer, py::arg("checker"), py::arg("theta1"), py::arg("wrist"),
        py::arg("opening"), py::arg("options") = LayerOptions(), Unlocked(),
        R"(Look at one layer of a slice: which cells are proved free, and which collide.

A cell called free is free for every configuration in it and every wrist value of the range.

Args:
    checker: of the cell, with what is held.
    theta1: any waist angle of the layer [rad].
    wrist: WristRange.
    opening: distance between the pads [m].
    options: LayerOptions.

Returns:
    SliceLayer.

Raises:
    InvalidInput: for a waist angle outside its limits, a wrist range of the wrong length or not in
        order, an opening that is not the gripper's, or options out of range.)");
}

}  // namespace handey::bindings
