// Floor motion: timing, sampling, shortcut, gross.
#include "bindings.hpp"
#include "handey/collision/certificate.hpp"
#include "handey/cspace/free_space.hpp"
#include "handey/cspace/search.hpp"
#include "handey/cspace/separation.hpp"
#include "handey/cspace/slice.hpp"
#include "handey/motion/gross.hpp"
#include "handey/motion/sampling.hpp"
#include "handey/motion/shortcut.hpp"
#include "handey/motion/timing.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

// Rows of joint values, (n, joints).
Eigen::MatrixXd positions(const TimedPath& timed) {
  const Eigen::Index columns =
      timed.configurations.empty() ? 0 : timed.configurations.front().q.size();
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(timed.configurations.size()), columns);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = timed.configurations[static_cast<std::size_t>(i)].q.transpose();
  }
  return rows;
}

Eigen::VectorXd openings(const TimedPath& timed) {
  Eigen::VectorXd column(static_cast<Eigen::Index>(timed.configurations.size()));
  for (Eigen::Index i = 0; i < column.size(); ++i) {
    column(i) = timed.configurations[static_cast<std::size_t>(i)].opening;
  }
  return column;
}

Eigen::VectorXd times(const TimedPath& timed) {
  return Eigen::Map<const Eigen::VectorXd>(timed.time.data(),
                                           static_cast<Eigen::Index>(timed.time.size()));
}

void bind_timing(py::module_& m) {
  py::class_<TimingOptions>(m, "TimingOptions", "Options of time_path.")
      .def(py::init([](double interval, double speed_scale) {
             return TimingOptions{interval, speed_scale};
           }),
           py::kw_only(), "interval"_a = TimingOptions().interval,
           "speed_scale"_a = TimingOptions().speed_scale)
      .def_readwrite("interval", &TimingOptions::interval,
                     "Longest time between rows while the speed changes, 1e-4 to 1 [s].")
      .def_readwrite("speed_scale", &TimingOptions::speed_scale,
                     "Of the velocity limits, in (0, 1].");
  py::class_<TimedPath>(m, "TimedPath", "Rows of a timed path; straight lines between them.")
      .def_property_readonly("time", &times, "(n,) from 0, strictly increasing [s].")
      .def_property_readonly("positions", &positions, "(n, joints) arm joint values [rad].")
      .def_property_readonly("opening", &openings, "(n,) distance between the pads [m].")
      .def_readonly("configurations", &TimedPath::configurations, "One Configuration per time.")
      .def_property_readonly("duration", &TimedPath::duration, "Time of the last row [s].")
      .def("__len__", [](const TimedPath& timed) { return timed.time.size(); });
  m.def("time_path", &time_path, "robot"_a, "path"_a, "options"_a = TimingOptions(), Unlocked(),
        R"(Time a path: the shortest time along the polyline within the limits.

The rows lie exactly on the polyline, every corner is a row, the motion starts and ends at rest.

Args:
    robot: whose velocity and acceleration limits hold.
    path: list of Configuration; waypoints that repeat the one before are dropped.
    options: TimingOptions.

Returns:
    TimedPath.

Raises:
    InvalidInput: for an empty path, wrong lengths, numbers or options, or a path outside the limits.
)");
  m.def("travel_time", &travel_time, "robot"_a, "path"_a,
        R"(Least time along a path at the velocity limits alone, sum of max_j |dq_j| / v_j [s].

Args:
    robot: whose velocity limits hold.
    path: list of Configuration.

Returns:
    Seconds; never more than time_path takes.
)");
}

void bind_sampling(py::module_& m) {
  const SamplingOptions defaults;
  py::class_<SamplingOptions>(m, "SamplingOptions", "Options of plan_by_sampling.")
      .def(py::init([](std::uint64_t seed, int max_iterations, double range,
                       const CertificateOptions& certificate) {
             return SamplingOptions{seed, max_iterations, range, certificate};
           }),
           py::kw_only(), "seed"_a = defaults.seed, "max_iterations"_a = defaults.max_iterations,
           "range"_a = defaults.range, "certificate"_a = defaults.certificate)
      .def_readwrite("seed", &SamplingOptions::seed, "Fixes every random choice.")
      .def_readwrite("max_iterations", &SamplingOptions::max_iterations,
                     "States sampled, or boxes of the slices looked at.")
      .def_readwrite("range", &SamplingOptions::range,
                     "Longest tree edge, in the weighted metric [rad].")
      .def_readwrite("certificate", &SamplingOptions::certificate);
  py::enum_<MotionStatus>(m, "MotionStatus", "How a motion planner ended.")
      .value("Found", MotionStatus::Found)
      .value("StartBlocked", MotionStatus::StartBlocked)
      .value("GoalsBlocked", MotionStatus::GoalsBlocked)
      .value("IterationLimit", MotionStatus::IterationLimit)
      .value("Infeasible", MotionStatus::Infeasible, "Proved: no path leads to any free goal.");
  py::class_<MotionResult>(m, "MotionResult", "A motion, or why there is none; true if found.")
      .def_readonly("status", &MotionResult::status)
      .def_readonly("path", &MotionResult::path,
                    "Configurations from the start to goals[goal]; every edge certified.")
      .def_readonly("goal", &MotionResult::goal, "Which goal was reached, -1 for none.")
      .def_readonly("iterations", &MotionResult::iterations,
                    "States sampled, or boxes of the slices looked at.")
      .def_readonly("planner", &MotionResult::planner, "'straight', 'slices' or 'RRT-Connect'.")
      .def_readonly("slices_reason", &MotionResult::slices_reason,
                    "Why the slices gave no way, where they were searched in vain.")
      .def_readonly("reason", &MotionResult::reason, "Why not found, with names and numbers.")
      .def_property_readonly("found", &MotionResult::found)
      .def("__bool__", &MotionResult::found);
  m.def("plan_by_sampling", &plan_by_sampling, "checker"_a, "start"_a, "goals"_a,
        "options"_a = SamplingOptions(), Unlocked(),
        R"(Plan a motion by RRT-Connect over all joints, every edge certified.

Args:
    checker: CollisionChecker of the cell, with what is held.
    start: Configuration.
    goals: list of Configuration with the start's opening; any of them will do.
    options: SamplingOptions; the same seed gives the same path.

Returns:
    MotionResult.

Raises:
    InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
)");
}

void bind_shortcut(py::module_& m) {
  const ShortcutOptions defaults;
  py::class_<ShortcutOptions>(m, "ShortcutOptions", "Options of shorten_path.")
      .def(py::init([](std::uint64_t seed, int attempts, double clearance,
                       const CertificateOptions& certificate) {
             return ShortcutOptions{seed, attempts, clearance, certificate};
           }),
           py::kw_only(), "seed"_a = defaults.seed, "attempts"_a = defaults.attempts,
           "clearance"_a = defaults.clearance, "certificate"_a = defaults.certificate)
      .def_readwrite("seed", &ShortcutOptions::seed, "Fixes every random choice.")
      .def_readwrite("attempts", &ShortcutOptions::attempts, "Most moves of corners tried.")
      .def_readwrite("clearance", &ShortcutOptions::clearance,
                     "Kept where the path has it [m]; 0: no more than the certificate's.")
      .def_readwrite("certificate", &ShortcutOptions::certificate);
  m.def("shorten_path", &shorten_path, "checker"_a, "path"_a, "options"_a = ShortcutOptions(),
        Unlocked(),
        R"(Shorten a certified path; same ends, never longer, every new edge certified.

A new edge keeps options.clearance from everything, except where the path itself is nearer, at its
ends or in a passage: there it stays at least half as far away as the path does.

Args:
    checker: CollisionChecker of the cell, with what is held.
    path: list of Configuration.
    options: ShortcutOptions; the same seed gives the same result.

Returns:
    List of Configuration.

Raises:
    InvalidInput: for an empty path, wrong lengths, numbers or options, waypoints outside the limits.
)");
}

}  // namespace

void bind_motion(py::module_& m) {
  bind_timing(m);
  bind_sampling(m);
  bind_shortcut(m);
  py::class_<GrossOptions>(m, "GrossOptions", "Options of plan_gross_motion.")
      .def(py::init([](const FreeSpaceOptions& free_space, const SearchOptions& search,
                       const SeparationOptions& separation, const SamplingOptions& sampling,
                       const ShortcutOptions& shortcut) {
             return GrossOptions{free_space, search, separation, sampling, shortcut};
           }),
           py::kw_only(), "free_space"_a = FreeSpaceOptions(), "search"_a = SearchOptions(),
           "separation"_a = SeparationOptions(), "sampling"_a = SamplingOptions(),
           "shortcut"_a = ShortcutOptions())
      .def_readwrite("free_space", &GrossOptions::free_space)
      .def_readwrite("search", &GrossOptions::search,
                     "max_proofs = 0: sampling at once where no straight edge is free.")
      .def_readwrite("separation", &GrossOptions::separation)
      .def_readwrite("sampling", &GrossOptions::sampling)
      .def_readwrite("shortcut", &GrossOptions::shortcut);
  m.def(
      "plan_gross_motion", &plan_gross_motion, "checker"_a, "start"_a, "goals"_a,
      "options"_a = GrossOptions(), Unlocked(),
      R"(Plan a gross motion: straight if free, else through slices, else by sampling; then shortened.

Where sampling gives no way either, a proof that there is none is tried.

The goal nearest by travel time is tried first; goals in collision are left out.

Args:
    checker: CollisionChecker of the cell, with what is held.
    start: Configuration.
    goals: list of Configuration with the start's opening; any of them will do.
    options: GrossOptions.

Returns:
    MotionResult.

Raises:
    InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
)");
}

}  // namespace handey::bindings
