// Walks the tree of links from the root. A link under a fixed joint joins its parent's body, any
// other starts a body of its own. Open meshes become their convex hulls, which contain them: errs
// on the side of collision.
#include "robot_builder.hpp"

#include <cmath>
#include <limits>

#include "handey/geometry/convex_pieces.hpp"
#include "handey/geometry/mesh_file.hpp"
#include "numbers.hpp"

namespace handey::kinematics {
namespace {

constexpr double kLimitTolerance = 1e-9;      // [rad] or [m]
constexpr double kDirectionTolerance = 1e-3;  // finger axes against the closing axis

Eigen::Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose pose(const urdf::Pose& from) {
  const Eigen::Quaterniond turn(from.rotation.w, from.rotation.x, from.rotation.y, from.rotation.z);
  Pose to = Pose::Identity();
  to.linear() = turn.normalized().toRotationMatrix();
  to.translation() = vector(from.position);
  return to;
}

class Builder {
 public:
  Builder(const urdf::ModelInterface& model, const XmlElement& root,
          const RobotDescription& description, const MeshReferences& references,
          UrdfFindings& findings)
      : model_(model),
        root_(root),
        description_(description),
        references_(references),
        findings_(findings) {}

  Robot build() {
    robot_.name = description_.name.empty() ? model_.name_ : description_.name;
    add_links();
    for (std::size_t i = 0; i < description_.arm.size(); ++i) add_arm_joint(i);
    add_gripper();
    robot_.home = Eigen::Map<const Eigen::VectorXd>(
        description_.home.data(), static_cast<Eigen::Index>(description_.home.size()));
    for (const auto& [a, b] : description_.ignore_collisions) {
      robot_.ignored_pairs.emplace_back(place_of_.at(a).body, place_of_.at(b).body);
    }
    const std::string violation = limit_violation(robot_, robot_.home);
    if (!violation.empty()) findings_.faults.push_back({"E_LIMIT", "home", violation});
    return std::move(robot_);
  }

 private:
  struct LinkPlace {
    int body = 0;
    Pose X_BL = Pose::Identity();
  };

  const XmlElement& element(const char* tag, const std::string& name) const {
    for (const auto& child : root_.children) {
      if (child->name == tag && child->value("name") == name) return *child;
    }
    return root_;
  }

  void add_links() {
    std::vector<std::string> open{model_.getRoot()->name};
    place_of_[open.front()] = {};
    start_body(open.front());
    for (std::size_t next = 0; next < open.size(); ++next) {
      const std::string name = open[next];
      add_shapes(name);
      for (const auto& child : root_.children) {  // in the order of the file
        if (child->name != "joint") continue;
        const urdf::JointConstSharedPtr joint = model_.getJoint(child->value("name"));
        if (joint->parent_link_name != name) continue;
        place_child(*joint);
        open.push_back(joint->child_link_name);
      }
    }
  }

  void start_body(const std::string& link) {
    robot_.bodies.emplace_back();
    robot_.bodies.back().name = link;
  }

  void place_child(const urdf::Joint& joint) {
    const LinkPlace& parent = place_of_.at(joint.parent_link_name);
    if (joint.type == urdf::Joint::FIXED) {
      place_of_[joint.child_link_name] = {
          parent.body, parent.X_BL * pose(joint.parent_to_joint_origin_transform)};
    } else {
      place_of_[joint.child_link_name] = {static_cast<int>(robot_.bodies.size()), Pose::Identity()};
      start_body(joint.child_link_name);
    }
  }

  void add_shapes(const std::string& name) {
    const LinkPlace& place = place_of_.at(name);
    RobotBody& body = robot_.bodies[static_cast<std::size_t>(place.body)];
    body.links.push_back(name);
    const std::vector<const XmlElement*> elements = element("link", name).all("collision");
    const auto& collisions = model_.getLink(name)->collision_array;
    for (std::size_t i = 0; i < collisions.size(); ++i) {
      try {
        Shape shape;
        shape.geometry = geometry(*collisions[i]->geometry, *elements[i], name);
        shape.X_BS = place.X_BL * pose(collisions[i]->origin);
        body.shapes.push_back(std::move(shape));
      } catch (const InvalidInput& error) {
        for (const Fault& fault : error.faults()) {
          const std::string inner = fault.place.empty() ? "" : fault.place + ": ";
          findings_.fault(fault.code.c_str(), *elements[i], "link '" + name + "'",
                          inner + fault.message);
        }
      }
    }
  }

  Geometry geometry(const urdf::Geometry& from, const XmlElement& element,
                    const std::string& link) {
    switch (from.type) {
      case urdf::Geometry::BOX:
        return Box{vector(static_cast<const urdf::Box&>(from).dim)};
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(from);
        return Cylinder{cylinder.radius, cylinder.length};
      }
      case urdf::Geometry::SPHERE:
        return Sphere{static_cast<const urdf::Sphere&>(from).radius};
      default:
        return mesh(static_cast<const urdf::Mesh&>(from), element, link);
    }
  }

  MeshShape mesh(const urdf::Mesh& from, const XmlElement& element, const std::string& link) {
    MeshFileOptions options;
    options.scale = vector(from.scale);
    LoadedMesh loaded = load_mesh(references_.resolve(from.filename), options);
    for (const std::string& warning : loaded.warnings) {
      findings_.warn(element, "link '" + link + "'", from.filename + ": " + warning);
    }
    MeshShape shape;
    if (loaded.surface.closed && loaded.surface.consistently_oriented) {
      shape.mesh = std::make_shared<const TriangleMesh>(std::move(loaded.mesh));
    } else {
      findings_.warn(element, "link '" + link + "'",
                     from.filename + ": is not a closed surface; its convex hull stands for it");
      shape.mesh =
          std::make_shared<const TriangleMesh>(triangulate(convex_hull(loaded.mesh.vertices)));
    }
    return shape;
  }

  /// Limits of a joint, narrowed by its safety controller.
  JointLimit limit(const urdf::Joint& joint) {
    JointLimit limit;
    limit.velocity = joint.limits->velocity;
    if (joint.type == urdf::Joint::CONTINUOUS) {
      limit.lower = -std::numeric_limits<double>::infinity();
      limit.upper = std::numeric_limits<double>::infinity();
      return limit;
    }
    limit.lower = joint.limits->lower;
    limit.upper = joint.limits->upper;
    const XmlElement* safety = element("joint", joint.name).child("safety_controller");
    if (!safety) return limit;
    if (safety->attribute("soft_lower_limit") && joint.safety->soft_lower_limit > limit.lower) {
      limit.lower = joint.safety->soft_lower_limit;
      findings_.warn(
          *safety, "joint '" + joint.name + "'",
          "the safety controller's lower limit " + number_text(limit.lower) + " is applied");
    }
    if (safety->attribute("soft_upper_limit") && joint.safety->soft_upper_limit < limit.upper) {
      limit.upper = joint.safety->soft_upper_limit;
      findings_.warn(
          *safety, "joint '" + joint.name + "'",
          "the safety controller's upper limit " + number_text(limit.upper) + " is applied");
    }
    if (!(limit.lower < limit.upper)) {
      findings_.fault("E_LIMIT", *safety, "joint '" + joint.name + "'",
                      "the safety controller leaves no range: " + number_text(limit.lower) +
                          " to " + number_text(limit.upper));
    }
    return limit;
  }

  void add_arm_joint(std::size_t i) {
    const urdf::JointConstSharedPtr from = model_.getJoint(description_.arm[i]);
    const LinkPlace& parent = place_of_.at(from->parent_link_name);
    ArmJoint joint;
    joint.name = from->name;
    joint.parent = parent.body;
    joint.child = place_of_.at(from->child_link_name).body;
    joint.X_PJ = parent.X_BL * pose(from->parent_to_joint_origin_transform);
    joint.axis = vector(from->axis).normalized();
    joint.limit = limit(*from);
    if (!description_.acceleration.empty()) joint.limit.acceleration = description_.acceleration[i];
    robot_.joints.push_back(std::move(joint));
  }

  void add_gripper() {
    Gripper& gripper = robot_.gripper;
    const LinkPlace& hand = place_of_.at(description_.gripper_link);
    gripper.body = hand.body;
    gripper.X_BH = hand.X_BL * description_.X_LH;
    gripper.min_opening = description_.min_opening;
    gripper.max_opening = description_.max_opening;
    gripper.pad_width = description_.pad_width;
    gripper.pad_length = description_.pad_length;
    for (std::size_t i = 0; i < 2; ++i) add_finger(i);
    const Eigen::Vector3d y = gripper.X_BH.linear().col(1);
    const Eigen::Vector3d first = direction(gripper.fingers[0]),
                          second = direction(gripper.fingers[1]);
    if (std::abs(std::abs(first.dot(y)) - 1.0) > kDirectionTolerance * kDirectionTolerance ||
        (first + second).norm() > kDirectionTolerance) {
      findings_.faults.push_back({"E_AXIS", "gripper.fingers",
                                  "the fingers do not move apart along y of the grasp frame, the "
                                  "closing axis, as their values grow"});
    }
  }

  /// A finger's direction of opening in the hand's body.
  static Eigen::Vector3d direction(const FingerJoint& finger) {
    return finger.X_PJ.linear() * finger.axis;
  }

  void add_finger(std::size_t i) {
    const urdf::JointConstSharedPtr from = model_.getJoint(description_.fingers[i]);
    const LinkPlace& parent = place_of_.at(from->parent_link_name);
    FingerJoint& finger = robot_.gripper.fingers[i];
    finger.name = from->name;
    finger.parent = parent.body;
    finger.child = place_of_.at(from->child_link_name).body;
    finger.X_PJ = parent.X_BL * pose(from->parent_to_joint_origin_transform);
    finger.axis = vector(from->axis).normalized();
    const JointLimit range = limit(*from);
    finger.velocity = range.velocity;
    const double least = 0.5 * description_.min_opening, most = 0.5 * description_.max_opening;
    if (least < range.lower - kLimitTolerance || most > range.upper + kLimitTolerance) {
      findings_.faults.push_back({"E_LIMIT", "gripper.opening",
                                  "moves '" + from->name + "' from " + number_text(least) + " to " +
                                      number_text(most) + " m (half the opening); its limits are " +
                                      number_text(range.lower) + " to " +
                                      number_text(range.upper)});
    }
  }

  const urdf::ModelInterface& model_;
  const XmlElement& root_;
  const RobotDescription& description_;
  const MeshReferences& references_;
  UrdfFindings& findings_;
  Robot robot_;
  std::map<std::string, LinkPlace> place_of_;
};

}  // namespace

LoadedRobot build_robot(const urdf::ModelInterface& model, const XmlElement& root,
                        const RobotDescription& description, const MeshReferences& references,
                        UrdfFindings findings) {
  LoadedRobot loaded;
  loaded.robot = Builder(model, root, description, references, findings).build();
  findings.throw_if_any();
  loaded.warnings = std::move(findings.warnings);
  return loaded;
}

}  // namespace handey::kinematics
