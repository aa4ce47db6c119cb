// The robot file against the URDF: every name exists and is of the right kind, the arm is one chain
// from the base, the hand and its fingers are carried by the flange, and nothing else moves.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "numbers.hpp"
#include "urdf_checks.hpp"

namespace handey::kinematics {
namespace {

class DescriptionWalk {
 public:
  DescriptionWalk(const XmlElement& robot, const RobotDescription& description,
                  UrdfFindings& findings)
      : description_(description), findings_(findings) {
    for (const XmlElement* link : robot.all("link")) links_.push_back(link->value("name"));
    for (const XmlElement* joint : robot.all("joint")) {
      joints_.emplace(joint->value("name"), joint);
      order_.push_back(joint);
      if (const XmlElement* child = joint->child("child")) above_[child->value("link")] = joint;
    }
  }

  void numbers() {
    const RobotDescription& d = description_;
    if (d.home.size() != d.arm.size()) {
      wrong("E_DOF", "home", count_text(d.home.size(), d.arm.size()));
    }
    all_finite("home", d.home);
    if (!d.acceleration.empty() && d.acceleration.size() != d.arm.size()) {
      wrong("E_DOF", "acceleration", count_text(d.acceleration.size(), d.arm.size()));
    }
    for (const double value : d.acceleration) {
      if (!(value > 0.0 && std::isfinite(value))) {
        wrong("E_RANGE", "acceleration",
              "has " + number_text(value) + "; expected more than 0 rad/s2");
      }
    }
    if (!(d.min_opening >= 0.0 && d.min_opening < d.max_opening && std::isfinite(d.max_opening))) {
      wrong("E_RANGE", "gripper.opening",
            "is " + number_text(d.min_opening) + " to " + number_text(d.max_opening) +
                " m; expected 0 <= least < greatest");
    }
    positive("gripper.pad.width", d.pad_width);
    positive("gripper.pad.length", d.pad_length);
    try {
      require_rigid(d.X_LH, "gripper.grasp_frame");
    } catch (const InvalidInput& error) {
      findings_.faults.insert(findings_.faults.end(), error.faults().begin(), error.faults().end());
    }
  }

  void names() {
    if (description_.arm.empty()) wrong("E_EMPTY", "arm", "names no joint");
    std::set<std::string> seen;
    for (const std::string& name : description_.arm) {
      joint("arm", name, {"revolute", "continuous"});
      if (!seen.insert(name).second) wrong("E_DUP", "arm", "names '" + name + "' twice");
    }
    for (const std::string& name : description_.fingers) {
      joint("gripper.fingers", name, {"prismatic"});
      if (!seen.insert(name).second)
        wrong("E_DUP", "gripper.fingers", "names '" + name + "' twice");
    }
    link("gripper.link", description_.gripper_link);
    for (const auto& [a, b] : description_.ignore_collisions) {
      link("ignore_collisions", a);
      link("ignore_collisions", b);
    }
  }

  /// Only for a URDF and names without faults.
  void structure() {
    const RobotDescription& d = description_;
    for (std::size_t i = 0; i < d.arm.size(); ++i) {
      const std::string found = mover_of(joints_.at(d.arm[i])->child("parent")->value("link"));
      const std::string expected = i == 0 ? "" : d.arm[i - 1];
      if (found == expected) continue;
      findings_.fault("E_TREE", *joints_.at(d.arm[i]), owner_of(*joints_.at(d.arm[i])),
                      "hangs from " + (found.empty() ? "the base" : "joint '" + found + "'") +
                          ", but the arm lists it after " +
                          (expected.empty() ? "the base" : "'" + expected + "'") +
                          "; expected a chain from the base to the flange");
    }
    carried("gripper.link", "link '" + d.gripper_link + "'", d.gripper_link);
    for (const std::string& name : d.fingers) {
      carried("gripper.fingers", "joint '" + name + "'",
              joints_.at(name)->child("parent")->value("link"));
    }
    for (const XmlElement* each : order_) other_joint(*each);
  }

 private:
  void wrong(const char* code, const std::string& place, std::string message) {
    findings_.faults.push_back({code, place, std::move(message)});
  }
  static std::string count_text(std::size_t found, std::size_t expected) {
    return "has " + std::to_string(found) + " values; expected one per arm joint, " +
           std::to_string(expected);
  }
  void all_finite(const std::string& place, const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value))
        wrong("E_NUMBER", place, "has " + number_text(value) + "; expected finite numbers");
    }
  }
  void positive(const std::string& place, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    wrong("E_RANGE", place, "is " + number_text(value) + " m; expected more than 0");
  }

  void joint(const std::string& place, const std::string& name,
             const std::vector<std::string>& types) {
    const auto found = joints_.find(name);
    if (found == joints_.end()) {
      std::vector<std::string> legal;
      for (const XmlElement* each : order_) {
        const std::string type = each->value("type");
        if (std::find(types.begin(), types.end(), type) != types.end())
          legal.push_back(each->value("name"));
      }
      wrong("E_REF", place,
            "'" + name + "' is no joint of the URDF; " + types.front() + " joints are " +
                quoted_list(legal));
      return;
    }
    const std::string type = found->second->value("type");
    if (std::find(types.begin(), types.end(), type) != types.end()) return;
    wrong("E_JOINT_TYPE", place, "'" + name + "' is " + type + "; expected " + types.front());
  }

  void link(const std::string& place, const std::string& name) {
    if (std::find(links_.begin(), links_.end(), name) != links_.end()) return;
    wrong("E_REF", place,
          "'" + name + "' is no link of the URDF; links are " + quoted_list(links_));
  }

  /// The joint that moves a link: the first above it that is not fixed, "" for the base.
  std::string mover_of(std::string link) const {
    for (auto at = above_.find(link); at != above_.end(); at = above_.find(link)) {
      if (at->second->value("type") != "fixed") return at->second->value("name");
      link = at->second->child("parent")->value("link");
    }
    return {};
  }

  void carried(const std::string& place, const std::string& what, const std::string& link) {
    const std::string found = mover_of(link);
    if (found == description_.arm.back()) return;
    wrong("E_TREE", place,
          what + " is carried by " + (found.empty() ? "the base" : "joint '" + found + "'") +
              "; expected the arm's last joint, '" + description_.arm.back() + "'");
  }

  void other_joint(const XmlElement& joint) {
    const std::string name = joint.value("name");
    const auto& arm = description_.arm;
    const auto& fingers = description_.fingers;
    if (joint.value("type") == "fixed" || std::count(arm.begin(), arm.end(), name) ||
        std::count(fingers.begin(), fingers.end(), name)) {
      return;
    }
    findings_.fault(
        "E_UNSUPPORTED", joint, owner_of(joint),
        "moves, but is neither an arm joint nor a finger of the robot file; make it fixed");
  }

  const RobotDescription& description_;
  UrdfFindings& findings_;
  std::vector<std::string> links_;
  std::map<std::string, const XmlElement*> joints_;
  std::vector<const XmlElement*> order_;
  std::map<std::string, const XmlElement*> above_;  ///< the joint whose child a link is
};

}  // namespace

void check_description(const XmlElement& robot, const RobotDescription& description,
                       UrdfFindings& findings) {
  const bool sound = findings.faults.empty();
  DescriptionWalk walk(robot, description, findings);
  walk.numbers();
  walk.names();
  if (sound && findings.faults.empty()) walk.structure();
}

}  // namespace handey::kinematics
