// Stretches of an edge are looked at in their middle. A pair of pieces is done with for the whole
// stretch when it is farther apart there than it can come nearer by; the pairs that are not go on
// to both halves.
#include "handey/collision/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "motion_bounds.hpp"

namespace handey {

using collision::MotionBounds;
using collision::PiecePair;

namespace {

constexpr double kRounding = 1e-9;  // of distances and bounds, far above what doubles lose [m]
// Choice: so many stretches are looked at in order of size, which finds most collisions; after them
// depth comes first, which finds the hopeless stretch soon instead of all of its kin.
constexpr int kBroadFirst = 31;

// Choice: movers that can move by more than this are hardly ever proved free of anything; they go
// on to the halves without a look [m].
constexpr double kHopeless = 0.1;

// Choice: of so many pieces of one body near a mover, one by one, nearly all would go on to the
// halves even where it moves by less than that.
constexpr int kCrowd = 16;
constexpr double kHopelessInCrowd = 0.03;  // [m]

/// Middle `at` and half width of a stretch in the parameter of the edge, and what is not yet proved
/// on it.
struct Stretch {
  double at = 0.5, half = 0.5;
  std::vector<int> movers;      ///< against all obstacles: no pair of these was looked at yet
  std::vector<NearPair> pairs;  ///< of other movers
  bool is_proved() const { return movers.empty() && pairs.empty(); }
};

void require_edge(CollisionChecker::Impl& checker, const Configuration& a, const Configuration& b,
                  const CertificateOptions& options) {
  checker.place(a);  // checks lengths and numbers
  checker.place(b);
  if (!std::isfinite(options.clearance) || options.clearance < 0.0) {
    throw InvalidInput("E_RANGE", "certificate.clearance", "must be finite and not negative");
  }
  if (!std::isfinite(options.resolution) || options.resolution <= 0.0) {
    throw InvalidInput("E_RANGE", "certificate.resolution", "must be finite and greater than 0");
  }
}

Configuration between(const Configuration& a, const Configuration& b, double t) {
  Configuration middle;
  middle.q = a.q + t * (b.q - a.q);
  middle.opening = a.opening + t * (b.opening - a.opening);
  return middle;
}

/// The proof of one edge.
class EdgeProof {
 public:
  EdgeProof(CollisionChecker::Impl& checker, const Configuration& a, const Configuration& b,
            const CertificateOptions& options)
      : checker_(checker), bounds_(checker), a_(a), b_(b), options_(options) {}

  EdgeResult run() {
    Stretch whole;
    whole.movers.resize(checker_.movers.size());
    std::iota(whole.movers.begin(), whole.movers.end(), 0);
    stand_in_middle(whole);
    const bool may_be_free = look_at_movers(whole, true);
    const EdgeResult middle = result_;
    // A collision at an end counts before one between. What is proved on all of the edge needs no
    // look at its ends.
    for (const double end : {0.0, 1.0}) {
      if (may_be_free && whole.is_proved()) break;
      const bool few = may_be_free && whole.movers.empty();
      if (!(few ? is_end_free(end, whole.pairs) : is_end_free(end))) return result_;
    }
    if (!may_be_free) return middle;
    std::deque<Stretch> open;
    split(whole, open);
    while (!open.empty()) {
      const bool broad = result_.evaluations < kBroadFirst;
      Stretch stretch = std::move(broad ? open.front() : open.back());
      broad ? open.pop_front() : open.pop_back();
      stand_in_middle(stretch);
      if (!prove(stretch)) return result_;
      split(stretch, open);
    }
    result_.status = EdgeStatus::Free;
    return result_;
  }

 private:
  void stand_in_middle(const Stretch& stretch) {
    ++result_.evaluations;
    checker_.place(between(a_, b_, stretch.at));
    bounds_.set(stretch.half * (b_.q - a_.q),
                0.5 * stretch.half * std::abs(b_.opening - a_.opening), true);
  }

  /// How far a pair must be apart in the middle to stay apart on the stretch.
  double needed(const PiecePair& pair) {
    return options_.clearance + bounds_.approach(pair) * (1.0 + kRounding) + kRounding;
  }

  bool fail(EdgeStatus status, const PiecePair& pair, double distance, double at) {
    result_.status = status;
    result_.hit = checker_.hit(pair, distance);
    result_.at = at;
    return false;
  }

  bool is_end_free(double end) {
    ++result_.evaluations;
    checker_.place(end == 0.0 ? a_ : b_);
    return !checker_.visit_near([this](const PiecePair&) { return options_.clearance; },
                                [&](const PiecePair& pair) { return collides_at(end, pair); });
  }

  /// The same of these pairs alone.
  bool is_end_free(double end, const std::vector<NearPair>& pairs) {
    ++result_.evaluations;
    checker_.place(end == 0.0 ? a_ : b_);
    return std::none_of(pairs.begin(), pairs.end(), [&](const NearPair& near) {
      return checker_.rough_distance(near.pair) <= options_.clearance &&
             collides_at(end, near.pair);
    });
  }

  bool collides_at(double end, const PiecePair& pair) {
    const double distance = checker_.distance(pair, options_.clearance, options_.clearance);
    return distance <= options_.clearance && !fail(EdgeStatus::Colliding, pair, distance, end);
  }

  /// Collects the pairs of the stretch's movers that are not proved on it at once; leaves it the
  /// movers for which there is no hope of that. @param first  pairs of movers too
  bool look_at_movers(Stretch& stretch, bool first) {
    looked_at_.assign(checker_.movers.size(), 0);
    std::vector<int> hopeless;
    for (const int m : stretch.movers) {
      const double approach = bounds_.approach({m, -1, -1, -1});
      if (approach > kHopeless || (approach > kHopelessInCrowd &&
                                   checker_.is_in_crowd(m, needed({m, -1, -1, -1}), kCrowd))) {
        hopeless.push_back(m);
      } else {
        looked_at_[static_cast<std::size_t>(m)] = 1;
      }
    }
    const bool none = hopeless.size() == stretch.movers.size();
    stretch.movers = std::move(hopeless);
    if (none && !first) return true;
    constexpr double kNowhere = -std::numeric_limits<double>::infinity();
    const auto reach = [&](const PiecePair& pair) {
      const bool left_out =
          pair.other >= 0 ? !first : looked_at_[static_cast<std::size_t>(pair.mover)] == 0;
      return left_out ? kNowhere : needed(pair);
    };
    return !checker_.visit_near(reach, [&](const PiecePair& pair) {
      return !settle(stretch, {pair, Eigen::Vector3d::Zero()});
    });
  }

  /// Leaves in the stretch what is not proved on it. @return false if the edge has failed
  bool prove(Stretch& stretch) {
    const std::vector<NearPair> pairs = std::move(stretch.pairs);
    stretch.pairs.clear();
    if (!stretch.movers.empty() && !look_at_movers(stretch, false)) return false;
    for (const NearPair& pair : pairs) {
      if (checker_.rough_distance(pair.pair) > needed(pair.pair)) continue;
      if (!settle(stretch, pair)) return false;
    }
    return true;
  }

  /// Is a distance along a direction that does not move enough for the whole stretch?
  bool is_enough_along(const PiecePair& pair, double distance, const Eigen::Vector3d& direction) {
    return distance > options_.clearance &&
           distance > options_.clearance +
                          bounds_.approach_along(pair, direction) * (1.0 + kRounding) + kRounding;
  }

  bool settle(Stretch& stretch, const NearPair& near) {
    const PiecePair& pair = near.pair;
    if (bounds_.approach(pair) > kHopeless) {
      stretch.pairs.push_back(near);
      return true;
    }
    if (!near.apart.isZero() &&
        is_enough_along(pair, checker_.distance_along(pair, near.apart), near.apart)) {
      return true;
    }
    const double enough = needed(pair);
    Eigen::Vector3d apart = Eigen::Vector3d::Zero();
    const bool convex = checker_.are_convex(pair);
    if (!convex) {
      const double hulls = checker_.hull_distance(pair, enough, &apart);
      if (hulls > enough || is_enough_along(pair, hulls, apart)) return true;
    }
    const double distance =
        checker_.distance(pair, options_.clearance, enough, convex ? &apart : nullptr);
    if (distance > enough) return true;
    if (convex && !apart.isZero() && is_enough_along(pair, distance, apart)) return true;
    if (distance <= options_.clearance)
      return fail(EdgeStatus::Colliding, pair, distance, stretch.at);
    if (2.0 * bounds_.approach(pair) <= options_.resolution) {
      return fail(EdgeStatus::GivenUp, pair, distance, stretch.at);
    }
    stretch.pairs.push_back({pair, apart});
    return true;
  }

  static void split(const Stretch& stretch, std::deque<Stretch>& open) {
    if (stretch.is_proved()) return;
    const double half = 0.5 * stretch.half;
    open.push_back({stretch.at - half, half, stretch.movers, stretch.pairs});
    open.push_back({stretch.at + half, half, stretch.movers, stretch.pairs});
  }

  CollisionChecker::Impl& checker_;
  MotionBounds bounds_;
  const Configuration& a_;
  const Configuration& b_;
  const CertificateOptions& options_;
  std::vector<char> looked_at_;  // per mover, in look_at_movers
  EdgeResult result_;
};

}  // namespace

EdgeResult certify_edge(CollisionChecker& checker, const Configuration& a, const Configuration& b,
                        const CertificateOptions& options) {
  require_edge(checker.impl(), a, b, options);
  return EdgeProof(checker.impl(), a, b, options).run();
}

EdgeResult certify_path(CollisionChecker& checker, const std::vector<Configuration>& path,
                        const CertificateOptions& options) {
  if (path.empty()) throw InvalidInput("E_EMPTY", "path", "has no configuration");
  EdgeResult total;
  if (path.size() == 1) return certify_edge(checker, path.front(), path.front(), options);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    EdgeResult edge = certify_edge(checker, path[i], path[i + 1], options);
    edge.evaluations += total.evaluations;
    total = std::move(edge);
    if (total.is_free()) continue;
    total.at += static_cast<double>(i);
    return total;
  }
  return total;
}

double motion_bound(CollisionChecker& checker, const Configuration& a, const Configuration& b) {
  CollisionChecker::Impl& impl = checker.impl();
  require_edge(impl, a, b, {});
  impl.place(between(a, b, 0.5));
  MotionBounds bounds(impl);
  bounds.set(0.5 * (b.q - a.q).cwiseAbs(), 0.25 * std::abs(b.opening - a.opening));
  double most = 0.0;
  for (int m = 0; m < static_cast<int>(impl.movers.size()); ++m) {
    double mover = 0.0;
    const int pieces =
        static_cast<int>(impl.movers[static_cast<std::size_t>(m)].geometry->pieces.size());
    for (int p = 0; p < pieces; ++p) mover = std::max(mover, bounds.piece_motion(m, p));
    most = std::max(most, mover);
  }
  return 2.0 * most;
}

}  // namespace handey
