// What gross motion costs and what it is worth: plan_gross_motion beside OMPL's RRT-Connect with
// FCL, in one process, for the same queries in three families of scenes (gross_scenes.hpp), and how
// the time grows with the number of obstacles and with triangles. Every query begins with a cold
// scene: collision geometry is made anew by both; what depends on the robot alone is warm. All
// times are of the processor. Both planners' paths are replayed every 0.25 degrees by a third
// checker (replay.hpp). Usage:
// gross_motion_benchmark MODELS [--family table|clutter|shelf|pockets|growth|all] [--queries 50]
//   [--seed 1] [--no-peer] [--verbose]
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gross_report.hpp"
#include "gross_scenes.hpp"
#include "ompl_peer.hpp"
#include "puma560.hpp"
#include "replay.hpp"

using namespace handey;
using benchmark::Measured;
using benchmark::OmplPeer;
using benchmark::Outcome;
using benchmark::Query;
using benchmark::Replay;
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
  std::shared_ptr<const CollisionModel>
      model;  ///< what depends on the robot alone is taken from it
  GrossOptions options;
  std::vector<std::pair<int, int>> self_pairs;
  benchmark::PeerRobot peer_robot;
};

// What is made once per robot and kept.
Warm warm_up(const Cell& cell) {
  const Robot& robot = *cell.robot;
  GrossOptions options;
  options.free_space.table = make_arm_table(robot);
  const std::vector<std::pair<int, int>> self_pairs = benchmark::checked_self_pairs(robot);
  return {make_collision_model(cell), options, self_pairs, benchmark::PeerRobot(robot, self_pairs)};
}

double cpu_milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void judge(const Cell& cell, const Query& query, const std::vector<Configuration>& path,
           Replay& replay, Outcome& outcome) {
  outcome.solved = !path.empty();
  if (!outcome.solved) return;
  const benchmark::ReplayResult result = replay.check(path, query.start, query.goal);
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
  CollisionChecker checker(make_collision_model(cell, warm.model), cell);
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
  const benchmark::PeerResult result = peer.plan(query.start, query.goal);
  outcome.planning = 1e3 * result.planning;
  outcome.simplifying = 1e3 * result.simplifying;
  outcome.planner = "OMPL";
  judge(cell, query, result.path, replay, outcome);
  return outcome;
}

bool is_direct(const Cell& cell, const Query& query) {
  CollisionChecker checker(make_collision_model(cell), cell);
  return certify_edge(checker, query.start, query.goal).is_free();
}

class Measurement {
 public:
  Measurement(const Cell& cell, const Arguments& arguments)
      : arguments_(arguments), warm_(warm_up(cell)) {}

  /// @param most_peer_queries the peer is asked no more than the first ones
  void run(const std::string& name, const std::vector<Setting>& settings,
           std::size_t most_peer_queries = 1000000) const {
    Measured measured;
    for (const Setting& setting : settings) {
      Replay replay(setting.cell, warm_.self_pairs);
      for (const Query& query : setting.queries) {
        const bool direct = is_direct(setting.cell, query);
        const auto keep = [&](std::vector<Outcome>& outcomes, Outcome outcome) {
          outcome.direct = direct;
          outcomes.push_back(outcome);
          if (arguments_.verbose) benchmark::print_query(name, outcomes.size(), query, outcome);
        };
        keep(measured.handey, run_handey(setting.cell, query, warm_, replay));
        if (!arguments_.peer || measured.handey.size() > most_peer_queries) continue;
        keep(measured.peer, run_peer(setting.cell, query, warm_, replay));
      }
    }
    benchmark::print_rows(name, measured);
  }

  bool wants(const std::string& family) const {
    return arguments_.family == "all" || arguments_.family == family;
  }

 private:
  const Arguments& arguments_;
  Warm warm_;
};

void measure_families(const Cell& table, const Measurement& measurement,
                      const Arguments& arguments) {
  const std::uint64_t seed = arguments.seed;
  benchmark::print_head();
  if (measurement.wants("table")) {
    measurement.run("table", benchmark::table_family(table, seed, arguments.queries));
  }
  if (measurement.wants("clutter")) {
    measurement.run("clutter", benchmark::clutter_family(table, seed, arguments.queries));
  }
  if (measurement.wants("shelf")) {
    const std::vector<Setting> shelf = benchmark::shelf_family(table, seed, arguments.queries);
    measurement.run("shelf", shelf);
    benchmark::print_depths(shelf);
  }
}

void measure_growth(const Cell& table, const Measurement& measurement, const Arguments& arguments) {
  constexpr std::size_t kPeerQueries = 20, kPeerPockets = 4;
  const std::uint64_t seed = arguments.seed;
  benchmark::print_head();
  if (measurement.wants("pockets")) {
    measurement.run("no way", {benchmark::pocket_setting(table, seed, arguments.queries)},
                    kPeerPockets);
  }
  if (!measurement.wants("growth")) return;
  const std::vector<int> counts = {5, 25, 100, 400};
  const std::vector<Setting> growth =
      benchmark::growth_settings(table, seed, arguments.queries, counts);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    measurement.run(std::to_string(counts[i]) + " boxes", {growth[i]}, kPeerQueries);
  }
  measurement.run("20 160 triangles", {benchmark::tray_setting(table, seed, arguments.queries)},
                  kPeerQueries);
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
  const std::vector<std::string> families = {"table",   "clutter", "shelf",
                                             "pockets", "growth",  "all"};
  if (std::find(families.begin(), families.end(), arguments.family) == families.end()) {
    throw std::runtime_error("no family " + arguments.family +
                             "; there are table, clutter, shelf, pockets, growth, all");
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments arguments = read_arguments(argc, argv);
  OmplPeer::seed(arguments.seed);
  const Cell table = example::table_cell(arguments.models);
  const Measurement measurement(table, arguments);
  if (arguments.family != "growth" && arguments.family != "pockets") {
    measure_families(table, measurement, arguments);
  }
  if (measurement.wants("growth") || measurement.wants("pockets")) {
    measure_growth(table, measurement, arguments);
  }
  benchmark::print_legend();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
