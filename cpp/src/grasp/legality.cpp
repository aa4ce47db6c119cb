// Legal grasps of a pair: candidates in the order of their promise, until enough are legal.
#include "handey/grasp/legality.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "candidates.hpp"
#include "handey/grasp/blocked_poses.hpp"
#include "handey/stop.hpp"
#include "pose_test.hpp"
#include "ranges.hpp"
#include "scene_input.hpp"

namespace handey {
namespace {

void require_valid_input(const GraspScene& scene, const RankedPair& pair,
                         const LegalityOptions& options) {
  grasp::require_valid_scene(scene);
  require_rigid(pair.pair.X_PG, "pair.X_PG");
  grasp::require_in_range(pair.pair.width, 0.0, 10.0, "pair.width");
  grasp::require_in_range(options.directions, 1, 3600, "legality.directions");
  if (options.spacing != 0.0) {
    grasp::require_in_range(options.spacing, 1e-4, 1.0, "legality.spacing");
  }
  grasp::require_in_range(options.open_clearance, 0.0, 0.5, "legality.open_clearance");
  grasp::require_in_range(options.clearance, 0.0, 0.1, "legality.clearance");
  grasp::require_in_range(options.least_contact_share, 0.0, 1.0, "legality.least_contact_share");
  grasp::require_in_range(options.grip_force, 0.0, 1e6, "legality.grip_force");
  grasp::require_in_range(options.grip_ratio, 0.0, 1e6, "legality.grip_ratio");
  grasp::require_in_range(options.most_poses, 1, 100000, "legality.most_poses");
}

// The world's downward direction in the grasp plane, mean of both ends.
Eigen::Vector2d down_in_plane(const GraspScene& scene, const RankedPair& pair) {
  const Eigen::Vector3d down(0.0, 0.0, -1.0);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const Pose& X_WP_origin = scene.cell.parts[static_cast<std::size_t>(scene.part)].X_WB;
  for (const Pose& X_WP : {X_WP_origin, scene.X_WP_goal}) {
    const Eigen::Matrix3d R_WG = X_WP.linear() * pair.pair.X_PG.linear();
    const Eigen::Vector3d down_in_G = R_WG.transpose() * down;
    sum += down_in_G.head<2>();
  }
  return 0.5 * sum;
}

void count(LegalGrasps& result, grasp::PoseVerdict verdict) {
  switch (verdict) {
    case grasp::PoseVerdict::Legal:
      break;
    case grasp::PoseVerdict::UnreachableAtOrigin:
      ++result.unreachable_at_origin;
      break;
    case grasp::PoseVerdict::UnreachableAtDestination:
      ++result.unreachable_at_destination;
      break;
    case grasp::PoseVerdict::CollidesAtOrigin:
      ++result.collides_at_origin;
      break;
    case grasp::PoseVerdict::CollidesAtDestination:
      ++result.collides_at_destination;
      break;
  }
}

const Body& part_of(const GraspScene& scene) {
  return scene.cell.parts[static_cast<std::size_t>(scene.part)];
}

// Of a contact with an edge, the length: "12.0 mm".
std::string amount(const RankedPair& pair, double area) {
  switch (pair.pair.kind) {
    case PairKind::FaceEdge:
    case PairKind::ParallelEdges:
      return grasp::millimetres(area / pair.pair.strip) + " mm";
    default:
      return grasp::one_decimal(area * 1e6) + " mm2";
  }
}

std::vector<GraspPose> best_first(std::vector<GraspPose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const GraspPose& a, const GraspPose& b) { return a.merit > b.merit + 1e-9; });
  return poses;
}

std::string too_little_contact(const RankedPair& pair, const grasp::ContactDemand& demand) {
  const std::string needed = amount(pair, demand.required), most = amount(pair, demand.best);
  switch (pair.pair.kind) {
    case PairKind::FaceFace:
      return "a pad has too little contact on the free faces (" + needed + " are needed, " + most +
             " is the most at any target)";
    case PairKind::FaceEdge:
    case PairKind::ParallelEdges:
      return "a pad has too little of a free edge (" + needed + " are needed, " + most +
             " is the most at any target)";
    case PairKind::FaceVertex:
    case PairKind::CrossedEdges:
      break;
  }
  return "a point of contact is not 1 mm inside the pad or next to an obstacle";
}

// A pose that is not looked at further.
GraspPose hand_pose_of(const RankedPair& pair, const PlanarPose& in_plane) {
  GraspPose pose;
  pose.in_plane = in_plane;
  pose.X_PH = pair.pair.X_PG * hand_in_plane(in_plane, false);
  pose.width = pair.pair.width_at({in_plane.x, in_plane.y});
  return pose;
}

}  // namespace

struct LegalGraspSearch::Impl {
  Impl(const GraspScene& scene_in, const SphericalWristSolver& solver, const RankedPair& pair_in,
       const LegalityOptions& options_in, std::shared_ptr<BlockedPoses> blocked_in)
      : scene(scene_in),
        pair(pair_in),
        options(options_in),
        down(down_in_plane(scene, pair)),
        demand(grasp::contact_demand(pair, scene.cell.robot->gripper, options)),
        hold(part_of(scene), options),
        maker(pair, *scene.cell.robot, down, demand, hold, options),
        blocked(std::move(blocked_in)),
        tester(scene, solver, options) {
    if (blocked) cells.emplace(pair.pair, maker.lattice(), *blocked);
    if (options.spread) return;
    list = grasp::make_candidates(pair, *scene.cell.robot, down, demand, hold, options);
    slot = maker.slots();
    count_fallen(0, 0);
  }

  bool is_done() const {
    return (slot == maker.slots() && at == list.candidates.size() && in_hand.empty()) ||
           static_cast<int>(result.poses.size()) >= options.most_poses;
  }

  // The next candidates. What is thrown on the way leaves all as if the pose that was being tested,
  // or the slot that was being made, had not been begun.
  void look() {
    if (in_hand.empty()) take();
    for (; !in_hand.empty(); in_hand.pop_back(), flipped = false) {
      if (!flipped) test(in_hand.back(), false);
      flipped = true;
      test(in_hand.back(), true);
    }
  }

  // Of those that are made already, or of a slot.
  void take() {
    if (slot == maker.slots()) {
      in_hand.push_back(list.candidates[at++]);
      return;
    }
    const grasp::NoCandidates before = list;
    const std::size_t first = list.candidates.size();
    try {
      // Multiples of the golden ratio, modulo one, are spread evenly wherever one stops.
      maker.make(slot * stride() % maker.slots(), list);
    } catch (...) {
      static_cast<grasp::NoCandidates&>(list) = before;
      list.candidates.resize(first);
      throw;
    }
    ++slot;
    count_fallen(before.too_little_contact, before.would_turn);
    // What seems blocked waits in the list until the end.
    const auto waiting = std::stable_partition(
        list.candidates.begin() + static_cast<std::ptrdiff_t>(first), list.candidates.end(),
        [](const grasp::Candidate& candidate) { return candidate.promise < 0.0; });
    in_hand.assign(std::make_reverse_iterator(list.candidates.end()),
                   std::make_reverse_iterator(waiting));
    list.candidates.erase(waiting, list.candidates.end());
  }

  // About the golden ratio of the slots, with no divisor in common with their number.
  std::size_t stride() const {
    std::size_t step = std::max<std::size_t>(
        1, static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(maker.slots())));
    while (std::gcd(step, maker.slots()) != 1) ++step;
    return step;
  }

  // Contact and hold do not depend on the hand's half-turn.
  void count_fallen(int contact_before, int turn_before) {
    const int contact = list.too_little_contact - contact_before;
    const int turn = list.would_turn - turn_before;
    result.too_little_contact += contact;
    result.would_turn += turn;
    result.tried += contact + turn;
    if (contact > 0) {
      tally.add({FallKind::LittleContact, GraspEnd::Both, -1, "", ""}, posed(list.little_contact),
                too_little_contact(pair, demand), std::nullopt, contact);
    }
    if (turn > 0) {
      const bool slips = hold.slips();
      tally.add({slips ? FallKind::Slips : FallKind::Turns, GraspEnd::Both, -1, "", ""},
                posed(list.turning), list.turn_reason,
                slips ? std::nullopt : std::optional<double>(list.least_excess), turn);
    }
  }

  GraspPose posed(const PlanarPose& in_plane) const { return hand_pose_of(pair, in_plane); }

  void test(const grasp::Candidate& candidate, bool is_flipped) {
    if (static_cast<int>(result.poses.size()) >= options.most_poses) return;
    // Legal already, less drawn back.
    if (found.count({candidate.group, is_flipped}) != 0) return;
    GraspPose pose;
    pose.in_plane = candidate.pose;
    pose.flipped = is_flipped;
    pose.contact_area = candidate.contact_area;
    if (cells) {
      if (const PoseBlock* block = cells->find(candidate.point, is_flipped)) {
        ++result.tried;
        count_blocked(*block, pose);
        return;
      }
    }
    const grasp::PoseVerdict verdict = tester.test(pair.pair, pose, tally);
    ++result.tried;
    count(result, verdict);
    if (verdict != grasp::PoseVerdict::Legal) return;
    pose.merit += grasp::planar_merit(pair, scene.cell.robot->gripper, pose.in_plane,
                                      pose.contact_area, candidate.along_edge, down, demand);
    found.insert({candidate.group, is_flipped});
    result.poses.push_back(std::move(pose));
  }

  // Without a look at the arm.
  void count_blocked(const PoseBlock& block, GraspPose& pose) {
    pose.X_PH = pair.pair.X_PG * hand_in_plane(pose.in_plane, pose.flipped);
    pose.width = pair.pair.width_at({pose.in_plane.x, pose.in_plane.y});
    count(result, tester.add_blocked(block, pose, tally));
  }

  const GraspScene scene;
  const RankedPair pair;
  const LegalityOptions options;
  const Eigen::Vector2d down;
  const grasp::ContactDemand demand;
  const grasp::Hold hold;
  grasp::CandidateMaker maker;
  std::size_t slot = 0;  ///< slots looked at, in their mixed order
  /// Candidates to test: all, or with `spread` those of the slots looked at that seem blocked.
  grasp::CandidateList list;
  std::size_t at = 0;                     ///< candidates of the list that are tested
  std::vector<grasp::Candidate> in_hand;  ///< taken from either and not tested yet; the next last
  bool flipped = false;                   ///< the next one is tested as it is, not yet flipped
  std::size_t told = 0;                   ///< poses that `next` has returned
  std::shared_ptr<BlockedPoses> blocked;
  std::optional<grasp::LatticeCells> cells;
  grasp::PoseTester tester;
  grasp::Tally tally;
  std::set<std::pair<int, bool>> found;
  LegalGrasps result;  ///< poses in the order found
};

LegalGraspSearch::LegalGraspSearch(const GraspScene& scene, const SphericalWristSolver& solver,
                                   const RankedPair& pair, const LegalityOptions& options,
                                   std::shared_ptr<BlockedPoses> blocked) {
  require_valid_input(scene, pair, options);
  impl_ = std::make_unique<Impl>(scene, solver, pair, options, std::move(blocked));
}
LegalGraspSearch::~LegalGraspSearch() = default;
LegalGraspSearch::LegalGraspSearch(LegalGraspSearch&&) noexcept = default;
LegalGraspSearch& LegalGraspSearch::operator=(LegalGraspSearch&&) noexcept = default;

bool LegalGraspSearch::is_done() const { return impl_->is_done(); }

std::vector<GraspPose> LegalGraspSearch::next(int candidates) {
  grasp::require_in_range(candidates, 1, std::numeric_limits<int>::max(), "candidates");
  for (int i = 0; i < candidates && !impl_->is_done(); ++i) {
    throw_if_stopped();
    impl_->look();
  }
  const auto fresh = impl_->result.poses.begin() + static_cast<std::ptrdiff_t>(impl_->told);
  impl_->told = impl_->result.poses.size();
  return best_first({fresh, impl_->result.poses.end()});
}

LegalGrasps LegalGraspSearch::result() const {
  LegalGrasps result = impl_->result;
  result.poses = best_first(std::move(result.poses));
  result.fallen = impl_->tally.list();
  result.worst_reason = impl_->tally.worst(result.tried);
  return result;
}

LegalGrasps find_legal_grasps(const GraspScene& scene, const SphericalWristSolver& solver,
                              const RankedPair& pair, const LegalityOptions& options) {
  LegalGraspSearch search(scene, solver, pair, options);
  search.next(std::numeric_limits<int>::max());
  return search.result();
}

LegalGrasps test_grasp_pose(const GraspScene& scene, const SphericalWristSolver& solver,
                            const RankedPair& pair, const PlanarPose& pose, bool flipped,
                            const LegalityOptions& options) {
  require_valid_input(scene, pair, options);
  for (const double value : {pose.x, pose.y, pose.theta}) {
    grasp::require_in_range(value, -1e3, 1e3, "pose");
  }
  const Gripper& gripper = scene.cell.robot->gripper;
  const grasp::ContactDemand demand = grasp::contact_demand(pair, gripper, options);
  LegalGrasps result;
  result.tried = 1;
  grasp::Tally tally;
  GraspPose grasp_pose;
  grasp_pose.in_plane = pose;
  grasp_pose.flipped = flipped;
  const grasp::PadContact contact = grasp::pad_contact(pair, pose, gripper);
  const grasp::Hold hold(part_of(scene), options);
  grasp_pose.contact_area = contact.area;
  if (!demand.is_met(contact)) {
    result.too_little_contact = 1;
    tally.add({FallKind::LittleContact, GraspEnd::Both, -1, "", ""}, hand_pose_of(pair, pose),
              "a pad has " + amount(pair, contact.area) + " of contact on the free features, " +
                  amount(pair, demand.required) + " are needed");
  } else if (hold.excess(pair, contact) > 0.0) {
    result.would_turn = 1;
    const bool slips = hold.slips();
    tally.add({slips ? FallKind::Slips : FallKind::Turns, GraspEnd::Both, -1, "", ""},
              hand_pose_of(pair, pose), hold.reason(pair, contact),
              slips ? std::nullopt : std::optional<double>(hold.excess(pair, contact)));
  } else {
    const grasp::PoseVerdict verdict =
        grasp::PoseTester(scene, solver, options).test(pair.pair, grasp_pose, tally);
    count(result, verdict);
    if (verdict == grasp::PoseVerdict::Legal) {
      grasp_pose.merit += grasp::planar_merit(pair, gripper, pose, grasp_pose.contact_area,
                                              grasp::is_along_edge(pair, pose.theta),
                                              down_in_plane(scene, pair), demand);
      result.poses.push_back(std::move(grasp_pose));
    }
  }
  result.fallen = tally.list();
  result.worst_reason = tally.worst(1);
  return result;
}

}  // namespace handey
