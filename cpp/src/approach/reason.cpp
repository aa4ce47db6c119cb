// Words for reasons. Numbers with a point whatever the locale.
#include "reason.hpp"

#include <iomanip>
#include <locale>
#include <sstream>

namespace handey {

std::string millimetres(double metres) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << 1e3 * metres << " mm";
  return text.str();
}

std::string describe(const Hit& hit) { return hit.a + " meets " + hit.b; }

}  // namespace handey
