// Each known shape is asked only for the pixels whose rays can meet the box about it. Along a row
// of the image a pixel's point in the shape's frame is depth times a vector that grows by the same
// step from pixel to pixel.
#include <algorithm>
#include <cmath>
#include <limits>

#include "depth_image.hpp"
#include "handey/world/depth_map.hpp"
#include "surface_distance.hpp"

namespace handey {
namespace {

using Eigen::Vector3d;

// Points this near to the limit count as not explained: another program may see them as such [m].
constexpr double kDoubt = 5e-7;

struct Window {
  int v0, v1, u0, u1;  // rows [v0, v1), columns [u0, u1)
};

/// The pixels that can see a box; all if it reaches behind the camera.
Window window_of(const DepthImage& image, const Eigen::AlignedBox3d& box, const Pose& X_CS) {
  double u0 = std::numeric_limits<double>::infinity(), u1 = -u0, v0 = u0, v1 = -u0;
  for (int k = 0; k < 8; ++k) {
    const Vector3d p = X_CS * Vector3d(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
    if (p.z() < 1e-6) return {0, image.rows, 0, image.columns};
    const double u = image.fx * p.x() / p.z() + image.cx, v = image.fy * p.y() / p.z() + image.cy;
    u0 = std::min(u0, u);
    u1 = std::max(u1, u);
    v0 = std::min(v0, v);
    v1 = std::max(v1, v);
  }
  const auto within = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {within(std::floor(v0), image.rows), within(std::ceil(v1) + 1.0, image.rows),
          within(std::floor(u0), image.columns), within(std::ceil(u1) + 1.0, image.columns)};
}

void explain(const DepthImage& image, const Shape& shape, const Pose& X_WB,
             std::vector<char>& explained) {
  world::SurfaceBand band(shape, image.explained - kDoubt);
  const Pose X_SC = (X_WB * shape.X_BS).inverse() * image.X_WD;
  const Window window = window_of(image, band.box(), X_SC.inverse());
  const Vector3d step = X_SC.linear().col(0) / image.fx, origin = X_SC.translation();
  const Vector3d low = band.box().min(), high = band.box().max();
  for (int v = window.v0; v < window.v1; ++v) {
    const Vector3d first =
        X_SC.linear() * Vector3d(-image.cx / image.fx, (v - image.cy) / image.fy, 1.0);
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(image.columns);
    for (int u = window.u0; u < window.u1; ++u) {
      const std::size_t i = row + static_cast<std::size_t>(u);
      const double z = image.depths[i];
      if (explained[i] != 0 || !(z > 0.0)) continue;
      const Vector3d p = origin + z * (first + u * step);
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
      if (band.contains(p)) explained[i] = 1;
    }
  }
}

/// The quick shapes first: what they explain the others are not asked for.
void explain_bodies(const DepthImage& image,
                    const std::vector<std::pair<const Shape*, Pose>>& shapes,
                    std::vector<char>& explained) {
  for (const bool meshes : {false, true}) {
    for (const auto& [shape, X_WB] : shapes) {
      if (std::holds_alternative<MeshShape>(shape->geometry) == meshes) {
        explain(image, *shape, X_WB, explained);
      }
    }
  }
}

}  // namespace

std::vector<char> explained_pixels(const DepthImage& image, const Cell& cell) {
  world::require_valid(image);
  require_valid(cell);
  std::vector<char> explained(image.depths.size(), 0);
  if (!(image.explained > kDoubt)) return explained;
  std::vector<std::pair<const Shape*, Pose>> shapes;
  for (const std::vector<Body>* bodies : {&cell.fixtures, &cell.parts}) {
    for (const Body& body : *bodies) {
      for (const Shape& shape : body.shapes) shapes.emplace_back(&shape, body.X_WB);
    }
  }
  const std::vector<Pose> poses = body_poses(*cell.robot, cell.start);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    for (const Shape& shape : cell.robot->bodies[b].shapes) {
      shapes.emplace_back(&shape, cell.X_WR * poses[b]);
    }
  }
  explain_bodies(image, shapes, explained);
  return explained;
}

}  // namespace handey
