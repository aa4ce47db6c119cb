// The links and joints of a URDF as one tree: every name that is referred to exists, no link has
// two parents, one link has none, and all others hang from it.
#include <map>
#include <set>

#include "numbers.hpp"
#include "urdf_checks.hpp"

namespace handey::kinematics {
namespace {

using ByName = std::map<std::string, const XmlElement*>;

ByName by_name(const std::vector<const XmlElement*>& elements) {
  ByName table;
  for (const XmlElement* element : elements) table.emplace(element->value("name"), element);
  return table;
}

std::vector<std::string> names(const ByName& table) {
  std::vector<std::string> list;
  for (const auto& [name, element] : table) list.push_back(name);
  return list;
}

/// The link a joint's <parent> or <child> names; "" with a fault if there is none.
std::string linked(const XmlElement& joint, const char* end, const ByName& links,
                   UrdfFindings& findings) {
  const XmlElement* reference = joint.child(end);
  if (!reference || !reference->attribute("link")) {
    findings.fault("E_REF", joint, owner_of(joint), std::string("names no <") + end + "> link");
    return {};
  }
  std::string name = reference->value("link");
  if (links.count(name)) return name;
  findings.fault("E_REF", *reference, owner_of(joint),
                 std::string("the ") + end + " '" + name + "' is no link; links are " +
                     quoted_list(names(links)));
  return {};
}

void check_mimics(const ByName& joints, UrdfFindings& findings) {
  for (const auto& [name, joint] : joints) {
    const XmlElement* mimic = joint->child("mimic");
    if (!mimic) continue;
    if (!joints.count(mimic->value("joint"))) {
      findings.fault("E_REF", *mimic, owner_of(*joint),
                     "mimics '" + mimic->value("joint") + "', which is no joint; joints are " +
                         quoted_list(names(joints)));
      continue;
    }
    std::string leader = mimic->value("joint");
    for (std::size_t steps = 0; steps <= joints.size(); ++steps) {
      if (leader == name) {
        findings.fault("E_MIMIC", *mimic, owner_of(*joint), "mimics itself, in a ring");
        break;
      }
      const auto at = joints.find(leader);
      const XmlElement* next = at == joints.end() ? nullptr : at->second->child("mimic");
      if (!next) break;
      leader = next->value("joint");
    }
  }
}

/// Links without a parent, in file order.
std::vector<const XmlElement*> roots(const std::vector<const XmlElement*>& links,
                                     const std::map<std::string, std::string>& parent_of) {
  std::vector<const XmlElement*> found;
  for (const XmlElement* link : links) {
    if (!parent_of.count(link->value("name"))) found.push_back(link);
  }
  return found;
}

void check_connected(const XmlElement& robot, const std::map<std::string, std::string>& parent_of,
                     UrdfFindings& findings) {
  const std::vector<const XmlElement*> links = robot.all("link");
  const std::vector<const XmlElement*> tops = roots(links, parent_of);
  if (tops.size() > 1) {
    std::vector<std::string> list;
    for (const XmlElement* top : tops) list.push_back(top->value("name"));
    findings.fault(
        "E_TREE", *tops[1], owner_of(*tops[1]),
        "is a second root; expected one link without a parent, found " + quoted_list(list));
  }
  std::set<std::string> reported;
  for (const XmlElement* link : links) {
    std::set<std::string> seen;
    std::string at = link->value("name");
    while (parent_of.count(at) && seen.insert(at).second) at = parent_of.at(at);
    if (!parent_of.count(at)) continue;  // came to a root
    // A ring: report it once, at the first of its links in the file.
    bool fresh = true;
    for (const std::string& name : seen) fresh = fresh && !reported.count(name);
    if (fresh) {
      findings.fault("E_TREE", *link, owner_of(*link),
                     "is its own ancestor: the joints form a ring with '" + at + "'");
    }
    reported.insert(seen.begin(), seen.end());
  }
}

}  // namespace

void check_tree(const XmlElement& robot, UrdfFindings& findings) {
  const ByName links = by_name(robot.all("link")), joints = by_name(robot.all("joint"));
  std::map<std::string, std::string> parent_of;
  bool complete = true;
  for (const XmlElement* joint : robot.all("joint")) {
    const std::string parent = linked(*joint, "parent", links, findings);
    const std::string child = linked(*joint, "child", links, findings);
    if (parent.empty() || child.empty()) {
      complete = false;
    } else if (parent == child) {
      findings.fault("E_TREE", *joint, owner_of(*joint), "joins '" + parent + "' to itself");
      complete = false;
    } else if (!parent_of.emplace(child, parent).second) {
      findings.fault("E_TREE", *joint, owner_of(*joint),
                     "'" + child + "' has a parent already, '" + parent_of[child] + "'");
    }
  }
  check_mimics(joints, findings);
  if (complete) check_connected(robot, parent_of, findings);
}

}  // namespace handey::kinematics
