// Proofs that there is no grasp, or no way to one: of the floors grasp and cspace.
#include "configurations.hpp"
#include "handey/cspace/exhaustion.hpp"
#include "handey/cspace/shut_in.hpp"
#include "handey/cspace/walled_off.hpp"
#include "handey/grasp/hand_reach.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

std::vector<Pose> poses_of(const py::sequence& given, const std::string& place) {
  std::vector<Pose> poses;
  for (const py::handle& each : given) {
    poses.push_back(real_pose(each, place + "[" + std::to_string(poses.size()) + "]"));
  }
  return poses;
}

void bind_exhaustion(py::module_& m) {
  const ExhaustionOptions defaults;
  py::class_<ExhaustionOptions>(m, "ExhaustionOptions", "Options of exhaust_grasps.")
      .def(py::init([](const py::object& spacing, const py::object& turn, std::size_t most_cells,
                       int most_pairs) {
             return ExhaustionOptions{real_number(spacing, "spacing"), real_number(turn, "turn"),
                                      most_cells, most_pairs};
           }),
           py::kw_only(), py::arg("spacing") = defaults.spacing, py::arg("turn") = defaults.turn,
           py::arg("most_cells") = defaults.most_cells, py::arg("most_pairs") = defaults.most_pairs)
      .def_readwrite("spacing", &ExhaustionOptions::spacing,
                     "Of cells that may be judged by their centres [m].")
      .def_readwrite("turn", &ExhaustionOptions::turn, "The same of directions [rad].")
      .def_readwrite("most_cells", &ExhaustionOptions::most_cells,
                     "Looked at before it is given up.")
      .def_readwrite("most_pairs", &ExhaustionOptions::most_pairs,
                     "With edges or vertices; a part with more is given up.");
  py::enum_<IllegalKind>(m, "IllegalKind")
      .value("OutOfReach", IllegalKind::OutOfReach)
      .value("JointLimit", IllegalKind::JointLimit)
      .value("Collision", IllegalKind::Collision);
  py::class_<IllegalCause>(m, "IllegalCause", "What makes hand poses illegal.")
      .def_readonly("kind", &IllegalCause::kind)
      .def_readonly("mover", &IllegalCause::mover, "Of collisions: a link.")
      .def_readonly("other", &IllegalCause::other, "Of collisions: what it meets.")
      .def_readonly("joint", &IllegalCause::joint, "Of joint limits: its index; else -1.")
      .def_readonly("share", &IllegalCause::share, "Of all that is illegal, 0..1.")
      .def_readonly("least", &IllegalCause::least,
                    "The least met: out of reach [m], past a limit [rad]; 0 for collisions.");
  py::class_<Exhaustion>(m, "Exhaustion", "Is no hand pose legal? True if that is so.")
      .def_readonly("exhausted", &Exhaustion::exhausted,
                    "No hand pose is legal at the resolution told.")
      .def_readonly("pairs", &Exhaustion::pairs, "Of features that the jaws span.")
      .def_readonly("cells_looked_at", &Exhaustion::cells_looked_at)
      .def_readonly("spacing", &Exhaustion::spacing,
                    "Widest cells judged by their centres [m]; 0: none, all is proved.")
      .def_readonly("turn", &Exhaustion::turn, "The same of directions [rad].")
      .def_readonly("causes", &Exhaustion::causes, "Greatest share first.")
      .def_readonly("reason", &Exhaustion::reason, "Why it is not exhausted.")
      .def("__bool__", [](const Exhaustion& self) { return self.exhausted; });
  m.def(
      "exhaust_grasps",
      [](const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
         const py::sequence& places, const SphericalWristSolver& solver,
         const ExhaustionOptions& options) {
        const std::vector<Pose> poses = poses_of(places, "places");
        const Unlock unlock;
        return exhaust_grasps(model, cell, part, poses, solver, options);
      },
      "model"_a, "cell"_a, "part"_a, "places"_a, "solver"_a, "options"_a = defaults,
      R"(Is no hand pose legal at which the jaws could hold a part where it stands?

Hand poses on all feature pairs are cut into cells until each is proved illegal, or its centre is
illegal with a margin. Ends at the first pose that is legal.

Args:
    model: CollisionModel of the cell.
    cell: Cell with an empty hand.
    part: index of the part.
    places: the part in the world, (n, 4, 4); a pose must be legal at all of them.
    solver: SphericalWristSolver of the cell's robot.
    options: ExhaustionOptions.

Returns:
    Exhaustion.

Raises:
    InvalidInput: for no place, poses that are not rigid, an unknown part, a part in the hand, bad
        options.)");
}

void bind_walled_off(py::module_& m) {
  py::class_<WalledOff>(m, "WalledOff", "Is the arm shut out from a part? True if that is proved.")
      .def_readonly("walled_off", &WalledOff::walled_off)
      .def_readonly("within_limits", &WalledOff::within_limits,
                    "Some configuration within the joints' limits comes so near.")
      .def_readonly("resolution", &WalledOff::resolution,
                    "Widest edge of the finest cells looked at [rad].")
      .def_readonly("cells_looked_at", &WalledOff::cells_looked_at)
      .def_readonly("bodies", &WalledOff::bodies,
                    "What is met at the border, those with most cells first.")
      .def_readonly("movers", &WalledOff::movers, "What of the robot meets them, likewise.")
      .def_readonly("reason", &WalledOff::reason, "Why it is not proved.")
      .def("__bool__", [](const WalledOff& self) { return self.walled_off; });
  m.def(
      "prove_walled_off",
      [](CollisionChecker& checker, const Configuration& start, const SphericalWristSolver& solver,
         const Body& part, const py::object& X_RP, const SeparationOptions& options) {
        const Pose pose = real_pose(X_RP, "X_RP");
        const Unlock unlock;
        return prove_walled_off(checker, start, solver, part, pose, options);
      },
      "checker"_a, "start"_a, "solver"_a, "part"_a, "X_RP"_a, "options"_a = SeparationOptions(),
      R"(Prove that the arm does not come to where a hand that holds a part must be.

What is called walled off is, whatever the grasp, the opening and the joints after the third do.
What is not may be so all the same.

Args:
    checker: CollisionChecker of the cell with an empty hand, without the part.
    start: Configuration.
    solver: SphericalWristSolver of the robot.
    part: Body; its own pose does not count.
    X_RP: the part in the robot frame, (4, 4).
    options: SeparationOptions.

Returns:
    WalledOff.

Raises:
    InvalidInput: for a start outside the limits, a pose that is not rigid, a part without shapes.)");
}

void bind_shut_in(py::module_& m) {
  const ShutInOptions defaults;
  py::class_<ShutInOptions>(m, "ShutInOptions", "Options of prove_shut_in.")
      .def(py::init([](const py::object& finest, std::size_t most_cubes, std::size_t most_steps) {
             return ShutInOptions{real_number(finest, "finest"), most_cubes, most_steps};
           }),
           py::kw_only(), py::arg("finest") = defaults.finest,
           py::arg("most_cubes") = defaults.most_cubes, py::arg("most_steps") = defaults.most_steps)
      .def_readwrite("finest", &ShutInOptions::finest, "Edge of the smallest cubes [m].")
      .def_readwrite("most_cubes", &ShutInOptions::most_cubes, "Looked at before it is given up.")
      .def_readwrite("most_steps", &ShutInOptions::most_steps,
                     "From cube to cube before it is given up.");
  py::class_<ShutIn>(m, "ShutIn", "Can a part not come to its goal at all? True if that is proved.")
      .def_readonly("shut_in", &ShutIn::shut_in)
      .def_readonly("end", &ShutIn::end,
                    "0: it does not come away from the first place; 1: to the second.")
      .def_readonly("radius", &ShutIn::radius, "Of the ball that the part holds [m].")
      .def_readonly("resolution", &ShutIn::resolution,
                    "Edge of the smallest cubes that took part [m].")
      .def_readonly("cubes_looked_at", &ShutIn::cubes_looked_at)
      .def_readonly("bodies", &ShutIn::bodies, "Round the end, those that block most cubes first.")
      .def_readonly("reason", &ShutIn::reason, "Why it is not proved.")
      .def("__bool__", [](const ShutIn& self) { return self.shut_in; });
  m.def(
      "prove_shut_in",
      [](CollisionChecker& checker, const py::object& X_RP, const py::object& X_RP_goal,
         const ShutInOptions& options) {
        const Pose from = real_pose(X_RP, "X_RP"), to = real_pose(X_RP_goal, "X_RP_goal");
        const Unlock unlock;
        return prove_shut_in(checker, from, to, options);
      },
      "checker"_a, "X_RP"_a, "X_RP_goal"_a, "options"_a = defaults,
      R"(Prove that a part does not come from one place to another, whoever carries it.

A ball that the part holds would have to. What is called shut in is, with any grasp and any regrasp.
What is not may be so all the same.

Args:
    checker: CollisionChecker of the cell with the part held; what stands there never moves.
    X_RP: the part in the robot frame where it stands, (4, 4).
    X_RP_goal: the same where it is to stand.
    options: ShutInOptions.

Returns:
    ShutIn.

Raises:
    InvalidInput: for an empty hand, poses that are not rigid, options out of range.)");
}

}  // namespace

void bind_proofs(py::module_& m) {
  bind_walled_off(m);
  bind_shut_in(m);
  bind_exhaustion(m);
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
