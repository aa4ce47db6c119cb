// Cells of hand poses, level by level, so that a legal pose is met early where there is one.
#include "handey/cspace/exhaustion.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "handey/errors.hpp"
#include "handey/grasp/hand_reach.hpp"
#include "handey/grasp/hand_solids.hpp"
#include "handey/grasp/target.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr int kJudged = 2;  // cells of this level and finer may be judged by their centres
constexpr int kFinest = 4;  // finer cells are not looked at
constexpr double kLeastPatch = 1e-9;  // less contact is none [m2]
constexpr double kPerimeter = 0.15;   // Choice: a joint turns less than a shift over this [m]
// An arm that hits something this much deeper than a fraction of the cell's shift is not saved by
// another pose of the cell. Choice.
constexpr double kDepthShare = 0.7;
constexpr double kOfFaces = 0.99;  // Choice: of the surface, where a part has no pair at all
// Choice: to solve the arm's joints costs as much as so many cells, to tell how deep it overlaps
// something as much as so many.
constexpr std::size_t kCostOfJoints = 2, kCostOfDepth = 25;
constexpr double kLeastDepth = 1e-3;  // [m]

/// Features as the check of a plan takes them, which is less strict than planning.
FeatureOptions all_features(int most_pairs) {
  FeatureOptions options;
  options.jaw_clearance = 0.0;
  options.friction_use = 1.0;
  options.angle = 0.0175;
  options.most_beyond_faces = most_pairs;
  return options;
}

/// Hand poses within (half, half, half_turn) of the middle, in the grasp plane.
struct HandCell {
  PlanarPose middle;
  int level = 0;  ///< half as wide as a cell of the level before
};

/// What made poses illegal, by volume.
class Tally {
 public:
  void add(const IllegalCause& cause, int level) {
    const double volume = std::pow(8.0, -level);
    total_ += volume;
    IllegalCause& known =
        causes_[{static_cast<int>(cause.kind), cause.mover, cause.other, cause.joint}];
    const double least = known.share > 0.0 ? std::min(known.least, cause.least) : cause.least;
    const double share = known.share + volume;
    known = cause;
    known.share = share;
    known.least = least;
  }
  std::vector<IllegalCause> causes() const {
    std::vector<IllegalCause> result;
    for (const auto& [key, cause] : causes_) {
      result.push_back(cause);
      result.back().share /= total_;
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.share > b.share; });
    return result;
  }

 private:
  std::map<std::tuple<int, std::string, std::string, int>, IllegalCause> causes_;
  double total_ = 0.0;
};

/// One place of the part.
struct Standing {
  Standing(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
           const Pose& X_WP, double hand, double part_radius, const Vector3d& part_centre)
      : X_RP(cell.X_WR.inverse() * X_WP),
        closed(model, cell.with_part_at(part, X_WP), closed_on(part)),
        solids(closed, X_RP * part_centre, part_radius + hand) {}

  static Allowance closed_on(int part) {
    Allowance allowance;
    allowance.closed_on = part;
    return allowance;
  }

  Pose X_RP;
  CollisionChecker closed;
  HandSolids solids;
};

enum class Verdict { Blocked, Empty, Legal, Doubt };

class Search {
 public:
  Search(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
         const std::vector<Pose>& places, const SphericalWristSolver& solver,
         const ExhaustionOptions& options)
      : robot_(*cell.robot), solver_(solver), reach_(solver.wrist_reach()), options_(options) {
    const Body& body = cell.parts[static_cast<std::size_t>(part)];
    Eigen::AlignedBox3d box;
    for (const Shape& shape : body.shapes) {
      for (const Vector3d& point : hull_points(shape)) box.extend(point);
    }
    const double hand = HandSolids::extent(robot_) + 0.5 * box.diagonal().norm();
    for (const Pose& X_WP : places) {
      standing_.push_back(std::make_unique<Standing>(model, cell, part, X_WP, hand,
                                                     0.5 * box.diagonal().norm(), box.center()));
    }
  }

  void look_at(const std::vector<FeaturePair>& pairs, Exhaustion& result) {
    std::vector<std::pair<int, HandCell>> cells, finer;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      for (const HandCell& cell : coarse_cells(pairs[p])) {
        cells.emplace_back(static_cast<int>(p), cell);
      }
    }
    while (!cells.empty()) {
      if (result.cells_looked_at + cost_ + cells.size() >= options_.most_cells) {
        give_up(result);  // all of them would have to be looked at
        return;
      }
      for (const std::size_t i : spread(cells.size())) {
        throw_if_stopped();
        const auto& [p, cell] = cells[i];
        if (result.cells_looked_at + cost_ >= options_.most_cells) {
          give_up(result);
          return;
        }
        ++result.cells_looked_at;
        const Verdict verdict = judge(pairs[static_cast<std::size_t>(p)], cell);
        if (verdict == Verdict::Legal) {
          result.reason = "a hand pose is legal";
          return;
        }
        if (verdict != Verdict::Doubt) continue;
        if (cell.level == kFinest) {
          result.reason = "a hand pose is nearly legal";
          return;
        }
        for (int k = 0; k < 8; ++k) finer.emplace_back(p, child(cell, k));
      }
      cells.swap(finer);
      finer.clear();
    }
    result.exhausted = true;
    result.spacing = judged_ ? options_.spacing : 0.0;
    result.turn = judged_ ? options_.turn : 0.0;
  }

  std::vector<IllegalCause> causes() const { return tally_.causes(); }

 private:
  static void give_up(Exhaustion& result) {
    result.reason = "given up after " + std::to_string(result.cells_looked_at) + " cells";
  }

  double width_at(int level) const { return options_.spacing * std::pow(2.0, kJudged - level); }
  double turn_at(int level) const { return options_.turn * std::pow(2.0, kJudged - level); }

  HandMotion motion_of(const FeaturePair& pair, int level) const {
    HandMotion motion;
    motion.shift = 0.5 * std::sqrt(2.0) * width_at(level) * (1.0 + pair.taper.norm());
    motion.half_turn = 0.5 * turn_at(level);
    return motion;
  }

  HandCell child(const HandCell& cell, int k) const {
    HandCell part = cell;
    ++part.level;
    const double step = 0.5 * width_at(part.level), turn = 0.5 * turn_at(part.level);
    part.middle.x += (k & 1) != 0 ? step : -step;
    part.middle.y += (k & 2) != 0 ? step : -step;
    part.middle.theta += (k & 4) != 0 ? turn : -turn;
    return part;
  }

  /// All poses at which a pad comes near the overlap.
  std::vector<HandCell> coarse_cells(const FeaturePair& pair) const {
    Eigen::AlignedBox2d box;
    for (const Polygon& loop : pair.overlap.loops) {
      for (const Eigen::Vector2d& corner : loop) box.extend(corner);
    }
    std::vector<HandCell> cells;
    if (box.isEmpty()) return cells;
    const Gripper& gripper = robot_.gripper;
    const double pad = 0.5 * std::hypot(gripper.pad_width, gripper.pad_length);
    const double step = width_at(0);
    const Eigen::Vector2d half = 0.5 * box.sizes() + Eigen::Vector2d::Constant(pad);
    const int columns = static_cast<int>(std::ceil(2.0 * half.x() / step));
    const int rows = static_cast<int>(std::ceil(2.0 * half.y() / step));
    const int turns = std::max(1, static_cast<int>(std::ceil(2.0 * kPi / turn_at(0) - 1e-6)));
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        for (int k = 0; k < turns; ++k) {
          const Eigen::Vector2d at =
              box.center() + step * Eigen::Vector2d(i - 0.5 * (columns - 1), j - 0.5 * (rows - 1));
          cells.push_back({{at.x(), at.y(), 2.0 * kPi * k / turns}, 0});
        }
      }
    }
    return cells;
  }

  /// Indices in an order that is spread evenly wherever one stops: steps of about the golden ratio.
  static std::vector<std::size_t> spread(std::size_t count) {
    std::size_t step =
        std::max<std::size_t>(1, static_cast<std::size_t>(0.6180339887498949 * double(count)));
    while (std::gcd(step, count) != 1) ++step;
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i * step % count;
    return order;
  }

  Verdict judge(const FeaturePair& pair, const HandCell& cell) {
    const HandMotion motion = motion_of(pair, cell.level);
    const Gripper& gripper = robot_.gripper;
    Gripper grown = gripper;
    const double grow = motion.of(0.5 * std::hypot(gripper.pad_width, gripper.pad_length));
    grown.pad_width += 2.0 * grow;
    grown.pad_length += 2.0 * grow;
    if (pad_contact_area(pair.overlap, cell.middle, grown) <= kLeastPatch) return Verdict::Empty;
    const bool touches = pad_contact_area(pair.overlap, cell.middle, gripper) > kLeastPatch;
    if (!touches && cell.level == kFinest) return Verdict::Empty;
    const double width =
        std::max(gripper.min_opening, pair.width_at({cell.middle.x, cell.middle.y}));
    // The two half-turns of the hand are judged together: what is left of either is looked at.
    bool doubt = false;
    for (const bool flipped : {false, true}) {
      const Pose X_PH = pair.X_PG * hand_in_plane(cell.middle, flipped);
      IllegalCause cause;
      const Verdict verdict = judge(pair, X_PH, width, motion, cell.level, touches, cause);
      if (verdict == Verdict::Legal) return verdict;
      if (verdict == Verdict::Doubt) {
        doubt = true;
        continue;
      }
      causes_of_cell_[flipped ? 1 : 0] = cause;
    }
    if (doubt) return Verdict::Doubt;
    for (const IllegalCause& cause : causes_of_cell_) tally_.add(cause, cell.level);
    return Verdict::Blocked;
  }

  Verdict judge(const FeaturePair& pair, const Pose& X_PH, double width, const HandMotion& motion,
                int level, bool touches, IllegalCause& cause) {
    bool doubt = false, proved = false;
    for (const auto& standing : standing_) {
      const Pose X_RH = standing->X_RP * X_PH;
      if (is_beyond_reach(X_RH, motion, cause)) return Verdict::Blocked;
      standing->solids.set_width(width);
      const Vector3d axis = standing->X_RP.linear() * pair.X_PG.linear().col(2);
      const std::optional<HandBlock> hit = standing->solids.blocking(X_RH, axis, motion);
      if (hit) {
        cause = {};
        cause.mover = standing->solids.mover_name(hit->mover);
        cause.other = standing->solids.other_name(hit->other);
        proved = true;
        break;
      }
    }
    if (proved) return Verdict::Blocked;
    bool legal = touches;
    for (const auto& standing : standing_) {
      const Verdict here =
          judge_centre(*standing, standing->X_RP * X_PH, width, motion, level, cause);
      if (here == Verdict::Blocked) {
        judged_ = true;
        return here;
      }
      if (here == Verdict::Doubt) doubt = true;
    }
    legal = legal && !doubt;
    return legal ? Verdict::Legal : Verdict::Doubt;
  }

  bool is_beyond_reach(const Pose& X_RH, const HandMotion& motion, IllegalCause& cause) const {
    const Vector3d from = X_RH * reach_.p_HC - reach_.centre;
    const double along = from.dot(reach_.axis);
    const double out = (from - along * reach_.axis).norm();
    const double lack = std::hypot(along, out - reach_.radius) - reach_.farthest;
    if (lack <= motion.of(reach_.p_HC.norm())) return false;
    cause = {};
    cause.kind = IllegalKind::OutOfReach;
    cause.least = lack;
    return true;
  }

  /// Illegal by so much that no other pose of the cell can be expected to be legal? Only in cells
  /// that are fine enough.
  Verdict judge_centre(Standing& standing, const Pose& X_RH, double width, const HandMotion& motion,
                       int level, IllegalCause& cause) {
    const InverseResult inverse = solver_.solve(X_RH);
    cost_ += kCostOfJoints;
    if (inverse.solutions.empty()) {
      cause = {};
      cause.least = inverse.excess;
      const bool turned = inverse.status == InverseStatus::OutsideLimits;
      cause.kind = turned ? IllegalKind::JointLimit : IllegalKind::OutOfReach;
      cause.joint = turned ? inverse.joint : -1;
      const double margin =
          turned ? motion.half_turn + motion.shift / kPerimeter : motion.of(reach_.p_HC.norm());
      return level >= kJudged && inverse.excess > margin ? Verdict::Blocked : Verdict::Doubt;
    }
    const double depth = std::max(kLeastDepth, kDepthShare * motion.shift);
    bool all_deep = level >= kJudged;
    int branch = -1;
    for (const InverseSolution& solution : inverse.solutions) {
      if (solution.branch == branch) continue;  // the same but for full turns
      branch = solution.branch;
      const Configuration closed{solution.q, width};
      if (all_deep && is_deep(standing, closed, depth, cause)) continue;
      if (!standing.closed.find_hit(closed, 0.0)) return Verdict::Legal;
      if (!all_deep) continue;
      cost_ += kCostOfDepth;
      const std::vector<Hit> hits = robot_overlaps(standing.closed, closed, depth);
      all_deep = !hits.empty();
      if (!all_deep) continue;
      cause = {};
      cause.mover = hits.front().a;
      cause.other = hits.front().b;
    }
    return all_deep ? Verdict::Blocked : Verdict::Doubt;
  }

  static bool is_deep(Standing& standing, const Configuration& closed, double depth,
                      IllegalCause& cause) {
    const std::optional<HandBlock> hit = standing.solids.deep_in_arm(closed, depth);
    if (!hit) return false;
    cause = {};
    cause.mover = standing.solids.mover_name(hit->mover);
    cause.other = standing.solids.other_name(hit->other);
    return true;
  }

  const Robot& robot_;
  const SphericalWristSolver& solver_;
  const WristReach reach_;
  const ExhaustionOptions options_;
  std::vector<std::unique_ptr<Standing>> standing_;
  IllegalCause causes_of_cell_[2];
  Tally tally_;
  bool judged_ = false;
  std::size_t cost_ = 0;  ///< beside the cells
};

bool is_round(const Body& part) {
  return std::any_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) {
    return std::holds_alternative<Sphere>(shape.geometry);
  });
}

/// Are nearly all of its surfaces faces? Where there are none, it is not known how to hold it.
bool is_of_faces(const Body& part, const FeaturePairs& features) {
  double all = 0.0, faces = 0.0;
  for (const Shape& shape : part.shapes) {
    const TriangleMesh mesh = tessellate(shape);
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const auto corner = [&](int i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
      all += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
  }
  for (const PlanarFace& face : features.faces) faces += face.area;
  return faces > kOfFaces * all;
}

void require_inputs(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
                    const std::vector<Pose>& places, const ExhaustionOptions& options) {
  if (!model) throw InvalidInput("E_MISSING", "model", "is missing");
  if (!cell.robot) throw InvalidInput("E_MISSING", "cell.robot", "is missing");
  if (part < 0 || static_cast<std::size_t>(part) >= cell.parts.size()) {
    throw InvalidInput("E_REF", "part", std::to_string(part) + " is not an index of a part");
  }
  if (cell.held) {
    throw InvalidInput("E_RANGE", "cell.held", "holds a part, expected an empty hand");
  }
  if (places.empty()) throw InvalidInput("E_EMPTY", "places", "is empty, expected at least one");
  for (const Pose& place : places) require_rigid(place, "places");
  const auto within = [](double value, double least, double most) {
    return std::isfinite(value) && value >= least && value <= most;
  };
  if (!within(options.spacing, 1e-4, 1.0)) {
    throw InvalidInput("E_RANGE", "spacing", "expected 1e-4 to 1 m");
  }
  if (!within(options.turn, 1e-3, 1.0)) {
    throw InvalidInput("E_RANGE", "turn", "expected 1e-3 to 1 rad");
  }
  if (options.most_pairs < 0) {
    throw InvalidInput("E_RANGE", "most_pairs", "is negative, expected 0 or more");
  }
}

}  // namespace

Exhaustion exhaust_grasps(const std::shared_ptr<const CollisionModel>& model, const Cell& cell,
                          int part, const std::vector<Pose>& places,
                          const SphericalWristSolver& solver, const ExhaustionOptions& options) {
  require_inputs(model, cell, part, places, options);
  const Body& body = cell.parts[static_cast<std::size_t>(part)];
  const FeatureOptions wanted = all_features(options.most_pairs);
  const FeaturePairs features = find_feature_pairs(body, cell.robot->gripper, wanted);
  Exhaustion result;
  result.pairs = static_cast<int>(features.pairs.size());
  const auto of_faces =
      std::count_if(features.pairs.begin(), features.pairs.end(),
                    [](const FeaturePair& pair) { return pair.kind == PairKind::FaceFace; });
  if (is_round(body) || features.beyond_faces > result.pairs - static_cast<int>(of_faces) ||
      static_cast<int>(features.edges.size()) > wanted.most_edges) {
    result.reason = "the part has too many features, or round ones";
    return result;
  }
  if (features.pairs.empty() && !is_of_faces(body, features)) {
    result.reason = "the part has no pair of features, but it is not all of flat faces";
    return result;
  }
  Search search(model, cell, part, places, solver, options);
  search.look_at(features.pairs, result);
  if (result.exhausted) result.causes = search.causes();
  return result;
}

}  // namespace handey
