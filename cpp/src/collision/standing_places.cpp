// Samples (x, y, turn) about the centre of mass; cheap tests in the plane of the face first. Where
// a part is to be in a region or within walls and few samples are good, the least bad are mended.
#include "handey/collision/standing_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "place_mending.hpp"

namespace handey {
namespace {

using collision::BodyGeometry;
using collision::margin_of;
using collision::moved;
using collision::PlaceSample;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 0.02;  // of a lift: how much nearer than it a body may be
constexpr double kNothing = 1e-9;   // smaller areas are rounding [m2]
constexpr int kFew = 8;  // Choice: with fewer than one good sample in so many, bad ones are mended
constexpr int kMended = 6;  // Choice: at most so many in one run
// Powers of 1 / g, g the real root of x^4 = x + 1: Roberts' low-discrepancy sequence.
constexpr double kPowers[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

void refuse(const char* name, const std::string& message) {
  throw InvalidInput("E_RANGE", name, message);
}

void require_valid(const StandingPlaceOptions& options) {
  if (options.first < 0) refuse("first", std::to_string(options.first) + ", expected 0 or more");
  if (options.count < 0) refuse("count", std::to_string(options.count) + ", expected 0 or more");
  const auto positive = [](const char* name, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    refuse(name, std::to_string(value) + ", expected a finite length > 0");
  };
  positive("within", options.within);
  positive("clearance", options.clearance);
  double before = options.clearance;
  for (const double room : options.rooms) {
    positive("rooms", room);
    if (room <= before) refuse("rooms", "expected ascending lengths, greater than the clearance");
    before = room;
  }
  if (!std::isfinite(options.least_margin) || options.least_margin < 0.0) {
    refuse("least_margin", std::to_string(options.least_margin) + ", expected 0 or more");
  }
  if (options.near_point && !options.near_point->allFinite()) {
    throw InvalidInput("E_NUMBER", "near_point", "is not finite");
  }
}

/// A body that stands, in the world.
struct Standing {
  const BodyGeometry* geometry;
  Pose X_WB;
  std::string label;
};

double frac(double x) { return x - std::floor(x); }

/// Start of the sequence for a seed (splitmix64).
Vector3d start_of(std::uint64_t seed) {
  Vector3d start;
  for (int k = 0; k < 3; ++k) {
    seed += 0x9e3779b97f4a7c15u;
    std::uint64_t z = seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    start[k] = static_cast<double>(z >> 11) * 0x1.0p-53;
  }
  return start;
}

/// Direction of the longest edge of a region [rad].
double longest_edge(const std::vector<Polygon>& loops) {
  Vector2d longest = Vector2d::UnitX();
  double most = 0.0;
  for (const Polygon& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2d edge = loop[(i + 1) % loop.size()] - loop[i];
      if (edge.norm() <= most + 1e-7) continue;
      most = edge.norm();
      longest = edge;
    }
  }
  return std::atan2(longest.y(), longest.x());
}

class Finder {
 public:
  Finder(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
         const RestingPose& rest, const SupportFace& face, const StandingPlaceOptions& options)
      : cell_(cell),
        part_(part),
        rest_(rest),
        face_(face),
        options_(options),
        start_(start_of(options.seed)) {
    const CollisionModel::Impl& bodies = model->impl();
    own_ = &bodies.parts[static_cast<std::size_t>(part)];
    for (const collision::Obstacle& body :
         collision::make_obstacles(bodies, cell, Pose::Identity())) {
      if (body.ref == BodyRef{BodyRef::Kind::Part, part}) continue;
      standing_.push_back({body.geometry, body.X_RB, body.label});
    }
    if (options.robot) {
      Cell empty_hand = cell;
      empty_hand.held.reset();
      checker_ = std::make_unique<CollisionChecker>(model, empty_hand);
      CollisionChecker::Impl& impl = checker_->impl();
      impl.place(*options.robot);
      for (std::size_t m = 0; m < impl.movers.size(); ++m) {
        standing_.push_back(
            {impl.movers[m].geometry, cell.X_WR * impl.X_RM[m], impl.movers[m].label});
      }
    }
    for (const Vector2d& point : rest.footprint) {
      contact_radius_ = std::max(contact_radius_, point.norm());
    }
    const std::vector<Polygon>& edges = options.inside ? face.enclosed.loops : face.region.loops;
    aligned_ = longest_edge(edges) - longest_edge({rest.shadow});
    for (const Polygon& loop : edges) {
      for (const Vector2d& point : loop) domain_.extend(point);
    }
    if (options.region) {
      Eigen::AlignedBox2d box;
      for (const Vector2d& corner : collision::region_in_face(*options.region, face)) {
        box.extend(corner);
      }
      domain_ = domain_.intersection(box);
    }
  }

  StandingPlaces run() {
    if (domain_.isEmpty()) found_.tried = found_.outside_the_region = options_.count;
    if (domain_.isEmpty() || rest_.footprint.size() < 3) return found_;
    for (int i = 0; i < options_.count; ++i) look_at(options_.first + i);
    const bool tight = options_.inside || options_.region;
    if (tight && static_cast<int>(found_.places.size()) * kFew < options_.count) mend();
    int most = 0;
    for (const auto& [name, count] : met_) {
      if (count <= most) continue;
      most = count;
      found_.in_the_way = name;
    }
    return found_;
  }

 private:
  void look_at(int index) {
    Vector3d u;
    for (int k = 0; k < 3; ++k) u[k] = frac(start_[k] + kPowers[k] * (index + 1));
    Vector2d at = domain_.min() + u.head<2>().cwiseProduct(domain_.sizes());
    if (options_.near_point && index % 2 == 1) {
      const Vector3d near(options_.near_point->x(), options_.near_point->y(),
                          face_.X_WS.translation().z());
      const double angle = 2.0 * kPi * u.y();
      at = (face_.X_WS.inverse() * near).head<2>() +
           options_.within * u.x() * Vector2d(std::cos(angle), std::sin(angle));
    }
    // Half of them square to the face, as people put things down and as they fit where it is tight.
    const bool square = (index / 2) % 2 == 0;
    const double turn = square ? aligned_ + 0.5 * kPi * std::floor(4.0 * u.z()) : 2.0 * kPi * u.z();
    ++found_.tried;
    const PlaceSample sample{at, turn};
    int* why = test(sample);
    if (why == nullptr) return;
    ++*why;
    fallen_.emplace_back(sample, why);
  }

  /// Keeps a sample that is good; else which of the counts it is of.
  int* test(const PlaceSample& sample) {
    const Polygon hull = stood_on(sample);
    const double margin = std::min(margin_of(hull, sample.at), std::max(rest_.margin, 1e-9));
    if (margin < std::min(options_.least_margin, 0.5 * rest_.margin)) return &found_.off_the_face;
    if (options_.region && !in_region(hull)) return &found_.outside_the_region;
    if (options_.inside && !in_walls(hull, moved(rest_.shadow, sample))) {
      return &found_.outside_the_walls;
    }
    Pose X_SS = Pose::Identity();
    X_SS.linear().topLeftCorner<2, 2>() = Eigen::Rotation2Dd(sample.turn).toRotationMatrix();
    X_SS.translation().head<2>() = sample.at;
    const Pose X_WP = face_.X_WS * X_SS * rest_.X_SP;
    if (const Standing* met = meets(X_WP, options_.clearance)) {
      ++met_[met->label];
      return &found_.not_clear;
    }
    double room = options_.clearance;
    for (const double wider : options_.rooms) {
      if (meets(X_WP, wider) != nullptr) break;
      room = wider;
    }
    found_.places.push_back({X_WP, margin, room});
    return nullptr;
  }

  /// Mends the least bad samples.
  void mend() {
    const collision::PlaceMender mender(cell_, part_, rest_, face_, options_);
    if (!mender.can_fit()) return;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < fallen_.size(); ++i) {
      order.emplace_back(mender.badness(fallen_[i].first), i);
    }
    std::sort(order.begin(), order.end());
    if (order.size() > kMended) order.resize(kMended);
    for (const auto& [bad, index] : order) {
      if (test(mender.mended(fallen_[index].first)) == nullptr) --*fallen_[index].second;
    }
  }

  /// Hull of where part and face are in contact, in S.
  Polygon stood_on(const PlaceSample& sample) const {
    if (contains(face_.region, sample.at) &&
        boundary_distance(face_.region, sample.at) >= contact_radius_) {
      return moved(rest_.footprint, sample);
    }
    Region contact;
    for (const Polygon& loop : rest_.contact.loops) contact.loops.push_back(moved(loop, sample));
    std::vector<Vector2d> corners;
    for (const Polygon& loop : intersect(contact, face_.region).loops) {
      corners.insert(corners.end(), loop.begin(), loop.end());
    }
    return corners.size() < 3 ? Polygon() : convex_hull(corners);
  }

  bool in_region(const Polygon& hull) const {
    return std::all_of(hull.begin(), hull.end(), [&](const Vector2d& corner) {
      const Vector3d p = face_.X_WS * Vector3d(corner.x(), corner.y(), 0.0);
      return options_.region->contains(Vector2d(p.head<2>()));
    });
  }

  bool in_walls(const Polygon& hull, const Polygon& shadow) const {
    return area(subtract(Region{{hull}}, face_.enclosed)) < kNothing &&
           area(subtract(Region{{shadow}}, face_.outline)) < kNothing;
  }

  /// The first body that the part, lifted off the face, is nearer to than it was lifted.
  const Standing* meets(const Pose& X_WP, double lifted) const {
    throw_if_stopped();
    Pose X_WL = X_WP;
    X_WL.translation() += lifted * face_.X_WS.linear().col(2);
    const double gap = (1.0 - kRounding) * lifted;
    const Vector3d centre = X_WL * own_->centre;
    for (const Standing& body : standing_) {
      const double balls = own_->radius + body.geometry->radius + gap;
      if ((centre - body.X_WB * body.geometry->centre).squaredNorm() > balls * balls) continue;
      for (const auto& own : own_->pieces) {
        for (const auto& other : body.geometry->pieces) {
          const Vector3d at = X_WL * own->box.X_BO.translation();
          const Pose X_WO = body.X_WB * other->box.X_BO;
          if (collision::ball_to_box(at, own->radius, X_WO, other->box.half) > gap) continue;
          if (collision::piece_distance(*own, X_WL, *other, body.X_WB, gap, gap) <= gap) {
            return &body;
          }
        }
      }
    }
    return nullptr;
  }

  const Cell& cell_;
  const int part_;
  const RestingPose& rest_;
  const SupportFace& face_;
  const StandingPlaceOptions& options_;
  Vector3d start_;
  const BodyGeometry* own_ = nullptr;
  std::vector<Standing> standing_;
  std::unique_ptr<CollisionChecker> checker_;  // has the robot's bodies where it stands
  double contact_radius_ = 0.0;
  double aligned_ = 0.0;  // turn that makes the part square to the face [rad]
  Eigen::AlignedBox2d domain_;
  std::vector<std::pair<PlaceSample, int*>> fallen_;  // and which of the counts they are in
  std::map<std::string, int> met_;
  StandingPlaces found_;
};

}  // namespace

StandingPlaces find_standing_places(const std::shared_ptr<const CollisionModel>& model,
                                    const Cell& cell, int part, const RestingPose& rest,
                                    const SupportFace& face, const StandingPlaceOptions& options) {
  require_valid(options);
  if (model == nullptr) throw InvalidInput("E_MISSING", "model", "is missing");
  collision::require_same_bodies(model->impl(), cell);
  collision::require_part(cell, part, "part");
  if (options.region && options.region->isEmpty()) {
    refuse("region", "is empty, expected the least x, y, then a greater x, y");
  }
  return Finder(model, cell, part, rest, face, options).run();
}

}  // namespace handey
