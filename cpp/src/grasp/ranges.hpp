// Checks of numbers at the public functions of this floor.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "handey/errors.hpp"

namespace handey::grasp {

/// @throws InvalidInput (E_NUMBER, E_RANGE) unless least <= value <= most
inline void require_in_range(double value, double least, double most, const std::string& place) {
  if (!std::isfinite(value)) {
    throw InvalidInput("E_NUMBER", place, "is not finite, expected a number");
  }
  if (value < least || value > most) {
    std::ostringstream text;
    text << "is " << value << ", expected " << least << " to " << most;
    throw InvalidInput("E_RANGE", place, text.str());
  }
}

/// "12.3"
inline std::string one_decimal(double value) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(1);
  text << value;
  return text.str();
}

/// "12.3" for 0.0123 m.
inline std::string millimetres(double metres) { return one_decimal(metres * 1e3); }

}  // namespace handey::grasp
