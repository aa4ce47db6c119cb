#include "gross_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "puma560.hpp"
#include "query_drawing.hpp"
#include "roadmap.hpp"

using namespace handey;
using Eigen::Vector3d;

namespace benchmark {
namespace {

// Choice: free space falls into parts in this one; three fifths of random pairs are apart.
constexpr std::uint64_t kPocketScene = 2000007;
constexpr double kQuarter = 1.5707963267948966;  // turn [rad]

bool is_anywhere(const Vector3d&) { return true; }
// Where work is done: before the robot and less than half a metre over the table.
bool is_at_work(const Vector3d& hand) { return hand.x() > 0.1 && hand.z() > 0.0 && hand.z() < 0.5; }

struct Wanted {
  bool (*is_place)(const Vector3d&) = is_anywhere;  // where the hand may be at both ends
  const Cell* blocked_in = nullptr;                 // the straight edge is blocked in this cell
  bool way = true;                                  // one is known, or none is known
};

std::vector<Query> random_queries(const Cell& cell, const Wanted& wanted, Random& random,
                                  int count) {
  CollisionChecker checker(make_collision_model(cell), cell);
  const Cell& fewer_bodies = wanted.blocked_in ? *wanted.blocked_in : cell;
  CollisionChecker fewer(make_collision_model(fewer_bodies), fewer_bodies);
  const auto draw = [&] {
    for (;;) {
      Configuration drawn = random_free(checker, random);
      if (wanted.is_place(hand_in_world(cell, drawn.q).translation())) return drawn;
    }
  };
  Roadmap roadmap(checker, kRoadmapSeed);
  std::vector<Query> queries;
  while (static_cast<int>(queries.size()) < count) {
    Query query;
    query.start = draw();
    query.goal = draw();
    if (!are_apart(cell, query.start, query.goal)) continue;
    if (wanted.blocked_in && certify_edge(fewer, query.start, query.goal).is_free()) continue;
    if (roadmap.knows_way(query.start, query.goal) == wanted.way) queries.push_back(query);
  }
  return queries;
}

Body random_box(const std::string& name, const Vector3d& least, const Vector3d& most, double radius,
                double angle, double height, Random& random) {
  const Vector3d size(random.between(least.x(), most.x()), random.between(least.y(), most.y()),
                      random.between(least.z(), most.z()));
  return example::box(name, size,
                      example::at(radius * std::cos(angle), radius * std::sin(angle),
                                  0.5 * size.z() + height, random.between(0.0, 1.0)));
}

void add_boxes_on_table(Cell& cell, Random& random) {
  for (int i = 0; i < 5; ++i) {
    const double radius = random.between(0.4, 0.8), angle = random.between(-1.1, 1.1);
    cell.fixtures.push_back(random_box("box " + std::to_string(i), {0.08, 0.08, 0.1},
                                       {0.25, 0.25, 0.4}, radius, angle, 0.0, random));
  }
}

void add_clutter(Cell& cell, Random& random) {
  for (int i = 0; i < 24; ++i) {
    const double radius = random.between(0.35, 0.8), angle = random.between(-2.2, 2.2);
    const double height = random.between(0.0, 0.9);
    cell.fixtures.push_back(random_box("box " + std::to_string(i), Vector3d::Constant(0.05),
                                       Vector3d::Constant(0.15), radius, angle, height, random));
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
  return draw_settings(seed, queries, [&](Random& random, int count) {
    Setting setting{table, {}};
    add_boxes_on_table(setting.cell, random);
    setting.queries = random_queries(setting.cell, {is_at_work}, random, count);
    return setting;
  });
}

std::vector<Setting> clutter_family(const Cell& table, std::uint64_t seed, int queries) {
  return draw_settings(seed + 1, queries, [&](Random& random, int count) {
    Setting setting{table, {}};
    add_clutter(setting.cell, random);
    setting.queries = random_queries(setting.cell, {}, random, count);
    return setting;
  });
}

Setting pocket_setting(const Cell& table, std::uint64_t seed, int queries) {
  Random random(kPocketScene);
  Setting setting{table, {}};
  add_clutter(setting.cell, random);
  random = Random(seed);
  setting.queries = random_queries(setting.cell, {is_anywhere, nullptr, false}, random, queries);
  return setting;
}

std::vector<Setting> growth_settings(const Cell& table, std::uint64_t seed, int queries,
                                     const std::vector<int>& counts) {
  Random random(seed * 1000003 + 500009);
  Setting most{table, {}};
  add_boxes_on_table(most.cell, random);
  const Cell fewest = most.cell;
  for (int i = 5; i < *std::max_element(counts.begin(), counts.end()); ++i) {
    const bool stands = i % 2 == 0;
    const double radius = stands ? random.between(0.35, 0.7) : random.between(0.95, 1.5);
    const double angle = stands ? random.between(-1.3, 1.3) : random.between(-2.6, 2.6);
    const double height = stands ? 0.0 : random.between(0.0, 1.4);
    most.cell.fixtures.push_back(random_box("box " + std::to_string(i), Vector3d::Constant(0.02),
                                            {0.06, 0.06, 0.12}, radius, angle, height, random));
  }
  most.queries = random_queries(most.cell, {is_at_work, &fewest}, random, queries);
  std::vector<Setting> settings;
  for (int count : counts) {
    settings.push_back(most);
    settings.back().cell.fixtures.resize(table.fixtures.size() + static_cast<std::size_t>(count));
  }
  return settings;
}

Setting tray_setting(const Cell& table, std::uint64_t seed, int queries) {
  Random random(seed * 1000003 + 600011);
  Setting setting{table, {}};
  Body tray;
  tray.name = "tray";
  tray.shapes = {Shape{wavy_tray(), Pose::Identity()}};
  tray.X_WB = pose_from_xyz_rpy({0.62, 0.0, 0.31}, {0.0, -kQuarter, 0.0});
  setting.cell.fixtures.push_back(std::move(tray));
  setting.queries = random_queries(setting.cell, {is_at_work, &setting.cell}, random, queries);
  return setting;
}

}  // namespace benchmark
