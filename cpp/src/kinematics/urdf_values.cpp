// The numbers of a URDF: finite, as many as there should be, sizes positive, axes not zero, limits
// that leave a motion. The parser behind takes most of these as they come.
#include <cmath>
#include <map>

#include "numbers.hpp"
#include "urdf_checks.hpp"

namespace handey::kinematics {
namespace {

constexpr std::size_t kMostLinks = 1000;  // Choice: a robot with a hand has below 100
constexpr double kMostRadians = 20.0;     // above, the file surely means degrees
constexpr double kUnitTolerance = 1e-6;

class ValueWalk {
 public:
  explicit ValueWalk(UrdfFindings& findings) : findings_(findings) {}

  void robot(const XmlElement& robot) {
    if (robot.value("name").empty()) {
      findings_.fault("E_NAME", robot, "", "<robot> has no name");
    }
    const auto links = robot.all("link"), joints = robot.all("joint");
    if (links.empty()) findings_.fault("E_EMPTY", robot, "", "has no <link>");
    if (links.size() > kMostLinks || joints.size() > kMostLinks) {
      findings_.fault("E_TOO_BIG", robot, "",
                      "has " + std::to_string(links.size()) + " links and " +
                          std::to_string(joints.size()) + " joints; at most 1000 are read");
      return;
    }
    names(links);
    names(joints);
    for (const XmlElement* each : links) link(*each);
    for (const XmlElement* each : joints) joint(*each);
  }

 private:
  void names(const std::vector<const XmlElement*>& elements) {
    std::map<std::string, int> first_line;
    for (const XmlElement* element : elements) {
      const std::string name = element->value("name");
      if (name.empty()) {
        findings_.fault("E_NAME", *element, "", "<" + element->name + "> has no name");
      } else if (const auto [at, fresh] = first_line.emplace(name, element->line); !fresh) {
        findings_.fault("E_DUP", *element, owner_of(*element),
                        "the name is taken already in line " + std::to_string(at->second));
      }
    }
  }

  /// The numbers of an attribute; empty with a fault if they are not `count` finite numbers.
  std::vector<double> numbers(const XmlElement& element, const std::string& key, std::size_t count,
                              const std::string& owner, const char* code) {
    const std::string* text = element.attribute(key);
    const std::string what = "<" + element.name + "> " + key;
    const std::string expected =
        "; expected " +
        (count == 1 ? "a finite number" : std::to_string(count) + " finite numbers");
    if (!text) {
      findings_.fault(code, element, owner, what + " is missing" + expected);
      return {};
    }
    std::string wrong;
    std::vector<double> values = read_numbers(*text, wrong);
    if (wrong.find('$') != std::string::npos) return {};  // left over from xacro: told already
    if (!wrong.empty()) {
      const bool comma = wrong.find(',') != std::string::npos;
      findings_.fault(code, element, owner,
                      what + " has '" + wrong + "'" + expected +
                          (comma ? ", with a decimal point and blanks between" : ""));
      return {};
    }
    if (values.size() != count) {
      findings_.fault(code, element, owner,
                      what + " has " + std::to_string(values.size()) + " numbers" + expected);
      return {};
    }
    return values;
  }
  std::vector<double> optional_numbers(const XmlElement& element, const std::string& key,
                                       std::size_t count, const std::string& owner) {
    if (!element.attribute(key)) return {};
    return numbers(element, key, count, owner, "E_NUMBER");
  }

  void origin(const XmlElement& element, const std::string& owner) {
    const XmlElement* at = element.child("origin");
    if (!at) return;
    optional_numbers(*at, "xyz", 3, owner);
    optional_numbers(*at, "rpy", 3, owner);
  }

  void link(const XmlElement& link) {
    const std::string owner = owner_of(link);
    for (const char* kind : {"visual", "collision"}) {
      for (const XmlElement* element : link.all(kind)) {
        origin(*element, owner);
        geometry(*element, owner);
      }
    }
    if (link.child("visual") && !link.child("collision")) {
      findings_.fault("E_NO_COLLISION", link, owner,
                      "has a <visual> but no <collision>: nothing would keep it from colliding");
    }
    const XmlElement* inertial = link.child("inertial");
    if (!inertial) return;
    origin(*inertial, owner);
    for (const auto& part : inertial->children) {
      if (part->name == "origin") continue;
      for (const auto& [key, value] : part->attributes) optional_numbers(*part, key, 1, owner);
    }
  }

  void geometry(const XmlElement& element, const std::string& owner) {
    const XmlElement* geometry = element.child("geometry");
    if (!geometry || geometry->children.empty()) {
      findings_.fault("E_GEOMETRY", element, owner, "<" + element.name + "> has no geometry");
      return;
    }
    if (geometry->children.size() > 1) {
      findings_.fault("E_GEOMETRY", *geometry, owner,
                      "two shapes in one <geometry>; give each its own <" + element.name + ">");
      return;
    }
    const XmlElement& shape = *geometry->children.front();
    if (shape.name == "box") sizes(shape, "size", 3, owner);
    if (shape.name == "sphere" || shape.name == "cylinder") sizes(shape, "radius", 1, owner);
    if (shape.name == "cylinder") sizes(shape, "length", 1, owner);
    if (shape.name == "capsule") {
      findings_.fault("E_UNSUPPORTED", shape, owner,
                      "<capsule> is not supported; use a cylinder and two spheres");
    }
    if (shape.name == "mesh") mesh(shape, owner);
  }

  void sizes(const XmlElement& shape, const std::string& key, std::size_t count,
             const std::string& owner) {
    for (const double value : numbers(shape, key, count, owner, "E_GEOMETRY")) {
      if (value > 0.0) continue;
      findings_.fault("E_GEOMETRY", shape, owner,
                      "<" + shape.name + "> " + key + " has " + number_text(value) +
                          "; expected numbers above 0");
      return;
    }
  }

  void mesh(const XmlElement& mesh, const std::string& owner) {
    if (mesh.value("filename").empty()) {
      findings_.fault("E_MESH_REF", mesh, owner, "<mesh> has no filename");
    }
    if (!mesh.attribute("scale")) return;
    for (const double value : numbers(mesh, "scale", 3, owner, "E_SCALE")) {
      if (value > 0.0) continue;
      findings_.fault("E_SCALE", mesh, owner,
                      "<mesh> scale has " + number_text(value) + "; expected numbers above 0");
      return;
    }
  }

  void joint(const XmlElement& joint) {
    const std::string owner = owner_of(joint), type = joint.value("type");
    origin(joint, owner);
    if (type == "floating" || type == "planar") {
      findings_.fault(
          "E_UNSUPPORTED", joint, owner,
          "the type '" + type + "' is not supported; move the robot by its cell instead");
      return;
    }
    if (type != "revolute" && type != "continuous" && type != "prismatic" && type != "fixed") {
      findings_.fault("E_JOINT_TYPE", joint, owner,
                      "the type '" + type +
                          "' is unknown; known are 'revolute', 'continuous', "
                          "'prismatic', 'fixed'");
      return;
    }
    if (const XmlElement* mimic = joint.child("mimic")) {
      optional_numbers(*mimic, "multiplier", 1, owner);
      optional_numbers(*mimic, "offset", 1, owner);
    }
    if (type == "fixed") return;
    axis(joint, owner);
    limit(joint, type, owner);
    for (const char* tag : {"dynamics", "calibration"}) {
      if (const XmlElement* part = joint.child(tag)) {
        for (const auto& [key, value] : part->attributes) optional_numbers(*part, key, 1, owner);
      }
    }
  }

  void axis(const XmlElement& joint, const std::string& owner) {
    const XmlElement* axis = joint.child("axis");
    if (!axis) return;
    const std::vector<double> a = numbers(*axis, "xyz", 3, owner, "E_NUMBER");
    if (a.empty()) return;
    const double length = std::hypot(a[0], a[1], a[2]);
    if (!std::isfinite(length) || length < kUnitTolerance) {
      findings_.fault("E_AXIS", *axis, owner, "the axis is zero; expected a direction");
    } else if (std::abs(length - 1.0) > kUnitTolerance) {
      findings_.warn(*axis, owner,
                     "the axis has length " + number_text(length) + "; taken as a unit");
    }
  }

  void limit(const XmlElement& joint, const std::string& type, const std::string& owner) {
    const XmlElement* limit = joint.child("limit");
    if (!limit) {
      findings_.fault("E_LIMIT", joint, owner,
                      "has no <limit>; expected one with " +
                          std::string(type == "continuous" ? "" : "lower, upper, ") +
                          "velocity and effort");
      return;
    }
    for (const char* key : {"velocity", "effort"}) {
      if (!limit->attribute(key)) {
        findings_.fault("E_LIMIT", *limit, owner, std::string("<limit> has no ") + key);
        continue;
      }
      const std::vector<double> value = numbers(*limit, key, 1, owner, "E_NUMBER");
      if (std::string(key) == "velocity" && !value.empty() && !(value[0] > 0.0)) {
        findings_.fault(
            "E_LIMIT", *limit, owner,
            "the velocity limit is " + number_text(value[0]) + "; expected more than 0");
      }
    }
    range(*limit, type, owner);
    if (const XmlElement* safety = joint.child("safety_controller")) safety_range(*safety, owner);
  }

  void range(const XmlElement& limit, const std::string& type, const std::string& owner) {
    const std::vector<double> lower = optional_numbers(limit, "lower", 1, owner);
    const std::vector<double> upper = optional_numbers(limit, "upper", 1, owner);
    if (type == "continuous") return;
    if (!limit.attribute("lower") && !limit.attribute("upper")) {
      findings_.fault("E_LIMIT", limit, owner, "<limit> has neither lower nor upper");
      return;
    }
    if ((limit.attribute("lower") && lower.empty()) ||
        (limit.attribute("upper") && upper.empty())) {
      return;  // not numbers: reported
    }
    const double low = lower.empty() ? 0.0 : lower[0], high = upper.empty() ? 0.0 : upper[0];
    if (!(low < high)) {
      findings_.fault("E_LIMIT", limit, owner,
                      "the limits are " + number_text(low) + " to " + number_text(high) +
                          "; expected lower < upper");
    } else if (type == "revolute" && (high > kMostRadians || low < -kMostRadians)) {
      findings_.fault("E_LIMIT", limit, owner,
                      "the limits are " + number_text(low) + " to " + number_text(high) +
                          " rad; are they in degrees?");
    }
  }

  void safety_range(const XmlElement& safety, const std::string& owner) {
    for (const char* key : {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}) {
      optional_numbers(safety, key, 1, owner);
    }
  }

  UrdfFindings& findings_;
};

}  // namespace

void check_values(const XmlElement& robot, UrdfFindings& findings) {
  ValueWalk(findings).robot(robot);
}

}  // namespace handey::kinematics
