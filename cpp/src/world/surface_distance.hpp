// Does a point lie within a distance of the surface of a shape? Boxes, cylinders and spheres in
// closed form, meshes by their nearest triangle.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "handey/geometry/shape.hpp"

namespace handey::world {

class SurfaceBand {
 public:
  /// @param within half of the band's thickness, >= 0 [m]
  SurfaceBand(const Shape& shape, double within);

  /// The box about the band, in the shape's frame.
  const Eigen::AlignedBox3d& box() const { return box_; }
  /// A point of the shape's frame; one that is in box().
  bool contains(const Eigen::Vector3d& point);

 private:
  struct Triangle {
    Eigen::Vector3d a, ab, ac, bc;
    double abab, acac, bcbc, abac;
    Eigen::Vector3d normal;  // unit; zero for a triangle without area
  };
  struct Node {
    Eigen::AlignedBox3d box;   // grown by the band
    int first = 0, count = 0;  // triangles of a leaf; count 0: children first and first + 1
  };

  static Triangle triangle_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c);
  bool is_near(const Triangle& triangle, const Eigen::Vector3d& point) const;
  void add_mesh(const TriangleMesh& mesh);
  void build(int node, int first, int count);

  Geometry geometry_;
  double within_;
  Eigen::AlignedBox3d box_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  int last_ = 0;  // triangle that was near the point before: neighbours ask for it again
};

}  // namespace handey::world
