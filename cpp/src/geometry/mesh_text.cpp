// Words and numbers of textual mesh files. Numbers by std::from_chars, which no locale changes.
#include <charconv>
#include <cmath>

#include "handey/errors.hpp"
#include "mesh_formats.hpp"

namespace handey {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string quoted(std::string_view word) {
  std::string text = "'";
  for (const char c : word.substr(0, 40)) text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > 40 ? "...'" : "'");
}

}  // namespace

void throw_mesh_fault(const MeshSource& source, const char* code, std::size_t line,
                      const std::string& message) {
  throw InvalidInput(code, line > 0 ? source.path + ":" + std::to_string(line) : source.path,
                     message);
}

void require_few_triangles(const MeshSource& source, unsigned long long count) {
  if (count <= source.most_triangles) return;
  throw_mesh_fault(source, "E_TOO_BIG", 0,
                   "found " + std::to_string(count) + " triangles or more, expected at most " +
                       std::to_string(source.most_triangles));
}

bool TextScanner::next_line(std::vector<std::string_view>& words) {
  words.clear();
  while (at_ < source_.bytes.size()) {
    line_ = next_line_++;
    std::size_t end = source_.bytes.find('\n', at_);
    if (end == std::string_view::npos) end = source_.bytes.size();
    std::string_view text = source_.bytes.substr(at_, end - at_);
    at_ = end + 1;
    text = text.substr(0, text.find('#'));
    for (std::size_t i = 0; i < text.size();) {
      while (i < text.size() && is_blank(text[i])) ++i;
      const std::size_t start = i;
      while (i < text.size() && !is_blank(text[i])) ++i;
      if (i > start) words.push_back(text.substr(start, i - start));
    }
    if (!words.empty()) return true;
  }
  return false;
}

std::string_view TextScanner::next_word() {
  const std::string_view bytes = source_.bytes;
  while (at_ < bytes.size() && (is_blank(bytes[at_]) || bytes[at_] == '\n')) {
    if (bytes[at_++] == '\n') ++next_line_;
  }
  line_ = next_line_;
  const std::size_t start = at_;
  while (at_ < bytes.size() && !is_blank(bytes[at_]) && bytes[at_] != '\n') ++at_;
  return bytes.substr(start, at_ - start);
}

void TextScanner::skip_line() {
  const std::size_t end = source_.bytes.find('\n', at_);
  at_ = end == std::string_view::npos ? source_.bytes.size() : end;
}

double TextScanner::number(std::string_view word) const {
  const std::string_view digits = !word.empty() && word.front() == '+' ? word.substr(1) : word;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  const bool underflow =
      error == std::errc::result_out_of_range &&
      (digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos);
  if (whole && underflow) return 0.0;
  if (whole && error == std::errc() && std::isfinite(value)) return value;
  std::string message = "found " + quoted(word) + ", expected a finite number";
  if (word.find(',') != std::string_view::npos) message += " with a decimal point, not a comma";
  throw_mesh_fault(source_, "E_NUMBER", line_, message);
}

long long TextScanner::integer(std::string_view word, const char* code) const {
  const std::string_view digits = !word.empty() && word.front() == '+' ? word.substr(1) : word;
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size() && !digits.empty()) return value;
  throw_mesh_fault(source_, code, line_, "found " + quoted(word) + ", expected an integer");
}

}  // namespace handey
