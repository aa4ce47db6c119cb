// Numbers in text, the same under every locale.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace handey::kinematics {

/// Shortest text with at most `digits` significant digits.
std::string number_text(double value, int digits = 9);

/// All whitespace-separated finite numbers of `text`, or empty with `wrong` set to the first word
/// that is none.
std::vector<double> read_numbers(std::string_view text, std::string& wrong);

/// 'a', 'b', 'c' for messages that name what is legal.
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace handey::kinematics
