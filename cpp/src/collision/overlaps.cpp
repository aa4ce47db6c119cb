// What overlaps or touches where bodies rest.
#include <algorithm>
#include <cmath>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "overlap.hpp"

namespace handey {

using collision::BodyGeometry;

namespace {

void require_not_negative(double value, const char* name) {
  if (std::isfinite(value) && value >= 0.0) return;
  throw InvalidInput("E_RANGE", name, std::to_string(value) + ", must be finite and not negative");
}

bool balls_apart(const BodyGeometry& a, const Pose& X_WA, const BodyGeometry& b, const Pose& X_WB,
                 double gap) {
  return (X_WA * a.centre - X_WB * b.centre).norm() > a.radius + b.radius + gap;
}

/// The deepest overlap of any two pieces: at least so far the bodies must be moved.
double body_depth(const BodyGeometry& a, const Pose& X_WA, const BodyGeometry& b,
                  const Pose& X_WB) {
  double depth = 0.0;
  if (balls_apart(a, X_WA, b, X_WB, 0.0)) return depth;
  for (const auto& piece_a : a.pieces) {
    for (const auto& piece_b : b.pieces) {
      throw_if_stopped();
      depth = std::max(depth, collision::overlap_depth(*piece_a, X_WA, *piece_b, X_WB));
    }
  }
  return depth;
}

bool are_near(const BodyGeometry& a, const Pose& X_WA, const BodyGeometry& b, const Pose& X_WB,
              double gap) {
  if (balls_apart(a, X_WA, b, X_WB, gap)) return false;
  for (const auto& piece_a : a.pieces) {
    throw_if_stopped();
    for (const auto& piece_b : b.pieces) {
      if (collision::piece_distance(*piece_a, X_WA, *piece_b, X_WB, gap, gap) <= gap) return true;
    }
  }
  return false;
}

/// All bodies that stand: fixtures, then the parts that are not held.
std::vector<collision::Obstacle> standing_bodies(const CollisionModel::Impl& model,
                                                 const Cell& cell) {
  return collision::make_obstacles(model, cell, Pose::Identity());
}

}  // namespace

std::vector<Overlap> find_overlaps(const CollisionModel& model, const Cell& cell,
                                   double tolerance) {
  require_not_negative(tolerance, "tolerance");
  collision::require_same_bodies(model.impl(), cell);
  const std::vector<collision::Obstacle> bodies = standing_bodies(model.impl(), cell);
  std::vector<Overlap> overlaps;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (bodies[j].ref.kind == BodyRef::Kind::Fixture)
        continue;  // fixtures may run into each other
      const double depth =
          body_depth(*bodies[i].geometry, bodies[i].X_RB, *bodies[j].geometry, bodies[j].X_RB);
      if (depth <= tolerance) continue;
      overlaps.push_back({bodies[i].ref, bodies[j].ref, bodies[i].label, bodies[j].label, depth});
    }
  }
  return overlaps;
}

std::vector<BodyRef> touching_bodies(const CollisionModel& model, const Cell& cell, int part,
                                     double gap) {
  require_not_negative(gap, "gap");
  collision::require_same_bodies(model.impl(), cell);
  collision::require_part(cell, part, "part");
  const BodyGeometry& own = model.impl().parts[static_cast<std::size_t>(part)];
  const Pose& X_WP = cell.parts[static_cast<std::size_t>(part)].X_WB;
  std::vector<BodyRef> touching;
  for (const collision::Obstacle& body : standing_bodies(model.impl(), cell)) {
    if (body.ref == BodyRef{BodyRef::Kind::Part, part}) continue;
    if (are_near(own, X_WP, *body.geometry, body.X_RB, gap)) touching.push_back(body.ref);
  }
  return touching;
}

std::vector<Hit> robot_overlaps(CollisionChecker& checker, const Configuration& configuration,
                                double tolerance) {
  require_not_negative(tolerance, "tolerance");
  CollisionChecker::Impl& impl = checker.impl();
  impl.place(configuration);
  std::vector<Hit> hits;
  const auto look = [&](std::size_t m, const std::string& name, const BodyGeometry& other,
                        const Pose& X_RO) {
    const double depth = body_depth(*impl.movers[m].geometry, impl.X_RM[m], other, X_RO);
    if (depth > tolerance) hits.push_back({impl.movers[m].label, name, -depth});
  };
  for (std::size_t m = 0; m < impl.movers.size(); ++m) {
    for (std::size_t o = 0; o < impl.obstacles.size(); ++o) {
      const collision::Obstacle& obstacle = impl.obstacles[o];
      const bool base_and_part =
          impl.movers[m].is_base() && obstacle.ref.kind == BodyRef::Kind::Part;
      if (impl.movers[m].against[o] == 0 && !base_and_part) continue;
      look(m, obstacle.label, *obstacle.geometry, obstacle.X_RB);
    }
  }
  for (const auto& [a, b] : impl.mover_pairs) {
    const std::size_t other = static_cast<std::size_t>(b);
    look(static_cast<std::size_t>(a), impl.movers[other].label, *impl.movers[other].geometry,
         impl.X_RM[other]);
  }
  return hits;
}

}  // namespace handey
