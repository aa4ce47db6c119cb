#include "handey/errors.hpp"

#include <utility>

namespace handey {
namespace {

std::string join(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    if (!fault.place.empty()) text += fault.place + ": ";
    text += fault.message;
  }
  return text;
}

}  // namespace

InvalidInput::InvalidInput(std::string code, std::string place, std::string message)
    : InvalidInput(std::vector<Fault>{{std::move(code), std::move(place), std::move(message)}}) {}

InvalidInput::InvalidInput(std::vector<Fault> faults)
    : std::invalid_argument(join(faults)), faults_(std::move(faults)) {}

}  // namespace handey
