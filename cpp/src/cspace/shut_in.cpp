// Floods that begin anew whenever one comes through: the cubes in doubt on its way are cut.
#include "handey/cspace/shut_in.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "cube_tree.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using cspace::CubeKind;
using cspace::CubeTree;
using Eigen::Vector3d;

// What a part may overlap with what it touches where it stands, and a little more [m].
constexpr double kContact = 6e-4;
// Choice: so far beyond both ends nothing is looked at; what comes there is out [m].
constexpr double kBeyond = 0.4;
constexpr int kDoubt = 1;  // weight of a cube in doubt; that of a free one is 0
// Choice: floods that end where they first come through. Where there is a way out they find it; the
// later ones, which cut ever more of the cubes that leak, are for proofs.
constexpr int kSingle = 16;

enum class Flood { RunsOut, ComesThrough, GivenUp };

/// The ball that fits into the part: centre in the part's frame.
struct Ball {
  Vector3d centre = Vector3d::Zero();
  double radius = 0.0;
};

Ball largest_ball(const std::vector<InnerSolid>& solids) {
  Ball ball;
  for (const InnerSolid& solid : solids) {
    if (!solid.normals.empty() && solid.inradius > ball.radius) {
      ball = {solid.centre, solid.inradius};
    }
  }
  return ball;
}

class Floods {
 public:
  Floods(CubeTree& tree, const ShutInOptions& options)
      : tree_(tree), options_(options), steps_left_(options.most_steps) {}

  /// Does a chain of cubes that are not blocked lead from a point to another, or outside?
  Flood run(const Vector3d& from, const Vector3d& to) {
    for (int round = 0;; ++round) {
      const Flood flood = once(from, to, round < kSingle ? 1 : 1 << std::min(round - kSingle, 20));
      if (flood != Flood::ComesThrough || is_sure_) return flood;
      for (int cube : to_cut_) tree_.cut(cube);
    }
  }

  /// After RunsOut: obstacles that block cubes beside the flood, most first.
  std::vector<int> border() {
    std::map<int, int> counted;
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      if (!reached_[i].settled) continue;
      tree_.neighbours(static_cast<int>(i), beside_);
      for (int other : beside_) {
        if (other != CubeTree::kOutside && tree_.kind(other) == CubeKind::Blocked) {
          ++counted[tree_.blocker(other)];
        }
      }
    }
    std::vector<std::pair<int, int>> sorted;
    for (const auto& [obstacle, cubes] : counted) sorted.emplace_back(-cubes, obstacle);
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> result;
    for (const auto& [cubes, obstacle] : sorted) result.push_back(obstacle);
    return result;
  }

 private:
  struct Reached {
    int weight = -1;
    int from = -1;
    int gate = -1;  // the first cube in doubt on the way to it
    bool settled = false;
  };
  struct Entry {
    int weight;
    double gap;  // to the other end
    int cube;
    bool operator<(const Entry& other) const {
      if (weight != other.weight) return weight > other.weight;
      if (gap != other.gap) return gap > other.gap;
      return cube > other.cube;
    }
  };

  Reached& reached(int cube) { return reached_[static_cast<std::size_t>(cube)]; }
  /// Through this gate the flood has come out already.
  bool leaks(int gate) const { return leaking_.count(gate) > 0; }

  Flood once(const Vector3d& from, const Vector3d& to, std::size_t most_leaks) {
    reached_.assign(tree_.size(), {});
    leaking_.clear();
    to_cut_.clear();
    is_sure_ = false;
    queue_ = {};
    const int last = tree_.at(to);
    reach(tree_.at(from), -1, to);
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      if (reached(entry.cube).settled) continue;
      reached(entry.cube).settled = true;
      const int gate = reached(entry.cube).gate;
      if (leaks(gate)) continue;
      bool is_through = entry.cube == last;
      tree_.neighbours(entry.cube, beside_);
      for (int other : beside_) {
        if (is_through) break;
        // Beside where another gate leaks this one does; without a gate the other's is to be cut.
        is_through = other == CubeTree::kOutside ||
                     (gate >= 0 && reached(other).settled && leaks(reached(other).gate));
        if (!is_through) reach(other, entry.cube, to);
      }
      if (is_through) {
        note_way(entry.cube);
        if (is_sure_ || leaking_.size() >= most_leaks) return Flood::ComesThrough;
      }
      steps_left_ -= std::min(steps_left_, beside_.size());
      if (tree_.looked_at() >= options_.most_cubes || steps_left_ == 0) return Flood::GivenUp;
    }
    return leaking_.empty() ? Flood::RunsOut : Flood::ComesThrough;
  }

  void reach(int cube, int before, const Vector3d& to) {
    const CubeKind kind = tree_.kind(cube);
    if (kind == CubeKind::Blocked) return;
    Reached& it = reached(cube);
    const int so_far = before < 0 ? 0 : reached(before).weight;
    const int weight = so_far + (kind == CubeKind::Doubt ? kDoubt : 0);
    if (it.settled || (it.weight >= 0 && it.weight <= weight)) return;
    const int gate = before < 0 ? -1 : reached(before).gate;
    const bool can_cut = kind == CubeKind::Doubt && !tree_.is_finest(cube);
    it = {weight, before, gate < 0 && can_cut ? cube : gate, false};
    queue_.push({weight, (tree_.centre(cube) - to).norm(), cube});
  }

  /// The cubes in doubt on the way to one from which the flood comes out are to be cut; if there
  /// are none, it certainly comes out, as far as the smallest cubes tell.
  void note_way(int cube) {
    const int gate = reached(cube).gate;
    is_sure_ = gate < 0;
    leaking_.insert(gate);
    for (; cube >= 0; cube = reached(cube).from) {
      const bool can_cut = tree_.kind(cube) == CubeKind::Doubt && !tree_.is_finest(cube);
      if (can_cut) to_cut_.insert(cube);
    }
  }

  CubeTree& tree_;
  const ShutInOptions& options_;
  std::size_t steps_left_;
  std::vector<Reached> reached_;
  std::priority_queue<Entry> queue_;
  std::set<int> leaking_, to_cut_;
  bool is_sure_ = false;
  std::vector<int> beside_;
};

void require_inputs(const CollisionChecker& checker, const Pose& X_RP, const Pose& X_RP_goal,
                    const ShutInOptions& options) {
  if (!checker.cell().held) throw InvalidInput("E_REF", "checker", "the hand holds no part");
  require_rigid(X_RP, "X_RP");
  require_rigid(X_RP_goal, "X_RP_goal");
  if (!(options.finest >= 1e-4 && options.finest <= 0.1)) {
    throw InvalidInput("E_RANGE", "finest", "expected 0.0001 to 0.1 m");
  }
}

}  // namespace

ShutIn prove_shut_in(CollisionChecker& checker, const Pose& X_RP, const Pose& X_RP_goal,
                     const ShutInOptions& options) {
  require_inputs(checker, X_RP, X_RP_goal, options);
  ShutIn result;
  const Ball ball = largest_ball(held_solids(checker));
  result.radius = ball.radius;
  if (ball.radius <= 2.0 * kContact) {
    result.reason = "the part holds no ball";
    return result;
  }
  const Vector3d ends[2] = {X_RP * ball.centre, X_RP_goal * ball.centre};
  Eigen::AlignedBox3d box(ends[0]);
  box.extend(ends[1]);
  box.min().array() -= kBeyond;
  box.max().array() += kBeyond;
  const SolidScene scene = describe_solids(checker);
  CubeTree tree(scene, ball.radius - kContact, box, options.finest);
  for (int end = 0; end < 2 && !result.shut_in; ++end) {
    Floods floods(tree, options);
    const Flood flood = floods.run(ends[end], ends[1 - end]);
    if (flood == Flood::GivenUp) {
      result.reason = "given up after " + std::to_string(tree.looked_at()) + " cubes";
    } else if (result.reason.empty()) {
      result.reason = "cubes that are not proved blocked lead out";
    }
    if (flood != Flood::RunsOut) continue;
    result.shut_in = true;
    result.end = end;
    result.reason.clear();
    for (int obstacle : floods.border()) {
      result.bodies.push_back(scene.obstacles[static_cast<std::size_t>(obstacle)].name);
    }
  }
  result.cubes_looked_at = tree.looked_at();
  result.resolution = tree.finest_looked_at();
  return result;
}

}  // namespace handey
