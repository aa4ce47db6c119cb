// What a slice over the whole range of the first three joints costs, and how much of the free space
// it finds: time of the scene's description and all layers, the scene cold, what depends on the
// robot alone warm (its table, its collision model), and recall, the share of
// configurations of the first three joints, free at all of 24 wrist values sampled from the range,
// that lie in free cells. By family of scenes, mode and resolution; the wrist's range is that
// between the ends of a query, or a small one. Usage: slice_benchmark MODELS [SCENES]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "gross_scenes.hpp"
#include "puma560.hpp"

using namespace handey;

namespace {

constexpr int kWristSamples = 24;
constexpr int kRecallSamples = 1500;

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

WristRange wrist_between(const Configuration& a, const Configuration& b) {
  const Eigen::VectorXd one = a.q.tail(a.q.size() - 3), two = b.q.tail(b.q.size() - 3);
  return {one.cwiseMin(two), one.cwiseMax(two)};
}

/// A turn of joint 4 and 5 by 30 degrees, of joint 6 by 60.
WristRange small_range(const Configuration& a) {
  const double degree = std::acos(-1.0) / 180.0;
  const Eigen::Vector3d middle = a.q.tail<3>(), half = degree * Eigen::Vector3d(15, 15, 30);
  return {middle - half, middle + half};
}

/// Of the first query over whose range the hand is proved to keep clear of the arm; false: of none.
bool find_range(CollisionChecker& checker, const std::shared_ptr<const ArmTable>& table,
                const std::vector<benchmark::Query>& queries, bool small, WristRange& range) {
  for (const benchmark::Query& query : queries) {
    range = small ? small_range(query.start) : wrist_between(query.start, query.goal);
    if (Slice(checker, table, range, checker.cell().start.opening).reason().empty()) return true;
  }
  return false;
}

/// Configurations of the first three joints that are free at all sampled wrist values.
std::vector<Eigen::Vector3d> free_samples(CollisionChecker& checker, const WristRange& wrist,
                                          double opening, std::mt19937_64& random) {
  const Robot& robot = *checker.cell().robot;
  const auto draw = [&random](double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  };
  std::vector<Eigen::Vector3d> samples;
  for (int tried = 0; tried < 40 * kRecallSamples && samples.size() < kRecallSamples; ++tried) {
    Configuration q{Eigen::VectorXd(static_cast<Eigen::Index>(robot.joints.size())), opening};
    for (Eigen::Index j = 0; j < 3; ++j) {
      const JointLimit& limit = robot.joints[static_cast<std::size_t>(j)].limit;
      q.q(j) = draw(limit.lower, limit.upper);
    }
    bool free = true;
    for (int i = 0; i < kWristSamples && free; ++i) {
      for (Eigen::Index j = 3; j < q.q.size(); ++j) {
        q.q(j) = draw(wrist.lower(j - 3), wrist.upper(j - 3));
      }
      free = checker.is_free(q);
    }
    if (free) samples.emplace_back(q.q.head<3>());
  }
  return samples;
}

struct Row {
  std::vector<double> ms;
  long samples = 0, found = 0, cells = 0, free_cells = 0;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

void measure(const Cell& cell, const std::shared_ptr<const CollisionModel>& robot,
             const std::shared_ptr<const ArmTable>& table, const WristRange& wrist, SliceMode mode,
             const std::vector<Eigen::Vector3d>& samples, Row& row) {
  SliceOptions options;
  options.mode = mode;
  CollisionChecker checker(make_collision_model(cell, robot), cell);
  const double begin = cpu_ms();
  Slice slice(checker, table, wrist, cell.start.opening, options);
  const int layers = slice.lattice().cells(slice.level(), 0);
  for (int layer = 0; layer < layers; ++layer) slice.blocked(layer);
  row.ms.push_back(cpu_ms() - begin);
  const Lattice& lattice = slice.lattice();
  for (const Eigen::Vector3d& q : samples) {
    CellIndex cell;
    for (int j = 0; j < 3; ++j) {
      cell[static_cast<std::size_t>(j)] = lattice.index_of(slice.level(), j, q(j));
    }
    ++row.samples;
    if (slice.is_free(cell)) ++row.found;
  }
  for (int layer = 0; layer < layers; ++layer) {
    for (const std::uint64_t word : slice.blocked(layer)) {
      for (std::uint64_t free = ~word; free != 0; free &= free - 1) ++row.free_cells;
    }
  }
  row.cells +=
      static_cast<long>(layers) * lattice.cells(slice.level(), 1) * lattice.cells(slice.level(), 2);
}

void print(const char* family, const char* wrist, const char* mode, int level, const Row& row) {
  std::printf(
      "| %s | %s | %s | %d | %.2f | %.1f %% | %.1f %% |\n", family, wrist, mode, 8 >> level,
      median(row.ms),
      100.0 * static_cast<double>(row.found) / static_cast<double>(std::max(1L, row.samples)),
      100.0 * static_cast<double>(row.free_cells) / static_cast<double>(std::max(1L, row.cells)));
}

}  // namespace

int main(int argc, char** argv) {
  const Cell table_cell = example::table_cell(argc > 1 ? argv[1] : "models");
  const int scenes = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<std::shared_ptr<const ArmTable>> tables;
  for (int level = 0; level < 3; ++level) {
    ArmTableOptions options;
    options.level = level;
    const double begin = cpu_ms();
    tables.push_back(make_arm_table(*table_cell.robot, options));
    std::printf("table of %d degrees made in %.1f ms\n", 8 >> level, cpu_ms() - begin);
  }
  std::printf("\n| scenes | wrist | mode | degrees | CPU ms, median | recall | free cells |\n");
  std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
  struct Family {
    const char* name;
    std::vector<benchmark::Setting> settings;
  };
  const Family families[] = {{"table", benchmark::table_family(table_cell, 1, 10 * scenes)},
                             {"clutter", benchmark::clutter_family(table_cell, 1, 10 * scenes)},
                             {"shelf", benchmark::shelf_family(table_cell, 1, 10 * scenes)}};
  std::mt19937_64 random(7);
  for (const Family& family : families) {
    for (const bool small : {true, false}) {
      Row rows[2][3];
      for (const benchmark::Setting& setting : family.settings) {
        const std::shared_ptr<const CollisionModel> model = make_collision_model(setting.cell);
        CollisionChecker checker(model, setting.cell);
        WristRange wrist;
        if (!find_range(checker, tables[0], setting.queries, small, wrist)) continue;
        const std::vector<Eigen::Vector3d> samples =
            free_samples(checker, wrist, setting.cell.start.opening, random);
        for (int level = 0; level < 3; ++level) {
          for (const SliceMode mode : {SliceMode::Cells, SliceMode::Article}) {
            measure(setting.cell, model, tables[static_cast<std::size_t>(level)], wrist, mode,
                    samples, rows[static_cast<int>(mode)][level]);
          }
        }
      }
      for (int level = 0; level < 3; ++level) {
        print(family.name, small ? "small" : "query", "cells", level, rows[0][level]);
        print(family.name, small ? "small" : "query", "article", level, rows[1][level]);
      }
    }
  }
  return 0;
}
