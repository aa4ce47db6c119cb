// The floor cspace: the tables of arms, and slices made from them.
#include "handey/cspace/slice.hpp"

#include "configurations.hpp"
#include "handey/collision/checker.hpp"
#include "handey/cspace/arm_table.hpp"
#include "handey/cspace/cross_section.hpp"
#include "handey/cspace/free_space.hpp"
#include "handey/cspace/lattice.hpp"
#include "handey/kinematics/arm.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

int index_within(int index, int count, const char* place) {
  if (index < 0 || index >= count) {
    throw InvalidInput(
        "E_INDEX", place,
        "found " + std::to_string(index) + ", expected 0 to " + std::to_string(count - 1));
  }
  return index;
}

/// A layer as rows of theta2 and columns of theta3; true where a cell is blocked.
py::array_t<bool> blocked_cells(Slice& slice, int waist_cell) {
  const int rows = slice.lattice().cells(slice.level(), 1);
  const int columns = slice.lattice().cells(slice.level(), 2);
  std::vector<std::uint64_t> words;
  {
    const Unlock unlock;
    words = slice.blocked(waist_cell);
  }
  py::array_t<bool> cells({rows, columns});
  auto out = cells.mutable_unchecked<2>();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int word = row * slice.words_per_row() + column / 64;
      out(row, column) = ((words[static_cast<std::size_t>(word)] >> (column % 64)) & 1U) != 0;
    }
  }
  return cells;
}

void bind_table(py::module_& m) {
  const ArmTableOptions defaults;
  py::class_<ArmTableOptions>(m, "ArmTableOptions", "Options of make_arm_table.")
      .def(py::init([](int level, double square, const std::string& directory) {
             return ArmTableOptions{level, square, directory};
           }),
           py::kw_only(), py::arg("level") = defaults.level, py::arg("square") = defaults.square,
           py::arg("directory") = defaults.directory)
      .def_readwrite("level", &ArmTableOptions::level,
                     "Of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1.")
      .def_readwrite("square", &ArmTableOptions::square,
                     "Width of a ring of the arm's plane at level 0 [m].")
      .def_readwrite("directory", &ArmTableOptions::directory,
                     "Where tables are kept; empty: in memory only.");
  py::class_<ArmTable, std::shared_ptr<ArmTable>>(
      m, "ArmTable", "What each piece of an arm's plane blocks. Made once per robot; shared.")
      .def_property_readonly("lattice", [](const ArmTable& self) { return self.lattice(); })
      .def_property_readonly("level", &ArmTable::level, "Of the lattice.");
  m.def(
      "make_arm_table",
      [](const Robot& robot, const ArmTableOptions& options) {
        std::string reason;
        std::shared_ptr<ArmTable> table;
        {
          const Unlock unlock;
          table = std::const_pointer_cast<ArmTable>(make_arm_table(robot, options, &reason));
        }
        return std::make_pair(table, reason);
      },
      py::arg("robot"), py::arg("options") = defaults,
      R"(Read a robot's table from the directory if it is kept there, else make and keep it.

Args:
    robot: the arm.
    options: ArmTableOptions.

Returns:
    The table and "", or None and why the arm has none.

Raises:
    InvalidInput: for options out of range.)");
}

void bind_slices(py::module_& m) {
  py::enum_<SliceMode>(m, "SliceMode", "How obstacles are taken to the arm's plane.")
      .value("Cells", SliceMode::Cells, "a cross section for every cell of the waist angle")
      .value("Article", SliceMode::Article, "tori: one cross section for all waist angles");
  py::class_<WristRange>(m, "WristRange", R"(Values of the joints after the third.

Args:
    lower: (n - 3,) [rad].
    upper: (n - 3,) [rad].)")
      .def(py::init([](const py::object& lower, const py::object& upper) {
             return WristRange{joint_vector(lower, "lower"), joint_vector(upper, "upper")};
           }),
           py::arg("lower"), py::arg("upper"))
      .def_property_readonly("lower", [](const WristRange& self) { return self.lower; })
      .def_property_readonly("upper", [](const WristRange& self) { return self.upper; });
  const SliceOptions defaults;
  py::class_<SliceOptions>(m, "SliceOptions", "Options of Slice.")
      .def(py::init([](SliceMode mode, double clearance) {
             return SliceOptions{mode, clearance};
           }),
           py::kw_only(), py::arg("mode") = defaults.mode,
           py::arg("clearance") = defaults.clearance)
      .def_readwrite("mode", &SliceOptions::mode)
      .def_readwrite("clearance", &SliceOptions::clearance,
                     "Least distance of free configurations from everything [m].");
  py::class_<Slice>(m, "Slice", R"(Cells of the first three joints, free for a range of the wrist.

A cell called free is free for every configuration in it and every wrist value of the range. Layers
of the waist angle are built when asked for. One worker: not to be shared between threads.

Args:
    checker: CollisionChecker of the cell, with what is held.
    table: ArmTable of its robot.
    wrist: WristRange.
    opening: between the pads [m].
    options: SliceOptions.

Raises:
    InvalidInput: for a wrist range of the wrong length or not in order, an opening that is not the
        gripper's, or a table of another robot.)")
      .def(py::init([](CollisionChecker& checker, const std::shared_ptr<ArmTable>& table,
                       const WristRange& wrist, double opening, const SliceOptions& options) {
             return std::make_unique<Slice>(checker, table, wrist, opening, options);
           }),
           py::arg("checker"), py::arg("table").none(false), py::arg("wrist"), py::arg("opening"),
           py::arg("options") = defaults, py::keep_alive<1, 2>(), Unlocked())
      .def_property_readonly("lattice", [](const Slice& self) { return self.lattice(); })
      .def_property_readonly("level", &Slice::level, "Of the lattice.")
      .def_property_readonly("reason", &Slice::reason,
                             "Why no cell can be free at all; empty if there is no such reason.")
      .def_property_readonly("layers_built", &Slice::layers_built)
      .def(
          "is_free",
          [](Slice& self, const CellIndex& cell) {
            for (int j = 0; j < 3; ++j) {
              index_within(cell[static_cast<std::size_t>(j)], self.lattice().cells(self.level(), j),
                           "cell");
            }
            return self.is_free(cell);
          },
          py::arg("cell"), Unlocked(),
          "Is a cell free? Given by its indices along the first three joints.")
      .def("blocked", &blocked_cells, py::arg("waist_cell"),
           "One layer of the waist angle: (cells of theta2, cells of theta3), true if blocked.");
}

}  // namespace

/// Called by bind_cspace.
void bind_slice(py::module_& m);

void bind_slice(py::module_& m) {
  bind_table(m);
  bind_slices(m);
}

}  // namespace handey::bindings
