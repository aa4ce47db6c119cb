// The floor grasp, for regrasping: grasps in the part frame, and where they are legal.
#include "configurations.hpp"
#include "handey/collision/checker.hpp"
#include "handey/grasp/compatibility.hpp"
#include "handey/grasp/part_grasps.hpp"
#include "handey/kinematics/spherical_wrist.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

// Many grasps cross the border as arrays: one Python object each would cost more than the tests.
struct PartGrasps {
  std::vector<PartGrasp> grasps;
};

constexpr py::ssize_t kRow = 9;  // kinds and indices of a and b, x, y, theta, flipped, width

py::array_t<double> row_array(const PartGrasps& self) {
  const py::ssize_t count = static_cast<py::ssize_t>(self.grasps.size());
  py::array_t<double> array({count, kRow + 1});
  auto out = array.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < count; ++i) {
    const PartGrasp& grasp = self.grasps[static_cast<std::size_t>(i)];
    const double values[] = {static_cast<double>(grasp.a.kind),
                             static_cast<double>(grasp.a.index),
                             static_cast<double>(grasp.b.kind),
                             static_cast<double>(grasp.b.index),
                             grasp.in_plane.x,
                             grasp.in_plane.y,
                             grasp.in_plane.theta,
                             grasp.flipped ? 1.0 : 0.0,
                             grasp.width,
                             grasp.merit};
    for (py::ssize_t j = 0; j <= kRow; ++j) out(i, j) = values[j];
  }
  return array;
}

Feature feature(double kind, double index) {
  if (!(kind >= 0.0 && kind <= 2.0 && index >= 0.0 && index <= 1e9)) {
    throw InvalidInput("E_RANGE", "rows", "names a feature that is none");
  }
  return {static_cast<FeatureKind>(static_cast<int>(kind)), static_cast<int>(index)};
}

std::vector<Pose> pose_list(const py::handle& object, const std::string& place) {
  const py::array_t<double> values = real_array(object, place);
  if (values.size() == 0) return {};
  if (values.ndim() != 3 || values.shape(1) != 4 || values.shape(2) != 4) {
    throw InvalidInput("E_SHAPE", place, "expected shape (n, 4, 4)");
  }
  std::vector<Pose> poses;
  for (py::ssize_t i = 0; i < values.shape(0); ++i) {
    const Eigen::Matrix4d m =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data(i, 0, 0));
    poses.push_back(pose(m, place + "[" + std::to_string(i) + "]"));
  }
  return poses;
}

PartGrasps from_rows(const py::object& given_rows, const py::object& X_PH) {
  const auto values = real_rows<static_cast<int>(kRow) + 1>(given_rows, "rows");
  const std::vector<Pose> poses = pose_list(X_PH, "X_PH");
  if (values.size() != poses.size()) {
    throw InvalidInput("E_SHAPE", "X_PH", "expected as many poses as rows");
  }
  PartGrasps result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    PartGrasp grasp;
    grasp.a = feature(values[i][0], values[i][1]);
    grasp.b = feature(values[i][2], values[i][3]);
    grasp.in_plane = {values[i][4], values[i][5], values[i][6]};
    grasp.flipped = values[i][7] != 0.0;
    grasp.X_PH = poses[i];
    grasp.width = values[i][8];
    grasp.merit = values[i][9];
    result.grasps.push_back(grasp);
  }
  return result;
}

void bind_part_grasps(py::module_& m) {
  py::class_<PartGrasps>(m, "PartGrasps", R"(Grasps of a part, wherever it stands.

Args:
    rows: as the property, (n, 10).
    X_PH: as the property, (n, 4, 4).)")
      .def(py::init(&from_rows), py::kw_only(), "rows"_a, "X_PH"_a)
      .def("__len__", [](const PartGrasps& self) { return self.grasps.size(); })
      .def_property_readonly(
          "rows", &row_array,
          "Kind and index of the features a and b, x, y [m], theta [rad] in the grasp plane, "
          "flipped (0 or 1), width [m], merit (0..0.7): (n, 10).")
      .def_property_readonly(
          "X_PH",
          [](const PartGrasps& self) {
            std::vector<Pose> poses;
            for (const PartGrasp& grasp : self.grasps) poses.push_back(grasp.X_PH);
            return pose_array(poses);
          },
          "Grasp frames in the part, (n, 4, 4).");
  m.def(
      "rank_part_alone",
      [](const Body& part, const std::shared_ptr<Robot>& robot, const RankingOptions& options) {
        const Unlock unlock;
        return rank_part_alone(part, robot, options);
      },
      "part"_a, py::arg("robot").none(false), "options"_a = RankingOptions(),
      R"(The feature pairs of a part that stands alone: obstructed by its own protrusions only.

Args:
    part: Body.
    robot: Robot.
    options: RankingOptions.

Returns:
    Ranking.

Raises:
    InvalidInput: for a part without shapes, bad options.)");
  m.def(
      "sample_part_grasps",
      [](const Body& part, const std::shared_ptr<Robot>& robot, const RankingOptions& ranking,
         const LegalityOptions& legality, int most) {
        const Unlock unlock;
        return PartGrasps{sample_part_grasps(part, robot, {ranking, legality, most})};
      },
      "part"_a, py::arg("robot").none(false), py::kw_only(), "ranking"_a = RankingOptions(),
      "legality"_a = LegalityOptions(), "most"_a = PartGraspOptions().most,
      R"(Hand poses in the part frame that hold the part, with an eye on nothing but the part.

Args:
    part: Body.
    robot: Robot.
    ranking: RankingOptions of its feature pairs.
    legality: LegalityOptions; directions, spacing, contact, hold and clearances count.
    most: grasps, shared evenly by pairs and directions; more where one would have none.

Returns:
    PartGrasps.

Raises:
    InvalidInput: for a part without shapes, bad options.)");
  m.def(
      "clears_plane",
      [](const std::shared_ptr<Robot>& robot, const PartGrasps& grasps, const py::object& X_SP,
         const LegalityOptions& options) {
        const Pose placed = real_pose(X_SP, "X_SP");
        std::vector<char> clear;
        {
          const Unlock unlock;
          clear = clears_plane(robot, grasps.grasps, placed, options);
        }
        py::array_t<bool> array(static_cast<py::ssize_t>(clear.size()));
        for (std::size_t i = 0; i < clear.size(); ++i) {
          array.mutable_at(static_cast<py::ssize_t>(i)) = clear[i] != 0;
        }
        return array;
      },
      py::arg("robot").none(false), "grasps"_a, "X_SP"_a, "options"_a = LegalityOptions(),
      R"(Which grasps keep the hand above the plane z = 0, with the part at X_SP.

Args:
    robot: Robot.
    grasps: PartGrasps.
    X_SP: the part on the plane, (4, 4).
    options: LegalityOptions.

Returns:
    Array (n,) of bool.

Raises:
    InvalidInput: for a bad pose.)");
}

void bind_compatible_grasps(py::module_& m) {
  py::class_<CompatibleGrasp>(m, "CompatibleGrasp", "A grasp that is legal at a place.")
      .def_readonly("grasp", &CompatibleGrasp::grasp, "Index.")
      .def_readonly("opening", &CompatibleGrasp::opening,
                    "The widest of those tried at which it is legal [m].")
      .def_readonly("margin", &CompatibleGrasp::margin,
                    "From joint limits and singularities, best configuration, 0..1.")
      .def_readonly("q", &CompatibleGrasp::q,
                    "Legal configurations, best margin first: list of (dof,) [rad].");
  py::class_<CompatibleGrasps>(m, "CompatibleGrasps", "The grasps that are legal at a place.")
      .def_readonly("legal", &CompatibleGrasps::legal, "CompatibleGrasp, by index.")
      .def_readonly("tried", &CompatibleGrasps::tried)
      .def_readonly("unreachable", &CompatibleGrasps::unreachable)
      .def_readonly("collides", &CompatibleGrasps::collides)
      .def_readonly("worst_reason", &CompatibleGrasps::worst_reason,
                    "What was met most often: 'hand hits table: 14 of 48'; empty if nothing.");
  m.def(
      "find_compatible_grasps",
      [](const std::shared_ptr<CollisionModel>& model, const Cell& cell, int part,
         const SphericalWristSolver& solver, const PartGrasps& grasps,
         const std::vector<std::vector<int>>& groups, const py::object& places,
         double open_clearance, double clearance, int configurations, int most) {
        const std::vector<Pose> poses = pose_list(places, "places");
        const Unlock unlock;
        return find_compatible_grasps(model, cell, part, solver, grasps.grasps, groups, poses,
                                      {open_clearance, clearance, configurations, most});
      },
      py::arg("model").none(false), "cell"_a, "part"_a, "solver"_a, "grasps"_a, "groups"_a,
      "places"_a, py::kw_only(), "open_clearance"_a = CompatibilityOptions().open_clearance,
      "clearance"_a = CompatibilityOptions().clearance,
      "configurations"_a = CompatibilityOptions().configurations,
      "most"_a = CompatibilityOptions().most,
      R"(Which grasps are legal with the part at some places: hand open and closing, arm, reach.

Args:
    model: CollisionModel of the cell.
    cell: Cell with an empty hand.
    part: index in cell.parts.
    solver: SphericalWristSolver of the cell's robot.
    grasps: PartGrasps.
    groups: lists of indices, each looked at in its order until `most` of it are legal.
    places: the part in the world, (n, 4, 4).
    open_clearance: of the open pads from the faces, each side; also half and a quarter of it [m].
    clearance: of the whole robot [m].
    configurations: of the arm, per grasp: the legal ones of best margin.
    most: legal grasps per group at a place; 0 for all.

Returns:
    List of CompatibleGrasps, one per place.

Raises:
    InvalidInput: for a part in the hand, unknown indices, bad poses or numbers.)");
  m.def(
      "reach_margins",
      [](const Cell& cell, const SphericalWristSolver& solver, const PartGrasps& grasps,
         const std::vector<std::vector<int>>& groups, const py::object& places) {
        const std::vector<Pose> poses = pose_list(places, "places");
        std::vector<std::vector<double>> margins;
        {
          const Unlock unlock;
          margins = reach_margins(cell, solver, grasps.grasps, groups, poses);
        }
        py::array_t<double> array(
            {static_cast<py::ssize_t>(poses.size()), static_cast<py::ssize_t>(groups.size())});
        auto out = array.mutable_unchecked<2>();
        for (std::size_t i = 0; i < margins.size(); ++i) {
          for (std::size_t j = 0; j < groups.size(); ++j) {
            out(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)) = margins[i][j];
          }
        }
        return array;
      },
      "cell"_a, "solver"_a, "grasps"_a, "groups"_a, "places"_a,
      R"(How well the arm reaches the best grasp of each group with the part at some places.

Args:
    cell: Cell.
    solver: SphericalWristSolver of the cell's robot.
    grasps: PartGrasps.
    groups: lists of indices.
    places: the part in the world, (n, 4, 4).

Returns:
    Joint margin 0..1, -1 where none is reached: (n, groups). Collision is not looked at.

Raises:
    InvalidInput: for unknown indices or bad poses.)");
}

}  // namespace

void bind_regrasp(py::module_& m) {
  bind_part_grasps(m);
  bind_compatible_grasps(m);
}

}  // namespace handey::bindings
