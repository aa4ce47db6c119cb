// Samples hand poses pair by pair, puts each to all tests, and counts in how many ways every
// obstacle is the only one.
#include "handey/grasp/diagnosis.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "candidates.hpp"
#include "end_obstacles.hpp"
#include "handey/grasp/part_grasps.hpp"
#include "handey/stop.hpp"
#include "ranges.hpp"
#include "scene_input.hpp"

namespace handey {
namespace {

using grasp::EndObstacles;
using grasp::EndResult;
using grasp::InTheWay;

constexpr double kHugeForce = 1e6;  // [N]: holds whatever is to be looked at
constexpr int kMostDepths = 64;     // Choice: overlaps of one obstacle that are measured
// Choice: where the hand meets more bodies at an end, the arm is not looked at.
constexpr std::size_t kMostHandHits = 1;

struct Sample {
  Pose X_PH = Pose::Identity();
  double opening = 0.0, width = 0.0;
  std::vector<InTheWay> common;  // at neither end: the jaws, the hold
};

/// Spread over pairs, and in each over places and directions.
class Sampler {
 public:
  Sampler(const GraspScene& scene, const DiagnosisOptions& options)
      : part_(scene.cell.parts[static_cast<std::size_t>(scene.part)]),
        gripper_(scene.cell.robot->gripper),
        options_(options),
        hold_(part_, options.legality),
        wide_(std::make_shared<Robot>(*scene.cell.robot)) {
    wide_->gripper.max_opening += options.wider;
    least_opening_ = 0.5 * options.legality.open_clearance;
  }

  std::vector<Sample> run() {
    std::vector<RankedPair> pairs = pairs_of(PairChoice::TwoFaces);
    if (pairs.empty() && options_.ranking.features.beyond_faces) {
      pairs = pairs_of(PairChoice::BeyondFaces);
    }
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const std::size_t left = static_cast<std::size_t>(options_.most_poses) - samples.size();
      add(pairs[i], left / (pairs.size() - i), samples);
    }
    return samples;
  }

 private:
  std::vector<RankedPair> pairs_of(PairChoice choice) const {
    RankingOptions ranking = options_.ranking;
    ranking.pairs = choice;
    std::vector<RankedPair> pairs = rank_part_alone(part_, wide_, ranking).ranked;
    const std::size_t most = static_cast<std::size_t>(options_.most_pairs);
    if (pairs.size() > most) pairs.resize(most);
    return pairs;
  }

  void add(const RankedPair& pair, std::size_t most, std::vector<Sample>& samples) const {
    LegalityOptions held = options_.legality;
    held.grip_force = held.grip_ratio = kHugeForce;
    const grasp::Hold any_hold(part_, held);
    const Eigen::Vector2d down = Eigen::Vector2d::Zero();
    const grasp::ContactDemand demand = grasp::contact_demand(pair, gripper_, options_.legality);
    grasp::CandidateMaker maker(pair, *wide_, down, demand, any_hold, options_.legality);
    std::size_t step = std::max<std::size_t>(
        1, static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(maker.slots())));
    while (std::gcd(step, maker.slots()) != 1) ++step;
    const std::size_t end = samples.size() + most;
    for (std::size_t slot = 0; slot < maker.slots(); ++slot) {
      grasp::CandidateList list;
      maker.make(slot * step % maker.slots(), list);
      for (const grasp::Candidate& candidate : list.candidates) {
        for (const bool flipped : {false, true}) {
          if (samples.size() == end) return;
          samples.push_back(sample(pair, candidate.pose, flipped));
        }
      }
    }
  }

  Sample sample(const RankedPair& pair, const PlanarPose& pose, bool flipped) const {
    Sample sample;
    sample.X_PH = pair.pair.X_PG * hand_in_plane(pose, flipped);
    sample.width = pair.pair.width_at({pose.x, pose.y});
    sample.opening = sample.width + least_opening_;
    const double needed = pair.pair.width + 2.0 * options_.ranking.features.jaw_clearance;
    const auto add = [&](FallKind kind, double amount) {
      InTheWay found;
      found.kind = kind;
      found.amount = amount;
      sample.common.push_back(found);
    };
    if (needed > gripper_.max_opening) add(FallKind::TooWide, needed - gripper_.max_opening);
    const grasp::PadContact contact = grasp::pad_contact(pair, pose, gripper_);
    const double excess = hold_.excess(pair, contact);
    if (excess > 0.0 && hold_.slips()) add(FallKind::Slips, 0.0);
    if (excess > 0.0 && !hold_.slips()) add(FallKind::Turns, excess);
    return sample;
  }

  const Body& part_;
  const Gripper& gripper_;
  const DiagnosisOptions& options_;
  const grasp::Hold hold_;
  std::shared_ptr<Robot> wide_;
  double least_opening_ = 0.0;
};

/// Counts obstacles over all hand poses.
class Counter {
 public:
  void add(const Sample& sample, const std::vector<InTheWay>& found,
           const Eigen::VectorXd& at_origin, const Eigen::VectorXd& at_destination) {
    fewest_ = std::min(fewest_, found.size());
    for (const InTheWay& one : found) {
      Entry& entry = entries_[key(one)];
      if (entry.obstacle.met++ == 0) {
        entry.obstacle.kind = one.kind;
        entry.obstacle.end = one.end;
        entry.obstacle.joint = one.joint;
        entry.obstacle.body = one.body;
        entry.obstacle.mover = one.mover;
      }
      const bool is_alone = found.size() == 1;
      if (is_alone && entry.obstacle.alone++ == 0) entry.looks.clear();
      if (found.size() <= 3) ++entry.sizes[found.size()];
      if (!is_alone && entry.obstacle.alone > 0) continue;
      const Eigen::VectorXd& q = one.end == GraspEnd::Origin ? at_origin : at_destination;
      keep(entry, {&sample, q, one.amount});
    }
  }

  /// `alone` falling.
  std::vector<GraspObstacle> list(EndObstacles& origin, EndObstacles& destination) {
    std::vector<GraspObstacle> list;
    for (auto& [key, entry] : entries_) {
      EndObstacles& end = entry.obstacle.end == GraspEnd::Origin ? origin : destination;
      entry.obstacle.carries =
          entry.obstacle.kind == FallKind::Collision && end.carries(entry.obstacle.body);
      const auto at = entry.sizes.find(fewest_);
      entry.obstacle.in_fewest = at == entry.sizes.end() ? 0 : at->second;
      measure(entry, end);
      list.push_back(entry.obstacle);
    }
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
      return std::tie(a.alone, a.in_fewest, a.met) > std::tie(b.alone, b.in_fewest, b.met);
    });
    return list;
  }

  std::size_t fewest() const { return entries_.empty() ? 0 : fewest_; }

 private:
  struct Look {
    const Sample* sample;
    Eigen::VectorXd q;
    double amount;
  };
  struct Entry {
    GraspObstacle obstacle;
    std::map<std::size_t, int> sizes;  // hand poses with so many obstacles that have this one
    std::vector<Look> looks;           // of known amount the least, else the first
  };
  using Key = std::tuple<FallKind, GraspEnd, int, std::string>;

  static Key key(const InTheWay& one) { return {one.kind, one.end, one.joint, one.body}; }

  static void keep(Entry& entry, const Look& look) {
    if (look.amount < 0.0) {
      if (static_cast<int>(entry.looks.size()) < kMostDepths) entry.looks.push_back(look);
    } else if (entry.looks.empty() || look.amount < entry.looks.front().amount) {
      entry.looks.assign(1, look);
    }
  }

  static void measure(Entry& entry, EndObstacles& end) {
    GraspObstacle& obstacle = entry.obstacle;
    const bool is_worth_it = obstacle.alone > 0 || obstacle.in_fewest > 0;
    for (const Look& look : entry.looks) {
      double amount = look.amount;
      if (amount < 0.0 && is_worth_it) {
        amount = end.depth(look.sample->X_PH, look.sample->opening, look.q, obstacle.body);
      }
      if (obstacle.least >= 0.0 && (amount < 0.0 || amount >= obstacle.least)) continue;
      obstacle.least = amount;
      obstacle.X_PH = look.sample->X_PH;
      obstacle.opening = look.sample->opening;
      obstacle.width = look.sample->width;
    }
  }

  std::map<Key, Entry> entries_;
  std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
};

void require_valid_input(const GraspScene& scene, const DiagnosisOptions& options) {
  grasp::require_valid_scene(scene);
  grasp::require_in_range(options.most_poses, 1, 1e6, "most_poses");
  grasp::require_in_range(options.most_pairs, 1, 1e6, "most_pairs");
  grasp::require_in_range(options.wider, 0.0, 10.0, "wider");
}

Robot without_limits(const Robot& robot) {
  Robot unlimited = robot;
  for (ArmJoint& joint : unlimited.joints) {
    joint.limit.lower = -std::numeric_limits<double>::infinity();
    joint.limit.upper = std::numeric_limits<double>::infinity();
  }
  return unlimited;
}

}  // namespace

Diagnosis diagnose_grasps(const GraspScene& scene, const DiagnosisOptions& options) {
  require_valid_input(scene, options);
  const SphericalWristSolver unlimited(without_limits(*scene.cell.robot));
  EndObstacles origin(scene, GraspEnd::Origin, unlimited, options.legality);
  EndObstacles destination(scene, GraspEnd::Destination, unlimited, options.legality);
  Diagnosis diagnosis;
  Counter counter;
  const std::vector<Sample> samples = Sampler(scene, options).run();
  for (const Sample& sample : samples) {
    throw_if_stopped();
    EndResult first = origin.hand(sample.X_PH, sample.opening, sample.width);
    if (first.meets_part) {
      ++diagnosis.misfits;
      continue;
    }
    ++diagnosis.looked_at;
    EndResult second = destination.hand(sample.X_PH, sample.opening, sample.width);
    const auto add_arm = [&](EndObstacles& end, EndResult& result) {
      if (result.obstacles.size() <= kMostHandHits) {
        end.add_arm(sample.X_PH, sample.opening, result);
      }
    };
    add_arm(origin, first);
    add_arm(destination, second);
    if (sample.common.empty() && first.obstacles.empty()) ++diagnosis.free_at_origin;
    if (sample.common.empty() && second.obstacles.empty()) ++diagnosis.free_at_destination;
    std::vector<InTheWay> found = sample.common;
    found.insert(found.end(), first.obstacles.begin(), first.obstacles.end());
    found.insert(found.end(), second.obstacles.begin(), second.obstacles.end());
    if (found.empty()) ++diagnosis.legal;
    counter.add(sample, found, first.q, second.q);
  }
  diagnosis.fewest = static_cast<int>(counter.fewest());
  diagnosis.obstacles = counter.list(origin, destination);
  return diagnosis;
}

}  // namespace handey
