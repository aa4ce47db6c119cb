// The floor grasp: face pairs, neighbours at both ends, ranking, fingertip targets, legal hand
// poses.
#include "configurations.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;
using Unlocked = py::call_guard<py::gil_scoped_release>;

void bind_planar_pose(py::module_& m) {
  py::class_<PlanarPose>(m, "PlanarPose", R"(Position and direction of the hand in the grasp plane.

Args:
    x, y: finger grasp point in G [m].
    theta: direction of the hand's approach axis, from x of G [rad].)")
      .def(py::init([](const py::object& x, const py::object& y, const py::object& theta) {
             return PlanarPose{real_number(x, "x"), real_number(y, "y"),
                               real_number(theta, "theta")};
           }),
           "x"_a = 0.0, "y"_a = 0.0, "theta"_a = 0.0)
      .def_readonly("x", &PlanarPose::x, "[m]")
      .def_readonly("y", &PlanarPose::y, "[m]")
      .def_readonly("theta", &PlanarPose::theta, "[rad]")
      .def("__repr__", [](const PlanarPose& self) {
        return py::str("PlanarPose({}, {}, {})").format(self.x, self.y, self.theta);
      });
  m.def(
      "hand_in_plane",
      [](const PlanarPose& pose, bool flipped) { return matrix(hand_in_plane(pose, flipped)); },
      "pose"_a, "flipped"_a,
      "The grasp frame in the plane frame, (4, 4): z_H = (cos, sin, 0), y_H = +z_G, or -z_G if "
      "flipped.");
}

void bind_features(py::module_& m) {
  py::class_<FacePair>(m, "FacePair", "Two opposite faces that the jaws can hold.")
      .def_readonly("face_a", &FacePair::face_a, "Index into FeaturePairs.faces.")
      .def_readonly("face_b", &FacePair::face_b, "Index into FeaturePairs.faces.")
      .def_readonly("width", &FacePair::width, "Distance between the faces at the origin of G [m].")
      .def_property_readonly(
          "X_PG", [](const FacePair& self) { return matrix(self.X_PG); },
          "Grasp plane in the part, (4, 4): midway between the faces, z the closing axis.")
      .def_readonly("overlap", &FacePair::overlap, "Common area, in (x, y) of G [m].")
      .def_readonly("area", &FacePair::area, "Of the overlap [m2].")
      .def_readonly("taper", &FacePair::taper, "How the width grows with x and y of G, (2,) [m/m].")
      .def(
          "width_at",
          [](const FacePair& self, const py::object& point) {
            return self.width_at(real_vector<2>(point, "point"));
          },
          "point"_a, "Distance between the faces at a point (2,) of G [m].");
  py::enum_<Rejection>(m, "Rejection", "Why the jaws cannot take a pair.")
      .value("TooWide", Rejection::TooWide)
      .value("TooThin", Rejection::TooThin)
      .value("LittleOverlap", Rejection::LittleOverlap);
  py::class_<RejectedPair>(m, "RejectedPair", "A pair that the jaws cannot take, and why.")
      .def_readonly("face_a", &RejectedPair::face_a)
      .def_readonly("face_b", &RejectedPair::face_b)
      .def_readonly("width", &RejectedPair::width, "[m]")
      .def_readonly("kind", &RejectedPair::kind)
      .def_readonly("reason", &RejectedPair::reason, "For people, with numbers.");
  const FeatureOptions defaults;
  py::class_<FeatureOptions>(m, "FeatureOptions", "Options of find_feature_pairs.")
      .def(py::init([](double angle, double least_face_area, double least_overlap,
                       double jaw_clearance) {
             return FeatureOptions{angle, least_face_area, least_overlap, jaw_clearance};
           }),
           py::kw_only(), "angle"_a = defaults.angle,
           "least_face_area"_a = defaults.least_face_area,
           "least_overlap"_a = defaults.least_overlap, "jaw_clearance"_a = defaults.jaw_clearance)
      .def_readwrite("angle", &FeatureOptions::angle, "Most the normals leave antiparallel [rad].")
      .def_readwrite("least_face_area", &FeatureOptions::least_face_area, "[m2]")
      .def_readwrite("least_overlap", &FeatureOptions::least_overlap, "[m2]")
      .def_readwrite("jaw_clearance", &FeatureOptions::jaw_clearance,
                     "The jaws open at least this much wider than the part, each side [m].");
  py::class_<FeaturePairs>(m, "FeaturePairs", "A part's faces and the pairs of them.")
      .def_readonly("faces", &FeaturePairs::faces, "PlanarFace of all shapes, in the part frame.")
      .def_readonly("pairs", &FeaturePairs::pairs, "FacePair, largest overlap first.")
      .def_readonly("rejected", &FeaturePairs::rejected, "RejectedPair.");
  m.def("find_feature_pairs", &find_feature_pairs, "part"_a, "gripper"_a,
        "options"_a = FeatureOptions(), Unlocked(),
        R"(Pairs of planar faces that a parallel jaw can hold (article, step 1).

Args:
    part: Body.
    gripper: Gripper.
    options: FeatureOptions.

Returns:
    FeaturePairs.

Raises:
    InvalidInput: for a part without shapes, bad shapes or options.)");
}

void bind_backproject(py::module_& m) {
  py::class_<NearbyBody>(m, "NearbyBody", "A body seen from the part.")
      .def_readonly("body", &NearbyBody::body, "BodyRef.")
      .def_readonly("name", &NearbyBody::name)
      .def_readonly("at_destination", &NearbyBody::at_destination, "Moved by the inverse of T.")
      .def_property_readonly(
          "X_PB", [](const NearbyBody& self) { return matrix(self.X_PB); },
          "The body in the part frame, (4, 4).");
  m.def(
      "nearby_bodies",
      [](const Cell& cell, int part, const py::object& X_WP_goal, double radius) {
        return nearby_bodies(cell, part, real_pose(X_WP_goal, "X_WP_goal"), radius);
      },
      "cell"_a, "part"_a, "X_WP_goal"_a, "radius"_a = 0.25,
      R"(What is near a part at its origin and at its destination, seen from the part (Figure 4).

Args:
    cell: Cell.
    part: index in cell.parts.
    X_WP_goal: the part at its destination, (4, 4).
    radius: between bounding boxes [m].

Returns:
    List of NearbyBody, those at the origin first.

Raises:
    InvalidInput: for an unknown part, a bad pose or radius.)");
}

void bind_targets(py::module_& m) {
  m.def("pad_contact_area", &pad_contact_area, "region"_a, "pose"_a, "gripper"_a,
        "Area of one pad on a region of the grasp plane, the hand at a PlanarPose [m2].");
  m.def(
      "fingertip_targets",
      [](const Region& unobstructed, const py::object& centre_of_mass, const Gripper& gripper,
         int most) {
        return rows_of<2>(fingertip_targets(
            unobstructed, real_vector<2>(centre_of_mass, "centre_of_mass"), gripper, most));
      },
      "unobstructed"_a, "centre_of_mass"_a, "gripper"_a, "most"_a = 5,
      "At most `most` fingertip targets in a region, best first, (n, 2) [m].");
}

void bind_ranking_types(py::module_& m) {
  const RankingOptions defaults;
  py::class_<RankingOptions>(m, "RankingOptions", "Options of rank_grasps.")
      .def(py::init([](const FeatureOptions& features, double finger_clearance,
                       double open_clearance, bool use_destination, double least_share,
                       int most_targets) {
             return RankingOptions{features,        finger_clearance, open_clearance,
                                   use_destination, least_share,      most_targets};
           }),
           py::kw_only(), "features"_a = defaults.features,
           "finger_clearance"_a = defaults.finger_clearance,
           "open_clearance"_a = defaults.open_clearance,
           "use_destination"_a = defaults.use_destination, "least_share"_a = defaults.least_share,
           "most_targets"_a = defaults.most_targets)
      .def_readwrite("features", &RankingOptions::features)
      .def_readwrite("finger_clearance", &RankingOptions::finger_clearance,
                     "Obstacles this near the finger's layer obstruct it [m].")
      .def_readwrite("open_clearance", &RankingOptions::open_clearance,
                     "The open pads stand this far from the faces [m].")
      .def_readwrite("use_destination", &RankingOptions::use_destination,
                     "False: look at the origin only.")
      .def_readwrite("least_share", &RankingOptions::least_share,
                     "Pairs with less unobstructed are dropped.")
      .def_readwrite("most_targets", &RankingOptions::most_targets);
  py::class_<RankedPair>(m, "RankedPair", "A face pair and what of it stays unobstructed.")
      .def_readonly("pair", &RankedPair::pair, "FacePair.")
      .def_readonly("unobstructed", &RankedPair::unobstructed, "Region in (x, y) of G.")
      .def_readonly("blocked", &RankedPair::blocked,
                    "What obstructs the fingers' layers on and around the overlap, Region.")
      .def_readonly("share", &RankedPair::share, "Unobstructed / overlap area.")
      .def_readonly("share_at_origin", &RankedPair::share_at_origin)
      .def_readonly("score", &RankedPair::score,
                    "share * min(1, unobstructed area / area of a pad).")
      .def_readonly("obstructing", &RankedPair::obstructing, "Names of what obstructs.")
      .def_property_readonly(
          "targets", [](const RankedPair& self) { return rows_of<2>(self.targets); },
          "Fingertip targets in G, best first, (n, 2) [m].")
      .def_readonly("centre_of_mass", &RankedPair::centre_of_mass,
                    "Of the part, in (x, y) of G, (2,) [m].");
  py::class_<Ranking>(m, "Ranking", "A part's face pairs in the order to try them.")
      .def_readonly("ranked", &Ranking::ranked, "RankedPair, best first.")
      .def_readonly("obstructed", &Ranking::obstructed, "Dropped for want of unobstructed area.")
      .def_readonly("rejected", &Ranking::rejected, "RejectedPair.")
      .def_readonly("faces", &Ranking::faces, "How many faces the part has.");
}

Ranking rank(const Cell& cell, int part, const py::object& X_WP_goal, const RankingOptions& options,
             const FeaturePairs* features) {
  const Pose goal = real_pose(X_WP_goal, "X_WP_goal");
  const py::gil_scoped_release unlocked;
  return features != nullptr ? rank_grasps(cell, part, goal, *features, options)
                             : rank_grasps(cell, part, goal, options);
}

void bind_ranking(py::module_& m) {
  bind_ranking_types(m);
  m.def("rank_grasps", &rank, "cell"_a, "part"_a, "X_WP_goal"_a, "options"_a = RankingOptions(),
        py::kw_only(), "features"_a = py::none(),
        R"(Rank a part's face pairs by what stays unobstructed at both ends (article, steps 1-3).

Args:
    cell: Cell.
    part: index in cell.parts.
    X_WP_goal: the part at its destination, (4, 4).
    options: RankingOptions.
    features: FeaturePairs of the part found before, or None; then options.features is not used.

Returns:
    Ranking.

Raises:
    InvalidInput: for an unknown part, a bad pose or bad options.)");
}

void bind_legality_types(py::module_& m) {
  py::class_<GraspScene>(m, "GraspScene", R"(A pick-and-place to plan.

Args:
    model: CollisionModel of the cell.
    cell: Cell with the part at its origin and an empty hand.
    part: index in cell.parts.
    X_WP_goal: the part at its destination, (4, 4).)")
      .def(py::init([](const std::shared_ptr<CollisionModel>& model, const Cell& cell, int part,
                       const py::object& X_WP_goal) {
             return GraspScene{model, cell, part, real_pose(X_WP_goal, "X_WP_goal")};
           }),
           py::kw_only(), py::arg("model").none(false), "cell"_a, "part"_a, "X_WP_goal"_a)
      .def_readonly("cell", &GraspScene::cell)
      .def_readonly("part", &GraspScene::part)
      .def_property_readonly(
          "X_WP_goal", [](const GraspScene& self) { return matrix(self.X_WP_goal); }, "(4, 4)");
  const LegalityOptions defaults;
  py::class_<LegalityOptions>(m, "LegalityOptions", "Options of find_legal_grasps.")
      .def(py::init([](int directions, double open_clearance, double clearance,
                       double least_contact_share, int most_poses) {
             return LegalityOptions{directions, open_clearance, clearance, least_contact_share,
                                    most_poses};
           }),
           py::kw_only(), "directions"_a = defaults.directions,
           "open_clearance"_a = defaults.open_clearance, "clearance"_a = defaults.clearance,
           "least_contact_share"_a = defaults.least_contact_share,
           "most_poses"_a = defaults.most_poses)
      .def_readwrite("directions", &LegalityOptions::directions,
                     "Approach directions per target; those along edges come on top.")
      .def_readwrite("open_clearance", &LegalityOptions::open_clearance,
                     "The open pads stand this far from the faces, where there is room [m].")
      .def_readwrite("clearance", &LegalityOptions::clearance, "Of the whole robot [m].")
      .def_readwrite("least_contact_share", &LegalityOptions::least_contact_share,
                     "Of the pad on the unobstructed area.")
      .def_readwrite("most_poses", &LegalityOptions::most_poses, "Returned per pair.");
  py::class_<GraspPose>(m, "GraspPose", "A grasp with all configurations that are legal for it.")
      .def_readonly("in_plane", &GraspPose::in_plane, "PlanarPose.")
      .def_readonly("flipped", &GraspPose::flipped, "The hand is turned half round.")
      .def_property_readonly(
          "X_PH", [](const GraspPose& self) { return matrix(self.X_PH); },
          "Grasp frame in the part, (4, 4).")
      .def_readonly("width", &GraspPose::width, "Opening when closed on the part [m].")
      .def_readonly("opening", &GraspPose::opening, "Opening while approaching [m].")
      .def_readonly("contact_area", &GraspPose::contact_area, "Of a pad [m2].")
      .def_readonly("merit", &GraspPose::merit, "Larger is better, 0..1.")
      .def_readonly("q_pick", &GraspPose::q_pick, "Legal at the origin: list of (dof,) [rad].")
      .def_readonly("q_place", &GraspPose::q_place, "Legal at the destination.");
  py::class_<LegalGrasps>(m, "LegalGrasps", "Legal grasps of a pair, and why others are not.")
      .def_readonly("poses", &LegalGrasps::poses, "GraspPose, best merit first.")
      .def_readonly("tried", &LegalGrasps::tried, "Candidates looked at.")
      .def_readonly("too_little_contact", &LegalGrasps::too_little_contact)
      .def_readonly("unreachable_at_origin", &LegalGrasps::unreachable_at_origin)
      .def_readonly("unreachable_at_destination", &LegalGrasps::unreachable_at_destination)
      .def_readonly("collides_at_origin", &LegalGrasps::collides_at_origin)
      .def_readonly("collides_at_destination", &LegalGrasps::collides_at_destination)
      .def_readonly("worst_reason", &LegalGrasps::worst_reason, "The reason met most often.");
}

void bind_legality(py::module_& m) {
  bind_legality_types(m);
  m.def("find_legal_grasps", &find_legal_grasps, "scene"_a, "solver"_a, "pair"_a,
        "options"_a = LegalityOptions(), Unlocked(),
        R"(Hand poses on a face pair at which hand and arm are legal at both ends.

Args:
    scene: GraspScene.
    solver: SphericalWristSolver of the scene's robot.
    pair: RankedPair.
    options: LegalityOptions.

Returns:
    LegalGrasps.

Raises:
    InvalidInput: for a scene with a part in the hand, an unknown part, bad options.)");
  m.def("test_grasp_pose", &test_grasp_pose, "scene"_a, "solver"_a, "pair"_a, "pose"_a, "flipped"_a,
        "options"_a = LegalityOptions(), Unlocked(),
        R"(Is one hand pose of a pair legal at both ends?

Args:
    scene: GraspScene.
    solver: SphericalWristSolver of the scene's robot.
    pair: RankedPair.
    pose: PlanarPose.
    flipped: the hand is turned half round.
    options: LegalityOptions.

Returns:
    LegalGrasps with at most one pose.

Raises:
    InvalidInput: as find_legal_grasps.)");
}

}  // namespace

void bind_grasp(py::module_& m) {
  bind_planar_pose(m);
  bind_features(m);
  bind_backproject(m);
  bind_targets(m);
  bind_ranking(m);
  bind_legality(m);
}

}  // namespace handey::bindings
