// The strict walk over a URDF before it is parsed, in four parts, and what they find.
// Each part reports all it finds; a later part may rely on what an earlier one has passed only if
// there were no faults.
#pragma once

#include <string>
#include <vector>

#include "handey/errors.hpp"
#include "handey/kinematics/urdf.hpp"
#include "urdf_xml.hpp"

namespace handey::kinematics {

struct UrdfFindings {
  std::string file;  ///< its name, for places
  std::vector<Fault> faults;
  std::vector<std::string> warnings;

  /// "puma560.urdf:12: joint 'joint2'"
  std::string place(const XmlElement& element, const std::string& owner) const;
  /// Adds a fault. Throws InvalidInput with all of them once there are too many to read.
  void fault(const char* code, const XmlElement& element, const std::string& owner,
             std::string message);
  void warn(const XmlElement& element, const std::string& owner, const std::string& message);
  void throw_if_any() const;
};

/// "joint 'joint2'": how faults name a link or a joint.
std::string owner_of(const XmlElement& element);

/// Known tags and attributes, each at its place, once where it may stand once; leftovers of xacro.
void check_schema(const XmlElement& robot, UrdfFindings& findings);

/// Names, numbers, axes, limits, sizes.
void check_values(const XmlElement& robot, UrdfFindings& findings);

/// Parents, children and mimics exist; the links form one tree.
void check_tree(const XmlElement& robot, UrdfFindings& findings);

/// Names and numbers of the robot file against the URDF.
void check_description(const XmlElement& robot, const RobotDescription& description,
                       UrdfFindings& findings);

}  // namespace handey::kinematics
