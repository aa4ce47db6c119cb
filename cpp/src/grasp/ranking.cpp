// Ranks the pairs of a part: per pair, what is near at both ends is projected on the overlap and
// taken off.
#include "handey/grasp/ranking.hpp"

#include <algorithm>

#include "handey/stop.hpp"
#include "obstruction.hpp"
#include "pair_rules.hpp"
#include "ranges.hpp"

namespace handey {
namespace {

using grasp::kind_worth;
using grasp::kLeastContactLength;

// Less than this of the overlap taken is not called obstructing [m2].
constexpr double kNoArea = 1e-9;

// Around the overlap, obstacles are looked for as far as the fingers reach about it [m]. Choice:
// two pad lengths.
double reach_of(const Gripper& gripper) { return 2.0 * gripper.pad_length; }

void require_valid_input(const Cell& cell, int part, const Pose& X_WP_goal,
                         const RankingOptions& options) {
  if (!cell.robot) throw InvalidInput("E_MISSING", "robot", "is missing, expected a robot");
  grasp::require_in_range(part, 0, static_cast<double>(cell.parts.size()) - 1, "part");
  require_rigid(X_WP_goal, "X_WP_goal");
  grasp::require_in_range(options.finger_clearance, 0.0, 0.1, "ranking.finger_clearance");
  grasp::require_in_range(options.open_clearance, 0.0, 0.5, "ranking.open_clearance");
  grasp::require_in_range(options.least_share, 0.0, 1.0, "ranking.least_share");
  grasp::require_in_range(options.most_targets, 1, 1000, "ranking.most_targets");
}

class Ranker {
 public:
  Ranker(const Cell& cell, int part, const Pose& X_WP_goal, const FeaturePairs& features,
         const RankingOptions& options)
      : cell_(cell),
        part_(cell.parts[static_cast<std::size_t>(part)]),
        gripper_(cell.robot->gripper),
        options_(options),
        obstruction_(part_, features.faces,
                     grasp::finger_extent(*cell.robot).thickness + options.open_clearance,
                     options.finger_clearance),
        nearby_(nearby_bodies(cell, part, X_WP_goal)),
        p_centre_(centre_of_mass(part_)) {}

  RankedPair rank(const FeaturePair& pair) {
    RankedPair ranked;
    ranked.pair = pair;
    ranked.centre_of_mass = (pair.X_PG.inverse() * p_centre_).head<2>();
    ranked.blocked = obstruction_.own(pair);
    if (covers(ranked, ranked.blocked)) ranked.obstructing.push_back("the part itself");
    add_obstacles(ranked, false);
    ranked.unobstructed = free_of(pair.overlap, ranked.blocked);
    ranked.share_at_origin = area(ranked.unobstructed) / pair.area;
    if (options_.use_destination && add_obstacles(ranked, true)) {
      ranked.unobstructed = free_of(pair.overlap, ranked.blocked);
    }
    ranked.contact_a = free_of(pair.contact_a, ranked.blocked);
    ranked.contact_b = free_of(pair.contact_b, ranked.blocked);
    const double free_area = area(ranked.unobstructed);
    ranked.share = free_area / pair.area;
    ranked.score =
        kind_worth(pair.kind) * ranked.share * std::min(1.0, free_area / full_area(pair));
    return ranked;
  }

  // Enough for a contact: the least area that a pad must have on a face, the least length of an
  // edge; a vertex must be free all round.
  bool is_usable(const RankedPair& ranked) const {
    if (ranked.share < options_.least_share) return false;
    const double free_area = area(ranked.unobstructed);
    switch (ranked.pair.kind) {
      case PairKind::FaceFace:
        return free_area >= std::min(0.1 * pad_area(), 25e-6);
      case PairKind::FaceEdge:
      case PairKind::ParallelEdges:
        return free_area >= kLeastContactLength * ranked.pair.strip;
      case PairKind::FaceVertex:
      case PairKind::CrossedEdges:
        return ranked.share > 0.99;
    }
    return false;
  }

  void choose_targets(RankedPair& ranked) const {
    ranked.targets = fingertip_targets(ranked.unobstructed, ranked.centre_of_mass, gripper_,
                                       options_.most_targets);
  }

 private:
  /// To what is blocked; true if there is anything.
  bool add_obstacles(RankedPair& ranked, bool at_destination) {
    const std::size_t known = ranked.blocked.loops.size();
    for (const NearbyBody& near : nearby_) {
      throw_if_stopped();
      if (near.at_destination != at_destination) continue;
      const Body& body = cell_.body(near.body);
      Region region = obstruction_.of_body(ranked.pair, body, near.X_PB, reach_of(gripper_));
      if (covers(ranked, region)) note(ranked, near);
      grasp::append(std::move(region), ranked.blocked);
    }
    return ranked.blocked.loops.size() > known;
  }

  /// Booleans take time by the number of loops: most are beside the region.
  static Region free_of(const Region& region, const Region& blocked) {
    return region.empty() ? Region{} : subtract(region, grasp::loops_near(blocked, region));
  }

  static bool covers(const RankedPair& ranked, const Region& region) {
    const Region near = grasp::loops_near(region, ranked.pair.overlap);
    return !near.empty() && area(intersect(ranked.pair.overlap, near)) >= kNoArea;
  }

  static void note(RankedPair& ranked, const NearbyBody& near) {
    ranked.obstructing.push_back(near.at_destination ? near.name + " (destination)" : near.name);
    (near.at_destination ? ranked.obstructing_at_destination : ranked.obstructing_at_origin)
        .push_back(near.name);
  }

  // The most that a pad can have of the overlap.
  double full_area(const FeaturePair& pair) const {
    if (pair.kind == PairKind::FaceFace) return pad_area();
    const bool is_line = pair.kind == PairKind::FaceEdge || pair.kind == PairKind::ParallelEdges;
    return pair.strip * (is_line ? gripper_.pad_length : pair.strip);
  }

  double pad_area() const { return gripper_.pad_width * gripper_.pad_length; }

  const Cell& cell_;
  const Body& part_;
  const Gripper& gripper_;
  const RankingOptions& options_;
  grasp::Obstruction obstruction_;
  std::vector<NearbyBody> nearby_;
  Eigen::Vector3d p_centre_;  // of mass, in the part
};

template <typename Pair>
bool has_faces_only(const Pair& pair) {
  return pair.a.kind == FeatureKind::Face && pair.b.kind == FeatureKind::Face;
}

bool is_asked_for(bool faces_only, const RankingOptions& options) {
  return options.pairs == PairChoice::All || faces_only == (options.pairs == PairChoice::TwoFaces);
}

// Best first; equal to 1e-9 is equal, so that rounding does not decide.
bool comes_before(const RankedPair& a, const RankedPair& b) {
  if (std::abs(a.score - b.score) > 1e-9) return a.score > b.score;
  const double area_a = a.share * a.pair.area, area_b = b.share * b.pair.area;
  if (std::abs(area_a - area_b) > 1e-12) return area_a > area_b;
  if (a.pair.kind != b.pair.kind) return a.pair.kind < b.pair.kind;
  if (a.pair.a.index != b.pair.a.index) return a.pair.a.index < b.pair.a.index;
  return a.pair.b.index < b.pair.b.index;
}

}  // namespace

Ranking rank_grasps(const Cell& cell, int part, const Pose& X_WP_goal, const FeaturePairs& features,
                    const RankingOptions& options) {
  require_valid_input(cell, part, X_WP_goal, options);
  Ranking ranking;
  ranking.faces = static_cast<int>(features.faces.size());
  ranking.edges = static_cast<int>(features.edges.size());
  ranking.vertices = static_cast<int>(features.vertices.size());
  ranking.beyond_faces = features.beyond_faces;
  for (const RejectedPair& pair : features.rejected) {
    if (is_asked_for(has_faces_only(pair), options)) ranking.rejected.push_back(pair);
  }
  Ranker ranker(cell, part, X_WP_goal, features, options);
  for (const FeaturePair& pair : features.pairs) {
    throw_if_stopped();
    if (!is_asked_for(has_faces_only(pair), options)) continue;
    RankedPair ranked = ranker.rank(pair);
    if (ranker.is_usable(ranked)) ranker.choose_targets(ranked);
    // An area too narrow for any target holds no pad either.
    (ranked.targets.empty() ? ranking.obstructed : ranking.ranked).push_back(std::move(ranked));
  }
  std::stable_sort(ranking.ranked.begin(), ranking.ranked.end(), comes_before);
  std::stable_sort(ranking.obstructed.begin(), ranking.obstructed.end(), comes_before);
  return ranking;
}

Ranking rank_grasps(const Cell& cell, int part, const Pose& X_WP_goal,
                    const RankingOptions& options) {
  require_valid_input(cell, part, X_WP_goal, options);
  FeatureOptions looked_for = options.features;
  looked_for.beyond_faces = looked_for.beyond_faces && options.pairs != PairChoice::TwoFaces;
  const FeaturePairs features = find_feature_pairs(cell.parts[static_cast<std::size_t>(part)],
                                                   cell.robot->gripper, looked_for);
  return rank_grasps(cell, part, X_WP_goal, features, options);
}

}  // namespace handey
