// Space cut into cubes about a ball's centre: free where the ball meets nothing, blocked where it
// meets one solid wherever in the cube its centre is, in doubt otherwise. Those in doubt can be cut
// into eight. Errs towards doubt.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "handey/collision/solids.hpp"

namespace handey::cspace {

enum class CubeKind { Unknown, Free, Doubt, Blocked };

class CubeTree {
 public:
  static constexpr int kOutside = -1;

  /// @param box     of the centre; beyond it nothing is looked at
  /// @param finest  edge of the smallest cubes [m]
  CubeTree(const SolidScene& scene, double radius, const Eigen::AlignedBox3d& box, double finest);

  /// The cube that is not cut and holds a point; kOutside beyond the box.
  int at(const Eigen::Vector3d& point) const;
  CubeKind kind(int cube);
  bool is_finest(int cube) const { return cubes_[static_cast<std::size_t>(cube)].level == levels_; }
  int level(int cube) const { return cubes_[static_cast<std::size_t>(cube)].level; }
  void cut(int cube);
  /// Cubes that are not cut and share a part of a face with this one; kOutside among them.
  void neighbours(int cube, std::vector<int>& found) const;
  Eigen::Vector3d centre(int cube) const;
  /// Index of the obstacle that blocks a cube.
  int blocker(int cube) const { return cubes_[static_cast<std::size_t>(cube)].blocker; }
  std::size_t looked_at() const { return looked_at_; }
  std::size_t size() const { return cubes_.size(); }
  double finest_looked_at() const { return edge(deepest_); }

 private:
  using Index = std::array<int, 3>;  // of the lower corner, in smallest cubes
  struct Cube {
    Index corner;
    int level = 0;
    int children = -1;  // the first of eight
    int blocker = -1;
    CubeKind kind = CubeKind::Unknown;
    std::vector<int> near;  // solids that the ball may meet, of the cube that was cut
  };

  double edge(int level) const;
  int width(int level) const { return 1 << (levels_ - level); }  // in smallest cubes
  int coarsest_at(const Index& index) const;
  void collect(int cube, const Index& lower, const Index& upper, std::vector<int>& found) const;
  void classify(Cube& cube);

  struct Solid {
    const InnerSolid* solid;
    int obstacle;
  };
  std::vector<Solid> solids_;
  double radius_, finest_;
  int levels_ = 0;
  int deepest_ = 0;
  Eigen::Vector3d lower_;
  Index count_;  // of the coarsest cubes
  std::vector<Cube> cubes_;
  std::size_t looked_at_ = 0;
};

}  // namespace handey::cspace
