// Words for reasons. Numbers with a point whatever the locale.
#include "reason.hpp"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace handey {

namespace {

std::string with_unit(double value, const char* unit, bool fixed) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (fixed) text << std::fixed;
  text << std::setprecision(fixed ? 1 : 3) << value << ' ' << unit;
  return text.str();
}

}  // namespace

std::string millimetres(double metres) { return with_unit(1e3 * metres, "mm", true); }

std::string degrees(double radians) {
  return with_unit(radians * 180.0 / std::acos(-1.0), "degrees", false);
}

std::string describe(const Hit& hit) { return hit.a + " meets " + hit.b; }

}  // namespace handey
