// Hull, its faces merged plane by plane, the solid angle of each seen from the centre of mass, and
// where each falls that does not hold it.
#include "handey/world/resting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "handey/errors.hpp"
#include "handey/geometry/convex_pieces.hpp"
#include "handey/geometry/point_tree.hpp"
#include "handey/stop.hpp"

namespace handey {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFlat = 5e-6;   // Choice: vertices this near to a face's plane belong to it [m]
constexpr double kFacing = 0.1;  // Choice: least vertical share of a normal; steeper are walls
constexpr double kPi = 3.14159265358979323846;

void require_valid(const RestingOptions& options) {
  const auto refuse = [](const char* name, double value, const char* expected) {
    throw InvalidInput("E_RANGE", name,
                       "found " + std::to_string(value) + ", expected " + expected);
  };
  if (options.segments < 8) refuse("segments", options.segments, "at least 8");
  const std::pair<const char*, double> lengths[] = {{"least_tip_angle", options.least_tip_angle},
                                                    {"contact_gap", options.contact_gap},
                                                    {"least_width", options.least_width},
                                                    {"rolling", options.rolling},
                                                    {"rolling_step", options.rolling_step}};
  for (const auto& [name, value] : lengths) {
    if (!std::isfinite(value) || value < 0.0) refuse(name, value, "a finite number, not negative");
  }
}

/// All shapes of a part as one list of triangles, body frame.
TriangleMesh surface_of(const Body& part, int segments) {
  TriangleMesh all;
  for (const Shape& shape : part.shapes) {
    const TriangleMesh mesh = tessellate(shape, segments);
    const Eigen::Vector3i shift = Eigen::Vector3i::Constant(static_cast<int>(all.vertices.size()));
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Eigen::Vector3i& triangle : mesh.triangles)
      all.triangles.push_back(triangle + shift);
  }
  return all;
}

/// Turn that brings `up` to +z, and x (or y) of the part into the half plane of +x.
Eigen::Matrix3d upright(const Vector3d& up) {
  const Vector3d z = up.normalized();
  const Vector3d along = std::abs(z.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  const Vector3d x = (along - along.dot(z) * z).normalized();
  Eigen::Matrix3d turn;
  turn.row(0) = x;
  turn.row(1) = z.cross(x);
  turn.row(2) = z;
  return turn;
}

/// Least distance of the origin from the edges of a counter-clockwise convex polygon; negative
/// outside [m].
double margin_of(const Polygon& hull) {
  double least = std::numeric_limits<double>::infinity();
  if (hull.size() < 3) return -least;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d& a = hull[i];
    const Vector2d along = (hull[(i + 1) % hull.size()] - a).normalized();
    least = std::min(least, along.y() * a.x() - along.x() * a.y());
  }
  return least;
}

double width_of(const Polygon& hull) {
  double least = std::numeric_limits<double>::infinity();
  if (hull.size() < 3) return 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vector2d along = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    double farthest = 0.0;
    for (const Vector2d& corner : hull) {
      const Vector2d to = corner - hull[i];
      farthest = std::max(farthest, along.x() * to.y() - along.y() * to.x());
    }
    least = std::min(least, farthest);
  }
  return least;
}

/// The part of a triangle below a height, seen from above.
Polygon below(const std::array<Vector3d, 3>& corners, double height) {
  Polygon polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z() <= height) polygon.push_back(a.head<2>());
    if ((a.z() <= height) == (b.z() <= height)) continue;
    polygon.push_back((a + (height - a.z()) / (b.z() - a.z()) * (b - a)).head<2>());
  }
  return polygon;
}

/// Describes how a surface stands after a turn about its centre of mass.
RestingPose stand(const TriangleMesh& surface, const Vector3d& centre, const Eigen::Matrix3d& turn,
                  double gap) {
  std::vector<Vector3d> points;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  std::vector<Vector2d> flat;
  for (const Vector3d& vertex : surface.vertices) {
    points.push_back(turn * (vertex - centre));
    flat.push_back(points.back().head<2>());
    lowest = std::min(lowest, points.back().z());
    highest = std::max(highest, points.back().z());
  }
  throw_if_stopped();
  std::vector<Polygon> loops;
  for (const Eigen::Vector3i& triangle : surface.triangles) {
    std::array<Vector3d, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = points[static_cast<std::size_t>(triangle[k])];
    }
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (-normal.z() <= kFacing * normal.norm()) continue;
    Polygon polygon = below(corners, lowest + gap);
    if (polygon.size() < 3) continue;
    if (signed_area(polygon) < 0.0) std::reverse(polygon.begin(), polygon.end());
    loops.push_back(std::move(polygon));
  }
  throw_if_stopped();
  RestingPose rest;
  rest.X_SP.linear() = turn;
  rest.X_SP.translation() = -(turn * centre) - lowest * Vector3d::UnitZ();
  rest.height = -lowest;
  rest.top = highest - lowest;
  rest.contact = region_of_loops(loops);
  rest.shadow = convex_hull(flat);
  std::vector<Vector2d> corners;
  for (const Polygon& loop : rest.contact.loops) {
    corners.insert(corners.end(), loop.begin(), loop.end());
  }
  rest.footprint = corners.size() < 3 ? Polygon() : convex_hull(corners);
  rest.width = width_of(rest.footprint);
  return rest;
}

/// A face of the hull: all the hull's facets in one plane.
struct Face {
  Vector3d normal = Vector3d::UnitZ();
  Polygon outline;           // about the projection of the centre of mass
  double height = 0.0;       // of the centre of mass over it
  double margin = 0.0;       // of the centre of mass within the outline; negative outside
  double solid_angle = 0.0;  // seen from the centre of mass
  int falls_to = -1;         // the face that it topples to, if the margin is negative
};

/// Of a triangle seen from the origin (Van Oosterom, Strackee 1983).
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double below = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
  return 2.0 * std::atan2(std::abs(a.dot(b.cross(c))), below);
}

class Faces {
 public:
  /// @param hull  about the centre of mass
  explicit Faces(ConvexPolyhedron hull) : hull_(std::move(hull)) {
    merge();
    measure();
    topple();
  }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  const Vector3d& corner(int index) const {
    return hull_.vertices[static_cast<std::size_t>(index)];
  }
  Vector3d doubled_area(const std::vector<int>& facet) const {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < facet.size(); ++i) {
      sum += (corner(facet[i]) - corner(facet[0])).cross(corner(facet[i + 1]) - corner(facet[0]));
    }
    return sum;
  }

  std::vector<std::vector<std::size_t>> facets_by_corner() const {
    std::vector<std::vector<std::size_t>> facets(hull_.vertices.size());
    for (std::size_t facet = 0; facet < hull_.faces.size(); ++facet) {
      for (const int index : hull_.faces[facet]) {
        facets[static_cast<std::size_t>(index)].push_back(facet);
      }
    }
    return facets;
  }

  /// The largest facet gives the plane; all facets within it are the same face.
  void merge() {
    std::vector<double> areas;
    throw_if_stopped();
    for (const std::vector<int>& facet : hull_.faces) areas.push_back(doubled_area(facet).norm());
    std::vector<std::size_t> order(hull_.faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Equal but for rounding: the first.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::llround(areas[a] * 1e12) > std::llround(areas[b] * 1e12);
    });
    face_of_.assign(hull_.faces.size(), -1);
    const PointTree corners_of_all(hull_.vertices);
    const std::vector<std::vector<std::size_t>> facets_at = facets_by_corner();
    for (const std::size_t largest : order) {
      throw_if_stopped();
      if (face_of_[largest] >= 0 || !(areas[largest] > 0.0)) continue;
      Face face;
      face.normal = doubled_area(hull_.faces[largest]) / areas[largest];
      face.height = std::max(face.height, corners_of_all.farthest(face.normal));
      const auto in_plane = [&](int index) {
        return face.normal.dot(corner(index)) > face.height - kFlat;
      };
      for (const int near : corners_of_all.beyond(face.normal, face.height - kFlat)) {
        for (const std::size_t facet : facets_at[static_cast<std::size_t>(near)]) {
          const std::vector<int>& corners = hull_.faces[facet];
          if (face_of_[facet] < 0 && std::all_of(corners.begin(), corners.end(), in_plane)) {
            face_of_[facet] = static_cast<int>(faces_.size());
          }
        }
      }
      face_of_[largest] = static_cast<int>(faces_.size());
      faces_.push_back(face);
    }
  }

  void measure() {
    std::vector<std::vector<Vector2d>> outlines(faces_.size());
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      throw_if_stopped();
      if (face_of_[f] < 0) continue;
      const std::size_t index = static_cast<std::size_t>(face_of_[f]);
      Face& face = faces_[index];
      const std::vector<int>& facet = hull_.faces[f];
      for (std::size_t i = 1; i + 1 < facet.size(); ++i) {
        face.solid_angle += solid_angle(corner(facet[0]), corner(facet[i]), corner(facet[i + 1]));
      }
      const Eigen::Matrix3d turn = upright(-face.normal);
      for (const int index_of_corner : facet) {
        outlines[index].push_back((turn * corner(index_of_corner)).head<2>());
      }
    }
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      throw_if_stopped();
      faces_[i].outline = convex_hull(outlines[i]);
      faces_[i].margin = margin_of(faces_[i].outline);
    }
  }

  /// A face that does not hold the centre of mass falls over the edge that it is farthest beyond.
  void topple() {
    using Edge = std::pair<int, int>;
    std::vector<std::pair<Edge, int>> facet_at;  // by directed edge
    for (std::size_t f = 0; f < hull_.faces.size(); ++f) {
      const std::vector<int>& facet = hull_.faces[f];
      for (std::size_t i = 0; i < facet.size(); ++i) {
        const Edge edge(facet[i], facet[(i + 1) % facet.size()]);
        facet_at.emplace_back(edge, static_cast<int>(f));
      }
    }
    throw_if_stopped();
    std::sort(facet_at.begin(), facet_at.end());
    std::vector<double> farthest(faces_.size(), -std::numeric_limits<double>::infinity());
    for (const auto& [edge, f] : facet_at) {
      throw_if_stopped();
      const Edge back(edge.second, edge.first);
      const auto twin = std::lower_bound(facet_at.begin(), facet_at.end(), std::make_pair(back, 0));
      const int own = face_of_[static_cast<std::size_t>(f)];
      if (own < 0 || twin == facet_at.end() || twin->first != back) continue;
      const int other = face_of_[static_cast<std::size_t>(twin->second)];
      Face& face = faces_[static_cast<std::size_t>(own)];
      // Falling lowers the centre of mass: so no face is come back to.
      if (other < 0 || other == own || face.margin >= 0.0 ||
          faces_[static_cast<std::size_t>(other)].height >= face.height) {
        continue;
      }
      const Vector3d along = (corner(edge.second) - corner(edge.first)).normalized();
      const double beyond = -corner(edge.first).dot(along.cross(face.normal));
      double& most = farthest[static_cast<std::size_t>(own)];
      if (beyond <= most) continue;
      most = beyond;
      face.falls_to = other;
    }
  }

  ConvexPolyhedron hull_;
  std::vector<int> face_of_;  // per facet
  std::vector<Face> faces_;
};

/// Share of the sphere of directions from which the part comes to rest on each face.
std::vector<double> probabilities(const std::vector<Face>& faces) {
  std::vector<double> share(faces.size(), 0.0);
  for (const Face& face : faces) {
    const Face* at = &face;
    while (at->falls_to >= 0) at = &faces[static_cast<std::size_t>(at->falls_to)];
    share[static_cast<std::size_t>(at - faces.data())] += face.solid_angle / (4.0 * kPi);
  }
  return share;
}

struct Candidate {
  const Face* face = nullptr;
  double tip_angle = 0.0;
  double probability = 0.0;
};

/// The steadiest first; of round sides few. What is left out gives its probability to the nearest.
std::vector<Candidate> choose(const std::vector<Face>& faces, const RestingOptions& options) {
  const std::vector<double> share = probabilities(faces);
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].margin < 0.0) continue;
    all.push_back({&faces[i], std::atan2(faces[i].margin, faces[i].height), share[i]});
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::llround(a.tip_angle * 1e9) > std::llround(b.tip_angle * 1e9);
  });
  std::vector<Candidate> kept;
  for (const Candidate& candidate : all) {
    throw_if_stopped();
    Candidate* nearest = nullptr;
    double greatest = std::cos(options.rolling_step);
    for (Candidate& other : kept) {
      const double cosine = other.face->normal.dot(candidate.face->normal);
      if (cosine > greatest) {
        greatest = cosine;
        nearest = &other;
      }
    }
    if (nearest != nullptr && candidate.tip_angle < options.rolling) {
      nearest->probability += candidate.probability;
    } else if (candidate.tip_angle >= options.least_tip_angle) {
      kept.push_back(candidate);
    }
  }
  return kept;
}

}  // namespace

std::vector<RestingPose> resting_poses(const Body& part, const RestingOptions& options) {
  require_valid(options);
  const Vector3d centre = centre_of_mass(part);
  const TriangleMesh surface = surface_of(part, options.segments);
  ConvexPolyhedron hull = convex_hull(surface.vertices);
  for (Vector3d& vertex : hull.vertices) vertex -= centre;
  const Faces faces(std::move(hull));
  std::vector<RestingPose> rests;
  double total = 0.0;
  for (const Candidate& candidate : choose(faces.faces(), options)) {
    RestingPose rest =
        stand(surface, centre, upright(-candidate.face->normal), options.contact_gap);
    if (rest.width < options.least_width) continue;
    rest.margin = candidate.face->margin;
    rest.tip_angle = candidate.tip_angle;
    rest.probability = candidate.probability;
    total += rest.probability;
    rests.push_back(std::move(rest));
  }
  for (RestingPose& rest : rests) rest.probability /= total > 0.0 ? total : 1.0;
  return rests;
}

RestingPose resting_pose(const Body& part, const Vector3d& up, const RestingOptions& options) {
  require_valid(options);
  if (!up.allFinite()) throw InvalidInput("E_NUMBER", "up", "is not finite");
  if (up.norm() < 1e-9) throw InvalidInput("E_RANGE", "up", "has no length, expected a direction");
  const Vector3d centre = centre_of_mass(part);
  const TriangleMesh surface = surface_of(part, options.segments);
  RestingPose rest = stand(surface, centre, upright(up), options.contact_gap);
  rest.margin = margin_of(rest.footprint);
  rest.tip_angle = std::atan2(rest.margin, rest.height);
  return rest;
}

}  // namespace handey
