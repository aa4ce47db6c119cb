// A prism within a convex solid: of each of the solid's planes, what it leaves at the one end of
// the prism and at the other.
#include "hand_with_part.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handey/collision/solids.hpp"

namespace handey {

namespace {

// Choice: more prisms cost more than they save the search.
constexpr std::size_t kMostPrisms = 8;
// Choice: one prism stands for a solid if it has so much of its middle section, else three do.
constexpr double kOneIsEnough = 0.9;

/// From H to the outline's coordinates: along the approach, across, and along the closing axis.
Eigen::Vector3d in_outline(const Eigen::Vector3d& in_hand) {
  return {in_hand.z(), in_hand.x(), in_hand.y()};
}

void add_piece(const OutlinePiece& piece, GripperOutline& outline) {
  if (piece.polygon.size() < 3) return;
  for (const Eigen::Vector2d& point : piece.polygon) {
    outline.radius = std::max(outline.radius, point.norm());
  }
  outline.pieces.push_back(piece);
}

/// A convex solid in the outline's coordinates.
struct Solid {
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> offsets;
  Eigen::Vector3d centre;
  double radius;
};

Solid in_outline(const InnerSolid& solid, const Pose& X_HP) {
  Solid result;
  for (std::size_t i = 0; i < solid.normals.size(); ++i) {
    const Eigen::Vector3d normal = X_HP.linear() * solid.normals[i];
    result.normals.push_back(in_outline(normal));
    result.offsets.push_back(solid.offsets[i] + normal.dot(X_HP.translation()));
  }
  result.centre = in_outline(X_HP * solid.centre);
  result.radius = solid.radius;
  return result;
}

/// What of the polygon has normal . p <= offset.
Polygon cut(const Polygon& polygon, const Eigen::Vector2d& normal, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    const double over_a = normal.dot(a) - offset, over_b = normal.dot(b) - offset;
    if (over_a <= 0.0) kept.push_back(a);
    if ((over_a <= 0.0) != (over_b <= 0.0))
      kept.push_back(a + over_a / (over_a - over_b) * (b - a));
  }
  return kept;
}

/// The points that lie in the solid at every height from lower to upper.
Polygon section(const Solid& solid, double lower, double upper) {
  const Eigen::Vector2d c = solid.centre.head<2>();
  const double r = solid.radius;
  Polygon polygon{c + Eigen::Vector2d(-r, -r), c + Eigen::Vector2d(r, -r),
                  c + Eigen::Vector2d(r, r), c + Eigen::Vector2d(-r, r)};
  for (std::size_t i = 0; i < solid.normals.size() && polygon.size() >= 3; ++i) {
    const double z = solid.normals[i].z();
    polygon =
        cut(polygon, solid.normals[i].head<2>(), solid.offsets[i] - std::max(z * lower, z * upper));
  }
  return polygon.size() >= 3 ? convex_hull(polygon) : Polygon{};
}

/// How far the solid reaches from its centre along the closing axis, up or down.
double reach(const Solid& solid, double sign) {
  double inside = 0.0, outside = solid.radius;
  for (int halving = 0; halving < 20; ++halving) {
    const double middle = 0.5 * (inside + outside);
    const double at = solid.centre.z() + sign * middle;
    (section(solid, at, at).size() >= 3 ? inside : outside) = middle;
  }
  return inside;
}

void add_prisms(const Solid& solid, std::vector<OutlinePiece>& prisms) {
  constexpr double kEnds = 0.02;  // Choice: left off at either end, where sections get small
  const double centre = solid.centre.z();
  const double lower = centre - (1.0 - kEnds) * reach(solid, -1.0);
  const double upper = centre + (1.0 - kEnds) * reach(solid, 1.0);
  const auto prism = [&](double from, double to) {
    return OutlinePiece{section(solid, from, to), from, to};
  };
  const OutlinePiece whole = prism(lower, upper);
  const double middle = signed_area(section(solid, centre, centre));
  if (whole.polygon.size() >= 3 && signed_area(whole.polygon) >= kOneIsEnough * middle) {
    prisms.push_back(whole);
    return;
  }
  for (int third = 0; third < 3; ++third) {
    const double from = lower + (upper - lower) * third / 3.0;
    const OutlinePiece slice = prism(from, from + (upper - lower) / 3.0);
    if (slice.polygon.size() >= 3) prisms.push_back(slice);
  }
}

double volume(const OutlinePiece& prism) {
  return signed_area(prism.polygon) * (prism.upper - prism.lower);
}

}  // namespace

GripperOutline outline_with_part(const GripperOutline& gripper, const Cell& cell) {
  GripperOutline outline = gripper;
  if (!cell.held) return outline;
  for (const Shape& shape : cell.parts[static_cast<std::size_t>(cell.held->part)].shapes) {
    std::vector<Eigen::Vector2d> shadow;
    OutlinePiece piece;
    piece.lower = std::numeric_limits<double>::infinity();
    piece.upper = -piece.lower;
    for (const Eigen::Vector3d& point : hull_points(shape)) {
      const Eigen::Vector3d p = in_outline(cell.held->X_HP * point);
      shadow.emplace_back(p.head<2>());
      piece.lower = std::min(piece.lower, p.z());
      piece.upper = std::max(piece.upper, p.z());
    }
    piece.polygon = convex_hull(shadow);
    add_piece(piece, outline);
  }
  return outline;
}

GripperOutline core_with_part(const GripperOutline& gripper, CollisionChecker& checker) {
  GripperOutline core = gripper;
  if (!checker.cell().held) return core;
  std::vector<OutlinePiece> prisms;
  for (const InnerSolid& solid : held_solids(checker)) {
    add_prisms(in_outline(solid, checker.cell().held->X_HP), prisms);
  }
  std::stable_sort(prisms.begin(), prisms.end(), [](const OutlinePiece& a, const OutlinePiece& b) {
    return volume(a) > volume(b);
  });
  if (prisms.size() > kMostPrisms) prisms.resize(kMostPrisms);
  for (const OutlinePiece& prism : prisms) add_piece(prism, core);
  return core;
}

}  // namespace handey
