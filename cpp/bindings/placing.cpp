// Where parts can be put down: resting poses, support faces, places on them.
#include <memory>
#include <optional>

#include "configurations.hpp"
#include "handey/collision/standing_places.hpp"
#include "handey/world/resting.hpp"
#include "handey/world/support_faces.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

void bind_resting(py::module_& m) {
  const RestingOptions defaults;
  py::class_<RestingOptions>(m, "RestingOptions", "Options of resting_poses.")
      .def(py::init([](int segments, double least_tip_angle, double contact_gap, double least_width,
                       double rolling, double rolling_step) {
             return RestingOptions{segments,    least_tip_angle, contact_gap,
                                   least_width, rolling,         rolling_step};
           }),
           py::kw_only(), py::arg("segments") = defaults.segments,
           py::arg("least_tip_angle") = defaults.least_tip_angle,
           py::arg("contact_gap") = defaults.contact_gap,
           py::arg("least_width") = defaults.least_width, py::arg("rolling") = defaults.rolling,
           py::arg("rolling_step") = defaults.rolling_step)
      .def_readwrite("segments", &RestingOptions::segments, "Sides of a round shape.")
      .def_readwrite("least_tip_angle", &RestingOptions::least_tip_angle,
                     "Poses that a smaller turn would tip over are left out [rad].")
      .def_readwrite("contact_gap", &RestingOptions::contact_gap,
                     "What lies this near above the table stands on it [m].")
      .def_readwrite("least_width", &RestingOptions::least_width,
                     "Of the region that it stands on [m].")
      .def_readwrite("rolling", &RestingOptions::rolling,
                     "A pose that a smaller turn tips over is one of a round side [rad].")
      .def_readwrite("rolling_step", &RestingOptions::rolling_step,
                     "Poses of a round side are kept this far apart, or more [rad].");
  py::class_<RestingPose>(m, "RestingPose",
                          "A part standing on the plane z = 0 of a support frame S.")
      .def_property_readonly(
          "X_SP", [](const RestingPose& self) { return matrix(self.X_SP); },
          "The part in S, (4, 4): lowest point at z = 0, centre of mass over the origin.")
      .def_readonly("margin", &RestingPose::margin,
                    "Of the centre of mass from the nearest edge of the footprint [m].")
      .def_readonly("height", &RestingPose::height, "Of the centre of mass over the plane [m].")
      .def_readonly("tip_angle", &RestingPose::tip_angle, "The least turn that tips it over [rad].")
      .def_readonly("width", &RestingPose::width, "Least width of what it stands on [m].")
      .def_readonly("probability", &RestingPose::probability, "Of coming to rest so.")
      .def_readonly("top", &RestingPose::top, "Height of its highest point [m].")
      .def_property_readonly(
          "footprint", [](const RestingPose& self) { return rows_of<2>(self.footprint); },
          "Convex hull of what it stands on, in x, y of S, (n, 2) [m].")
      .def_readonly("contact", &RestingPose::contact, "What it stands on, in x, y of S.")
      .def_property_readonly(
          "shadow", [](const RestingPose& self) { return rows_of<2>(self.shadow); },
          "Convex hull of the whole part seen from above, in x, y of S, (n, 2) [m].")
      .def("__repr__", [](const RestingPose& self) {
        return py::str("RestingPose(tip_angle={:.4f}, height={:.4f}, probability={:.3f})")
            .format(self.tip_angle, self.height, self.probability);
      });
  m.def("resting_poses", &resting_poses, py::arg("part"), py::arg("options") = defaults, Unlocked(),
        R"(All stable resting poses of a part on a plane, the steadiest first.

Args:
    part: Body; round shapes are polyhedra that contain them.
    options: RestingOptions.

Returns:
    List of RestingPose; their probabilities sum up to 1.)");
  m.def(
      "resting_pose",
      [](const Body& part, const py::object& up, const RestingOptions& options) {
        return resting_pose(part, real_vector<3>(up, "up"), options);
      },
      py::arg("part"), py::arg("up"), py::arg("options") = defaults,
      "The part standing with `up` (3,), a direction of its own frame, upwards, stably or not.");
}

void bind_support_faces(py::module_& m) {
  const SupportFaceOptions defaults;
  py::class_<SupportFaceOptions>(m, "SupportFaceOptions", "Options of support_faces.")
      .def(py::init([](double level, double least_area, double least_wall) {
             return SupportFaceOptions{level, least_area, least_wall};
           }),
           py::kw_only(), py::arg("level") = defaults.level,
           py::arg("least_area") = defaults.least_area, py::arg("least_wall") = defaults.least_wall)
      .def_readwrite("level", &SupportFaceOptions::level,
                     "A normal leaves the vertical by no more [rad].")
      .def_readwrite("least_area", &SupportFaceOptions::least_area,
                     "Smaller faces are left out [m2].")
      .def_readwrite("least_wall", &SupportFaceOptions::least_wall,
                     "A wall rises at least so far over the face [m].");
  py::class_<SupportFace>(m, "SupportFace", "An upward horizontal face of a body, in a frame S.")
      .def_property_readonly(
          "X_WS", [](const SupportFace& self) { return matrix(self.X_WS); },
          "S in the world, (4, 4): z along the outward normal.")
      .def_readonly("region", &SupportFace::region, "In x, y of S.")
      .def_readonly("area", &SupportFace::area, "[m2]")
      .def_readonly("enclosed", &SupportFace::enclosed, "What the body's walls enclose, in S.")
      .def_readonly("outline", &SupportFace::outline, "Of the body seen from above, in S.")
      .def("__repr__", [](const SupportFace& self) {
        return py::str("SupportFace({:.1f} cm2 at z = {:.4f})")
            .format(1e4 * self.area, self.X_WS.translation().z());
      });
  m.def("support_faces", &support_faces, py::arg("body"), py::arg("options") = defaults, Unlocked(),
        "The upward horizontal faces of a body where it is, as SupportFace, highest first.");
}

std::optional<Eigen::AlignedBox2d> box_from(const py::object& region) {
  if (region.is_none()) return std::nullopt;
  const std::vector<Eigen::Vector2d> corners = real_rows<2>(region, "region");
  if (corners.size() != 2) {
    throw InvalidInput("E_SHAPE", "region", "expected shape (2, 2): least x, y; greatest x, y");
  }
  return Eigen::AlignedBox2d(corners[0], corners[1]);
}

void bind_standing_places(py::module_& m) {
  const StandingPlaceOptions defaults;
  py::class_<StandingPlaceOptions>(m, "StandingPlaceOptions", R"(Options of find_standing_places.

Args:
    first, count: which samples of the sequence.
    seed: of the sequence.
    near_point: every second sample is around this point of the world, (2,), or None.
    within: up to so far from it [m].
    region: box of the world that all that it stands on lies in, (2, 2), or None.
    inside: within the walls of the face's body.
    least_margin: of the centre of mass within what it stands on [m].
    clearance: to all that is not under it [m].
    rooms: greater distances, ascending; a place's room is the greatest that it has [m].
    robot: Configuration in which the robot stands and is kept clear of, or None.)")
      .def(py::init([](int first, int count, std::uint64_t seed, const py::object& near_point,
                       double within, const py::object& region, bool inside, double least_margin,
                       double clearance, const std::vector<double>& rooms,
                       const std::optional<Configuration>& robot) {
             StandingPlaceOptions options;
             options.first = first;
             options.count = count;
             options.seed = seed;
             if (!near_point.is_none()) {
               options.near_point = real_vector<2>(near_point, "near_point");
             }
             options.within = within;
             options.region = box_from(region);
             options.inside = inside;
             options.least_margin = least_margin;
             options.clearance = clearance;
             options.rooms = rooms;
             options.robot = robot;
             return options;
           }),
           py::kw_only(), py::arg("first") = defaults.first, py::arg("count") = defaults.count,
           py::arg("seed") = defaults.seed, py::arg("near_point") = py::none(),
           py::arg("within") = defaults.within, py::arg("region") = py::none(),
           py::arg("inside") = defaults.inside, py::arg("least_margin") = defaults.least_margin,
           py::arg("clearance") = defaults.clearance, py::arg("rooms") = defaults.rooms,
           py::arg("robot") = py::none());
  py::class_<StandingPlace>(m, "StandingPlace", "Where a part can be put down.")
      .def_property_readonly(
          "X_WP", [](const StandingPlace& self) { return matrix(self.X_WP); }, "(4, 4)")
      .def_readonly("margin", &StandingPlace::margin,
                    "Of the centre of mass within what it stands on [m].")
      .def_readonly("room", &StandingPlace::room,
                    "It is at least so far from all that is not under it [m].");
  py::class_<StandingPlaces>(m, "StandingPlaces", "Places, and why the other samples fell.")
      .def_readonly("places", &StandingPlaces::places, "In the order of the sequence.")
      .def_readonly("tried", &StandingPlaces::tried)
      .def_readonly("off_the_face", &StandingPlaces::off_the_face)
      .def_readonly("outside_the_region", &StandingPlaces::outside_the_region)
      .def_readonly("outside_the_walls", &StandingPlaces::outside_the_walls)
      .def_readonly("not_clear", &StandingPlaces::not_clear)
      .def_readonly("in_the_way", &StandingPlaces::in_the_way,
                    "What was met most often by those that were not clear.");
  m.def(
      "find_standing_places",
      [](const std::shared_ptr<CollisionModel>& model, const Cell& cell, int part,
         const RestingPose& rest, const SupportFace& face, const StandingPlaceOptions& options) {
        return find_standing_places(model, cell, part, rest, face, options);
      },
      py::arg("model").none(false), py::arg("cell"), py::arg("part"), py::arg("rest"),
      py::arg("face"), py::arg("options") = defaults, Unlocked(),
      R"(Where on a face can a part be put down, standing stably and clear of everything?

Args:
    model: collision geometry of the cell.
    cell: where the other bodies are.
    part: index of the part.
    rest: RestingPose of the part.
    face: SupportFace of a body where it is.
    options: StandingPlaceOptions.

Raises:
    InvalidInput: for options out of range, or a model of another cell.)");
}

}  // namespace

void bind_placing(py::module_& m) {
  bind_resting(m);
  bind_support_faces(m);
  bind_standing_places(m);
}

}  // namespace handey::bindings
