// A parallel-jaw gripper: two fingers on prismatic joints, and the grasp frame H midway between the
// pads. H: +z points from the palm out past the finger tips, +y is the closing axis, x completes
// the frame. At opening w the pads are the rectangles |x| <= pad_width/2, |z| <= pad_length/2 at y
// = +w/2 and y = -w/2.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>

#include "handey/geometry/pose.hpp"

namespace handey {

/// A finger: child = parent * X_PJ * Translate(axis * opening / 2).
struct FingerJoint {
  std::string name;
  int parent = 0;  ///< body index (the hand's body)
  int child = 0;   ///< body index
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< unit, in the joint frame
  double velocity = 0.1;  ///< limit of the joint, half the opening's [m/s]
};

struct Gripper {
  int body = 0;                  ///< the robot body that carries H
  Pose X_BH = Pose::Identity();  ///< grasp frame in that body
  std::array<FingerJoint, 2> fingers;
  double min_opening = 0.0;  ///< [m]
  double max_opening = 0.1;  ///< [m]
  double pad_width = 0.02;   ///< along x of H [m]
  double pad_length = 0.03;  ///< along z of H [m]
  double acceleration =
      1.0;  ///< of a finger joint [m/s2]. Choice: typical of pneumatic and servo jaws
};

}  // namespace handey
