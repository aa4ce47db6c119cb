// The floor grasp: feature pairs, neighbours at both ends, ranking, fingertip targets.
#include "configurations.hpp"
#include "handey/geometry/polygon.hpp"
#include "handey/grasp/backproject.hpp"
#include "handey/grasp/features.hpp"
#include "handey/grasp/ranking.hpp"
#include "handey/grasp/target.hpp"
#include "handey/kinematics/gripper.hpp"
#include "handey/world/body.hpp"
#include "handey/world/cell.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

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

void bind_feature_kinds(py::module_& m) {
  py::enum_<FeatureKind>(m, "FeatureKind", "What a pad rests on.")
      .value("Face", FeatureKind::Face)
      .value("Edge", FeatureKind::Edge)
      .value("Vertex", FeatureKind::Vertex);
  py::class_<Feature>(m, "Feature", "One of a part's features.")
      .def_readonly("kind", &Feature::kind)
      .def_readonly("index", &Feature::index, "Into FeaturePairs.faces, edges or vertices.")
      .def("__str__", [](const Feature& self) { return to_string(self); });
  py::enum_<PairKind>(m, "PairKind", "How jaws can hold two features, best first.")
      .value("FaceFace", PairKind::FaceFace)
      .value("FaceEdge", PairKind::FaceEdge)
      .value("ParallelEdges", PairKind::ParallelEdges)
      .value("FaceVertex", PairKind::FaceVertex)
      .value("CrossedEdges", PairKind::CrossedEdges);
  py::class_<PartEdge>(m, "PartEdge", "A convex edge, straight.")
      .def_property_readonly(
          "ends",
          [](const PartEdge& self) {
            return rows_of<3>(std::vector<Eigen::Vector3d>{self.from, self.to});
          },
          "In the part, (2, 3) [m].")
      .def_property_readonly(
          "normals",
          [](const PartEdge& self) {
            return rows_of<3>(std::vector<Eigen::Vector3d>{self.normal_a, self.normal_b});
          },
          "Outward, of the faces that meet in it, (2, 3).")
      .def_readonly("face_a", &PartEdge::face_a, "The first of them can be held itself.")
      .def_readonly("face_b", &PartEdge::face_b, "The second of them can be held itself.");
  py::class_<PartVertex>(m, "PartVertex", "A convex corner.")
      .def_readonly("position", &PartVertex::position, "In the part, (3,) [m].")
      .def_property_readonly(
          "rays", [](const PartVertex& self) { return rows_of<3>(self.rays); },
          "Unit vectors along the edges that leave it, (n, 3).");
}

void bind_feature_pair(py::module_& m) {
  py::class_<FeaturePair>(m, "FeaturePair", "Two features that the jaws can hold.")
      .def_readonly("kind", &FeaturePair::kind, "PairKind.")
      .def_readonly("a", &FeaturePair::a, "Feature; a face comes before an edge or a vertex.")
      .def_readonly("b", &FeaturePair::b, "Feature.")
      .def_readonly("width", &FeaturePair::width,
                    "Distance between the features at the origin of G [m].")
      .def_property_readonly(
          "X_PG", [](const FeaturePair& self) { return matrix(self.X_PG); },
          "Grasp plane in the part, (4, 4): midway between the features, z the closing axis.")
      .def_readonly("overlap", &FeaturePair::overlap,
                    "Common area of two faces, else the strip or square that stands for an edge or "
                    "a vertex, in (x, y) of G [m].")
      .def_readonly("area", &FeaturePair::area, "Of the overlap [m2].")
      .def_readonly("strip", &FeaturePair::strip, "Width of the strip; 0 for two faces [m].")
      .def_readonly("contact_a", &FeaturePair::contact_a,
                    "What the pad on a touches, in (x, y) of G; empty for two faces.")
      .def_readonly("contact_b", &FeaturePair::contact_b,
                    "What the pad on b touches, in (x, y) of G; empty for two faces.")
      .def_readonly("taper", &FeaturePair::taper,
                    "How the width grows with x and y of G, (2,) [m/m].")
      .def(
          "width_at",
          [](const FeaturePair& self, const py::object& point) {
            return self.width_at(real_vector<2>(point, "point"));
          },
          "point"_a, "Distance between the features at a point (2,) of G [m].")
      .def("__str__", [](const FeaturePair& self) { return to_string(self); });
  py::enum_<Rejection>(m, "Rejection", "Why the jaws cannot take a pair.")
      .value("TooWide", Rejection::TooWide)
      .value("TooThin", Rejection::TooThin)
      .value("LittleOverlap", Rejection::LittleOverlap);
  py::class_<RejectedPair>(m, "RejectedPair", "A pair that the jaws cannot take, and why.")
      .def_readonly("a", &RejectedPair::a, "Feature.")
      .def_readonly("b", &RejectedPair::b, "Feature.")
      .def_readonly("width", &RejectedPair::width, "[m]")
      .def_readonly("kind", &RejectedPair::kind)
      .def_readonly("by", &RejectedPair::by, "How much is lacking [m]; of an overlap [m2].")
      .def_readonly("reason", &RejectedPair::reason, "For people, with numbers.")
      .def("__str__", [](const RejectedPair& self) { return to_string(self.a, self.b); });
}

void bind_feature_options(py::module_& m) {
  const FeatureOptions defaults;
  py::class_<FeatureOptions>(m, "FeatureOptions", "Options of find_feature_pairs.")
      .def(
          py::init([](double angle, double least_face_area, double least_overlap,
                      double jaw_clearance, bool beyond_faces, double least_edge, double sharp_edge,
                      double friction_use, int most_edges, int most_beyond_faces) {
            return FeatureOptions{angle,        least_face_area,  least_overlap, jaw_clearance,
                                  beyond_faces, least_edge,       sharp_edge,    friction_use,
                                  most_edges,   most_beyond_faces};
          }),
          py::kw_only(), "angle"_a = defaults.angle, "least_face_area"_a = defaults.least_face_area,
          "least_overlap"_a = defaults.least_overlap, "jaw_clearance"_a = defaults.jaw_clearance,
          "beyond_faces"_a = defaults.beyond_faces, "least_edge"_a = defaults.least_edge,
          "sharp_edge"_a = defaults.sharp_edge, "friction_use"_a = defaults.friction_use,
          "most_edges"_a = defaults.most_edges, "most_beyond_faces"_a = defaults.most_beyond_faces)
      .def_readwrite("angle", &FeatureOptions::angle, "Most the normals leave antiparallel [rad].")
      .def_readwrite("least_face_area", &FeatureOptions::least_face_area, "[m2]")
      .def_readwrite("least_overlap", &FeatureOptions::least_overlap, "Of two faces [m2].")
      .def_readwrite("jaw_clearance", &FeatureOptions::jaw_clearance,
                     "The jaws open at least this much wider than the part, each side [m].")
      .def_readwrite("beyond_faces", &FeatureOptions::beyond_faces,
                     "Look for pairs with edges and vertices too.")
      .def_readwrite("least_edge", &FeatureOptions::least_edge, "Shorter edges are left out [m].")
      .def_readwrite("sharp_edge", &FeatureOptions::sharp_edge,
                     "Edges between faces at a smaller angle are left out [rad].")
      .def_readwrite("friction_use", &FeatureOptions::friction_use,
                     "Share of the friction angle that the line between the contacts of two edges "
                     "may lean from the closing axis.")
      .def_readwrite("most_edges", &FeatureOptions::most_edges,
                     "The longest are paired with each other.")
      .def_readwrite("most_beyond_faces", &FeatureOptions::most_beyond_faces,
                     "Pairs with edges or vertices that are kept, the best.");
}

void bind_features(py::module_& m) {
  bind_feature_kinds(m);
  bind_feature_pair(m);
  bind_feature_options(m);
  py::class_<FeaturePairs>(m, "FeaturePairs", "A part's features and the pairs of them.")
      .def_readonly("faces", &FeaturePairs::faces, "PlanarFace of all shapes, in the part frame.")
      .def_readonly("edges", &FeaturePairs::edges, "PartEdge, longest first.")
      .def_readonly("vertices", &FeaturePairs::vertices, "PartVertex.")
      .def_readonly("pairs", &FeaturePairs::pairs,
                    "FeaturePair: two faces, largest overlap first; then the others.")
      .def_readonly("rejected", &FeaturePairs::rejected, "RejectedPair.")
      .def_readonly("beyond_faces", &FeaturePairs::beyond_faces,
                    "Pairs with edges or vertices that the jaws can span, kept or not.");
  m.def("find_feature_pairs", &find_feature_pairs, "part"_a, "gripper"_a,
        "options"_a = FeatureOptions(), Unlocked(),
        R"(Pairs of faces, edges and vertices that a parallel jaw can hold (article, step 1).

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
  py::enum_<PairChoice>(m, "PairChoice", "Which feature pairs are ranked.")
      .value("All", PairChoice::All)
      .value("TwoFaces", PairChoice::TwoFaces)
      .value("BeyondFaces", PairChoice::BeyondFaces);
  const RankingOptions defaults;
  py::class_<RankingOptions>(m, "RankingOptions", "Options of rank_grasps.")
      .def(py::init([](const FeatureOptions& features, double finger_clearance,
                       double open_clearance, bool use_destination, double least_share,
                       int most_targets, PairChoice pairs) {
             return RankingOptions{features,    finger_clearance, open_clearance, use_destination,
                                   least_share, most_targets,     pairs};
           }),
           py::kw_only(), "features"_a = defaults.features,
           "finger_clearance"_a = defaults.finger_clearance,
           "open_clearance"_a = defaults.open_clearance,
           "use_destination"_a = defaults.use_destination, "least_share"_a = defaults.least_share,
           "most_targets"_a = defaults.most_targets, "pairs"_a = defaults.pairs)
      .def_readwrite("features", &RankingOptions::features)
      .def_readwrite("finger_clearance", &RankingOptions::finger_clearance,
                     "Obstacles this near the finger's layer obstruct it [m].")
      .def_readwrite("open_clearance", &RankingOptions::open_clearance,
                     "The open pads stand this far from the faces [m].")
      .def_readwrite("use_destination", &RankingOptions::use_destination,
                     "False: look at the origin only.")
      .def_readwrite("least_share", &RankingOptions::least_share,
                     "Pairs with less unobstructed are dropped.")
      .def_readwrite("most_targets", &RankingOptions::most_targets)
      .def_readwrite("pairs", &RankingOptions::pairs, "PairChoice: which pairs are ranked.");
  py::class_<RankedPair>(m, "RankedPair", "A feature pair and what of it stays unobstructed.")
      .def_readonly("pair", &RankedPair::pair, "FeaturePair.")
      .def_readonly("unobstructed", &RankedPair::unobstructed, "Region in (x, y) of G.")
      .def_readonly("blocked", &RankedPair::blocked,
                    "What obstructs the fingers' layers on and around the overlap, Region.")
      .def_readonly("share", &RankedPair::share, "Unobstructed / overlap area.")
      .def_readonly("share_at_origin", &RankedPair::share_at_origin)
      .def_readonly("score", &RankedPair::score,
                    "share * min(1, unobstructed area / area of a pad) for two faces; others "
                    "a tenth of that or less.")
      .def_readonly("contact_a", &RankedPair::contact_a, "FeaturePair's, unobstructed.")
      .def_readonly("contact_b", &RankedPair::contact_b, "FeaturePair's, unobstructed.")
      .def_readonly("obstructing", &RankedPair::obstructing, "Names of what obstructs.")
      .def_readonly("obstructing_at_origin", &RankedPair::obstructing_at_origin,
                    "Names of bodies that do there.")
      .def_readonly("obstructing_at_destination", &RankedPair::obstructing_at_destination,
                    "Names of bodies that do there.")
      .def_property_readonly(
          "targets", [](const RankedPair& self) { return rows_of<2>(self.targets); },
          "Fingertip targets in G, best first, (n, 2) [m].")
      .def_readonly("centre_of_mass", &RankedPair::centre_of_mass,
                    "Of the part, in (x, y) of G, (2,) [m].");
  py::class_<Ranking>(m, "Ranking", "A part's feature pairs in the order to try them.")
      .def_readonly("ranked", &Ranking::ranked, "RankedPair, best first.")
      .def_readonly("obstructed", &Ranking::obstructed, "Dropped for want of unobstructed area.")
      .def_readonly("rejected", &Ranking::rejected, "RejectedPair.")
      .def_readonly("faces", &Ranking::faces, "How many faces the part has.")
      .def_readonly("edges", &Ranking::edges, "How many edges, if asked for.")
      .def_readonly("vertices", &Ranking::vertices, "How many vertices, if asked for.")
      .def_readonly("beyond_faces", &Ranking::beyond_faces,
                    "Pairs with edges or vertices, ranked or not.");
}

Ranking rank(const Cell& cell, int part, const py::object& X_WP_goal, const RankingOptions& options,
             const FeaturePairs* features) {
  const Pose goal = real_pose(X_WP_goal, "X_WP_goal");
  const Unlock unlock;
  return features != nullptr ? rank_grasps(cell, part, goal, *features, options)
                             : rank_grasps(cell, part, goal, options);
}

void bind_ranking(py::module_& m) {
  bind_ranking_types(m);
  m.def("rank_grasps", &rank, "cell"_a, "part"_a, "X_WP_goal"_a, "options"_a = RankingOptions(),
        py::kw_only(), "features"_a = py::none(),
        R"(Rank a part's feature pairs by what stays unobstructed at both ends (article, steps 1-3).

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

}  // namespace

void bind_grasp(py::module_& m) {
  bind_planar_pose(m);
  bind_features(m);
  bind_backproject(m);
  bind_targets(m);
  bind_ranking(m);
}

}  // namespace handey::bindings
