// Inner solids of the pieces of a checker.
#include "handey/collision/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "checker_impl.hpp"
#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/stop.hpp"
#include "inner_boxes.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

constexpr int kSegments = 16;  // Choice: polyhedra inside cylinders, 2 percent of the radius lost
constexpr int kBallSegments = 8;
constexpr std::size_t kMostPoints = 48;  // Choice: faces are looked at one by one
constexpr int kCentreSteps = 200;
constexpr double kThinnestFace = 1e-6;  // a thinner face has no reliable plane [m]
constexpr int kMostTrials = 20;

/// The points farthest out in even directions: their hull lies inside the hull of all.
std::vector<Vector3d> outermost(const std::vector<Vector3d>& points) {
  std::vector<char> taken(points.size(), 0);
  const double turn = 2.399963229728653;  // golden angle [rad]
  for (std::size_t k = 0; k < kMostPoints; ++k) {
    const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(kMostPoints);
    const double across = std::sqrt(1.0 - z * z), angle = turn * static_cast<double>(k);
    const Vector3d direction(across * std::cos(angle), across * std::sin(angle), z);
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].dot(direction) > points[best].dot(direction)) best = i;
    }
    taken[best] = 1;
  }
  std::vector<Vector3d> chosen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (taken[i] != 0) chosen.push_back(points[i]);
  }
  return chosen;
}

/// Adds the plane of a face. @return a corner of it to be left out if it has no reliable plane, -1
/// if it has
int add_face(const std::vector<Vector3d>& vertices, const std::vector<int>& face,
             InnerSolid& solid) {
  const auto corner = [&](std::size_t i) -> const Vector3d& {
    return vertices[static_cast<std::size_t>(face[i])];
  };
  Vector3d area = Vector3d::Zero();
  double longest = 0.0;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vector3d& next = corner((i + 1) % face.size());
    area += (corner(i) - corner(0)).cross(next - corner(0));
    longest = std::max(longest, (next - corner(i)).norm());
  }
  if (area.norm() < kThinnestFace * longest) return face.front();
  const Vector3d normal = area.normalized();
  double offset = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < face.size(); ++i) offset = std::min(offset, normal.dot(corner(i)));
  solid.normals.push_back(normal);
  solid.offsets.push_back(offset - kInnerSkin);
  return -1;
}

/// Climbs to a point about as deep as can be, and sets both balls.
void set_balls(InnerSolid& solid, const std::vector<Vector3d>& vertices) {
  Vector3d point = Vector3d::Zero();
  for (const Vector3d& vertex : vertices) point += vertex / static_cast<double>(vertices.size());
  double size = 0.0;
  for (const Vector3d& vertex : vertices) size = std::max(size, (vertex - point).norm());
  solid.inradius = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < kCentreSteps; ++step) {
    std::size_t nearest = 0;
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solid.normals.size(); ++i) {
      const double here = solid.offsets[i] - solid.normals[i].dot(point);
      if (here < depth) {
        depth = here;
        nearest = i;
      }
    }
    if (depth > solid.inradius) {
      solid.inradius = depth;
      solid.centre = point;
    }
    point -= solid.normals[nearest] * (0.5 * size / (2.0 + step));
  }
  for (const Vector3d& vertex : vertices) {
    solid.radius = std::max(solid.radius, (vertex - solid.centre).norm());
  }
}

InnerSolid moved(const InnerSolid& solid, const Pose& X) {
  InnerSolid result = solid;
  result.centre = X * solid.centre;
  for (std::size_t i = 0; i < solid.normals.size(); ++i) {
    result.normals[i] = X.linear() * solid.normals[i];
    result.offsets[i] = solid.offsets[i] + result.normals[i].dot(X.translation());
  }
  return result;
}

void add_solid(const InnerSolid& solid, std::vector<InnerSolid>& solids) {
  if (!solid.normals.empty()) solids.push_back(solid);
}

std::vector<Vector3d> corners_of(const Eigen::AlignedBox3d& box, const Pose& X) {
  std::vector<Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back(X * Vector3d(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k))));
  }
  return corners;
}

std::vector<InnerSolid> make_inner_solids(const collision::Piece& piece) {
  std::vector<InnerSolid> solids;
  if (!piece.solid) return solids;
  if (!piece.convex) {
    for (const Eigen::AlignedBox3d& box : collision::inner_boxes(piece)) {
      add_solid(inner_hull(corners_of(box, piece.box.X_BO)), solids);
    }
    return solids;
  }
  if (piece.hull.kind == collision::ConvexSolid::Kind::Points && piece.hull.points.size() > 1) {
    add_solid(inner_hull(piece.hull.points), solids);
    return solids;
  }
  const bool ball = std::holds_alternative<Sphere>(piece.shape.geometry);
  add_solid(inner_hull(tessellate(piece.shape, ball ? kBallSegments : kSegments, false).vertices),
            solids);
  return solids;
}

std::vector<InnerSolid> inner_solids(const collision::BodyGeometry& geometry) {
  std::vector<InnerSolid> solids;
  for (const auto& piece : geometry.pieces) {
    const std::vector<InnerSolid>& inside = piece->inside();
    solids.insert(solids.end(), inside.begin(), inside.end());
  }
  return solids;
}

}  // namespace

const std::vector<InnerSolid>& collision::Piece::inside() const {
  return inside_.get([this] { return make_inner_solids(*this); });
}

double InnerSolid::depth(const Vector3d& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    least = std::min(least, offsets[i] - normals[i].dot(point));
  }
  return least;
}

InnerSolid inner_hull(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> chosen = points.size() > kMostPoints ? outermost(points) : points;
  for (int trial = 0; trial < kMostTrials && chosen.size() >= 4; ++trial) {
    throw_if_stopped();
    InnerSolid solid;
    ConvexPolyhedron hull;
    try {
      hull = convex_hull(chosen);
    } catch (const InvalidInput&) {
      return {};  // flat: there is no inside
    }
    int left_out = -1;
    for (const std::vector<int>& face : hull.faces) {
      left_out = add_face(hull.vertices, face, solid);
      if (left_out >= 0) break;
    }
    if (left_out < 0) {
      set_balls(solid, hull.vertices);
      return solid.inradius > 0.0 ? solid : InnerSolid{};
    }
    chosen = std::move(hull.vertices);
    chosen.erase(chosen.begin() + left_out);
  }
  return {};
}

SolidScene describe_solids(CollisionChecker& checker) {
  const CollisionChecker::Impl& impl = checker.impl();
  SolidScene scene;
  for (const collision::Mover& mover : impl.movers) {
    SolidMover described;
    described.name = mover.label;
    described.depth = mover.depth;
    described.finger = mover.finger;
    described.body = mover.body;
    described.X_BM = mover.X_BM;
    described.solids = inner_solids(*mover.geometry);
    scene.movers.push_back(std::move(described));
  }
  for (const collision::Obstacle& obstacle : impl.obstacles) {
    SolidObstacle described;
    described.name = obstacle.label;
    const std::size_t index = static_cast<std::size_t>(&obstacle - impl.obstacles.data());
    for (const collision::Mover& mover : impl.movers) {
      described.checked.push_back(mover.against[index]);
    }
    for (const InnerSolid& solid : inner_solids(*obstacle.geometry)) {
      described.solids.push_back(moved(solid, obstacle.X_RB));
    }
    scene.obstacles.push_back(std::move(described));
  }
  scene.mover_pairs = impl.mover_pairs;
  return scene;
}

std::vector<InnerSolid> held_solids(CollisionChecker& checker) {
  const CollisionChecker::Impl& impl = checker.impl();
  return impl.cell.held ? inner_solids(*impl.movers.back().geometry) : std::vector<InnerSolid>{};
}

}  // namespace handey
