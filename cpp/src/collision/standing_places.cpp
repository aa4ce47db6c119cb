// Samples (x, y, turn) about the centre of mass; cheap tests in the plane of the face first.
#include "handey/collision/standing_places.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"

namespace handey {
namespace {

using collision::BodyGeometry;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRounding = 0.02;  // of a lift: how much nearer than it a body may be
// Powers of 1 / g, g the real root of x^4 = x + 1: Roberts' low-discrepancy sequence.
constexpr double kSteps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

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

Polygon moved(const Polygon& polygon, const Eigen::Rotation2Dd& turn, const Vector2d& to) {
  Polygon result;
  result.reserve(polygon.size());
  for (const Vector2d& point : polygon) result.push_back(turn * point + to);
  return result;
}

/// Least distance of a point from the edges of a counter-clockwise convex polygon; negative
/// outside [m].
double margin_of(const Polygon& hull, const Vector2d& point) {
  double least = std::numeric_limits<double>::infinity();
  if (hull.size() < 3) return -least;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d to = hull[i] - point;
    const Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    least = std::min(least, along.y() * to.x() - along.x() * to.y());
  }
  return least;
}

class Finder {
 public:
  Finder(const std::shared_ptr<const CollisionModel>& model, const Cell& cell, int part,
         const RestingPose& rest, const SupportFace& face, const StandingPlaceOptions& options)
      : rest_(rest), face_(face), options_(options), start_(start_of(options.seed)) {
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
      const Pose X_SW = face.X_WS.inverse();
      for (int corner = 0; corner < 4; ++corner) {
        const Vector2d at =
            options.region->corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner));
        box.extend((X_SW * Vector3d(at.x(), at.y(), face.X_WS.translation().z())).head<2>());
      }
      domain_ = domain_.intersection(box);
    }
  }

  StandingPlaces run() {
    if (domain_.isEmpty() || rest_.footprint.size() < 3) return found_;
    for (int i = 0; i < options_.count; ++i) look_at(options_.first + i);
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
    for (int k = 0; k < 3; ++k) u[k] = frac(start_[k] + kSteps[k] * (index + 1));
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
    test(at, turn);
  }

  void test(const Vector2d& at, double turn) {
    const Eigen::Rotation2Dd rotation(turn);
    const Polygon hull = stood_on(rotation, at);
    const double margin = std::min(margin_of(hull, at), std::max(rest_.margin, 1e-9));
    if (margin < std::min(options_.least_margin, 0.5 * rest_.margin)) {
      ++found_.off_the_face;
      return;
    }
    if (options_.region && !in_region(hull)) {
      ++found_.outside_the_region;
      return;
    }
    if (options_.inside && !in_walls(hull, moved(rest_.shadow, rotation, at))) {
      ++found_.outside_the_walls;
      return;
    }
    Pose X_SS = Pose::Identity();
    X_SS.linear().topLeftCorner<2, 2>() = rotation.toRotationMatrix();
    X_SS.translation().head<2>() = at;
    const Pose X_WP = face_.X_WS * X_SS * rest_.X_SP;
    if (const Standing* met = meets(X_WP, options_.clearance)) {
      ++found_.not_clear;
      ++met_[met->label];
      return;
    }
    double room = options_.clearance;
    for (const double wider : options_.rooms) {
      if (meets(X_WP, wider) != nullptr) break;
      room = wider;
    }
    found_.places.push_back({X_WP, margin, room});
  }

  /// Hull of where part and face are in contact, in S.
  Polygon stood_on(const Eigen::Rotation2Dd& turn, const Vector2d& at) const {
    if (!contains(face_.region, at) || boundary_distance(face_.region, at) < contact_radius_) {
      Region contact;
      for (const Polygon& loop : rest_.contact.loops) {
        contact.loops.push_back(moved(loop, turn, at));
      }
      std::vector<Vector2d> corners;
      for (const Polygon& loop : intersect(contact, face_.region).loops) {
        corners.insert(corners.end(), loop.begin(), loop.end());
      }
      return corners.size() < 3 ? Polygon() : convex_hull(corners);
    }
    return moved(rest_.footprint, turn, at);
  }

  bool in_region(const Polygon& hull) const {
    return std::all_of(hull.begin(), hull.end(), [&](const Vector2d& corner) {
      const Vector3d p = face_.X_WS * Vector3d(corner.x(), corner.y(), 0.0);
      return options_.region->contains(Vector2d(p.head<2>()));
    });
  }

  bool in_walls(const Polygon& hull, const Polygon& shadow) const {
    constexpr double kNothing = 1e-9;  // [m2]
    return area(subtract(Region{{hull}}, face_.enclosed)) < kNothing &&
           area(subtract(Region{{shadow}}, face_.outline)) < kNothing;
  }

  /// The first body that the part, lifted off the face, is nearer to than it was lifted.
  const Standing* meets(const Pose& X_WP, double lifted) const {
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
