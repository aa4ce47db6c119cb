// Pairs with an edge or a vertex: drafts are taken in the order of what they promise, those that
// are nearly the same as one taken before are passed over, those beside which the part itself
// stands out wait until the end, and regions are cut for as many as are kept. Choice of the
// promise: the kind's worth, times how much of a pad's length the contact can have, times closeness
// to the centre of mass.
#include "beyond_faces.hpp"

#include <algorithm>
#include <cmath>

#include "drafts.hpp"
#include "handey/stop.hpp"
#include "pair_rules.hpp"
#include "part_edges.hpp"
#include "plane_map.hpp"

namespace handey::grasp {
namespace {

// Nearly the same pair: closing axes within 7 degrees, contacts within 3 mm. Choice: more than the
// half angle between the facets of a cylinder, less than a pad's width.
constexpr double kSameAxis = 0.9925, kSamePlace = 0.003;
constexpr double kStandsOut = 5e-4;  // of the part beyond the plane of a pad: what gives way [m]
constexpr std::size_t kMostRejected = 8;  // of the pairs that are too wide, those that miss least
constexpr int kMostTried = 2000;          // drafts for which regions are cut

Region rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  return Region{{{low, {high.x(), low.y()}, high, {low.x(), high.y()}}}};
}

Region square(const Eigen::Vector2d& centre, double side) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * side);
  return rectangle(centre - half, centre + half);
}

// A segment of the grasp plane along x, `wide`; its ends may differ a little in y.
Region strip_about(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double wide) {
  const Eigen::Vector2d aside(0.0, 0.5 * wide);
  return rectangle(a.cwiseMin(b) - aside, a.cwiseMax(b) + aside);
}

class BeyondFaces {
 public:
  BeyondFaces(const Body& part, const Gripper& gripper, ExposedFaces& exposed,
              const FeatureOptions& options, FeaturePairs& features)
      : gripper_(gripper),
        exposed_(exposed),
        options_(options),
        features_(features),
        friction_(part.friction),
        p_centre_(centre_of_mass(part)) {
    for (const Shape& shape : part.shapes) {
      const TriangleMesh mesh = tessellate(shape);
      points_.insert(points_.end(), mesh.vertices.begin(), mesh.vertices.end());
    }
    for (const FeaturePair& pair : features.pairs) taken_.push_back({axis(pair), middle(pair)});
  }

  void find() {
    std::vector<Draft> drafts = draft_pairs(features_, friction_, options_);
    drop_those_the_jaws_cannot_span(drafts);
    features_.beyond_faces = static_cast<int>(drafts.size());
    for (Draft& draft : drafts) draft.merit = promise(draft);
    std::stable_sort(drafts.begin(), drafts.end(),
                     [](const Draft& a, const Draft& b) { return a.merit > b.merit + 1e-9; });
    std::vector<const Draft*> wait;
    for (const Draft& draft : drafts) {
      if (is_full()) return;
      throw_if_stopped();
      if (is_taken(draft)) continue;
      if (stands_out(draft)) {
        wait.push_back(&draft);
      } else {
        take(draft);
      }
    }
    for (const Draft* draft : wait) {
      if (is_full()) return;
      throw_if_stopped();
      if (!is_taken(*draft)) take(*draft);
    }
  }

 private:
  struct Taken {
    Eigen::Vector3d axis, middle;
  };

  static Eigen::Vector3d axis(const FeaturePair& pair) { return pair.X_PG.linear().col(2); }
  static Eigen::Vector3d middle(const FeaturePair& pair) { return pair.X_PG.translation(); }
  const PlanarFace& face(int index) const {
    return features_.faces[static_cast<std::size_t>(index)];
  }
  const PartEdge& edge(int index) const { return features_.edges[static_cast<std::size_t>(index)]; }

  bool is_full() const { return kept_ >= options_.most_beyond_faces || tried_ >= kMostTried; }

  void drop_those_the_jaws_cannot_span(std::vector<Draft>& drafts) {
    std::vector<RejectedPair> fallen;
    const auto cannot = [&](const Draft& draft) {
      FeaturePair pair;
      pair.a = draft.a;
      pair.b = draft.b;
      pair.width = draft.width;
      std::optional<RejectedPair> rejected = reject_width(pair, gripper_, options_);
      if (rejected) fallen.push_back(std::move(*rejected));
      return rejected.has_value();
    };
    drafts.erase(std::remove_if(drafts.begin(), drafts.end(), cannot), drafts.end());
    std::stable_sort(fallen.begin(), fallen.end(),
                     [](const auto& a, const auto& b) { return a.width < b.width - 1e-9; });
    if (fallen.size() > kMostRejected) fallen.resize(kMostRejected);
    features_.rejected.insert(features_.rejected.end(), fallen.begin(), fallen.end());
  }

  double promise(const Draft& draft) const {
    const Eigen::Vector3d away = p_centre_ - draft.at;
    const double lever = (away - away.dot(draft.normal) * draft.normal).norm();
    const double length =
        draft.length > 0.0 ? std::min(1.0, draft.length / gripper_.pad_length) : 1.0;
    return kind_worth(draft.kind) * length / (1.0 + lever / gripper_.pad_length);
  }

  bool is_taken(const Draft& draft) const {
    return std::any_of(taken_.begin(), taken_.end(), [&](const Taken& other) {
      if (std::abs(other.axis.dot(draft.normal)) < kSameAxis) return false;
      const Eigen::Vector3d apart = other.middle - draft.at;
      return (apart - apart.dot(draft.normal) * draft.normal).norm() < kSamePlace;
    });
  }

  // Has the part points near an edge or a vertex, beyond the plane of the pad there?
  bool stands_out(const Draft& draft) const {
    const double near = 0.5 * gripper_.pad_width;
    for (const double side : {1.0, -1.0}) {
      if (side > 0.0 && draft.a.kind == FeatureKind::Face) continue;
      const Eigen::Vector3d outward = side * draft.normal;
      const Eigen::Vector3d contact = draft.at + 0.5 * draft.width * outward;
      for (const Eigen::Vector3d& point : points_) {
        const Eigen::Vector3d away = point - contact;
        const double height = away.dot(outward);
        if (height < kStandsOut || height > near) continue;
        if ((away - height * outward).norm() < near) return true;
      }
    }
    return false;
  }

  void take(const Draft& draft) {
    ++tried_;
    FeaturePair pair;
    pair.kind = draft.kind;
    pair.a = draft.a;
    pair.b = draft.b;
    pair.width = draft.width;
    pair.X_PG.linear() = rotation_with_z(draft.normal, draft.along);
    pair.X_PG.translation() = draft.at;
    pair.strip = 2.0 * kInsidePad;
    if (!cut(draft, pair)) return;
    move_origin_to_overlap(pair);
    taken_.push_back({axis(pair), middle(pair)});
    features_.pairs.push_back(std::move(pair));
    ++kept_;
  }

  // The regions in the plane of the draft; false if too little is left of them.
  bool cut(const Draft& draft, FeaturePair& pair) {
    const Pose X_GP = pair.X_PG.inverse();
    const auto in_plane = [&](const Eigen::Vector3d& p) -> Eigen::Vector2d {
      return (X_GP * p).head<2>();
    };
    double least_area = options_.least_edge * pair.strip;
    if (draft.kind == PairKind::CrossedEdges) {
      pair.overlap = square(Eigen::Vector2d::Zero(), pair.strip);
      pair.contact_a = pair.contact_b = square(Eigen::Vector2d::Zero(), kContactWidth);
    } else if (draft.kind == PairKind::ParallelEdges) {
      const PartEdge &a = edge(draft.a.index), &b = edge(draft.b.index);
      cut_parallel({in_plane(a.from), in_plane(a.to)}, {in_plane(b.from), in_plane(b.to)}, pair);
      least_area = options_.least_edge * pair.strip;  // the strip is wider now
    } else {
      if (draft.kind == PairKind::FaceEdge) {
        const PartEdge& b = edge(draft.b.index);
        const Eigen::Vector2d from = in_plane(b.from), to = in_plane(b.to);
        pair.overlap = strip_about(from, to, pair.strip);
        pair.contact_b = strip_about(from, to, kContactWidth);
        const double slope = X_GP.linear().row(2).dot(b.to - b.from) / (to.x() - from.x());
        pair.taper = Eigen::Vector2d(-slope, 0.0);
      } else {
        pair.overlap = square(Eigen::Vector2d::Zero(), pair.strip);
        pair.contact_b = square(Eigen::Vector2d::Zero(), kContactWidth);
        least_area = 0.99 * pair.strip * pair.strip;
      }
      pair.contact_a = map_region(exposed_(draft.a.index), X_GP * face_frame(face(draft.a.index)));
      pair.overlap = intersect(pair.overlap, pair.contact_a);
      pair.contact_b = intersect(pair.contact_b, pair.contact_a);
      // The edge itself, not only the border of its strip, must be over the face.
      const double least = draft.kind == PairKind::FaceEdge ? options_.least_edge : kContactWidth;
      if (area(pair.contact_b) < 0.99 * least * kContactWidth) return false;
    }
    pair.area = area(pair.overlap);
    return pair.area >= least_area - 1e-12;
  }

  struct Segment {
    Eigen::Vector2d from, to;
  };
  void cut_parallel(Segment a, Segment b, FeaturePair& pair) const {
    for (Segment* segment : {&a, &b}) {
      if (segment->from.x() > segment->to.x()) std::swap(segment->from, segment->to);
    }
    const double x0 = std::max(a.from.x(), b.from.x()), x1 = std::min(a.to.x(), b.to.x());
    double y0 = a.from.y(), y1 = y0;
    for (const Segment& segment : {a, b}) {
      y0 = std::min({y0, segment.from.y(), segment.to.y()});
      y1 = std::max({y1, segment.from.y(), segment.to.y()});
    }
    pair.strip += y1 - y0;
    pair.overlap = rectangle({x0, y0 - kInsidePad}, {x1, y1 + kInsidePad});
    const auto shorten = [&](Segment segment) {
      segment.from.x() = x0;
      segment.to.x() = x1;
      return strip_about(segment.from, segment.to, kContactWidth);
    };
    pair.contact_a = shorten(a);
    pair.contact_b = shorten(b);
  }

  void move_origin_to_overlap(FeaturePair& pair) const {
    const Eigen::Vector2d centre = middle_of(pair.overlap);
    Pose X_GN = Pose::Identity();
    X_GN.translation() = Eigen::Vector3d(centre.x(), centre.y(), 0.0);
    pair.width = pair.width_at(centre);
    // Feature b falls away by half of what the width grows.
    X_GN.translation().z() = -0.5 * pair.taper.dot(centre);
    const Pose X_NG = X_GN.inverse();
    pair.X_PG = pair.X_PG * X_GN;
    pair.overlap = map_region(pair.overlap, X_NG);
    pair.contact_a = map_region(pair.contact_a, X_NG);
    pair.contact_b = map_region(pair.contact_b, X_NG);
  }

  const Gripper& gripper_;
  ExposedFaces& exposed_;
  const FeatureOptions& options_;
  FeaturePairs& features_;
  const double friction_;
  const Eigen::Vector3d p_centre_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Taken> taken_;
  int kept_ = 0, tried_ = 0;
};

}  // namespace

void add_pairs_beyond_faces(const Body& part, const Gripper& gripper, ExposedFaces& exposed,
                            const FeatureOptions& options, FeaturePairs& features) {
  EdgesAndVertices found = part_edges(part, options);
  features.edges = std::move(found.edges);
  features.vertices = std::move(found.vertices);
  BeyondFaces(part, gripper, exposed, options, features).find();
}

}  // namespace handey::grasp
