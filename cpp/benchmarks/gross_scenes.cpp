#include "gross_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

#include "puma560.hpp"

using namespace handey;
using Eigen::Vector3d;

namespace benchmark {
namespace {

constexpr double kClearance = 1e-3;   // of the ends [m]
constexpr double kLeastTravel = 0.3;  // of the hand from start to goal [m]
constexpr int kQueriesPerScene = 10;
constexpr double kBoard = 0.02;  // thickness of the shelf's boards [m]

// The same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(between(0.0, count)); }

 private:
  std::mt19937_64 generator_;
};

Eigen::VectorXd random_joints(const Robot& robot, Random& random) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(robot.joints.size()));
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointLimit& limit = robot.joints[j].limit;
    q(static_cast<Eigen::Index>(j)) = random.between(limit.lower, limit.upper);
  }
  return q;
}

Configuration random_free(CollisionChecker& checker, Random& random) {
  const Robot& robot = *checker.cell().robot;
  for (int attempt = 0; attempt < 100000; ++attempt) {
    const Configuration drawn{random_joints(robot, random), robot.gripper.max_opening};
    if (checker.is_free(drawn, kClearance)) return drawn;
  }
  throw std::runtime_error("no free configuration in this scene");
}

bool are_apart(const Cell& cell, const Configuration& a, const Configuration& b) {
  const Vector3d travel =
      hand_in_world(cell, a.q).translation() - hand_in_world(cell, b.q).translation();
  return travel.norm() >= kLeastTravel;
}

bool is_anywhere(const Vector3d&) { return true; }
// Where work is done: before the robot and less than half a metre over the table.
bool is_at_work(const Vector3d& hand) { return hand.x() > 0.1 && hand.z() > 0.0 && hand.z() < 0.5; }

/// @param is_place where the hand may be at both ends
std::vector<Query> random_queries(const Cell& cell, bool (*is_place)(const Vector3d&),
                                  Random& random, int count) {
  CollisionChecker checker(make_collision_model(cell), cell);
  const auto draw = [&] {
    for (;;) {
      Configuration drawn = random_free(checker, random);
      if (is_place(hand_in_world(cell, drawn.q).translation())) return drawn;
    }
  };
  std::vector<Query> queries;
  while (static_cast<int>(queries.size()) < count) {
    Query query;
    query.start = draw();
    query.goal = draw();
    if (are_apart(cell, query.start, query.goal)) queries.push_back(query);
  }
  return queries;
}

template <class MakeScene>
std::vector<Setting> family(std::uint64_t seed, int queries, const MakeScene& make_scene) {
  std::vector<Setting> scenes;
  for (int done = 0; done < queries; done += kQueriesPerScene) {
    Random random(seed * 1000003 + scenes.size());
    scenes.push_back(make_scene(random, std::min(kQueriesPerScene, queries - done)));
  }
  return scenes;
}

Body random_box(const std::string& name, const Vector3d& least, const Vector3d& most, double radius,
                double angle, double height, Random& random) {
  const Vector3d size(random.between(least.x(), most.x()), random.between(least.y(), most.y()),
                      random.between(least.z(), most.z()));
  return example::box(name, size,
                      example::at(radius * std::cos(angle), radius * std::sin(angle),
                                  0.5 * size.z() + height, random.between(0.0, 1.0)));
}

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

// Finger tips in the plane of the pads' far ends.
Vector3d finger_tips(const Cell& cell, const Eigen::VectorXd& q) {
  return hand_in_world(cell, q) * Vector3d(0.0, 0.0, 0.5 * cell.robot->gripper.pad_length);
}

// Can the hand be drawn straight back from the pose, at no less than the clearance, until the
// finger tips are out by 2 cm?
bool can_be_drawn_out(CollisionChecker& checker, const SphericalWristSolver& solver,
                      const Configuration& inside, double depth) {
  std::vector<Pose> poses;
  const Pose X_RH = hand_pose(*checker.cell().robot, inside.q);
  for (double back = 0.005; back < depth + 0.02; back += 0.005) {
    poses.push_back(X_RH * Eigen::Translation3d(0.0, 0.0, -back));
  }
  const HandPathResult way = follow_hand_path(solver, poses, inside.q);
  return way.complete && std::all_of(way.path.begin(), way.path.end(), [&](const auto& q) {
           return checker.is_free({q, inside.opening}, kClearance);
         });
}

struct InHole {
  Configuration configuration;
  int hole = 0;
  double inside = 0.0;  // finger tips beyond the entry [m]
};

InHole random_in_hole(CollisionChecker& checker, const SphericalWristSolver& solver,
                      const Shelf& shelf, Random& random) {
  const Robot& robot = *checker.cell().robot;
  const double tip = 0.5 * robot.gripper.pad_length;
  for (int attempt = 0; attempt < 100000; ++attempt) {
    InHole drawn;
    drawn.hole = random.below(shelf.columns * shelf.rows);
    const double depth = random.between(0.08, 0.20);
    const Vector3d p_tips =
        shelf.centre_of_entry(drawn.hole % shelf.columns, drawn.hole / shelf.columns) +
        Vector3d(depth, random.between(-0.03, 0.03), random.between(-0.03, 0.03));
    // The jaws close across or upright, give or take 20 degrees; the hand points 5 degrees off.
    const double roll = 1.5707963267948966 * random.below(4) + random.between(-0.35, 0.35);
    Pose X_WH = pose_from_xyz_rpy(p_tips, {0.0, 1.5707963267948966 + random.between(-0.09, 0.09),
                                           random.between(-0.09, 0.09)});
    X_WH.rotate(Eigen::AngleAxisd(roll, Vector3d::UnitZ()));
    X_WH.translate(Vector3d(0.0, 0.0, -tip));
    const InverseResult inverse = solver.solve(checker.cell().X_WR.inverse() * X_WH);
    if (inverse.solutions.empty()) continue;
    const int pick = random.below(static_cast<int>(inverse.solutions.size()));
    drawn.configuration = {inverse.solutions[static_cast<std::size_t>(pick)].q,
                           robot.gripper.max_opening};
    if (!checker.is_free(drawn.configuration, kClearance)) continue;
    if (!can_be_drawn_out(checker, solver, drawn.configuration, depth)) continue;
    drawn.inside = finger_tips(checker.cell(), drawn.configuration.q).x() - shelf.front;
    return drawn;
  }
  throw std::runtime_error("the hand fits into none of the pigeonholes");
}

Query shelf_query(CollisionChecker& checker, const SphericalWristSolver& solver, const Shelf& shelf,
                  bool both_inside, Random& random) {
  for (;;) {
    const InHole inside = random_in_hole(checker, solver, shelf, random);
    Configuration other;
    if (both_inside) {
      const InHole second = random_in_hole(checker, solver, shelf, random);
      if (second.hole == inside.hole) continue;
      other = second.configuration;
    } else {
      other = random_free(checker, random);
      if (finger_tips(checker.cell(), other.q).x() > shelf.front - 0.05) continue;
    }
    if (!are_apart(checker.cell(), inside.configuration, other)) continue;
    const bool ends_inside = random.below(2) == 0;
    return ends_inside ? Query{other, inside.configuration, inside.inside}
                       : Query{inside.configuration, other, inside.inside};
  }
}

// Both sheets of the tray have the same grid; z of the upper one is the wave, or the rim.
MeshShape wavy_tray() {
  constexpr int kCells = 70;
  constexpr double kLength = 0.6, kWidth = 0.5;
  TriangleMesh mesh;
  const auto vertex = [](int sheet, int i, int j) {
    return sheet * (kCells + 1) * (kCells + 1) + i * (kCells + 1) + j;
  };
  for (int sheet = 0; sheet < 2; ++sheet) {
    for (int i = 0; i <= kCells; ++i) {
      for (int j = 0; j <= kCells; ++j) {
        const double u = static_cast<double>(i) / kCells, v = static_cast<double>(j) / kCells;
        const bool rim = std::min({i, j, kCells - i, kCells - j}) <= 2;
        const double wave = 0.04 + 0.025 * std::sin(25.0 * u) * std::cos(21.0 * v);
        mesh.vertices.emplace_back(kLength * (u - 0.5), kWidth * (v - 0.5),
                                   sheet == 0 ? 0.001 : (rim ? 0.12 : wave));
      }
    }
  }
  const auto quad = [&mesh](int a, int b, int c, int d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      quad(vertex(1, i, j), vertex(1, i + 1, j), vertex(1, i + 1, j + 1), vertex(1, i, j + 1));
      quad(vertex(0, i, j), vertex(0, i, j + 1), vertex(0, i + 1, j + 1), vertex(0, i + 1, j));
    }
    quad(vertex(0, i, 0), vertex(0, i + 1, 0), vertex(1, i + 1, 0), vertex(1, i, 0));
    quad(vertex(0, i + 1, kCells), vertex(0, i, kCells), vertex(1, i, kCells),
         vertex(1, i + 1, kCells));
    quad(vertex(0, 0, i + 1), vertex(0, 0, i), vertex(1, 0, i), vertex(1, 0, i + 1));
    quad(vertex(0, kCells, i), vertex(0, kCells, i + 1), vertex(1, kCells, i + 1),
         vertex(1, kCells, i));
  }
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), true};
}

}  // namespace

std::vector<Setting> table_family(const Cell& table, std::uint64_t seed, int queries) {
  return family(seed, queries, [&](Random& random, int count) {
    Setting scene{table, {}};
    for (int i = 0; i < 5; ++i) {
      const double radius = random.between(0.4, 0.8), angle = random.between(-1.1, 1.1);
      scene.cell.fixtures.push_back(random_box("box " + std::to_string(i), {0.08, 0.08, 0.1},
                                               {0.25, 0.25, 0.4}, radius, angle, 0.0, random));
    }
    scene.queries = random_queries(scene.cell, is_at_work, random, count);
    return scene;
  });
}

std::vector<Setting> clutter_family(const Cell& table, std::uint64_t seed, int queries) {
  return family(seed + 1, queries, [&](Random& random, int count) {
    Setting scene{table, {}};
    for (int i = 0; i < 24; ++i) {
      const double radius = random.between(0.35, 0.8), angle = random.between(-2.2, 2.2);
      const double height = random.between(0.0, 0.9);
      scene.cell.fixtures.push_back(random_box("box " + std::to_string(i), Vector3d::Constant(0.05),
                                               Vector3d::Constant(0.15), radius, angle, height,
                                               random));
    }
    scene.queries = random_queries(scene.cell, is_anywhere, random, count);
    return scene;
  });
}

std::vector<Setting> shelf_family(const Cell& table, std::uint64_t seed, int queries) {
  const SphericalWristSolver solver(*table.robot);
  return family(seed + 2, queries, [&](Random& random, int count) {
    Shelf shelf;
    shelf.front = random.between(0.55, 0.68);
    shelf.width = random.between(0.22, 0.26);
    shelf.right = -0.5 * shelf.columns * (shelf.width + kBoard) + random.between(-0.1, 0.1);
    shelf.bottom = random.between(0.05, 0.35);
    Setting scene{table, {}};
    for (Body& body : shelf.bodies()) scene.cell.fixtures.push_back(std::move(body));
    CollisionChecker checker(make_collision_model(scene.cell), scene.cell);
    for (int i = 0; i < count; ++i) {
      scene.queries.push_back(shelf_query(checker, solver, shelf, i % 5 == 4, random));
    }
    return scene;
  });
}

Setting growth_scene(const Cell& table, std::uint64_t seed, int queries, int boxes) {
  constexpr int kMost = 400;
  Random random(seed * 1000003 + 500009);
  Setting scene{table, {}};
  for (int i = 0; i < kMost; ++i) {
    const bool stands = i % 2 == 0;
    const double radius = stands ? random.between(0.35, 0.7) : random.between(0.95, 1.5);
    const double angle = stands ? random.between(-1.3, 1.3) : random.between(-2.6, 2.6);
    const double height = stands ? 0.0 : random.between(0.0, 1.4);
    scene.cell.fixtures.push_back(random_box("box " + std::to_string(i), Vector3d::Constant(0.02),
                                             {0.06, 0.06, 0.12}, radius, angle, height, random));
  }
  scene.queries = random_queries(scene.cell, is_at_work, random, queries);
  scene.cell.fixtures.resize(table.fixtures.size() + static_cast<std::size_t>(boxes));
  return scene;
}

Setting tray_scene(const Cell& table, std::uint64_t seed, int queries) {
  Random random(seed * 1000003 + 600011);
  Setting scene{table, {}};
  Body tray;
  tray.name = "tray";
  tray.shapes = {Shape{wavy_tray(), Pose::Identity()}};
  tray.X_WB = example::at(0.6, 0.0, 0.0);
  scene.cell.fixtures.push_back(std::move(tray));
  scene.queries = random_queries(scene.cell, is_at_work, random, queries);
  return scene;
}

}  // namespace benchmark
