// The pigeonholes, and hands in them.
#include <stdexcept>

#include "gross_scenes.hpp"
#include "puma560.hpp"
#include "query_drawing.hpp"
#include "roadmap.hpp"

using namespace handey;
using Eigen::Vector3d;

namespace benchmark {
namespace {

constexpr double kBoard = 0.02;                  // thickness of the shelf's boards [m]
constexpr double kQuarter = 1.5707963267948966;  // turn [rad]

// Pigeonholes open towards the robot, in the plane x = front; y to the left, z up.
struct Shelf {
  double front = 0.6, depth = 0.32, width = 0.24, height = 0.25;
  double right = -0.4, bottom = 0.2;  // outer faces of the first upright and the first board [m]
  int columns = 3, rows = 3;

  Vector3d centre_of_entry(int column, int row) const {
    return {front, right + kBoard + 0.5 * width + column * (width + kBoard),
            bottom + kBoard + 0.5 * height + row * (height + kBoard)};
  }
  std::vector<Body> bodies() const {
    const double across = columns * (width + kBoard) + kBoard;
    const double tall = rows * (height + kBoard) + kBoard;
    const double x = front + 0.5 * depth, y = right + 0.5 * across, z = bottom + 0.5 * tall;
    std::vector<Body> result;
    for (int i = 0; i <= columns; ++i) {
      result.push_back(
          example::box("upright " + std::to_string(i), {depth, kBoard, tall},
                       example::at(x, right + 0.5 * kBoard + i * (width + kBoard), z)));
    }
    for (int i = 0; i <= rows; ++i) {
      result.push_back(
          example::box("board " + std::to_string(i), {depth, across, kBoard},
                       example::at(x, y, bottom + 0.5 * kBoard + i * (height + kBoard))));
    }
    result.push_back(example::box("back", {kBoard, across, tall},
                                  example::at(front + depth + 0.5 * kBoard, y, z)));
    return result;
  }
};

// A configuration with the hand in a pigeonhole, and the one that it is drawn straight back to.
struct InHole {
  Configuration inside, outside;
  int hole = 0;
  double depth = 0.0;  // of the finger tips beyond the entry [m]
};

class ShelfQueries {
 public:
  ShelfQueries(CollisionChecker& checker, const Shelf& shelf)
      : checker_(checker),
        solver_(*checker.cell().robot),
        shelf_(shelf),
        roadmap_(checker, kRoadmapSeed) {}

  Query draw(bool both_inside, Random& random) {
    for (;;) {
      const InHole hole = draw_in_hole(random);
      InHole other;
      if (both_inside) {
        other = draw_in_hole(random);
        if (other.hole == hole.hole) continue;
      } else {
        other.inside = other.outside = random_free(checker_, random);
        if (tips(other.inside).x() > shelf_.front - 0.05) continue;
      }
      if (!are_apart(checker_.cell(), hole.inside, other.inside)) continue;
      if (!roadmap_.knows_way(hole.outside, other.outside)) continue;
      const bool ends_inside = random.below(2) == 0;
      return ends_inside ? Query{other.inside, hole.inside, hole.depth}
                         : Query{hole.inside, other.inside, hole.depth};
    }
  }

 private:
  Vector3d tips(const Configuration& configuration) const {
    const double ahead = 0.5 * checker_.cell().robot->gripper.pad_length;
    return hand_in_world(checker_.cell(), configuration.q) * Vector3d(0.0, 0.0, ahead);
  }

  // The jaws close across or upright, give or take 20 degrees; the hand points up to 5 degrees off.
  Pose draw_hand(int hole, Random& random) const {
    const Vector3d p_tips = shelf_.centre_of_entry(hole % shelf_.columns, hole / shelf_.columns) +
                            Vector3d(random.between(0.08, 0.20), random.between(-0.03, 0.03),
                                     random.between(-0.03, 0.03));
    Pose X_WH = pose_from_xyz_rpy(
        p_tips, {0.0, kQuarter + random.between(-0.09, 0.09), random.between(-0.09, 0.09)});
    X_WH.rotate(Eigen::AngleAxisd(kQuarter * random.below(4) + random.between(-0.35, 0.35),
                                  Vector3d::UnitZ()));
    X_WH.translate(Vector3d(0.0, 0.0, -0.5 * checker_.cell().robot->gripper.pad_length));
    return X_WH;
  }

  InHole draw_in_hole(Random& random) {
    const Cell& cell = checker_.cell();
    for (int attempt = 0; attempt < 100000; ++attempt) {
      InHole drawn;
      drawn.hole = random.below(shelf_.columns * shelf_.rows);
      const InverseResult inverse =
          solver_.solve(cell.X_WR.inverse() * draw_hand(drawn.hole, random));
      if (inverse.solutions.empty()) continue;
      const int pick = random.below(static_cast<int>(inverse.solutions.size()));
      drawn.inside = {inverse.solutions[static_cast<std::size_t>(pick)].q,
                      cell.robot->gripper.max_opening};
      drawn.depth = tips(drawn.inside).x() - shelf_.front;
      if (checker_.is_free(drawn.inside, kEndClearance) && draw_out(drawn)) return drawn;
    }
    throw std::runtime_error("the hand fits into none of the pigeonholes");
  }

  // Straight back until the finger tips are out by 2 cm; false if that is not proved to be free.
  bool draw_out(InHole& hole) {
    std::vector<Pose> poses;
    const Pose X_RH = hand_pose(*checker_.cell().robot, hole.inside.q);
    for (double back = 0.005; back < hole.depth + 0.025; back += 0.005) {
      poses.push_back(X_RH * Eigen::Translation3d(0.0, 0.0, -back));
    }
    const HandPathResult way = follow_hand_path(solver_, poses, hole.inside.q);
    if (!way.complete) return false;
    std::vector<Configuration> path = {hole.inside};
    for (const Eigen::VectorXd& q : way.path) path.push_back({q, hole.inside.opening});
    hole.outside = path.back();
    return certify_path(checker_, path).is_free();
  }

  CollisionChecker& checker_;
  SphericalWristSolver solver_;
  Shelf shelf_;
  Roadmap roadmap_;
};

}  // namespace

std::vector<Setting> shelf_family(const Cell& table, std::uint64_t seed, int queries) {
  return draw_settings(seed + 2, queries, [&](Random& random, int count) {
    Shelf shelf;
    shelf.front = random.between(0.55, 0.68);
    shelf.width = random.between(0.22, 0.26);
    shelf.right = -0.5 * shelf.columns * (shelf.width + kBoard) + random.between(-0.1, 0.1);
    shelf.bottom = random.between(0.05, 0.35);
    Setting scene{table, {}};
    for (Body& body : shelf.bodies()) scene.cell.fixtures.push_back(std::move(body));
    CollisionChecker checker(make_collision_model(scene.cell), scene.cell);
    ShelfQueries generator(checker, shelf);
    for (int i = 0; i < count; ++i) {
      scene.queries.push_back(generator.draw(i % 5 == 4, random));
    }
    return scene;
  });
}

}  // namespace benchmark
