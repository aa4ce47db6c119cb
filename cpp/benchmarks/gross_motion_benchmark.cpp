// What gross motion costs and what it is worth: plan_gross_motion beside OMPL's RRT-Connect with
// FCL, in one process, for the same queries in three families of scenes (gross_scenes.hpp), and how
// the time grows with the number of obstacles and with triangles. Every query begins with a cold
// scene: collision geometry is made anew by both; what depends on the robot alone is warm. All
// times are of the processor. Both planners' paths are replayed every 0.25 degrees by a third
// checker (replay.hpp). Usage:
// gross_motion_benchmark MODELS [--family table|clutter|shelf|growth|all] [--queries 50] [--seed 1]
//   [--no-peer] [--verbose]
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "gross_scenes.hpp"
#include "ompl_peer.hpp"
#include "puma560.hpp"
#include "replay.hpp"

using namespace handey;
using benchmark::OmplPeer;
using benchmark::PeerResult;
using benchmark::Query;
using benchmark::Replay;
using benchmark::ReplayResult;
using benchmark::Setting;

namespace {

struct Arguments {
  std::string models = "models", family = "all";
  int queries = 50;
  std::uint64_t seed = 1;
  bool peer = true, verbose = false;
};

// What all queries share: made once per robot.
struct Warm {
  GrossOptions options;
  std::vector<std::pair<int, int>> self_pairs;
  benchmark::PeerRobot peer_robot;
};

struct Outcome {
  bool solved = false, valid = false;
  std::string planner, reason;
  double scene = 0.0, planning = 0.0, shortening = 0.0;  // CPU [ms]; shortening: the peer's
  double length = 0.0;                                   // of the path in joint space [rad]
  double travel = 0.0;                                   // at the velocity limits [s]
  double all() const { return scene + planning + shortening; }
};

double cpu_milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void judge(const Cell& cell, const Query& query, const std::vector<Configuration>& path,
           Replay& replay, Outcome& outcome) {
  outcome.solved = !path.empty();
  if (!outcome.solved) return;
  const ReplayResult result = replay.check(path, query.start, query.goal);
  outcome.valid = result.is_valid();
  if (!outcome.valid) outcome.reason = result.reason;
  for (std::size_t i = 1; i < path.size(); ++i) {
    outcome.length += (path[i].q - path[i - 1].q).norm();
  }
  outcome.travel = travel_time(*cell.robot, path);
}

Outcome run_handey(const Cell& cell, const Query& query, const Warm& warm, Replay& replay) {
  Outcome outcome;
  const double begin = cpu_milliseconds();
  CollisionChecker checker(make_collision_model(cell), cell);
  const double made = cpu_milliseconds();
  const MotionResult result = plan_gross_motion(checker, query.start, {query.goal}, warm.options);
  outcome.planning = cpu_milliseconds() - made;
  outcome.scene = made - begin;
  outcome.planner = result.planner;
  outcome.reason = result.reason;
  judge(cell, query, result.found() ? result.path : std::vector<Configuration>(), replay, outcome);
  return outcome;
}

Outcome run_peer(const Cell& cell, const Query& query, const Warm& warm, Replay& replay) {
  Outcome outcome;
  const double begin = cpu_milliseconds();
  OmplPeer peer(cell, warm.peer_robot);
  outcome.scene = cpu_milliseconds() - begin;
  const PeerResult result = peer.plan(query.start, query.goal);
  outcome.planning = 1e3 * result.planning;
  outcome.shortening = 1e3 * result.simplifying;
  outcome.planner = "OMPL";
  judge(cell, query, result.path, replay, outcome);
  return outcome;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

template <class Value>
std::vector<double> values_of(const std::vector<Outcome>& outcomes, const Value& value) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes) values.push_back(value(outcome));
  return values;
}

template <class Claim>
double percent(const std::vector<Outcome>& outcomes, const Claim& claim) {
  const auto count = std::count_if(outcomes.begin(), outcomes.end(), claim);
  return outcomes.empty()
             ? 0.0
             : 100.0 * static_cast<double>(count) / static_cast<double>(outcomes.size());
}

// Of the paths that were returned.
double percent_valid(const std::vector<Outcome>& outcomes) {
  std::vector<Outcome> solved;
  std::copy_if(outcomes.begin(), outcomes.end(), std::back_inserter(solved),
               [](const Outcome& outcome) { return outcome.solved; });
  return percent(solved, [](const Outcome& outcome) { return outcome.valid; });
}

std::string milliseconds(const std::vector<double>& values) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f / %.1f", quantile(values, 0.5), quantile(values, 0.95));
  return text;
}

struct Measured {
  std::vector<Outcome> handey, peer;
};

// Median over the queries that both solved; 0 without any.
template <class Value>
double median_ratio(const Measured& measured, const Value& value) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < measured.peer.size(); ++i) {
    if (measured.handey[i].solved && measured.peer[i].solved) {
      ratios.push_back(value(measured.handey[i]) / value(measured.peer[i]));
    }
  }
  return quantile(ratios, 0.5);
}

template <class Value>
double median_solved(const std::vector<Outcome>& outcomes, const Value& value) {
  std::vector<double> values;
  for (const Outcome& outcome : outcomes) {
    if (outcome.solved) values.push_back(value(outcome));
  }
  return quantile(values, 0.5);
}

double length_of(const Outcome& outcome) { return outcome.length; }
double travel_of(const Outcome& outcome) { return outcome.travel; }

void print_row(const std::string& name, const char* planner, const std::vector<Outcome>& outcomes,
               const std::string& ratio, const std::string& shares) {
  std::printf(
      "| %s | %s | %.0f %% | %.0f %% | %.2f | %s | %s | %.2f | %.2f | %s | %s |\n", name.c_str(),
      planner, percent(outcomes, [](const Outcome& outcome) { return outcome.solved; }),
      percent_valid(outcomes),
      quantile(values_of(outcomes, [](const Outcome& o) { return o.scene; }), 0.5),
      milliseconds(values_of(outcomes, [](const Outcome& o) { return o.planning; })).c_str(),
      milliseconds(values_of(outcomes, [](const Outcome& o) { return o.all(); })).c_str(),
      median_solved(outcomes, length_of), median_solved(outcomes, travel_of), ratio.c_str(),
      shares.c_str());
}

void print_rows(const std::string& name, const Measured& measured) {
  const auto share = [&](const char* planner) {
    return percent(measured.handey, [planner](const Outcome& outcome) {
      return outcome.solved && outcome.planner == planner;
    });
  };
  const double straight = share("straight"), slices = share("slices");
  const double fallback =
      percent(measured.handey, [](const Outcome& o) { return o.solved; }) - straight - slices;
  char shares[64], ratio[64] = "";
  std::snprintf(shares, sizeof shares, "%.0f / %.0f / %.0f %%", straight, slices, fallback);
  if (!measured.peer.empty()) {
    std::snprintf(ratio, sizeof ratio, "%.2f / %.2f", median_ratio(measured, length_of),
                  median_ratio(measured, travel_of));
  }
  print_row(name, "handey", measured.handey, ratio, shares);
  if (!measured.peer.empty()) print_row("", "OMPL + FCL", measured.peer, "", "");
  std::fflush(stdout);
}

void print_head() {
  std::printf(
      "| scene | planner | solved | valid | CPU ms, scene | CPU ms, planning: median / p95 | CPU "
      "ms, "
      "in all: median / p95 | length [rad] | least travel time [s] | length, time relative to OMPL "
      "| straight / slices / fallback |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
}

void print_query(const std::string& name, std::size_t number, const Query& query,
                 const Outcome& outcome) {
  std::printf("%s %zu: %s %s, %.2f + %.2f + %.2f ms, %.2f rad, %.2f s", name.c_str(), number,
              outcome.planner.c_str(),
              !outcome.solved ? "UNSOLVED" : (outcome.valid ? "valid" : "INVALID"), outcome.scene,
              outcome.planning, outcome.shortening, outcome.length, outcome.travel);
  if (query.inside > 0.0) std::printf(", %.0f mm inside", 1e3 * query.inside);
  std::printf("%s%s\n", outcome.reason.empty() ? "" : ": ", outcome.reason.c_str());
  std::fflush(stdout);
}

Measured measure(const std::string& name, const std::vector<Setting>& scenes, const Warm& warm,
                 const Arguments& arguments, int most_peer_queries = 1000000) {
  Measured measured;
  for (const Setting& scene : scenes) {
    Replay replay(scene.cell, warm.self_pairs);
    for (const Query& query : scene.queries) {
      measured.handey.push_back(run_handey(scene.cell, query, warm, replay));
      const std::size_t number = measured.handey.size();
      if (arguments.verbose) print_query(name, number, query, measured.handey.back());
      if (!arguments.peer || static_cast<int>(number) > most_peer_queries) continue;
      measured.peer.push_back(run_peer(scene.cell, query, warm, replay));
      if (arguments.verbose) print_query(name, number, query, measured.peer.back());
    }
  }
  return measured;
}

void print_depths(const std::vector<Setting>& scenes) {
  std::vector<double> depths;
  for (const Setting& scene : scenes) {
    for (const Query& query : scene.queries) depths.push_back(1e3 * query.inside);
  }
  std::printf(
      "\nIn the shelf the finger tips are %.0f to %.0f mm inside the pigeonhole, median %.0f.\n",
      quantile(depths, 0.0), quantile(depths, 1.0), quantile(depths, 0.5));
}

Warm warm_up(const Robot& robot) {
  GrossOptions options;
  // Whatever is made once per robot and kept, such as the arm's table, belongs here.
  const std::vector<std::pair<int, int>> self_pairs = benchmark::checked_self_pairs(robot);
  return {options, self_pairs, benchmark::PeerRobot(robot, self_pairs)};
}

void measure_families(const Cell& table, const Warm& warm, const Arguments& arguments) {
  const std::vector<std::pair<std::string, decltype(&benchmark::table_family)>> families = {
      {"table", benchmark::table_family},
      {"clutter", benchmark::clutter_family},
      {"shelf", benchmark::shelf_family}};
  std::vector<Setting> shelf;
  if (arguments.family != "growth") print_head();
  for (const auto& family : families) {
    if (arguments.family != "all" && arguments.family != family.first) continue;
    const std::vector<Setting> scenes = family.second(table, arguments.seed, arguments.queries);
    print_rows(family.first, measure(family.first, scenes, warm, arguments));
    if (family.first == "shelf") shelf = scenes;
  }
  if (!shelf.empty()) print_depths(shelf);
}

void measure_growth(const Cell& table, const Warm& warm, const Arguments& arguments) {
  constexpr int kPeerQueries = 20;
  std::printf("\n");
  print_head();
  for (int boxes : {5, 25, 100, 400}) {
    const std::string name = std::to_string(boxes) + " boxes";
    const Setting scene = benchmark::growth_scene(table, arguments.seed, arguments.queries, boxes);
    print_rows(name, measure(name, {scene}, warm, arguments, kPeerQueries));
  }
  const Setting scene = benchmark::tray_scene(table, arguments.seed, arguments.queries);
  print_rows("20 160 triangles", measure("tray", {scene}, warm, arguments, kPeerQueries));
}

Arguments read_arguments(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::runtime_error(word + " needs a value");
      return argv[++i];
    };
    if (word == "--family") {
      arguments.family = value();
    } else if (word == "--queries") {
      arguments.queries = std::stoi(value());
    } else if (word == "--seed") {
      arguments.seed = std::stoull(value());
    } else if (word == "--no-peer") {
      arguments.peer = false;
    } else if (word == "--verbose") {
      arguments.verbose = true;
    } else if (word.rfind("--", 0) == 0) {
      throw std::runtime_error("unknown option " + word +
                               "; there are --family, --queries, --seed, --no-peer, --verbose");
    } else {
      arguments.models = word;
    }
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments arguments = read_arguments(argc, argv);
  OmplPeer::seed(arguments.seed);
  const Cell table = example::table_cell(arguments.models);
  const Warm warm = warm_up(*table.robot);
  measure_families(table, warm, arguments);
  if (arguments.family == "growth" || arguments.family == "all") {
    measure_growth(table, warm, arguments);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
