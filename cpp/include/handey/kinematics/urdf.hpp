// Reads a URDF file into a Robot. The XML is walked strictly first (size, encoding, depth, unknown
// tags and attributes, duplicates, numbers, references, limits, geometry), because the parser below
// accepts much that is wrong; all faults of the file are reported at once, each with its line.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "handey/kinematics/arm.hpp"

namespace handey {

/// What a URDF does not say; the content of a robot file (docs: formats, section 1).
struct RobotDescription {
  std::string name;
  std::vector<std::string> arm;                 ///< revolute joints, base to flange
  std::vector<double> home;                     ///< [rad]
  std::vector<double> acceleration;             ///< [rad/s2]; empty: 5 for every joint
  std::string gripper_link;                     ///< the link that carries the grasp frame
  Pose X_LH = Pose::Identity();                 ///< grasp frame in that link
  std::array<std::string, 2> fingers;           ///< prismatic joints
  double min_opening = 0.0, max_opening = 0.1;  ///< [m]
  double pad_width = 0.02, pad_length = 0.03;   ///< [m]
  std::vector<std::pair<std::string, std::string>> ignore_collisions;  ///< pairs of link names
  std::map<std::string, std::string>
      packages;  ///< package:// name -> folder; the URDF's own folder is known
};

struct LoadedRobot {
  Robot robot;
  std::vector<std::string> warnings;
};

/// @throws InvalidInput with every fault of the file and of the description's names and numbers
LoadedRobot load_robot(const std::string& urdf_path, const RobotDescription& description);

}  // namespace handey
