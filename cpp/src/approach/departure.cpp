// Slides start where there is room and come in to the start of the departure, the arm led out
// before, so that it is in the start's branch. What the search finds is kept to an end with room:
// first by ending sooner on the way that it found, then by asking for other ends.
#include "handey/approach/departure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "certified_path.hpp"
#include "hand_reach.hpp"
#include "hand_search.hpp"
#include "hand_slide.hpp"
#include "hand_with_part.hpp"
#include "handey/errors.hpp"
#include "obstacle_layers.hpp"
#include "reason.hpp"
#include "room.hpp"
#include "slide_starts.hpp"

namespace handey {

namespace {

void require_range(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "plan_departure", message);
}

void require_valid(CollisionChecker& checker, const Configuration& start,
                   const DepartureOptions& options) {
  const std::size_t joints = checker.cell().robot->joints.size();
  if (static_cast<std::size_t>(start.q.size()) != joints) {
    throw InvalidInput("E_DOF", "plan_departure",
                       "the start has " + std::to_string(start.q.size()) +
                           " joint values, the arm " + std::to_string(joints) + " joints");
  }
  if (!start.q.allFinite() || !std::isfinite(start.opening)) {
    throw InvalidInput("E_NUMBER", "plan_departure", "the start must be finite numbers");
  }
  require_range(options.cell > 0.0 && options.slide.clearance >= 1.5 * options.cell * (1.0 - 1e-9),
                "the bump lines' clearance must be at least 1.5 cells");
  require_range(options.least > 0.0 && options.least <= options.most && options.most <= 1.0,
                "there must be 0 < least <= most <= 1 m");
  require_range(options.clearance >= 0.0 && options.clearance < 0.1,
                "clearance must be 0 to 0.1 m");
  require_range(options.room >= 0.0 && options.room < 1.0, "room must be 0 to 1 rad");
  require_range(options.most_slides >= 0, "most_slides must not be negative");
  require_range(options.search_levels >= 0 && options.search_levels <= 3,
                "search_levels must be 0 to 3");
  const std::optional<Hit> hit = checker.find_hit(start, options.certificate.clearance);
  if (hit) {
    throw InvalidInput("E_VALUE", "plan_departure", "the start is not free: " + describe(*hit));
  }
}

Pose plane_of_hand(const Cell& cell, const Eigen::VectorXd& q) {
  return hand_in_world(cell, q) * hand_in_plane({}, false).inverse(Eigen::Isometry);
}

/// A way with one configuration for each pose, from the start outwards.
struct Way {
  std::vector<Configuration> points;
  std::vector<PlanarPose> poses;
};

class Departure {
 public:
  Departure(CollisionChecker& checker, const SphericalWristSolver& solver,
            const Configuration& start, const DepartureOptions& options)
      : checker_(checker),
        start_(start),
        options_(options),
        X_WG_(plane_of_hand(checker.cell(), start.q)),
        gripper_(gripper_outline(*checker.cell().robot, start.opening, false)),
        outline_(outline_with_part(gripper_, checker.cell())),
        obstacles_(checker.cell(), outline_, X_WG_, {0.0, 0.0}, half_size()),
        reach_(solver, checker, X_WG_, false, start.opening, options.clearance) {}

  DepartureResult run() {
    if (options_.most_slides > 0) slide();
    if (options_.search_levels > 0 && !is_settled()) search();
    if (!best_.found) {
      best_.planner = result_.planner;
      best_.reason = result_.reason.empty() ? "no planner was asked" : result_.reason;
    }
    return best_;
  }

 private:
  double half_size() const {
    return options_.most + outline_.radius +
           std::max(options_.slide.clearance, 2.0 * options_.cell);
  }
  /// Is there nothing better to look for?
  bool is_settled() const { return best_.found && (best_.has_room || options_.room <= 0.0); }

  void slide() {
    result_.planner = ApproachPlanner::Quasipotential;
    HandSlider slider(outline_, obstacles_, reach_, {}, options_.cell, options_.slide);
    std::vector<SlideStart> starts = turned_starts({}, options_.most, options_.most);
    std::optional<SlideStart> widest = widest_start(slider.grid(), outline_, {}, options_.most);
    if (widest) starts.insert(starts.begin(), std::move(*widest));
    int slides = 0;
    for (const SlideStart& from : starts) {
      if (slides == options_.most_slides || is_settled()) break;
      const std::optional<Eigen::VectorXd> q = reach_.lead({}, from.pose, start_.q);
      if (!q || !reach_.follow_free(from.pose, *q)) continue;
      ++slides;
      HandSlide in = slider.run(from.pose, *q, from.route);
      if (!in.at_aim || (in.q.back() - start_.q).cwiseAbs().maxCoeff() > kSameConfiguration) {
        result_.reason = "a slide stalled" + (in.reason.empty() ? "" : ": " + in.reason);
        continue;
      }
      take(backwards(in));
    }
    if (slides == 0) result_.reason = "no slide could start: " + reach_.reason();
  }

  Way backwards(const HandSlide& in) const {
    Way way;
    for (std::size_t i = in.q.size(); i-- > 0;) {
      way.points.push_back(reach_.with_opening(in.q[i]));
      way.poses.push_back(in.slide.path[i]);
    }
    way.points.front() = start_;
    return way;
  }

  void search() {
    result_.planner = ApproachPlanner::PlaneSearch;
    const GripperOutline core = core_with_part(gripper_, checker_);
    const ObstacleLayers within(checker_.cell(), core, X_WG_, {0.0, 0.0}, half_size());
    BoxProver prover(checker_, options_.certificate.clearance);
    int ends = 0;
    const EndTest may_end = [&](const Eigen::VectorXd& q) {
      return ++ends <= kMostEnds && has_room(prover, reach_.with_opening(q), options_.room);
    };
    for (int level = 0; level < options_.search_levels && !is_settled(); ++level) {
      const double cell = std::ldexp(options_.cell, -level);
      PlaneSearch plane(obstacles_.draw(cell), outline_, within.draw_inside(cell), core, {},
                        options_.most, options_.search);
      HandSearch search(std::move(plane), reach_, {}, options_.certificate);
      if (!best_.found && !try_ends(search, {})) continue;
      if (!is_settled()) try_ends(search, may_end);
    }
  }

  bool try_ends(HandSearch& search, const EndTest& may_end) {
    SearchedWay found = search.way_from({}, start_.q, may_end);
    if (!found.found) {
      result_.reason = found.reason;
      return false;
    }
    Way way;
    way.points.assign(found.points.rbegin(), found.points.rend());
    way.poses.assign(found.poses.rbegin(), found.poses.rend());
    take(std::move(way));
    return true;
  }

  /// Certifies a way as far as it has room; keeps it if it is better than the one before.
  void take(Way way) {
    std::size_t first = 0;
    while (first + 1 < way.poses.size() &&
           std::hypot(way.poses[first].x, way.poses[first].y) < options_.least - 1e-9) {
      ++first;
    }
    std::optional<std::size_t> roomy;
    if (options_.room > 0.0) {
      roomy = last_with_room(checker_, way.points, first, options_.room,
                             options_.certificate.clearance);
    }
    if (best_.found && !roomy) return;
    const std::size_t end = roomy.value_or(way.points.size() - 1);
    way.points.resize(end + 1);
    way.poses.resize(end + 1);
    CertifiedPath proved = certified_path(checker_, way.points, options_.certificate);
    if (proved.reached < end) {
      result_.reason = "the way out is not proved free: " + describe(proved.obstacle.hit);
      return;
    }
    best_ = {true, result_.planner, std::move(proved.path), std::move(way.poses), roomy.has_value(),
             ""};
  }

  // Choice: ends of ways that are asked whether they have room.
  static constexpr int kMostEnds = 24;
  // Choice: far above rounding, far below what moves a finger [rad].
  static constexpr double kSameConfiguration = 1e-6;

  CollisionChecker& checker_;
  const Configuration& start_;
  const DepartureOptions& options_;
  const Pose X_WG_;
  const GripperOutline gripper_, outline_;  // without and with what is held
  const ObstacleLayers obstacles_;
  HandReach reach_;
  DepartureResult best_;
  DepartureResult result_;  // planner and reason of what was tried last
};

}  // namespace

DepartureResult plan_departure(CollisionChecker& checker, const SphericalWristSolver& solver,
                               const Configuration& start, const DepartureOptions& options) {
  require_valid(checker, start, options);
  return Departure(checker, solver, start, options).run();
}

}  // namespace handey
