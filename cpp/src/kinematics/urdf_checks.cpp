#include "urdf_checks.hpp"

#include "numbers.hpp"

namespace handey::kinematics {

namespace {
constexpr std::size_t kMostFaults = 100;  // Choice: more than anyone reads
}

std::string UrdfFindings::place(const XmlElement& element, const std::string& owner) const {
  const std::string line = file + ":" + std::to_string(element.line);
  return owner.empty() ? line : line + ": " + owner;
}

void UrdfFindings::fault(const char* code, const XmlElement& element, const std::string& owner,
                         std::string message) {
  faults.push_back({code, place(element, owner), std::move(message)});
  if (faults.size() < kMostFaults) return;
  faults.push_back(
      {"E_TOO_BIG", file,
       "may have more faults; no more than " + std::to_string(kMostFaults) + " are told"});
  throw_if_any();
}

void UrdfFindings::warn(const XmlElement& element, const std::string& owner,
                        const std::string& message) {
  warnings.push_back(place(element, owner) + ": " + message);
}

void UrdfFindings::throw_if_any() const {
  if (!faults.empty()) throw InvalidInput(faults);
}

std::string owner_of(const XmlElement& element) {
  return element.name + " '" + element.value("name") + "'";
}

}  // namespace handey::kinematics
