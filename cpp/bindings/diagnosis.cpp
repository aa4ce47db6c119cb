// Why no grasp is legal at both ends; what stands round one, or in the way of a motion.
#include "handey/grasp/diagnosis.hpp"

#include "configurations.hpp"
#include "handey/approach/enclosure.hpp"
#include "handey/collision/all_hits.hpp"
#include "interruptible.hpp"

namespace handey::bindings {

namespace py = pybind11;
using namespace py::literals;

void bind_diagnosis(py::module_& m) {
  py::class_<GraspObstacle>(m, "GraspObstacle", "Something that stands in the way of hand poses.")
      .def_readonly("kind", &GraspObstacle::kind, "FallKind.")
      .def_readonly("end", &GraspObstacle::end, "GraspEnd.")
      .def_readonly("mover", &GraspObstacle::mover, "Link that met it first, or 'hand'.")
      .def_readonly("body", &GraspObstacle::body, "Of a collision: what was met.")
      .def_readonly("joint", &GraspObstacle::joint, "Index of the joint past its limit; -1: none.")
      .def_readonly("carries", &GraspObstacle::carries, "The part stands on the body at that end.")
      .def_readonly("met", &GraspObstacle::met, "Hand poses in whose way it is.")
      .def_readonly("alone", &GraspObstacle::alone, "Of these those that are legal without it.")
      .def_readonly("in_fewest", &GraspObstacle::in_fewest,
                    "Hand poses of fewest obstacles that have it among them.")
      .def_readonly("least", &GraspObstacle::least,
                    "By how much it is in the way at least [m], of a joint [rad]; -1: not known.")
      .def_property_readonly(
          "X_PH", [](const GraspObstacle& self) { return matrix(self.X_PH); },
          "Grasp frame in the part for which it is so, (4, 4).")
      .def_readonly("opening", &GraspObstacle::opening, "As that hand comes [m].")
      .def_readonly("width", &GraspObstacle::width, "Of that hand, closed on the part [m].");
  py::class_<Diagnosis>(m, "Diagnosis", "What keeps hand poses from being legal at both ends.")
      .def_readonly("looked_at", &Diagnosis::looked_at, "Hand poses that fit the part itself.")
      .def_readonly("misfits", &Diagnosis::misfits, "Hand poses at which the hand meets the part.")
      .def_readonly("legal", &Diagnosis::legal, "Hand poses, at both ends.")
      .def_readonly("fewest", &Diagnosis::fewest, "Obstacles of the hand poses that have fewest.")
      .def_readonly("free_at_origin", &Diagnosis::free_at_origin, "Hand poses legal there.")
      .def_readonly("free_at_destination", &Diagnosis::free_at_destination,
                    "Hand poses legal there.")
      .def_readonly("obstacles", &Diagnosis::obstacles,
                    "GraspObstacle, those first that alone are in the way of most.");
  const DiagnosisOptions defaults;
  m.def(
      "diagnose_grasps",
      [](const GraspScene& scene, const RankingOptions& ranking, const LegalityOptions& legality,
         int most_poses, int most_pairs, double wider) {
        return diagnose_grasps(scene, {ranking, legality, most_poses, most_pairs, wider});
      },
      "scene"_a, py::kw_only(), "ranking"_a = RankingOptions(), "legality"_a = LegalityOptions(),
      "most_poses"_a = defaults.most_poses, "most_pairs"_a = defaults.most_pairs,
      "wider"_a = defaults.wider, Unlocked(),
      R"(What alone keeps most hand poses from being legal at both ends.

Args:
    scene: GraspScene.
    ranking: RankingOptions.
    legality: LegalityOptions.
    most_poses: hand poses looked at.
    most_pairs: pairs of features that they are spread over, the best.
    wider: pairs are looked at that the jaws miss by so much [m].

Returns:
    Diagnosis.

Raises:
    InvalidInput: for a scene with a part in the hand, an unknown part, bad options.)");
  m.def("find_enclosing", &find_enclosing, "checker"_a, "solver"_a, "start"_a, "distance"_a = 0.1,
        Unlocked(),
        R"(What stands round the hand where it is: what it meets that leaves along straight lines.

Args:
    checker: CollisionChecker of the cell, with what is held.
    solver: SphericalWristSolver of the cell's robot.
    start: Configuration.
    distance: length of the lines [m].

Returns:
    Hits, those first that end most of the lines.

Raises:
    InvalidInput: for wrong lengths or numbers out of range.)");
  m.def("find_hits_along", &find_hits_along, "checker"_a, "a"_a, "b"_a, "samples"_a = 64,
        Unlocked(),
        R"(What is met on the straight joint edge between two configurations.

Args:
    checker: CollisionChecker of the cell, with what is held.
    a: Configuration.
    b: Configuration.
    samples: configurations looked at.

Returns:
    Hits, those first that are met at most of them.

Raises:
    InvalidInput: for wrong lengths or numbers out of range.)");
}

}  // namespace handey::bindings
