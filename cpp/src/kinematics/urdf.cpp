// From URDF and robot file to a Robot, in three passes: the strict walk (urdf_checks), the parser
// of ROS (urdfdom), whose result must have as many links, joints and collision shapes as the walk
// has seen, and the building of bodies, links joined by fixed joints being one.
#include "handey/kinematics/urdf.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>

#include "mesh_reference.hpp"
#include "numbers.hpp"
#include "robot_builder.hpp"
#include "urdf_checks.hpp"
#include "urdf_xml.hpp"

namespace handey {
namespace kinematics {
namespace {

/// Keeps what the parser logs, which is its only way to say what it dislikes.
class Capture : public console_bridge::OutputHandler {
 public:
  Capture() { console_bridge::useOutputHandler(this); }
  ~Capture() override { console_bridge::restorePreviousOutputHandler(); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR)
      text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

urdf::ModelInterfaceSharedPtr parse(const std::string& text, const std::string& file) {
  static std::mutex one_at_a_time;  // the log handler is global
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  const Capture capture;
  urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) throw InvalidInput("E_URDF", file, "cannot be parsed: " + capture.text());
  return model;
}

/// The parser drops what it cannot read and still succeeds; nothing may be lost.
void require_nothing_lost(const urdf::ModelInterface& model, const XmlElement& robot,
                          UrdfFindings& findings) {
  const std::size_t links = robot.all("link").size(), joints = robot.all("joint").size();
  if (model.links_.size() != links || model.joints_.size() != joints) {
    findings.fault("E_URDF", robot, "",
                   "the parser kept " + std::to_string(model.links_.size()) + " of " +
                       std::to_string(links) + " links and " +
                       std::to_string(model.joints_.size()) + " of " + std::to_string(joints) +
                       " joints");
  }
  for (const XmlElement* link : robot.all("link")) {
    const auto found = model.links_.find(link->value("name"));
    const std::size_t expected = link->all("collision").size();
    const std::size_t kept =
        found == model.links_.end() ? 0 : found->second->collision_array.size();
    if (kept == expected) continue;
    findings.fault("E_URDF", *link, owner_of(*link),
                   "the parser kept " + std::to_string(kept) + " of " + std::to_string(expected) +
                       " collision shapes");
  }
  findings.throw_if_any();
}

void check_mesh_references(const XmlElement& robot, const MeshReferences& references,
                           UrdfFindings& findings) {
  for (const XmlElement* link : robot.all("link")) {
    for (const XmlElement* collision : link->all("collision")) {
      const XmlElement* geometry = collision->child("geometry");
      const XmlElement* mesh = geometry ? geometry->child("mesh") : nullptr;
      if (!mesh || mesh->value("filename").empty()) continue;
      try {
        references.resolve(mesh->value("filename"));
      } catch (const InvalidInput& error) {
        for (const Fault& fault : error.faults()) {
          findings.fault(fault.code.c_str(), *mesh, owner_of(*link), fault.message);
        }
      }
    }
  }
}

}  // namespace
}  // namespace kinematics

LoadedRobot load_robot(const std::string& urdf_path, const RobotDescription& description) {
  using namespace kinematics;
  const XmlDocument document = read_xml(urdf_path);
  const XmlElement& root = *document.root;
  UrdfFindings findings;
  findings.file = std::filesystem::path(urdf_path).filename().string();
  check_schema(root, findings);
  if (root.name == "robot") check_values(root, findings);
  const bool walkable =
      root.name == "robot" &&
      std::none_of(findings.faults.begin(), findings.faults.end(), [](const Fault& fault) {
        return fault.code == "E_TOO_BIG" || fault.code == "E_EMPTY";
      });
  if (!walkable) findings.throw_if_any();
  check_tree(root, findings);
  const MeshReferences references(urdf_path, description.packages);
  check_mesh_references(root, references, findings);
  check_description(root, description, findings);
  findings.throw_if_any();

  const urdf::ModelInterfaceSharedPtr model = parse(document.text, findings.file);
  require_nothing_lost(*model, root, findings);
  return build_robot(*model, root, description, references, findings);
}

}  // namespace handey
