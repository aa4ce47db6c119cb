// What is wrong with an input, and where. Every public function that takes numbers, names or files
// checks them once and throws InvalidInput, which holds all faults that were found, not only the
// first. A planner that finds nothing is not an error: it returns a status with its reason.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace handey {

/// One fault of an input.
struct Fault {
  std::string code;   ///< kind of fault, for programs: "E_NUMBER", "E_LIMIT", ... (docs list them)
  std::string place;  ///< where: "puma560.urdf:12: joint 'joint2'", "parts.bracket.pose.xyz"
  std::string message;  ///< what was found and what was expected
};

/// Thrown for wrong numbers, names, shapes of arrays and files.
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string code, std::string place, std::string message);
  explicit InvalidInput(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace handey
