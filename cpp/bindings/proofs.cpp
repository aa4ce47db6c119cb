// Proofs that there is no grasp, or no way to one: of the floors grasp and cspace.
#include "configurations.hpp"
#include "handey/grasp/hand_reach.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

}  // namespace

void bind_proofs(py::module_& m) {
  m.def(
      "beyond_reach",
      [](const SphericalWristSolver& solver, const Gripper& gripper, const Body& part,
         const py::object& X_RP) {
        return beyond_reach(solver.wrist_reach(), gripper, part, real_pose(X_RP, "X_RP"));
      },
      "solver"_a, "gripper"_a, "part"_a, "X_RP"_a,
      R"(By how much a part is farther away than the arm reaches, whatever the grasp.

Args:
    solver: SphericalWristSolver of the robot.
    gripper: of the robot.
    part: Body; its own pose does not count.
    X_RP: the part in the robot frame, (4, 4).

Returns:
    At least so much [m]; zero or less where it is not proved to be out of reach.

Raises:
    InvalidInput: for a pose that is not rigid, a part without shapes.)");
}

}  // namespace handey::bindings
