// The hand is a ball about the wrist point: an obstacle's part at lateral distance t from the plane
// of that point is in the way within sqrt(r^2 - t^2). So the obstacle is cut into lateral strips,
// each grown by what its nearest t leaves.
#include "slice_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace handey::cspace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-6;  // more than the checker's and all of ours together [m]
constexpr double kCorner = 0.8;     // Choice: a ball's round corners are 4 % too large [rad]
constexpr double kSharpCorner = 1.6;

/// Limits of the strips as shares of the ball's radius, the middle one first.
struct Strip {
  double lower, upper;
};
constexpr std::array<Strip, 3> kStrips{{{-0.55, 0.55}, {0.55, 1.0}, {-1.0, -0.55}}};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Are the balls of this radius about all points of `inner` within `outer`?
bool contains_grown(const Polygon& outer, const Polygon& inner, double radius) {
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vector2d along = outer[i + 1 < outer.size() ? i + 1 : 0] - outer[i];
    const double least = radius * along.norm();
    for (const Vector2d& point : inner) {
      if (cross(along, point - outer[i]) < least) return false;
    }
  }
  return !outer.empty();
}

/// Some edge of `a` has all of `b` farther beyond it than `distance`.
bool separates(const Polygon& a, const Polygon& b, double distance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d along = a[(i + 1) % a.size()] - a[i];
    const double enough = -distance * along.norm();
    bool beyond = true;
    for (const Vector2d& point : b) beyond = beyond && cross(along, point - a[i]) < enough;
    if (beyond) return true;
  }
  return false;
}

}  // namespace

bool come_near(const Polygon& a, const Polygon& b, double distance) {
  return !separates(a, b, distance) && !separates(b, a, distance);
}

void LayerMaps::clear(std::size_t balls) {
  upper.clear();
  lower.clear();
  hand.resize(balls);
  for (std::vector<RingSpan>& spans : hand) spans.clear();
  all_blocked = false;
}

LayerWork::LayerWork(const ArmTable::Impl& table, const SliceScene& scene, double clearance)
    : table_(table),
      scene_(scene),
      margin_(clearance + kRounding),
      raster_(table.grid.width, scene.rings) {}

void LayerWork::targets_of(const Standing& standing, std::vector<Target>& targets) const {
  targets.clear();
  const auto widened = [this](const Slab& slab) {
    return Slab{slab.lower - margin_, slab.upper + margin_};
  };
  if (standing.waist_body) {
    for (const LinkGroup& group : scene_.waist_body) {
      double reach = margin_;
      for (const Polygon& outline : group.outlines) {
        for (const Vector2d& point : outline) reach = std::max(reach, point.norm() + margin_);
      }
      targets.push_back(
          {Target::Kind::WaistBody, widened(group.slab), margin_, nullptr, &group, 0, reach});
    }
  }
  const auto add_groups = [&](Target::Kind kind, const std::vector<GroupMaps>& groups) {
    for (const GroupMaps& group : groups) {
      targets.push_back({kind, widened(group.slab), margin_, &group.maps, nullptr, 0,
                         group.maps.last_ring * table_.grid.width + margin_});
    }
  };
  if (standing.upper) add_groups(Target::Kind::Upper, table_.upper);
  if (standing.lower) add_groups(Target::Kind::Lower, table_.lower);
  if (standing.turning) add_groups(Target::Kind::Lower, table_.turning);
  for (std::size_t ball = 0; ball < standing.hand.size(); ++ball) {
    if (standing.hand[ball] <= 0.0) continue;
    const double radius = standing.hand[ball] + margin_;
    const double centre = scene_.balls[ball].lateral;
    const int last_ring = scene_.balls[ball].columns.last_ring();
    for (const Strip& strip : kStrips) {
      const double nearest = strip.lower * strip.upper < 0.0
                                 ? 0.0
                                 : std::min(std::abs(strip.lower), std::abs(strip.upper));
      const Slab slab{centre + strip.lower * radius, centre + strip.upper * radius};
      const double distance = radius * std::sqrt(1.0 - nearest * nearest);
      targets.push_back({Target::Kind::Hand, slab, distance, nullptr, nullptr, ball,
                         last_ring * table_.grid.width + distance});
    }
  }
}

void LayerWork::add(const Target& target, const Polygon& section, LayerMaps& maps) {
  if (target.kind == Target::Kind::WaistBody) {
    for (const Polygon& outline : target.group->outlines) {
      if (come_near(outline, section, target.distance)) maps.all_blocked = true;
    }
    return;
  }
  if (target.kind == Target::Kind::Hand) {
    grow(section, target.distance, kCorner, grown_);
    const WristColumns& columns = scene_.balls[target.ball].columns;
    raster_.add_spans(grown_, columns.first_ring(), columns.last_ring(), maps.hand[target.ball]);
    return;
  }
  grow(section, target.distance, kSharpCorner, grown_);
  spans_.clear();
  raster_.add_spans(grown_, target.maps->first_ring, target.maps->last_ring, spans_);
  std::vector<const std::uint8_t*>& list =
      target.kind == Target::Kind::Upper ? maps.upper : maps.lower;
  for (const RingSpan& span : spans_) {
    target.maps->collect(table_.grid, table_.bytes.data(), span, list);
  }
}

LayerWork::Place LayerWork::place_of(const Standing& standing, const Pose& X_ER,
                                     double half_width) const {
  const ArmPlane& plane = table_.links.plane;
  const Vector3d centre = X_ER * standing.centre;
  // A turn by phi moves a point by 2 sin(phi / 2) times its distance from axis 1: along z of E by
  // no more than sin(phi) times its distance from there along z x axis, and a remainder.
  const double from_axis =
      (centre - plane.waist_point).cross(plane.waist_axis).norm() + standing.radius;
  const double swing = 2.0 * std::sin(0.5 * half_width) * from_axis;
  Place place;
  place.nearest = centre.head<2>().norm() - standing.radius - swing;
  place.lateral = {centre.z() - standing.radius - swing, centre.z() + standing.radius + swing};
  if (place.nearest > scene_.rings * table_.grid.width + standing.widest_hand() + margin_)
    return place;
  const Vector3d forward = Vector3d::UnitZ().cross(plane.waist_axis);
  const Eigen::RowVector3d along_z = X_ER.linear().row(2);
  const Eigen::RowVector3d along_forward = forward.transpose() * X_ER.linear();
  const double base = -forward.dot(plane.waist_point - X_ER.translation());
  double lower = place.lateral.upper, upper = place.lateral.lower, ahead = 0.0;
  for (const Vector3d& point : standing.hull.points) {
    const double z = along_z * point;
    lower = std::min(lower, z);
    upper = std::max(upper, z);
    ahead = std::max(ahead, std::abs(along_forward * point + base));
  }
  const double slack =
      std::sin(half_width) * ahead + (1.0 - std::cos(half_width)) * from_axis + kRounding;
  const double offset = X_ER.translation().z();
  place.lateral.lower = std::max(place.lateral.lower, lower + offset - slack);
  place.lateral.upper = std::min(place.lateral.upper, upper + offset + slack);
  return place;
}

void LayerWork::add_at(const Standing& standing, const Pose& X_ER, double half_width,
                       WaistCell& cell, LayerMaps& maps) {
  const Place place = place_of(standing, X_ER, half_width);
  const double farthest = scene_.rings * table_.grid.width;
  if (place.nearest > farthest + standing.widest_hand() + margin_) return;
  targets_of(standing, targets_);
  std::size_t ball = 0;
  middle_.clear();
  for (const Target& target : targets_) {
    if (maps.all_blocked) return;
    if (target.ball != ball) middle_.clear();
    ball = target.ball;
    if (place.lateral.lower > target.slab.upper || place.lateral.upper < target.slab.lower) {
      continue;
    }
    if (place.nearest > target.reach) continue;
    cell.cross_section(standing.hull, target.slab, section_);
    if (section_.empty()) continue;
    // The outer strips' parts mostly lie within the middle one's, which is grown more.
    const bool hand = target.kind == Target::Kind::Hand;
    if (hand && contains_grown(middle_, section_, target.distance)) continue;
    add(target, section_, maps);
    if (hand && middle_.empty()) middle_ = grown_;
  }
}

}  // namespace handey::cspace
