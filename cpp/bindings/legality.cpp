// Hand poses that are legal at both ends, found at once, in portions, or tested one by one.
#include "handey/grasp/legality.hpp"

#include "configurations.hpp"
#include "handey/collision/checker.hpp"
#include "handey/grasp/blocked_poses.hpp"
#include "interruptible.hpp"

namespace handey::bindings {
namespace {

namespace py = pybind11;
using namespace py::literals;

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
      .def(py::init([](int directions, double spacing, double open_clearance, double clearance,
                       double least_contact_share, double grip_force, double grip_ratio,
                       int most_poses, bool spread) {
             return LegalityOptions{
                 directions, spacing,    open_clearance, clearance, least_contact_share,
                 grip_force, grip_ratio, most_poses,     spread};
           }),
           py::kw_only(), "directions"_a = defaults.directions, "spacing"_a = defaults.spacing,
           "open_clearance"_a = defaults.open_clearance, "clearance"_a = defaults.clearance,
           "least_contact_share"_a = defaults.least_contact_share,
           "grip_force"_a = defaults.grip_force, "grip_ratio"_a = defaults.grip_ratio,
           "most_poses"_a = defaults.most_poses, "spread"_a = defaults.spread)
      .def_readwrite("directions", &LegalityOptions::directions,
                     "Approach directions per target; those along edges come on top.")
      .def_readwrite("spacing", &LegalityOptions::spacing,
                     "Of a lattice of points tried beside the targets; 0: none [m].")
      .def_readwrite("open_clearance", &LegalityOptions::open_clearance,
                     "The open pads stand this far from the faces, where there is room [m].")
      .def_readwrite("clearance", &LegalityOptions::clearance, "Of the whole robot [m].")
      .def_readwrite("least_contact_share", &LegalityOptions::least_contact_share,
                     "Of the pad on the unobstructed features.")
      .def_readwrite("grip_force", &LegalityOptions::grip_force,
                     "Of the jaws, for parts whose mass or density is known [N].")
      .def_readwrite("grip_ratio", &LegalityOptions::grip_ratio,
                     "Friction of both pads over the part's weight where its mass is not known.")
      .def_readwrite("most_poses", &LegalityOptions::most_poses, "Returned per pair.")
      .def_readwrite("spread", &LegalityOptions::spread,
                     "Candidates in an order spread over all of them, not the best first.");
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
  py::enum_<FallKind>(m, "FallKind", "The test at which hand poses fell.")
      .value("TooWide", FallKind::TooWide)
      .value("LittleContact", FallKind::LittleContact)
      .value("Slips", FallKind::Slips)
      .value("Turns", FallKind::Turns)
      .value("OutOfReach", FallKind::OutOfReach)
      .value("JointLimit", FallKind::JointLimit)
      .value("Collision", FallKind::Collision);
  py::enum_<GraspEnd>(m, "GraspEnd", "Where the part stands meanwhile.")
      .value("Both", GraspEnd::Both)
      .value("Origin", GraspEnd::Origin)
      .value("Destination", GraspEnd::Destination);
  py::class_<Fallen>(m, "Fallen", "Hand poses that fell alike, with the nearest of them.")
      .def_readonly("kind", &Fallen::kind)
      .def_readonly("end", &Fallen::end)
      .def_readonly("mover", &Fallen::mover, "Of a collision: link of the robot, or 'hand'.")
      .def_readonly("body", &Fallen::body, "That it met.")
      .def_readonly("joint", &Fallen::joint, "Index of the joint past its limit; -1: none.")
      .def_readonly("count", &Fallen::count)
      .def_readonly("least", &Fallen::least,
                    "By which the nearest missed [m], of a joint [rad]; None: not known.")
      .def_readonly("text", &Fallen::text, "Of the nearest, without its end.")
      .def_property_readonly(
          "X_PH", [](const Fallen& self) { return matrix(self.X_PH); },
          "Grasp frame of the nearest in the part, (4, 4).")
      .def_readonly("opening", &Fallen::opening, "As that hand comes [m]; 0: not looked at.")
      .def_readonly("width", &Fallen::width, "Of that hand, closed on the part [m].");
  py::class_<LegalGrasps>(m, "LegalGrasps", "Legal grasps of a pair, and why others are not.")
      .def_readonly("poses", &LegalGrasps::poses, "GraspPose, best merit first.")
      .def_readonly("tried", &LegalGrasps::tried, "Candidates looked at.")
      .def_readonly("too_little_contact", &LegalGrasps::too_little_contact)
      .def_readonly("would_turn", &LegalGrasps::would_turn,
                    "Where the part's weight would turn it in the jaws.")
      .def_readonly("unreachable_at_origin", &LegalGrasps::unreachable_at_origin)
      .def_readonly("unreachable_at_destination", &LegalGrasps::unreachable_at_destination)
      .def_readonly("collides_at_origin", &LegalGrasps::collides_at_origin)
      .def_readonly("collides_at_destination", &LegalGrasps::collides_at_destination)
      .def_readonly("fallen", &LegalGrasps::fallen, "Fallen, most frequent first.")
      .def_readonly("worst_reason", &LegalGrasps::worst_reason, "The reason met most often.");
}

}  // namespace

void bind_legality(py::module_& m) {
  bind_legality_types(m);
  m.def("find_legal_grasps", &find_legal_grasps, "scene"_a, "solver"_a, "pair"_a,
        "options"_a = LegalityOptions(), Unlocked(),
        R"(Hand poses on a feature pair at which hand and arm are legal at both ends.

Args:
    scene: GraspScene.
    solver: SphericalWristSolver of the scene's robot.
    pair: RankedPair.
    options: LegalityOptions.

Returns:
    LegalGrasps.

Raises:
    InvalidInput: for a scene with a part in the hand, an unknown part, bad options.)");
  py::class_<PoseBlock>(m, "PoseBlock", "What blocks hand poses.")
      .def_readonly("end", &PoseBlock::end, "GraspEnd.")
      .def_readonly("mover", &PoseBlock::mover, "Body of the hand.")
      .def_readonly("body", &PoseBlock::body, "That it is in.");
  py::class_<BlockedPoses, std::shared_ptr<BlockedPoses>>(
      m, "BlockedPoses", R"(Hand poses that are certainly illegal, for the searches of one scene.

Not to be used by several threads at once.

Args:
    scene: GraspScene.

Raises:
    InvalidInput: for a scene with a part in the hand.)")
      .def(py::init<const GraspScene&>(), "scene"_a, Unlocked())
      .def(
          "find",
          [](BlockedPoses& self, const RankedPair& pair, const PlanarPose& middle, bool flipped,
             double shift, double half_turn) {
            return self.find(pair.pair, middle, flipped, {shift, half_turn});
          },
          "pair"_a, "middle"_a, "flipped"_a, py::kw_only(), "shift"_a = 0.0, "half_turn"_a = 0.0,
          Unlocked(), R"(What blocks all hand poses about one.

Args:
    pair: RankedPair.
    middle: PlanarPose.
    flipped: the hand is turned half round.
    shift: that the poses are from the middle at most [m].
    half_turn: that they are turned at most [rad].

Returns:
    PoseBlock, or None where that is not proved.

Raises:
    InvalidInput: E_RANGE, E_NUMBER.)");
  py::class_<LegalGraspSearch>(m, "LegalGraspSearch",
                               R"(find_legal_grasps in portions, for pairs looked at by turns.

Args:
    scene: GraspScene.
    solver: SphericalWristSolver of the scene's robot.
    pair: RankedPair.
    options: LegalityOptions.
    blocked: BlockedPoses of the scene: what it proves to be illegal is not looked at further.

Raises:
    InvalidInput: as find_legal_grasps.)")
      .def(py::init<const GraspScene&, const SphericalWristSolver&, const RankedPair&,
                    const LegalityOptions&, std::shared_ptr<BlockedPoses>>(),
           "scene"_a, "solver"_a, "pair"_a, "options"_a = LegalityOptions(), "blocked"_a = nullptr,
           py::keep_alive<1, 3>(), Unlocked())
      .def_property_readonly("is_done", &LegalGraspSearch::is_done,
                             "No candidate is left, or enough are legal.")
      .def("next", &LegalGraspSearch::next, "candidates"_a, Unlocked(),
           R"(Look at so many candidates more, at most, each with both half-turns of the hand.

Args:
    candidates: at least 1.

Returns:
    The GraspPoses of these that are legal, best merit first.)")
      .def("result", &LegalGraspSearch::result, "LegalGrasps of all candidates so far.");
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

}  // namespace handey::bindings
