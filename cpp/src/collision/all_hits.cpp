// Looks at all pairs of pieces that are near each other, and tells each pair of bodies once.
#include "handey/collision/all_hits.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "overlap.hpp"

namespace handey {
namespace {

bool is_hand(const CollisionChecker::Impl& impl, std::size_t mover) {
  const collision::Mover& one = impl.movers[mover];
  return one.finger || one.body == impl.cell.robot->gripper.body;
}

std::vector<Hit> near_pairs(const CollisionChecker::Impl& impl, HitsOf of, double clearance) {
  std::vector<Hit> hits;
  std::set<std::pair<int, int>> seen;
  const auto key = [&](const PiecePair& pair) {
    if (pair.other >= 0) return std::make_pair(pair.mover, -1 - pair.other);
    const std::size_t piece = static_cast<std::size_t>(pair.other_piece);
    return std::make_pair(pair.mover, impl.obstacle_pieces[piece].obstacle);
  };
  impl.visit_near([clearance](const PiecePair&) { return clearance; },
                  [&](const PiecePair& pair) {
                    const bool hand_and_cell =
                        pair.other < 0 && is_hand(impl, static_cast<std::size_t>(pair.mover));
                    if (of != HitsOf::Everything && (of == HitsOf::Hand) != hand_and_cell) {
                      return false;
                    }
                    if (seen.count(key(pair)) != 0) return false;
                    if (impl.distance(pair, clearance, clearance) > clearance) return false;
                    seen.insert(key(pair));
                    hits.push_back(impl.hit(pair, clearance));
                    return false;
                  });
  return hits;
}

/// The arm where it may be, the hand at X_RH.
void place_hand(CollisionChecker::Impl& impl, const Pose& X_RH, double opening) {
  require_rigid(X_RH, "X_RH");
  if (!std::isfinite(opening)) throw InvalidInput("E_NUMBER", "opening", "is not finite");
  const Gripper& gripper = impl.cell.robot->gripper;
  const Pose X_RB = X_RH * gripper.X_BH.inverse();
  for (std::size_t m = 0; m < impl.movers.size(); ++m) {
    const collision::Mover& mover = impl.movers[m];
    Pose X = X_RB;
    if (mover.finger) {
      for (const FingerJoint& finger : gripper.fingers) {
        if (finger.child != mover.body) continue;
        X = X_RB * finger.X_PJ * Eigen::Translation3d(0.5 * opening * finger.axis);
      }
    } else if (mover.body != gripper.body) {
      continue;
    } else if (m >= impl.model->robot_bodies.size()) {
      X = X * mover.X_BM;
    }
    impl.X_RM[m] = X;
    impl.mover_centres[m] = X * mover.geometry->centre;
  }
}

}  // namespace

std::vector<Hit> find_all_hits(CollisionChecker& checker, const Configuration& configuration,
                               HitsOf of, double clearance) {
  if (!std::isfinite(clearance)) throw InvalidInput("E_NUMBER", "clearance", "is not finite");
  checker.impl().place(configuration);
  return near_pairs(checker.impl(), of, clearance);
}

std::vector<Hit> find_hand_hits(CollisionChecker& checker, const Pose& X_RH, double opening,
                                double clearance) {
  if (!std::isfinite(clearance)) throw InvalidInput("E_NUMBER", "clearance", "is not finite");
  CollisionChecker::Impl& impl = checker.impl();
  impl.place(impl.cell.start);
  place_hand(impl, X_RH, opening);
  return near_pairs(impl, HitsOf::Hand, clearance);
}

std::vector<Hit> find_hits_along(CollisionChecker& checker, const Configuration& a,
                                 const Configuration& b, int samples) {
  if (samples < 1 || samples > 1000000) {
    throw InvalidInput("E_RANGE", "samples", "expected 1 to 1000000");
  }
  if (a.q.size() != b.q.size()) throw InvalidInput("E_DOF", "b", "has not as many joints as a");
  std::vector<std::pair<int, Hit>> met;
  for (int i = 0; i <= samples; ++i) {
    const double part = static_cast<double>(i) / samples;
    const Configuration at{a.q + part * (b.q - a.q), a.opening + part * (b.opening - a.opening)};
    for (const Hit& hit : find_all_hits(checker, at)) {
      const auto known = std::find_if(met.begin(), met.end(), [&](const auto& one) {
        return one.second.a == hit.a && one.second.b == hit.b;
      });
      if (known == met.end()) {
        met.emplace_back(1, hit);
      } else {
        ++known->first;
      }
    }
  }
  std::stable_sort(met.begin(), met.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  std::vector<Hit> hits;
  for (const auto& [count, hit] : met) hits.push_back(hit);
  return hits;
}

double hand_depth(CollisionChecker& checker, const Pose& X_RH, double opening,
                  const std::string& body) {
  CollisionChecker::Impl& impl = checker.impl();
  impl.place(impl.cell.start);
  place_hand(impl, X_RH, opening);
  double depth = 0.0;
  for (std::size_t m = 0; m < impl.movers.size(); ++m) {
    if (!is_hand(impl, m)) continue;
    for (std::size_t o = 0; o < impl.obstacles.size(); ++o) {
      const collision::Obstacle& obstacle = impl.obstacles[o];
      if (impl.movers[m].against[o] == 0 || obstacle.label != body) continue;
      const collision::BodyGeometry& hand = *impl.movers[m].geometry;
      if ((impl.mover_centres[m] - obstacle.centre).norm() >
          hand.radius + obstacle.geometry->radius) {
        continue;
      }
      for (const auto& own : hand.pieces) {
        for (const auto& other : obstacle.geometry->pieces) {
          depth =
              std::max(depth, collision::overlap_depth(*own, impl.X_RM[m], *other, obstacle.X_RB));
        }
      }
    }
  }
  return depth;
}

}  // namespace handey
