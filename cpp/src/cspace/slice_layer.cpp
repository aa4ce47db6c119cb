// The hand is a ball about the wrist point: an obstacle's part at lateral distance t from the plane
// of that point is in the way within sqrt(r^2 - t^2). So the obstacle is cut into lateral strips,
// each grown by what its nearest t leaves.
#include "slice_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "handey/stop.hpp"

namespace handey::cspace {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-6;  // more than the checker's and all of ours together [m]
constexpr double kCorner = 0.8;  // Choice: a ball's round corners are 9 % too large at most [rad]
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

const std::vector<Target>& LayerWork::targets_of(const Concerns& concerns) {
  // Neighbours in the list mostly have the same.
  if (targets_.empty() || !(concerns == targets_of_)) {
    targets_of_ = concerns;
    targets_.clear();
    find_targets(concerns);
  }
  return targets_;
}

void LayerWork::find_targets(const Concerns& concerns) {
  const auto widened = [this](const Slab& slab) {
    return Slab{slab.lower - margin_, slab.upper + margin_};
  };
  if (concerns.waist_body) {
    for (const LinkGroup& group : scene_.waist_body) {
      double reach = margin_;
      for (const Polygon& outline : group.outlines) {
        for (const Vector2d& point : outline) reach = std::max(reach, point.norm() + margin_);
      }
      targets_.push_back(
          {Target::Kind::WaistBody, widened(group.slab), margin_, nullptr, &group, 0, reach});
    }
  }
  const auto add_groups = [&](Target::Kind kind, const std::vector<GroupMaps>& groups) {
    for (const GroupMaps& group : groups) {
      targets_.push_back({kind, widened(group.slab), margin_, &group.maps, nullptr, 0,
                          group.maps.last_ring * table_.grid.width + margin_});
    }
  };
  if (concerns.upper) add_groups(Target::Kind::Upper, table_.upper);
  if (concerns.lower) add_groups(Target::Kind::Lower, table_.lower);
  if (concerns.turning) add_groups(Target::Kind::Lower, table_.turning);
  for (std::size_t ball = 0; ball < concerns.hand.size(); ++ball) {
    if (concerns.hand[ball] <= 0.0) continue;
    const double radius = concerns.hand[ball] + margin_;
    const double centre = scene_.balls[ball].lateral;
    const int last_ring = scene_.balls[ball].columns.last_ring();
    for (const Strip& strip : kStrips) {
      const double nearest = strip.lower * strip.upper < 0.0
                                 ? 0.0
                                 : std::min(std::abs(strip.lower), std::abs(strip.upper));
      const Slab slab{centre + strip.lower * radius, centre + strip.upper * radius};
      const double distance = radius * std::sqrt(1.0 - nearest * nearest);
      targets_.push_back({Target::Kind::Hand, slab, distance, nullptr, nullptr, ball,
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

void LayerWork::add_at(const Standing& standing, const Pose& X_ER, double half_width,
                       WaistCell& cell, LayerMaps& maps) {
  throw_if_stopped();
  // Where can the ball round it be? A turn by phi moves a point by 2 sin(phi / 2) times its
  // distance from axis 1.
  const ArmPlane& plane = table_.links.plane;
  const Vector3d centre = X_ER * standing.centre;
  const double from_axis =
      (centre - plane.waist_point).cross(plane.waist_axis).norm() + standing.radius;
  const double reach = standing.radius + 2.0 * std::sin(0.5 * half_width) * from_axis;
  const double nearest = centre.head<2>().norm() - reach;
  const double farthest = scene_.rings * table_.grid.width;
  if (nearest > farthest + standing.concerns.widest_hand() + margin_) return;
  cell.place(standing.hull);
  std::size_t ball = 0;
  middle_.clear();
  for (const Target& target : targets_of(standing.concerns)) {
    if (maps.all_blocked) return;
    if (target.ball != ball) middle_.clear();
    ball = target.ball;
    if (nearest > target.reach) continue;
    cell.cross_section(target.slab, section_);
    if (section_.empty()) continue;
    // The outer strips' parts mostly lie within the middle one's, which is grown more.
    const bool hand = target.kind == Target::Kind::Hand;
    if (hand && contains_grown(middle_, section_, target.distance)) continue;
    add(target, section_, maps);
    if (hand && middle_.empty()) middle_ = grown_;
  }
}

}  // namespace handey::cspace
