// std::to_chars and std::from_chars only: printf and strtod read and write a decimal comma under
// some locales.
#include "numbers.hpp"

#include <charconv>
#include <cmath>

namespace handey::kinematics {

std::string number_text(double value, int digits) {
  char text[64];
  const std::to_chars_result result =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return {text, result.ptr};
}

std::vector<double> read_numbers(std::string_view text, std::string& wrong) {
  std::vector<double> numbers;
  const std::string_view blanks = " \t\r\n";
  std::size_t at = text.find_first_not_of(blanks);
  while (at != std::string_view::npos) {
    const std::size_t stop = std::min(text.find_first_of(blanks, at), text.size());
    const std::string_view word = text.substr(at, stop - at);
    const std::size_t sign = word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0;
    double value = 0.0;
    const char* end = word.data() + word.size();
    const std::from_chars_result result = std::from_chars(word.data() + sign, end, value);
    if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value)) {
      wrong = std::string(word);
      return {};
    }
    numbers.push_back(value);
    at = text.find_first_not_of(blanks, stop);
  }
  return numbers;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text.empty() ? "(none)" : text;
}

}  // namespace handey::kinematics
