// A box is looked at in its middle. Boxes are mostly asked for within others that failed: the pair
// that failed there is looked at first, and the direction that kept a pair apart there is tried
// before a new one is sought. Once a pair has failed, the others are only put down for the parts.
#include "handey/collision/box_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "motion_bounds.hpp"

namespace handey {
namespace {

constexpr double kRounding = 1e-9;  // of distances and bounds, far above what doubles lose [m]

}  // namespace

struct BoxProver::Impl {
  CollisionChecker::Impl& checker;
  collision::MotionBounds bounds;
  double clearance;

  Impl(CollisionChecker& owner, double clearance_in)
      : checker(owner.impl()), bounds(checker), clearance(clearance_in) {}

  void stand(const ConfigurationBox& box) {
    checker.place(box.centre);
    bounds.set(box.half, 0.0);
  }

  /// How far a pair must be apart in the middle to stay apart in the box, whatever the direction
  /// [m].
  double enough(const PiecePair& pair) {
    return clearance + bounds.approach(pair) * (1.0 + kRounding) + kRounding;
  }

  /// Is a distance along a direction that does not move enough for the whole box?
  bool is_enough_along(const PiecePair& pair, double distance, const Eigen::Vector3d& direction) {
    return distance > clearance &&
           distance >
               clearance + bounds.approach_along(pair, direction) * (1.0 + kRounding) + kRounding;
  }

  bool settle(NearPair& near, bool& collides) {
    if (!near.apart.isZero() &&
        is_enough_along(near.pair, checker.distance_along(near.pair, near.apart), near.apart)) {
      return true;
    }
    const double needed = enough(near.pair);
    if (!checker.are_convex(near.pair)) {
      near.apart.setZero();
      const double hulls = checker.hull_distance(near.pair, needed, &near.apart);
      if (hulls > needed || is_enough_along(near.pair, hulls, near.apart)) return true;
      const double distance = checker.distance(near.pair, clearance, needed);
      if (distance <= clearance) collides = true;
      return distance > needed;
    }
    Eigen::Vector3d apart = Eigen::Vector3d::Zero();
    const double distance = checker.distance(near.pair, clearance, needed, &apart);
    near.apart = apart;
    if (distance > needed) return true;
    if (distance <= clearance) collides = true;
    return !apart.isZero() && is_enough_along(near.pair, distance, apart);
  }

  /// One pair's part in a proof.
  void take(NearPair near, BoxProof& proof) {
    if (!proof.free) {  // has failed already
      proof.near.push_back(std::move(near));
    } else if (!settle(near, proof.collides)) {
      proof.free = false;
      proof.near.insert(proof.near.begin(), std::move(near));
    }
  }
};

BoxProver::BoxProver(CollisionChecker& checker, double clearance)
    : impl_(std::make_unique<Impl>(checker, clearance)) {
  if (!std::isfinite(clearance) || clearance < 0.0) {
    throw InvalidInput("E_RANGE", "clearance", "must be finite and not negative");
  }
}
BoxProver::~BoxProver() = default;
BoxProver::BoxProver(BoxProver&&) noexcept = default;

BoxProof BoxProver::prove(const ConfigurationBox& box) {
  Impl& impl = *impl_;
  impl.stand(box);
  BoxProof proof;
  proof.free = true;
  impl.checker.visit_near([&](const PiecePair& pair) { return impl.enough(pair); },
                          [&](const PiecePair& pair) {
                            impl.take({pair, Eigen::Vector3d::Zero()}, proof);
                            return false;
                          });
  return proof;
}

BoxProof BoxProver::prove(const ConfigurationBox& box, const std::vector<NearPair>& near) {
  Impl& impl = *impl_;
  impl.stand(box);
  BoxProof proof;
  proof.free = true;
  for (const NearPair& pair : near) {
    if (impl.checker.rough_distance(pair.pair) > impl.enough(pair.pair)) continue;
    impl.take(pair, proof);
  }
  return proof;
}

bool BoxProver::prove_beyond(int joint, const ConfigurationBox& box, int evaluations) {
  Impl& impl = *impl_;
  std::vector<NearPair> pairs;
  for (const auto& [a, b] : impl.checker.mover_pairs) {
    const collision::Mover& one = impl.checker.movers[static_cast<std::size_t>(a)];
    const collision::Mover& other = impl.checker.movers[static_cast<std::size_t>(b)];
    if (std::min(one.depth, other.depth) < joint) continue;
    for (int p = 0; p < static_cast<int>(one.geometry->pieces.size()); ++p) {
      for (int r = 0; r < static_cast<int>(other.geometry->pieces.size()); ++r) {
        pairs.push_back({{a, p, b, r}, Eigen::Vector3d::Zero()});
      }
    }
  }
  struct Open {
    ConfigurationBox box;
    std::vector<NearPair> pairs;
  };
  std::vector<Open> open{{box, std::move(pairs)}};
  while (!open.empty()) {
    Open next = std::move(open.back());
    open.pop_back();
    if (evaluations-- <= 0) return false;
    BoxProof proof = prove(next.box, next.pairs);
    if (proof.collides) return false;
    if (proof.free) continue;
    Eigen::Index widest = joint;
    for (Eigen::Index j = joint; j < next.box.half.size(); ++j) {
      if (next.box.half(j) > next.box.half(widest)) widest = j;
    }
    if (widest >= next.box.half.size() || next.box.half(widest) <= 0.0) return false;
    next.box.half(widest) *= 0.5;
    for (const double side : {-1.0, 1.0}) {
      Open half{next.box, proof.near};
      half.box.centre.q(widest) += side * next.box.half(widest);
      open.push_back(std::move(half));
    }
  }
  return true;
}

}  // namespace handey
