// Which edges and vertices face which faces and edges. A pad rests on an edge if its direction lies
// in the arc from one of the edge's faces to the other; near the ends of the arc it lies on a face,
// which is another pair unless that face is too small to be one. Of two parallel edges the closing
// axis is the line that joins them (no moment on the contacts), or the direction next to it that
// both arcs hold, within the share of the friction angle that may be used.
#include "drafts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "handey/stop.hpp"

namespace handey::grasp {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kClosed = 1e-4;         // an arc's end that is no face belongs to the arc [rad]
constexpr double kLeanFromFace = 0.035;  // two edges: this far from lying on a face. Choice [rad]
constexpr double kLeastCrossing = 0.17;  // edges at a smaller angle are not crossed [rad]
constexpr double kSharp = 0.26;          // less than 15 degrees is a round, not a ridge [rad]
constexpr double kFromEnd = 0.001;       // edges cross this far from their ends, at least [m]

// The normals of an edge, as angles about it.
class Arc {
 public:
  // Angles from normal a, about `axis`.
  Arc(const PartEdge& edge, const Eigen::Vector3d& axis)
      : axis_(axis), zero_((edge.normal_a - edge.normal_a.dot(axis) * axis).normalized()) {
    const double turn = angle_of(edge.normal_b);
    low_ = std::min(0.0, turn);
    high_ = std::max(0.0, turn);
    face_at_low_ = turn > 0.0 ? edge.face_a : edge.face_b;
    face_at_high_ = turn > 0.0 ? edge.face_b : edge.face_a;
  }

  double angle_of(const Eigen::Vector3d& direction) const {
    return std::atan2(axis_.dot(zero_.cross(direction)), zero_.dot(direction));
  }
  double low(double from_face) const { return face_at_low_ ? low_ + from_face : low_ - kClosed; }
  double high(double from_face) const {
    return face_at_high_ ? high_ - from_face : high_ + kClosed;
  }
  bool holds(const Eigen::Vector3d& direction, double from_face) const {
    const double angle = angle_of(direction);
    return angle >= low(from_face) && angle <= high(from_face);
  }
  Eigen::Vector3d direction(double angle) const {
    return std::cos(angle) * zero_ + std::sin(angle) * axis_.cross(zero_);
  }
  double turn() const { return high_ - low_; }

 private:
  Eigen::Vector3d axis_, zero_;
  double low_ = 0.0, high_ = 0.0;
  bool face_at_low_ = false, face_at_high_ = false;
};

Eigen::Vector3d along(const PartEdge& edge) { return (edge.to - edge.from).normalized(); }
double length(const PartEdge& edge) { return (edge.to - edge.from).norm(); }
Eigen::Vector3d middle(const PartEdge& edge) { return 0.5 * (edge.from + edge.to); }

// Choice: seen from a pad, no face of an edge may turn farther away than 114 degrees; the check of
// a plan does not count what lies beyond 120 to this side.
bool is_blunt(const PartEdge& edge, const Eigen::Vector3d& normal) {
  return normal.dot(edge.normal_a) > -0.4 && normal.dot(edge.normal_b) > -0.4;
}

class Drafter {
 public:
  Drafter(const FeaturePairs& features, double friction, const FeatureOptions& options)
      : features_(features),
        options_(options),
        most_lean_(options.friction_use * std::atan(friction)) {}

  std::vector<Draft> draft() {
    for (std::size_t f = 0; f < features_.faces.size(); ++f) {
      const Feature face{FeatureKind::Face, static_cast<int>(f)};
      throw_if_stopped();
      for (std::size_t e = 0; e < features_.edges.size(); ++e) {
        face_edge(face, {FeatureKind::Edge, static_cast<int>(e)});
      }
      for (std::size_t v = 0; v < features_.vertices.size(); ++v) {
        face_vertex(face, {FeatureKind::Vertex, static_cast<int>(v)});
      }
    }
    const int count = std::min(options_.most_edges, static_cast<int>(features_.edges.size()));
    for (int a = 0; a < count; ++a) {
      throw_if_stopped();
      for (int b = a + 1; b < count; ++b) edge_edge(a, b);
    }
    return std::move(drafts_);
  }

 private:
  const PlanarFace& face(Feature f) const {
    return features_.faces[static_cast<std::size_t>(f.index)];
  }
  const PartEdge& edge(int index) const { return features_.edges[static_cast<std::size_t>(index)]; }

  void face_edge(Feature a, Feature b) {
    const Eigen::Vector3d& normal = face(a).normal;
    const PartEdge& opposite = edge(b.index);
    const Eigen::Vector3d direction = along(opposite);
    if (std::abs(direction.dot(normal)) > options_.angle) return;
    const double width = normal.dot(face(a).origin - middle(opposite));
    if (width <= 0.0 || !is_blunt(opposite, -normal)) return;
    if (!Arc(opposite, direction).holds(-normal, options_.angle)) return;
    drafts_.push_back({PairKind::FaceEdge, a, b, normal, direction,
                       middle(opposite) + 0.5 * width * normal, width, length(opposite), 0.0});
  }

  void face_vertex(Feature a, Feature b) {
    const Eigen::Vector3d& normal = face(a).normal;
    const PartVertex& opposite = features_.vertices[static_cast<std::size_t>(b.index)];
    const double width = normal.dot(face(a).origin - opposite.position);
    if (width <= 0.0) return;
    for (const Eigen::Vector3d& ray : opposite.rays) {
      if (ray.dot(normal) < options_.angle) return;
    }
    drafts_.push_back({PairKind::FaceVertex, a, b, normal, normal.unitOrthogonal(),
                       opposite.position + 0.5 * width * normal, width, 0.0, 0.0});
  }

  void edge_edge(int a, int b) {
    const Eigen::Vector3d cross = along(edge(a)).cross(along(edge(b)));
    const double sine = cross.norm();
    if (sine < options_.angle) {
      parallel_edges(a, b);
    } else if (sine > kLeastCrossing) {
      crossed_edges(a, b, cross / sine);
    }
  }

  void parallel_edges(int a, int b) {
    const Eigen::Vector3d axis = along(edge(a));
    // What the two have in common along the axis.
    const double half = 0.5 * length(edge(a));
    const Eigen::Vector3d centre = middle(edge(a));
    const double from = axis.dot(edge(b).from - centre), to = axis.dot(edge(b).to - centre);
    const double low = std::max(-half, std::min(from, to));
    const double high = std::min(half, std::max(from, to));
    if (high - low < options_.least_edge) return;
    Eigen::Vector3d apart = centre - middle(edge(b));
    apart -= apart.dot(axis) * axis;
    if (apart.norm() < 1e-6) return;
    const std::optional<Eigen::Vector3d> normal = closing_axis(a, b, axis, apart.normalized());
    if (!normal) return;
    const double width = apart.dot(*normal);
    const Eigen::Vector3d between = centre - 0.5 * apart + 0.5 * (low + high) * axis;
    drafts_.push_back({PairKind::ParallelEdges,
                       {FeatureKind::Edge, a},
                       {FeatureKind::Edge, b},
                       *normal,
                       axis,
                       between,
                       width,
                       high - low,
                       0.0});
  }

  // The direction in both arcs next to the line that joins the edges, if within the friction cone.
  std::optional<Eigen::Vector3d> closing_axis(int a, int b, const Eigen::Vector3d& axis,
                                              const Eigen::Vector3d& joining) const {
    const Arc arc_a(edge(a), axis);
    PartEdge turned = edge(b);
    turned.normal_a = -turned.normal_a;
    turned.normal_b = -turned.normal_b;
    const Arc arc_b(turned, axis);
    const double wanted = arc_a.angle_of(joining);
    // Arc b in the angles of arc a, shifted to lie about the wanted direction.
    const double shift = arc_a.angle_of(arc_b.direction(0.0));
    const double turns = std::round((wanted - shift - arc_b.angle_of(joining)) / (2.0 * kPi));
    const double offset = shift + 2.0 * kPi * turns;
    const double low = std::max(arc_a.low(kLeanFromFace), arc_b.low(kLeanFromFace) + offset);
    const double high = std::min(arc_a.high(kLeanFromFace), arc_b.high(kLeanFromFace) + offset);
    if (low > high) return std::nullopt;
    const double chosen = std::clamp(wanted, low, high);
    if (std::abs(chosen - wanted) > most_lean_) return std::nullopt;
    const Eigen::Vector3d normal = arc_a.direction(chosen);
    if (!is_blunt(edge(a), normal) || !is_blunt(edge(b), -normal)) return std::nullopt;
    return normal;
  }

  void crossed_edges(int a, int b, Eigen::Vector3d normal) {
    const Eigen::Vector3d apart = middle(edge(a)) - middle(edge(b));
    double width = normal.dot(apart);
    if (width < 0.0) {
      normal = -normal;
      width = -width;
    }
    if (width < 1e-6 || !is_blunt(edge(a), normal) || !is_blunt(edge(b), -normal)) return;
    const Arc arc_a(edge(a), along(edge(a))), arc_b(edge(b), along(edge(b)));
    if (arc_a.turn() < kSharp || arc_b.turn() < kSharp) return;
    if (!arc_a.holds(normal, kLeanFromFace) || !arc_b.holds(-normal, kLeanFromFace)) return;
    // middle_a + s u = middle_b + t v + width n
    const Eigen::Vector3d u = along(edge(a)), v = along(edge(b));
    const double cosine = u.dot(v), scale = 1.0 - cosine * cosine;
    const double s = (cosine * v.dot(apart) - u.dot(apart)) / scale;
    const double t = (v.dot(apart) - cosine * u.dot(apart)) / scale;
    if (std::abs(s) > 0.5 * length(edge(a)) - kFromEnd) return;
    if (std::abs(t) > 0.5 * length(edge(b)) - kFromEnd) return;
    drafts_.push_back({PairKind::CrossedEdges,
                       {FeatureKind::Edge, a},
                       {FeatureKind::Edge, b},
                       normal,
                       u,
                       middle(edge(a)) + s * u - 0.5 * width * normal,
                       width,
                       0.0,
                       0.0});
  }

  const FeaturePairs& features_;
  const FeatureOptions& options_;
  const double most_lean_;
  std::vector<Draft> drafts_;
};

}  // namespace

std::vector<Draft> draft_pairs(const FeaturePairs& features, double friction,
                               const FeatureOptions& options) {
  return Drafter(features, friction, options).draft();
}

}  // namespace handey::grasp
