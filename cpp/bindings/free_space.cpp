// The search through linked slices, as Python sees it.
#include "handey/cspace/free_space.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "handey/collision/checker.hpp"
#include "handey/cspace/arm_table.hpp"
#include "handey/cspace/search.hpp"
#include "handey/cspace/slice.hpp"
#include "handey/kinematics/arm.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {

using namespace pybind11::literals;

void bind_free_space(py::module_& m) {
  py::class_<FreeSpaceOptions>(m, "FreeSpaceOptions", "The slices of one gross motion.")
      .def(py::init([](int window_level, int outer_level, int range_level, int home_level,
                       int wrist_splits, double clearance, std::shared_ptr<ArmTable> table) {
             FreeSpaceOptions options;
             options.window_level = window_level;
             options.outer_level = outer_level;
             options.range_level = range_level;
             options.home_level = home_level;
             options.wrist_splits = wrist_splits;
             options.clearance = clearance;
             options.table = std::move(table);
             return options;
           }),
           py::kw_only(), "window_level"_a = FreeSpaceOptions().window_level,
           "outer_level"_a = FreeSpaceOptions().outer_level,
           "range_level"_a = FreeSpaceOptions().range_level,
           "home_level"_a = FreeSpaceOptions().home_level,
           "wrist_splits"_a = FreeSpaceOptions().wrist_splits,
           "clearance"_a = FreeSpaceOptions().clearance, "table"_a = std::shared_ptr<ArmTable>())
      .def_readwrite("window_level", &FreeSpaceOptions::window_level,
                     "Finest level within the windows round the ends: 0 is 8 degrees, 3 is 1.")
      .def_readwrite("outer_level", &FreeSpaceOptions::outer_level,
                     "Finest level of the ends' slices outside their windows.")
      .def_readwrite("range_level", &FreeSpaceOptions::range_level,
                     "Finest level of the slices over the wrist's range.")
      .def_readwrite("home_level", &FreeSpaceOptions::home_level,
                     "Finest level of the slice with the wrist as at home.")
      .def_readwrite("wrist_splits", &FreeSpaceOptions::wrist_splits,
                     "The wrist's range is halved at most so often.")
      .def_readwrite("clearance", &FreeSpaceOptions::clearance, "Least distance proved [m].")
      .def_property(
          "table",
          [](const FreeSpaceOptions& self) {
            return std::const_pointer_cast<ArmTable>(self.table);
          },
          [](FreeSpaceOptions& self, std::shared_ptr<ArmTable> table) {
            self.table = std::move(table);
          },
          "ArmTable of level 0 for this robot, or None: by proofs alone.");
  py::class_<SearchOptions>(m, "SearchOptions", "The search through the slices.")
      .def(py::init([](const std::vector<double>& windows, int max_proofs, double detour) {
             SearchOptions options;
             options.windows = windows;
             options.max_proofs = max_proofs;
             options.detour = detour;
             return options;
           }),
           py::kw_only(), "windows"_a = SearchOptions().windows,
           "max_proofs"_a = SearchOptions().max_proofs, "detour"_a = SearchOptions().detour)
      .def_readwrite("windows", &SearchOptions::windows,
                     "Half widths of the windows of finest cells, one after the other [rad].")
      .def_readwrite("max_proofs", &SearchOptions::max_proofs,
                     "Boxes proved at most; 0: the slices are not searched.")
      .def_readwrite("detour", &SearchOptions::detour, "Weight of the estimate, 1 or more.");
  py::class_<SearchResult>(m, "SearchResult", "A way through the slices, or why there is none.")
      .def_readonly("found", &SearchResult::found)
      .def_readonly("goal", &SearchResult::goal, "Which goal was reached, -1 for none.")
      .def_readonly("path", &SearchResult::path, "Configurations from start to goal.")
      .def_readonly("proofs", &SearchResult::proofs, "Boxes looked at.")
      .def_readonly("stances", &SearchResult::stances,
                    "Other stances of the wrist that the way goes through.")
      .def_readonly("window", &SearchResult::window, "Half width that sufficed [rad].")
      .def_readonly("reason", &SearchResult::reason)
      .def("__bool__", [](const SearchResult& self) { return self.found; });
  m.def(
      "search_free_space",
      [](CollisionChecker& checker, const Configuration& start,
         const std::vector<Configuration>& goals, const FreeSpaceOptions& slices,
         const SearchOptions& options) {
        FreeSpace space(checker, start, goals, slices);
        return search_free_space(space, options);
      },
      "checker"_a, "start"_a, "goals"_a, "slices"_a = FreeSpaceOptions(),
      "options"_a = SearchOptions(), Unlocked(),
      R"(Search the slices of a gross motion for a way: not shortened yet.

Args:
    checker: CollisionChecker of the cell, with what is held.
    start: Configuration.
    goals: list of Configuration with the start's opening; any of them will do.
    slices: FreeSpaceOptions.
    options: SearchOptions.

Returns:
    SearchResult.

Raises:
    InvalidInput: for arms of fewer than three joints, wrong lengths or options.
)");
}

}  // namespace handey::bindings
