// Pairs of planar faces that a parallel jaw can hold: every two faces are looked at, the normals
// first. Pairs with edges and vertices are found elsewhere.
#include "handey/grasp/features.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beyond_faces.hpp"
#include "handey/stop.hpp"
#include "pair_rules.hpp"
#include "part_faces.hpp"
#include "plane_map.hpp"
#include "ranges.hpp"

namespace handey {

Pose hand_in_plane(const PlanarPose& pose, bool flipped) {
  const double c = std::cos(pose.theta), s = std::sin(pose.theta);
  Pose X_GH = Pose::Identity();
  X_GH.linear().col(2) = Eigen::Vector3d(c, s, 0.0);
  X_GH.linear().col(1) = Eigen::Vector3d(0.0, 0.0, flipped ? -1.0 : 1.0);
  X_GH.linear().col(0) = X_GH.linear().col(1).cross(X_GH.linear().col(2));
  X_GH.translation() = Eigen::Vector3d(pose.x, pose.y, 0.0);
  return X_GH;
}

std::string to_string(const Feature& feature) {
  const char* kind = feature.kind == FeatureKind::Face   ? "face "
                     : feature.kind == FeatureKind::Edge ? "edge "
                                                         : "vertex ";
  return kind + std::to_string(feature.index);
}

std::string to_string(const Feature& a, const Feature& b) {
  if (a.kind != b.kind) return to_string(a) + " / " + to_string(b);
  const char* kind = a.kind == FeatureKind::Face ? "faces " : "edges ";
  return kind + std::to_string(a.index) + "/" + std::to_string(b.index);
}

namespace {

using grasp::face_frame;
using grasp::map_region;
using grasp::one_decimal;

void require_valid_input(const Body& part, const Gripper& gripper, const FeatureOptions& options) {
  if (part.shapes.empty()) {
    throw InvalidInput("E_GEOMETRY", "parts." + part.name, "has no shape, expected at least one");
  }
  for (std::size_t i = 0; i < part.shapes.size(); ++i) {
    require_valid(part.shapes[i], "parts." + part.name + ".shapes[" + std::to_string(i) + "]");
  }
  grasp::require_in_range(gripper.min_opening, 0.0, 10.0, "gripper.min_opening");
  grasp::require_in_range(gripper.max_opening, gripper.min_opening, 10.0, "gripper.max_opening");
  grasp::require_in_range(options.angle, 0.0, 0.1, "features.angle");
  grasp::require_in_range(options.least_face_area, 0.0, 1.0, "features.least_face_area");
  grasp::require_in_range(options.least_overlap, 0.0, 1.0, "features.least_overlap");
  grasp::require_in_range(options.jaw_clearance, 0.0, 1.0, "features.jaw_clearance");
  grasp::require_in_range(options.least_edge, 1e-5, 1.0, "features.least_edge");
  grasp::require_in_range(options.sharp_edge, 0.0, 3.0, "features.sharp_edge");
  grasp::require_in_range(options.friction_use, 0.0, 1.0, "features.friction_use");
  grasp::require_in_range(options.most_edges, 0, 10000, "features.most_edges");
  grasp::require_in_range(options.most_beyond_faces, 0, 10000, "features.most_beyond_faces");
}

// The longest edge of a region, as a direction.
Eigen::Vector2d longest_edge(const Region& region) {
  Eigen::Vector2d longest = Eigen::Vector2d::UnitX();
  double length = 0.0;
  for (const Polygon& loop : region.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Eigen::Vector2d edge = loop[(i + 1) % loop.size()] - loop[i];
      if (edge.norm() > length + 1e-9) {
        length = edge.norm();
        longest = edge / length;
      }
    }
  }
  return longest;
}

class PairFinder {
 public:
  PairFinder(const Body& part, const Gripper& gripper, const FeatureOptions& options)
      : part_(part),
        gripper_(gripper),
        options_(options),
        result_(with_faces(part, options)),
        exposed_(part, result_.faces) {}

  FeaturePairs find() {
    const int count = static_cast<int>(result_.faces.size());
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) consider(a, b);
    }
    std::stable_sort(result_.pairs.begin(), result_.pairs.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area + 1e-12; });
    if (options_.beyond_faces) {
      grasp::add_pairs_beyond_faces(part_, gripper_, exposed_, options_, result_);
    }
    return std::move(result_);
  }

 private:
  static FeaturePairs with_faces(const Body& part, const FeatureOptions& options) {
    FeaturePairs features;
    features.faces = grasp::part_faces(part, options.least_face_area);
    return features;
  }

  void consider(int index_a, int index_b) {
    throw_if_stopped();
    const PlanarFace& a = face(index_a);
    const PlanarFace& b = face(index_b);
    // |n_a + n_b| is the angle from antiparallel.
    if ((a.normal + b.normal).norm() > options_.angle) return;
    if ((a.origin - b.origin).dot(a.normal) <= 0.0) return;  // they face each other

    // C: plane frame of the pair before its origin is known.
    Pose X_PC = Pose::Identity();
    X_PC.linear() = grasp::rotation_with_z(a.normal - b.normal, a.u);
    X_PC.translation() = a.origin;
    const Region overlap = common_area(X_PC, index_a, index_b);
    const double overlap_area = area(overlap);
    if (overlap_area < 1e-9) return;

    FeaturePair pair;
    pair.a = {FeatureKind::Face, index_a};
    pair.b = {FeatureKind::Face, index_b};
    pair.area = overlap_area;
    place_plane(pair, X_PC, overlap);
    if (const std::optional<RejectedPair> rejected = reject(pair)) {
      result_.rejected.push_back(*rejected);
    } else {
      result_.pairs.push_back(std::move(pair));
    }
  }

  Region common_area(const Pose& X_PC, int a, int b) {
    const Pose X_CP = X_PC.inverse();
    const Region region_a = map_region(face(a).region, X_CP * face_frame(face(a)));
    const Region region_b = map_region(face(b).region, X_CP * face_frame(face(b)));
    const Region overlap = intersect(region_a, region_b);
    if (exposed_.none_covered() || overlap.empty()) return overlap;
    const Region exposed_a = map_region(exposed_(a), X_CP * face_frame(face(a)));
    const Region exposed_b = map_region(exposed_(b), X_CP * face_frame(face(b)));
    return intersect(exposed_a, exposed_b);
  }

  // G: origin in the overlap, midway between the faces, x along the longest edge.
  void place_plane(FeaturePair& pair, const Pose& X_PC, const Region& overlap) const {
    const Eigen::Vector2d middle = grasp::middle_of(overlap);
    const Eigen::Vector2d edge = longest_edge(overlap);
    Pose X_CG = Pose::Identity();
    X_CG.linear() =
        grasp::rotation_with_z(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(edge.x(), edge.y(), 0.0));
    X_CG.translation() = Eigen::Vector3d(middle.x(), middle.y(), 0.0);
    pair.X_PG = X_PC * X_CG;
    const double height_a = height_over(face(pair.a.index), pair.X_PG);
    const double height_b = height_over(face(pair.b.index), pair.X_PG);
    pair.width = height_a - height_b;
    pair.X_PG.translation() += 0.5 * (height_a + height_b) * pair.X_PG.linear().col(2);
    pair.overlap = map_region(overlap, X_CG.inverse());
    // A plane with normal n has the slope -n_xy / n_z over x and y.
    const Eigen::Matrix3d R_GP = pair.X_PG.linear().transpose();
    const Eigen::Vector3d n_a = R_GP * face(pair.a.index).normal;
    const Eigen::Vector3d n_b = R_GP * face(pair.b.index).normal;
    pair.taper = -n_a.head<2>() / n_a.z() + n_b.head<2>() / n_b.z();
  }

  // Where the axis z of G pierces the plane of a face.
  static double height_over(const PlanarFace& face, const Pose& X_PG) {
    const Eigen::Vector3d z = X_PG.linear().col(2);
    return (face.origin - X_PG.translation()).dot(face.normal) / z.dot(face.normal);
  }

  std::optional<RejectedPair> reject(const FeaturePair& pair) const {
    std::optional<RejectedPair> rejected = grasp::reject_width(pair, gripper_, options_);
    if (rejected || pair.area >= options_.least_overlap) return rejected;
    return RejectedPair{pair.a,
                        pair.b,
                        pair.width,
                        Rejection::LittleOverlap,
                        "faces overlap by " + one_decimal(pair.area * 1e6) + " mm2, at least " +
                            one_decimal(options_.least_overlap * 1e6) + " mm2 are needed",
                        options_.least_overlap - pair.area};
  }

  const PlanarFace& face(int index) const { return result_.faces[static_cast<std::size_t>(index)]; }

  const Body& part_;
  const Gripper& gripper_;
  const FeatureOptions& options_;
  FeaturePairs result_;
  grasp::ExposedFaces exposed_;
};

}  // namespace

FeaturePairs find_feature_pairs(const Body& part, const Gripper& gripper,
                                const FeatureOptions& options) {
  require_valid_input(part, gripper, options);
  return PairFinder(part, gripper, options).find();
}

}  // namespace handey
