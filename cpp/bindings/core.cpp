// The compiled module handey._core. InvalidInput becomes handey.errors.InvalidInput with all its
// faults.
#include "bindings.hpp"

namespace py = pybind11;

namespace {

void translate_invalid_input(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const handey::InvalidInput& error) {
    const py::module_ errors = py::module_::import("handey.errors");
    py::list faults;
    for (const handey::Fault& fault : error.faults()) {
      faults.append(errors.attr("Fault")(fault.code, fault.place, fault.message));
    }
    PyErr_SetObject(errors.attr("InvalidInput").ptr(), errors.attr("InvalidInput")(faults).ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "The compiled core of handey. Metres, radians, seconds. Poses are 4 x 4 arrays.";
  m.attr("__version__") = HANDEY_VERSION;
  py::register_exception_translator(&translate_invalid_input);
  using namespace handey::bindings;
  // Floors, lowest first.
  bind_stop(m);
  bind_geometry(m);
  bind_kinematics(m);
  bind_world(m);
  bind_collision(m);
  bind_placing(m);
  bind_grasp(m);
  bind_legality(m);
  bind_diagnosis(m);
  bind_regrasp(m);
  bind_grasp_plane(m);
  bind_approach(m);
  bind_cspace(m);
  bind_motion(m);
  bind_proofs(m);
}
