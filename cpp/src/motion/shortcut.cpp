// First the path is divided: a stretch that a straight edge can replace is replaced, any other is
// divided at its waypoint farthest from that edge, so few proofs are needed, however many waypoints
// there are. Then corners are left out, and moved toward the straight line past them, in all joints
// or in some. Corners are moved rather than cut off because the motion stops at every corner.
#include "handey/motion/shortcut.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "clearance.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "random.hpp"
#include "require.hpp"

namespace handey {
namespace {

using motion::ClearanceRule;
using motion::EdgeTime;
using motion::Limits;
using motion::Waypoint;

// Choice: a gain smaller than this share of the path's duration is not worth its proof.
constexpr double kLeastGain = 0.015;
constexpr double kRounding = 1e-12;  // of durations [s]
constexpr double kInLine = 1e-9;     // a waypoint this near to a straight edge lies on it [s]
// Choice: so many attempts without a gain end the shortening.
constexpr int kPatience = 12;
// Choice: moves of a corner among which the best are tried.
constexpr int kDraws = 16;

std::vector<Waypoint> with_places(const std::vector<Configuration>& path, const Limits& limits) {
  std::vector<Waypoint> waypoints{{path.front(), 0.0}};
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double travel = motion::edge_time(path[k - 1], path[k], limits).travel;
    if (travel > kInLine) waypoints.push_back({path[k], waypoints.back().place + travel});
  }
  if (waypoints.size() == 1) waypoints.push_back(waypoints.front());
  waypoints.back().configuration = path.back();
  return waypoints;
}

class Shortener {
 public:
  Shortener(ClearanceRule& rule, const std::vector<Waypoint>& given, const Limits& limits,
            std::uint64_t seed)
      : rule_(rule), given_(given), limits_(limits), generator_(seed) {}

  // Straight edges between few waypoints of the path, found by guesses, then proved.
  void divide() {
    std::vector<std::size_t> kept{0};
    divide(0, given_.size() - 1, false, kept);
    leave_out(kept, false);
    std::vector<std::size_t> proved{0};
    for (std::size_t k = 1; k < kept.size(); ++k) divide(kept[k - 1], kept[k], true, proved);
    if (proved.size() > kept.size()) leave_out(proved, true);
    for (const std::size_t k : proved) path_.push_back(given_[k]);
  }

  void move_corners(int attempts) {
    double duration = 0.0;
    for (std::size_t k = 1; k < path_.size(); ++k) {
      duration += time(path_[k - 1].configuration, path_[k].configuration).duration;
    }
    least_gain_ = kLeastGain * duration;
    int since_gain = 0;
    for (std::size_t k = 1; attempts > 0 && since_gain < kPatience && path_.size() > 2; ++k) {
      if (k + 1 >= path_.size()) k = 1;
      const int most = std::min(attempts, kPatience - since_gain);
      const int tried = move_corner(k, most);
      attempts -= std::max(1, std::abs(tried));
      since_gain = tried > 0 ? 0 : since_gain + std::max(1, -tried);
    }
  }

  const std::vector<Waypoint>& path() const { return path_; }

 private:
  bool is_allowed(std::size_t first, std::size_t last, bool prove) {
    const std::pair<std::size_t, std::size_t> edge{first, last};
    if (std::find(refused_.begin(), refused_.end(), edge) != refused_.end()) return false;
    const Waypoint &a = given_[first], &b = given_[last];
    const bool allowed = rule_.may_allow(a, b) && (!prove || rule_.allows(a, b));
    if (!allowed) refused_.push_back(edge);
    return allowed;
  }

  // Appends the shortened stretch between two waypoints of the given path, without the first.
  void divide(std::size_t first, std::size_t last, bool prove, std::vector<std::size_t>& kept) {
    if (last > first + 1 && !is_allowed(first, last, prove)) {
      const auto [farthest, deviation] = farthest_from_edge(first, last);
      if (deviation > kInLine) {
        divide(first, farthest, prove, kept);
        divide(farthest, last, prove, kept);
        return;
      }
      while (++first < last) kept.push_back(first);
    }
    kept.push_back(last);
  }

  void leave_out(std::vector<std::size_t>& kept, bool prove) {
    for (std::size_t k = 1; k + 1 < kept.size();) {
      if (is_allowed(kept[k - 1], kept[k + 1], prove)) {
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
      } else {
        ++k;
      }
    }
  }

  std::pair<std::size_t, double> farthest_from_edge(std::size_t first, std::size_t last) const {
    const Waypoint &a = given_[first], &b = given_[last];
    std::size_t farthest = (first + last) / 2;
    double most = 0.0;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double share = (given_[k].place - a.place) / (b.place - a.place);
      const Configuration on_edge = motion::between(a.configuration, b.configuration, share);
      const double deviation = time(on_edge, given_[k].configuration).travel;
      if (deviation > most) {
        most = deviation;
        farthest = k;
      }
    }
    return {farthest, most};
  }

  struct Move {
    Waypoint to;
    double gain;  // [s]
  };

  // Tries the moves of a corner that gain most. @return how many were tried; negative if none did
  int move_corner(std::size_t k, int most) {
    int tried = 0;
    for (const Move& move : draw_moves(k)) {
      if (tried == most) break;
      ++tried;
      const Waypoint &before = path_[k - 1], &after = path_[k + 1];
      if (!rule_.may_allow(before, move.to) || !rule_.may_allow(move.to, after)) continue;
      if (!rule_.allows(before, move.to) || !rule_.allows(move.to, after)) continue;
      path_[k] = move.to;
      return tried;
    }
    return -tried;
  }

  // Random moves toward points of the straight line past the corner, of all joints or of one; those
  // that gain, the best first.
  std::vector<Move> draw_moves(std::size_t k) {
    const Waypoint &before = path_[k - 1], &corner = path_[k], &after = path_[k + 1];
    const Cost cost = cost_by(before, corner, after);
    std::vector<Move> moves;
    throw_if_stopped();
    for (int draw = 0; draw < kDraws; ++draw) {
      const Configuration target =
          motion::between(before.configuration, after.configuration, motion::uniform(generator_));
      const double share = motion::uniform(generator_);
      const double joint = 2.0 * motion::uniform(generator_) - 1.0;
      Move move{corner, 0.0};
      Eigen::VectorXd& q = move.to.configuration.q;
      if (joint < 0.0) {
        move.to.configuration = motion::between(corner.configuration, target, share);
      } else {
        const Eigen::Index j = static_cast<Eigen::Index>(joint * static_cast<double>(q.size()));
        q(j) += share * (target.q(j) - q(j));
      }
      const Cost moved = cost_by(before, move.to, after);
      move.gain = cost.duration - moved.duration;
      if (move.gain > least_gain_ && moved.travel <= cost.travel + kRounding) moves.push_back(move);
    }
    std::stable_sort(moves.begin(), moves.end(),
                     [](const Move& a, const Move& b) { return a.gain > b.gain; });
    return moves;
  }

  using Cost = EdgeTime;
  Cost cost_by(const Waypoint& before, const Waypoint& corner, const Waypoint& after) const {
    const EdgeTime in = time(before.configuration, corner.configuration);
    const EdgeTime out = time(corner.configuration, after.configuration);
    return {in.travel + out.travel, in.duration + out.duration};
  }

  EdgeTime time(const Configuration& a, const Configuration& b) const {
    return motion::edge_time(a, b, limits_);
  }

  ClearanceRule& rule_;
  const std::vector<Waypoint>& given_;
  const Limits& limits_;
  std::mt19937_64 generator_;
  double least_gain_ = 0.0;                                   // [s]
  std::vector<std::pair<std::size_t, std::size_t>> refused_;  // edges between given waypoints
  std::vector<Waypoint> path_;
};

void require_valid(const Robot& robot, const std::vector<Configuration>& path,
                   const ShortcutOptions& options) {
  if (path.empty()) throw InvalidInput("E_EMPTY", "path", "no waypoint, expected at least one");
  for (std::size_t k = 0; k < path.size(); ++k) {
    motion::require_configuration(robot, path[k], "path[" + std::to_string(k) + "]");
  }
  if (options.attempts < 0) {
    throw InvalidInput("E_RANGE", "attempts",
                       std::to_string(options.attempts) + ", expected 0 or more");
  }
  if (!(std::isfinite(options.clearance) && options.clearance >= 0.0)) {
    throw InvalidInput("E_RANGE", "clearance",
                       std::to_string(options.clearance) + " m, expected a finite number >= 0");
  }
}

}  // namespace

std::vector<Configuration> shorten_path(CollisionChecker& checker,
                                        const std::vector<Configuration>& path,
                                        const ShortcutOptions& options) {
  const Robot& robot = *checker.cell().robot;
  require_valid(robot, path, options);
  if (path.size() < 3) return path;
  const Limits limits = motion::limits_of(robot);
  const std::vector<Waypoint> given = with_places(path, limits);
  ClearanceRule rule(checker, given, limits, options);
  Shortener shortener(rule, given, limits, options.seed);
  shortener.divide();
  shortener.move_corners(options.attempts);
  std::vector<Configuration> shorter;
  for (const Waypoint& waypoint : shortener.path()) shorter.push_back(waypoint.configuration);
  // Waypoints in line are driven through: leaving such a run in its middle can cost a stop.
  const bool is_longer =
      motion::path_duration(shorter, limits) > motion::path_duration(path, limits) + kRounding;
  return is_longer ? path : shorter;
}

}  // namespace handey
