#include "handey/motion/shortcut.hpp"

#include <algorithm>
#include <string>

#include "handey/errors.hpp"
#include "handey/motion/timing.hpp"
#include "random.hpp"
#include "require.hpp"

namespace handey {
namespace {

using Path = std::vector<Configuration>;

// A gain smaller than this is none [s]; it also ends the game of ever smaller cuts.
constexpr double kLeastGain = 1e-4;
constexpr double kRounding = 1e-12;  // of durations [s]

Configuration between(const Configuration& a, const Configuration& b, double share) {
  return {a.q + share * (b.q - a.q), a.opening + share * (b.opening - a.opening)};
}

double longest_joint_step(const Configuration& a, const Configuration& b) {
  return std::max((b.q - a.q).cwiseAbs().maxCoeff(), std::abs(b.opening - a.opening));
}

class Shortener {
 public:
  Shortener(CollisionChecker& checker, const ShortcutOptions& options)
      : checker_(checker),
        robot_(*checker.cell().robot),
        options_(options),
        generator_(options.seed) {}

  // From each waypoint straight to the farthest along the path that can be reached so.
  Path skip_waypoints(const Path& path) {
    Path kept{path.front()};
    for (std::size_t i = 0; i + 1 < path.size();) {
      std::size_t next = path.size() - 1;
      while (next > i + 1 && !is_free(path[i], path[next])) --next;
      kept.push_back(path[next]);
      i = next;
    }
    const bool is_longer = travel_time(robot_, kept) > travel_time(robot_, path) + kRounding ||
                           duration(kept) > duration(path) + kRounding;
    return is_longer ? path : kept;
  }

  // Joins two random points of the path, each uniform in travel time.
  Path cut_once(const Path& path) {
    const double total = travel_time(robot_, path);
    double s = total * motion::uniform(generator_);
    double t = total * motion::uniform(generator_);
    if (s > t) std::swap(s, t);
    const Point from = point_at(path, s), to = point_at(path, t);
    if (from.edge == to.edge) return path;
    Path cut(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(from.edge) + 1);
    append(cut, from.configuration);
    append(cut, to.configuration);
    const std::size_t joined = cut.size();
    cut.insert(cut.end(), path.begin() + static_cast<std::ptrdiff_t>(to.edge) + 1, path.end());
    if (!is_better(cut, path)) return path;
    // The pieces left of the two edges are certified anew: the certificate of the whole edge split
    // it elsewhere.
    for (std::size_t k = from.edge; k < joined; ++k) {
      if (!is_free(cut[k], cut[k + 1])) return path;
    }
    return cut;
  }

 private:
  struct Point {
    std::size_t edge;
    Configuration configuration;
  };

  Point point_at(const Path& path, double time) const {
    for (std::size_t k = 0; k + 2 < path.size(); ++k) {
      const double length = travel_time(robot_, {path[k], path[k + 1]});
      if (time < length) return {k, between(path[k], path[k + 1], time / length)};
      time -= length;
    }
    const std::size_t last = path.size() - 2;
    const double length = travel_time(robot_, {path[last], path[last + 1]});
    const double share = length > 0.0 ? std::min(1.0, time / length) : 0.0;
    return {last, between(path[last], path[last + 1], share)};
  }

  static void append(Path& path, const Configuration& configuration) {
    if (longest_joint_step(path.back(), configuration) > 1e-9) path.push_back(configuration);
  }

  bool is_free(const Configuration& a, const Configuration& b) {
    return certify_edge(checker_, a, b, options_.certificate).is_free();
  }

  // Shorter by the clock, and not longer without the acceleration limits.
  bool is_better(const Path& candidate, const Path& path) const {
    return travel_time(robot_, candidate) <= travel_time(robot_, path) + kRounding &&
           duration(candidate) < duration(path) - kLeastGain;
  }

  double duration(const Path& path) const { return time_path(robot_, path).duration(); }

  CollisionChecker& checker_;
  const Robot& robot_;
  const ShortcutOptions& options_;
  std::mt19937_64 generator_;
};

}  // namespace

std::vector<Configuration> shorten_path(CollisionChecker& checker,
                                        const std::vector<Configuration>& path,
                                        const ShortcutOptions& options) {
  if (path.empty()) throw InvalidInput("E_EMPTY", "path", "no waypoint, expected at least one");
  for (std::size_t k = 0; k < path.size(); ++k) {
    motion::require_configuration(*checker.cell().robot, path[k],
                                  "path[" + std::to_string(k) + "]");
  }
  if (options.attempts < 0) {
    throw InvalidInput("E_RANGE", "attempts",
                       std::to_string(options.attempts) + ", expected 0 or more");
  }
  if (path.size() < 3) return path;
  Shortener shortener(checker, options);
  Path shortest = shortener.skip_waypoints(path);
  for (int i = 0; i < options.attempts && shortest.size() > 2; ++i) {
    shortest = shortener.cut_once(shortest);
  }
  return shortest.size() > 2 ? shortener.skip_waypoints(shortest) : shortest;
}

}  // namespace handey
