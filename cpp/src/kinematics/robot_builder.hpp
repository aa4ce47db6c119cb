// Bodies, joints and gripper out of a URDF that has passed all checks.
#pragma once

#include <urdf_model/model.h>

#include "handey/kinematics/urdf.hpp"
#include "mesh_reference.hpp"
#include "urdf_checks.hpp"

namespace handey::kinematics {

/// @throws InvalidInput with all faults of meshes, limits and gripper
LoadedRobot build_robot(const urdf::ModelInterface& model, const XmlElement& root,
                        const RobotDescription& description, const MeshReferences& references,
                        UrdfFindings findings);

}  // namespace handey::kinematics
