// The iteration of Figure 5. Each turn: which bump lines touch filled cells; their bump vectors are
// zeroed; move along the goal vector if it has no component along a zeroed one, else along the
// remaining bump vector nearest to it; turn with the torque of the touching lines; never more than
// a cell. Ours: the order of further tries when a step is refused, and a short memory of poses
// against moving to and fro.
#include "handey/approach/quasipotential.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <string>

#include "hand_on_grid.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"

namespace handey {

namespace {

// Choice: rounding of unit vectors; a smaller component along a zeroed bump vector is none.
constexpr double kComponent = 1e-6;
// Choice: directions that lead back by more than 120 degrees from the goal vector are not taken, or
// a hand that is held up would leave the way it came.
constexpr double kMostBackward = -0.5;
// Choice: poses remembered; a loop of two or four steps is met.
constexpr std::size_t kMemory = 8;
constexpr double kSamePose = 0.05;  // cells; nearer poses are the same

void require_range(bool good, const std::string& message) {
  if (!good) throw InvalidInput("E_RANGE", "slide_to_target", message);
}

void require_valid(const MotionGrid& grid, const GripperOutline& outline, const PlanarPose& start,
                   const std::vector<Eigen::Vector2d>& route,
                   const QuasipotentialOptions& options) {
  const bool is_finite =
      std::isfinite(start.x) && std::isfinite(start.y) && std::isfinite(start.theta) &&
      std::isfinite(options.torque_gain) && std::isfinite(options.lead) &&
      std::all_of(route.begin(), route.end(),
                  [](const Eigen::Vector2d& point) { return point.allFinite(); });
  if (!is_finite) {
    throw InvalidInput("E_NUMBER", "slide_to_target",
                       "start, target, lead and torque gain must be finite numbers");
  }
  require_range(!route.empty(), "the route has no point");
  require_range(static_cast<std::size_t>(grid.layers()) == outline.pieces.size(),
                "the grid has " + std::to_string(grid.layers()) + " layers, the gripper " +
                    std::to_string(outline.pieces.size()) +
                    " pieces; there must be one layer each");
  require_range(grid.is_inside({start.x, start.y}), "the start lies outside the grid");
  for (const Eigen::Vector2d& point : route) {
    require_range(grid.is_inside(point), "the target lies outside the grid");
  }
  require_range(options.clearance >= 1.5 * grid.cell() * (1.0 - 1e-9),
                "clearance " + std::to_string(options.clearance) +
                    " m must be at least 1.5 cells of " + std::to_string(grid.cell()) + " m");
  require_range(options.max_iterations >= 1 && options.progress_interval >= 1,
                "max_iterations and progress_interval must be at least 1");
  require_range(options.torque_gain >= 0.0, "torque_gain must not be negative");
  require_range(options.lead >= 0.0, "lead must not be negative");
}

class Slide {
 public:
  Slide(const MotionGrid& grid, const GripperOutline& outline,
        const std::vector<Eigen::Vector2d>& route, const ReachTest& reachable,
        const QuasipotentialOptions& options)
      : grid_(grid),
        outline_(outline),
        route_(route),
        target_(route.back()),
        reachable_(reachable),
        options_(options),
        lines_(bump_lines(outline, options.clearance)) {
    for (const BumpLine& line : lines_) {
      radius_ = std::max({radius_, line.a.norm(), line.b.norm()});
    }
  }

  SlideResult run(const PlanarPose& start);

 private:
  struct Motion {
    Eigen::Vector2d direction;  // unit, or zero to turn only
    double length, turn;
  };

  double distance(const PlanarPose& pose) const {
    return (target_ - Eigen::Vector2d(pose.x, pose.y)).norm();
  }
  const Eigen::Vector2d& attraction() const { return route_[ahead_]; }
  void move_attraction(const PlanarPose& pose);
  double way_left(const PlanarPose& pose) const;
  std::vector<bool> touching_lines(const PlanarPose& pose) const;
  double torque(const std::vector<bool>& touching) const;
  std::vector<Eigen::Vector2d> directions(const PlanarPose& pose,
                                          const std::vector<bool>& touching) const;
  std::vector<Motion> motions(const PlanarPose& pose, const std::vector<bool>& touching) const;
  PlanarPose moved(const PlanarPose& pose, const Motion& motion) const;
  bool was_there(const PlanarPose& pose) const;
  bool step(PlanarPose& pose, const std::vector<bool>& touching);
  void end_where_nearest();

  const MotionGrid& grid_;
  const GripperOutline& outline_;
  const std::vector<Eigen::Vector2d>& route_;
  std::size_t ahead_ = 0;  // the point of the route that attracts
  const Eigen::Vector2d target_;
  const ReachTest& reachable_;
  const QuasipotentialOptions& options_;
  const std::vector<BumpLine> lines_;
  double radius_ = 0.0;  // of the farthest bump-line end from the finger grasp point
  std::deque<PlanarPose> memory_;
  SlideResult result_;
};

void Slide::move_attraction(const PlanarPose& pose) {
  const Eigen::Vector2d here(pose.x, pose.y);
  while (ahead_ + 1 < route_.size() && (attraction() - here).norm() < options_.lead) ++ahead_;
}

/// To the attraction point, and from there along the route.
double Slide::way_left(const PlanarPose& pose) const {
  double left = (attraction() - Eigen::Vector2d(pose.x, pose.y)).norm();
  for (std::size_t i = ahead_; i + 1 < route_.size(); ++i) {
    left += (route_[i + 1] - route_[i]).norm();
  }
  return left;
}

std::vector<bool> Slide::touching_lines(const PlanarPose& pose) const {
  std::vector<bool> touching(lines_.size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    touching[i] =
        grid_.touches(lines_[i].layer, placed(pose, lines_[i].a), placed(pose, lines_[i].b));
  }
  return touching;
}

// Sum of cross(bump vector, finger grasp point -> centre of the line): the turn that a push against
// the bump vector gives.
double Slide::torque(const std::vector<bool>& touching) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!touching[i]) continue;
    const Eigen::Vector2d arm = 0.5 * (lines_[i].a + lines_[i].b);
    sum += lines_[i].normal.x() * arm.y() - lines_[i].normal.y() * arm.x();
  }
  return sum;
}

/// The goal vector if it is allowed, then the remaining bump vectors, nearest to it first.
std::vector<Eigen::Vector2d> Slide::directions(const PlanarPose& pose,
                                               const std::vector<bool>& touching) const {
  const Eigen::Vector2d goal = (attraction() - Eigen::Vector2d(pose.x, pose.y)).normalized();
  const auto is_allowed = [&](const Eigen::Vector2d& direction) {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (touching[i] && turned(pose, lines_[i].normal).dot(direction) > kComponent) return false;
    }
    return true;
  };
  std::vector<Eigen::Vector2d> bump_vectors;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Eigen::Vector2d bump = turned(pose, lines_[i].normal);
    if (touching[i] || bump.dot(goal) < kMostBackward || !is_allowed(bump)) continue;
    const bool known = std::any_of(
        bump_vectors.begin(), bump_vectors.end(),
        [&](const Eigen::Vector2d& other) { return (other - bump).norm() < kComponent; });
    if (!known) bump_vectors.push_back(bump);
  }
  std::stable_sort(bump_vectors.begin(), bump_vectors.end(),
                   [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                     return a.dot(goal) > b.dot(goal) + kComponent;
                   });
  if (is_allowed(goal)) bump_vectors.insert(bump_vectors.begin(), goal);
  return bump_vectors;
}

/// What to try in this iteration, in this order.
std::vector<Slide::Motion> Slide::motions(const PlanarPose& pose,
                                          const std::vector<bool>& touching) const {
  const double cell = grid_.cell();
  const double wanted = options_.torque_gain * torque(touching);
  const double most_alone = cell / radius_;  // a cell at the farthest point
  const double turn = std::clamp(wanted, -0.5 * most_alone, 0.5 * most_alone);
  const Eigen::Vector2d to_target = attraction() - Eigen::Vector2d(pose.x, pose.y);
  std::vector<Motion> result;
  for (const Eigen::Vector2d& direction : directions(pose, touching)) {
    const auto length = [&](double most) {  // not past the point nearest to the target
      const double ahead = direction.dot(to_target);
      return ahead > 0.0 ? std::min(most, ahead) : most;
    };
    if (turn != 0.0) {
      result.push_back({direction, length(cell - radius_ * std::abs(turn)), turn});
    }
    result.push_back({direction, length(cell), 0.0});
    if (turn != 0.0 && result.size() == 2) {
      result.push_back({Eigen::Vector2d::Zero(), 0.0, std::clamp(wanted, -most_alone, most_alone)});
    }
  }
  if (result.empty() && turn != 0.0) {
    result.push_back({Eigen::Vector2d::Zero(), 0.0, std::clamp(wanted, -most_alone, most_alone)});
  }
  return result;
}

PlanarPose Slide::moved(const PlanarPose& pose, const Motion& motion) const {
  Eigen::Vector2d point = Eigen::Vector2d(pose.x, pose.y) + motion.length * motion.direction;
  // The last step lands on the target and not a rounding error beside it.
  if ((point - target_).norm() < 1e-12) point = target_;
  return {point.x(), point.y(), pose.theta + motion.turn};
}

bool Slide::was_there(const PlanarPose& pose) const {
  const double same = kSamePose * grid_.cell();
  return std::any_of(memory_.begin(), memory_.end(), [&](const PlanarPose& other) {
    return std::hypot(pose.x - other.x, pose.y - other.y) < same &&
           radius_ * std::abs(pose.theta - other.theta) < same;
  });
}

bool Slide::step(PlanarPose& pose, const std::vector<bool>& touching) {
  for (const Motion& motion : motions(pose, touching)) {
    const PlanarPose next = moved(pose, motion);
    const bool arrives = distance(next) == 0.0;
    if ((!arrives && was_there(next)) || touches_filled(grid_, outline_, next)) continue;
    if (!reachable_(next)) {
      ++result_.refusals;
      continue;
    }
    memory_.push_back(next);
    if (memory_.size() > kMemory) memory_.pop_front();
    result_.path.push_back(next);
    pose = next;
    return true;
  }
  return false;
}

// What was walked after the nearest pose only led away.
void Slide::end_where_nearest() {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < result_.path.size(); ++i) {
    if (distance(result_.path[i]) < distance(result_.path[nearest])) nearest = i;
  }
  result_.path.resize(nearest + 1);
}

SlideResult Slide::run(const PlanarPose& start) {
  PlanarPose pose = start;
  if (touches_filled(grid_, outline_, start) || covers_filled(grid_, outline_, start) ||
      !reachable_(start)) {
    result_.status = SlideStatus::StartBlocked;
    return result_;
  }
  result_.path.push_back(start);
  memory_.push_back(start);
  double left_before = std::numeric_limits<double>::infinity();
  std::ptrdiff_t touching_before = 0;
  result_.status = SlideStatus::IterationLimit;
  while (result_.iterations < options_.max_iterations) {
    throw_if_stopped();
    if (distance(pose) == 0.0) {
      result_.status = SlideStatus::Reached;
      return result_;
    }
    move_attraction(pose);
    move_attraction(pose);
    const std::vector<bool> touching = touching_lines(pose);
    if (result_.iterations % options_.progress_interval == 0) {
      const std::ptrdiff_t count = std::count(touching.begin(), touching.end(), true);
      if (way_left(pose) > left_before - grid_.cell() && count >= touching_before) {
        result_.status = SlideStatus::Stalled;
        break;
      }
      left_before = way_left(pose);
      touching_before = count;
    }
    ++result_.iterations;
    if (!step(pose, touching)) {
      result_.status = SlideStatus::Stalled;
      break;
    }
  }
  if (distance(pose) == 0.0)
    result_.status = SlideStatus::Reached;
  else
    end_where_nearest();
  return result_;
}

}  // namespace

SlideResult slide_to_target(const MotionGrid& grid, const GripperOutline& outline,
                            const PlanarPose& start, const Eigen::Vector2d& target,
                            const ReachTest& reachable, const QuasipotentialOptions& options) {
  return slide_along(grid, outline, start, {target}, reachable, options);
}

SlideResult slide_along(const MotionGrid& grid, const GripperOutline& outline,
                        const PlanarPose& start, const std::vector<Eigen::Vector2d>& route,
                        const ReachTest& reachable, const QuasipotentialOptions& options) {
  require_valid(grid, outline, start, route, options);
  if (!reachable) {
    throw InvalidInput("E_VALUE", "slide_to_target", "there must be a reach test");
  }
  return Slide(grid, outline, route, reachable, options).run(start);
}

}  // namespace handey
