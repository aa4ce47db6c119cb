// PLY, text and binary of both byte orders. Vertices need x, y, z; faces a list named
// vertex_indices or vertex_index; everything else is read over. Counts are checked against the
// bytes left before they are believed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "mesh_formats.hpp"

namespace handey {
namespace {

constexpr long long kMostCorners = 1000;  // of one face; ears are cut in quadratic time

enum class Encoding { Text, LittleEndian, BigEndian };

struct ScalarType {
  std::size_t size = 0;
  char kind = 'i';  // 'i' signed, 'u' unsigned, 'f' floating
};

std::optional<ScalarType> scalar_type(std::string_view name) {
  struct Named {
    std::string_view name;
    ScalarType type;
  };
  static constexpr Named kTypes[] = {
      {"char", {1, 'i'}},  {"int8", {1, 'i'}},    {"uchar", {1, 'u'}},  {"uint8", {1, 'u'}},
      {"short", {2, 'i'}}, {"int16", {2, 'i'}},   {"ushort", {2, 'u'}}, {"uint16", {2, 'u'}},
      {"int", {4, 'i'}},   {"int32", {4, 'i'}},   {"uint", {4, 'u'}},   {"uint32", {4, 'u'}},
      {"float", {4, 'f'}}, {"float32", {4, 'f'}}, {"double", {8, 'f'}}, {"float64", {8, 'f'}}};
  for (const Named& known : kTypes) {
    if (known.name == name) return known.type;
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  ScalarType type;
  std::optional<ScalarType> count;  // of a list
};

struct Element {
  std::string name;
  unsigned long long count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const MeshSource& source) : source_(source) {}

  TriangleMesh read() {
    read_header();
    const MeshSource body{source_.bytes.substr(body_), source_.path, source_.most_triangles};
    TextScanner scanner(body, header_lines_ + 1);
    scanner_ = &scanner;
    for (const Element& element : elements_) read_element(element);
    require_nothing_left();
    append_faces();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const char* code, const std::string& message) const {
    throw_mesh_fault(source_, code, line_, message);
  }

  void read_header() {
    bool has_format = false;
    for (;;) {
      const std::size_t end = source_.bytes.find('\n', body_);
      if (end == std::string_view::npos)
        fail("E_MESH_TRUNCATED", "the PLY header ends before 'end_header'");
      const MeshSource one{source_.bytes.substr(body_, end - body_), source_.path, 0};
      body_ = end + 1;
      ++line_;
      TextScanner scanner(one, line_);
      std::vector<std::string> words;
      for (std::string_view word = scanner.next_word(); !word.empty(); word = scanner.next_word()) {
        words.emplace_back(word);
      }
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "ply" && line_ == 1) continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        read_format(words);
        has_format = true;
      } else if (words[0] == "element" && words.size() == 3) {
        const long long count = scanner.integer(words[2], "E_MESH_FORMAT");
        if (count < 0)
          fail("E_MESH_FORMAT", "found a count of " + words[2] + ", expected at least 0");
        elements_.push_back({words[1], static_cast<unsigned long long>(count), {}});
      } else if (words[0] == "property" && !elements_.empty()) {
        read_property(words);
      } else {
        fail("E_MESH_FORMAT",
             "found '" + words[0].substr(0, 40) + "', expected a line of a PLY header");
      }
    }
    if (!has_format) fail("E_MESH_FORMAT", "found no 'format' line, expected one");
    header_lines_ = line_;
    line_ = 0;
  }

  void read_format(const std::vector<std::string>& words) {
    const std::string name = words.size() > 1 ? words[1] : "";
    if (name == "ascii") {
      encoding_ = Encoding::Text;
    } else if (name == "binary_little_endian") {
      encoding_ = Encoding::LittleEndian;
    } else if (name == "binary_big_endian") {
      encoding_ = Encoding::BigEndian;
    } else {
      fail("E_UNSUPPORTED", "found format '" + name +
                                "', expected ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_property(const std::vector<std::string>& words) {
    Property property;
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
      fail("E_MESH_FORMAT", "found a property line of wrong length");
    if (is_list) {
      property.count = scalar_type(words[2]);
      if (!property.count || property.count->kind == 'f') {
        fail("E_MESH_FORMAT",
             "found a list length of type '" + words[2] + "', expected an integer type");
      }
    }
    const std::optional<ScalarType> type = scalar_type(words[words.size() - 2]);
    if (!type) fail("E_MESH_FORMAT", "found unknown type '" + words[words.size() - 2] + "'");
    property.type = *type;
    property.name = words.back();
    elements_.back().properties.push_back(std::move(property));
  }

  // A number needs its bytes, or in text at least one digit and a blank (but the last).
  std::size_t least_size(const ScalarType& type) const {
    return encoding_ == Encoding::Text ? 1 : type.size;
  }

  std::size_t bytes_left() const { return source_.bytes.size() - body_; }

  void read_element(const Element& element) {
    std::size_t least = 0;
    for (const Property& property : element.properties) {
      least += least_size(property.count ? *property.count : property.type);
    }
    if (least == 0) return;  // nothing to read, however many
    if (element.count > bytes_left() / least) {
      fail("E_MESH_TRUNCATED", "found " + std::to_string(bytes_left()) +
                                   " bytes, expected at least " + std::to_string(element.count) +
                                   " times " + std::to_string(least) + " for element '" +
                                   element.name + "'");
    }
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    require_properties(element, is_vertex, is_face);
    if (element.name == "tristrips") fail("E_UNSUPPORTED", "found triangle strips, expected faces");
    if (is_face) require_few_triangles(source_, element.count);
    for (unsigned long long i = 0; i < element.count; ++i) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      for (const Property& property : element.properties)
        read_property_value(property, is_face, i, point);
      if (!is_vertex) continue;
      if (!point.allFinite()) fail("E_NUMBER", "vertex " + std::to_string(i) + " is not finite");
      mesh_.vertices.push_back(point);
    }
  }

  void require_properties(const Element& element, bool is_vertex, bool is_face) const {
    const auto has = [&element](std::string_view name, bool list) {
      return std::any_of(element.properties.begin(), element.properties.end(),
                         [&](const Property& property) {
                           return property.name == name && property.count.has_value() == list;
                         });
    };
    if (is_vertex && !(has("x", false) && has("y", false) && has("z", false))) {
      fail("E_MESH_FORMAT", "found vertices without x, y, z, expected all three");
    }
    if (is_face && !has("vertex_indices", true) && !has("vertex_index", true)) {
      fail("E_MESH_FORMAT", "found faces without a list 'vertex_indices', expected one");
    }
  }

  void read_property_value(const Property& property, bool is_face, unsigned long long index,
                           Eigen::Vector3d& point) {
    if (!property.count) {
      const double value = scalar(property.type);
      if (property.name == "x") point.x() = value;
      if (property.name == "y") point.y() = value;
      if (property.name == "z") point.z() = value;
      return;
    }
    const double length = scalar(*property.count);
    if (!(length >= 0.0) || length > static_cast<double>(bytes_left()) ||
        length * static_cast<double>(least_size(property.type)) >
            static_cast<double>(bytes_left() + 1)) {
      fail("E_MESH_TRUNCATED", "a list of " + std::to_string(static_cast<long long>(length)) +
                                   " entries is longer than what is left of the file");
    }
    const bool corners =
        is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
    if (corners && (length < 3.0 || length > static_cast<double>(kMostCorners))) {
      fail(length < 3.0 ? "E_MESH_FORMAT" : "E_TOO_BIG",
           "face " + std::to_string(index) + " has " +
               std::to_string(static_cast<long long>(length)) + " corners, expected 3 to " +
               std::to_string(kMostCorners));
    }
    std::vector<double> entries;
    for (long long i = 0; i < static_cast<long long>(length); ++i) {
      const double entry = scalar(property.type);
      if (corners) entries.push_back(entry);
    }
    if (!corners) return;
    triangles_ += entries.size() - 2;
    require_few_triangles(source_, triangles_);
    faces_.push_back(std::move(entries));
  }

  double scalar(const ScalarType& type) {
    if (encoding_ == Encoding::Text) {
      const std::string_view word = scanner_->next_word();
      if (word.empty()) fail("E_MESH_TRUNCATED", "the file ends, expected another number");
      const double value = scanner_->number(word);
      if (type.kind != 'f' && value != std::floor(value)) {
        fail("E_NUMBER", "found '" + std::string(word.substr(0, 40)) + "', expected an integer");
      }
      return value;
    }
    if (bytes_left() < type.size)
      fail("E_MESH_TRUNCATED", "the file ends, expected another number");
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = encoding_ == Encoding::BigEndian ? i : type.size - 1 - i;
      bits = (bits << 8) | static_cast<unsigned char>(source_.bytes[body_ + at]);
    }
    body_ += type.size;
    return decoded(bits, type);
  }

  static double decoded(std::uint64_t bits, const ScalarType& type) {
    if (type.kind == 'f' && type.size == 8) {
      double value = 0.0;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
    if (type.kind == 'f') {
      const std::uint32_t half = static_cast<std::uint32_t>(bits);
      float value = 0.0F;
      std::memcpy(&value, &half, sizeof value);
      return static_cast<double>(value);
    }
    const double range = std::ldexp(1.0, static_cast<int>(8 * type.size));
    const double value = static_cast<double>(bits);
    return type.kind == 'i' && value >= 0.5 * range ? value - range : value;
  }

  void require_nothing_left() {
    const bool nothing =
        encoding_ == Encoding::Text ? scanner_->next_word().empty() : body_ == source_.bytes.size();
    if (!nothing)
      fail("E_MESH_FORMAT", "found more data after the last element, expected the end of the file");
  }

  void append_faces() {
    const double count = static_cast<double>(mesh_.vertices.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      std::vector<int> polygon;
      for (const double index : faces_[f]) {
        if (!(index >= 0.0 && index < count)) {
          fail("E_INDEX",
               "face " + std::to_string(f) + " names vertex " +
                   std::to_string(static_cast<long long>(std::clamp(index, -1e18, 1e18))) +
                   ", expected 0 to " + std::to_string(static_cast<long long>(count) - 1));
        }
        polygon.push_back(static_cast<int>(index));
      }
      append_triangulated(polygon, mesh_);
    }
  }

  const MeshSource& source_;
  TextScanner* scanner_ = nullptr;
  Encoding encoding_ = Encoding::Text;
  std::vector<Element> elements_;
  std::size_t body_ = 0;  // the first byte not yet read
  std::size_t line_ = 0;  // of the header; 0 behind it
  std::size_t header_lines_ = 0;
  TriangleMesh mesh_;
  std::vector<std::vector<double>> faces_;
  std::size_t triangles_ = 0;
};

}  // namespace

TriangleMesh read_ply(const MeshSource& source) { return PlyReader(source).read(); }

}  // namespace handey
