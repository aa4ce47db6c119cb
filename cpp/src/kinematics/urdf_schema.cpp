// Which tags and attributes a URDF may have, and where. A misspelt tag would otherwise be dropped
// in silence, and with it a limit or a collision shape. What other programs keep in a URDF
// (transmissions, simulators) is let by.
#include <algorithm>
#include <map>
#include <set>

#include "numbers.hpp"
#include "urdf_checks.hpp"

namespace handey::kinematics {
namespace {

struct TagRule {
  std::set<std::string> attributes;
  std::set<std::string> once;  ///< children that may stand at most once
  std::set<std::string> many;  ///< children that may repeat
};

/// By "parent/tag"; "origin", "geometry" and the like have the same rule wherever they stand.
const std::map<std::string, TagRule>& rules() {
  static const std::map<std::string, TagRule> table = {
      {"robot", {{"name", "version"}, {}, {"link", "joint", "material"}}},
      {"link", {{"name", "type"}, {"inertial"}, {"visual", "collision"}}},
      {"inertial", {{}, {"origin", "mass", "inertia"}, {}}},
      {"mass", {{"value"}, {}, {}}},
      {"inertia", {{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}, {}}},
      {"visual", {{"name"}, {"origin", "geometry", "material"}, {}}},
      {"collision", {{"name"}, {"origin", "geometry", "material", "verbose"}, {}}},
      {"verbose", {{"value"}, {}, {}}},
      {"origin", {{"xyz", "rpy"}, {}, {}}},
      {"geometry", {{}, {}, {"box", "cylinder", "sphere", "mesh", "capsule"}}},
      {"box", {{"size"}, {}, {}}},
      {"cylinder", {{"radius", "length"}, {}, {}}},
      {"capsule", {{"radius", "length"}, {}, {}}},
      {"sphere", {{"radius"}, {}, {}}},
      {"mesh", {{"filename", "scale"}, {}, {}}},
      {"material", {{"name"}, {"color", "texture"}, {}}},
      {"color", {{"rgba"}, {}, {}}},
      {"texture", {{"filename"}, {}, {}}},
      {"joint",
       {{"name", "type"},
        {"origin", "parent", "child", "axis", "limit", "calibration", "dynamics", "mimic",
         "safety_controller"},
        {}}},
      {"parent", {{"link"}, {}, {}}},
      {"child", {{"link"}, {}, {}}},
      {"axis", {{"xyz"}, {}, {}}},
      {"limit", {{"lower", "upper", "velocity", "effort"}, {}, {}}},
      {"calibration", {{"reference_position", "rising", "falling"}, {}, {}}},
      {"dynamics", {{"damping", "friction"}, {}, {}}},
      {"mimic", {{"joint", "multiplier", "offset"}, {}, {}}},
      {"safety_controller",
       {{"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}, {}, {}}},
  };
  return table;
}

/// Elements of other programs, whose inside is not ours to judge.
bool is_foreign(const std::string& parent, const std::string& tag) {
  if (tag.find(':') != std::string::npos) return true;
  if (parent == "robot") {
    return tag == "transmission" || tag == "gazebo" || tag == "sensor" || tag == "ros2_control" ||
           tag == "mujoco";
  }
  return parent == "link" && tag == "contact";
}

std::vector<std::string> names(const std::set<std::string>& a,
                               const std::set<std::string>& b = {}) {
  std::vector<std::string> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

bool is_xacro(const std::string& text) {
  return text.find("${") != std::string::npos || text.find("$(") != std::string::npos;
}

class SchemaWalk {
 public:
  explicit SchemaWalk(UrdfFindings& findings) : findings_(findings) {}

  void visit(const XmlElement& element, const std::string& owner) {
    const TagRule& rule = rules().at(element.name);
    if (element.has_text) {
      findings_.fault("E_XML", element, owner, "stray text inside <" + element.name + ">");
    }
    visit_attributes(element, rule, owner);
    std::set<std::string> seen;
    for (const auto& child : element.children) visit_child(element, *child, rule, owner, seen);
  }

 private:
  void visit_attributes(const XmlElement& element, const TagRule& rule, const std::string& owner) {
    for (const auto& [key, value] : element.attributes) {
      if (is_xacro(value)) {
        findings_.fault("E_XACRO", element, owner,
                        key + "=\"" + value + "\" is left over from xacro; expand the file first");
      }
      if (key.find(':') != std::string::npos || key.rfind("xmlns", 0) == 0) continue;
      if (rule.attributes.count(key)) continue;
      findings_.fault("E_UNKNOWN_ATTR", element, owner,
                      "<" + element.name + "> has the unknown attribute '" + key + "'; known are " +
                          quoted_list(names(rule.attributes)));
    }
  }

  void visit_child(const XmlElement& parent, const XmlElement& child, const TagRule& rule,
                   const std::string& owner, std::set<std::string>& seen) {
    if (child.name.rfind("xacro:", 0) == 0) {
      findings_.fault("E_XACRO", child, owner,
                      "<" + child.name + "> is left over from xacro; expand the file first");
      return;
    }
    if (is_foreign(parent.name, child.name)) return;
    if (!rule.once.count(child.name) && !rule.many.count(child.name)) {
      findings_.fault("E_UNKNOWN_TAG", child, owner,
                      "<" + child.name + "> is unknown inside <" + parent.name + ">; known are " +
                          quoted_list(names(rule.once, rule.many)));
      return;
    }
    if (rule.once.count(child.name) && !seen.insert(child.name).second) {
      findings_.fault("E_DUP", child, owner,
                      "a second <" + child.name + "> inside <" + parent.name + ">");
    }
    visit(child, parent.name == "robot" ? owner_of(child) : owner);
  }

  UrdfFindings& findings_;
};

}  // namespace

void check_schema(const XmlElement& robot, UrdfFindings& findings) {
  if (robot.name != "robot") {
    findings.fault("E_ROOT", robot, "",
                   "the root element is <" + robot.name + ">; expected <robot>");
    return;
  }
  SchemaWalk(findings).visit(robot, "");
}

}  // namespace handey::kinematics
