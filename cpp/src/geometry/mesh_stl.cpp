// STL, binary and text. The facet normals in the file are not used: the order of the corners
// decides.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "handey/stop.hpp"
#include "mesh_formats.hpp"

namespace handey {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kPreamble = 84;  // header and count
constexpr std::size_t kRecord = 50;    // normal, three corners, attribute

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = (value << 8) | static_cast<unsigned char>(bytes[i]);
  return value;
}

double little_endian_float(const char* bytes) {
  const std::uint32_t bits = little_endian(bytes);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

bool is_keyword(std::string_view word, std::string_view keyword) {
  return word.size() == keyword.size() &&
         std::equal(word.begin(), word.end(), keyword.begin(), [](char a, char b) {
           return std::tolower(static_cast<unsigned char>(a)) == b;
         });
}

// Textual STL as a strict sequence of words.
class TextStl {
 public:
  explicit TextStl(const MeshSource& source) : source_(source), scanner_(source) {}

  TriangleMesh read() {
    expect("solid");
    scanner_.skip_line();  // the name
    for (;;) {
      const std::string_view word = scanner_.next_word();
      if (is_keyword(word, "facet")) {
        read_facet();
      } else if (is_keyword(word, "endsolid")) {
        scanner_.skip_line();
        const std::string_view after = scanner_.next_word();
        if (after.empty()) return std::move(mesh_);
        if (!is_keyword(after, "solid")) {
          throw_mesh_fault(source_, "E_MESH_FORMAT", scanner_.line(),
                           "found more text after 'endsolid', expected the end or another 'solid'");
        }
        scanner_.skip_line();
      } else {
        fail(word, "'facet' or 'endsolid'");
      }
    }
  }

 private:
  void read_facet() {
    require_few_triangles(source_, mesh_.triangles.size() + 1);
    expect("normal");
    for (int k = 0; k < 3; ++k) {
      if (scanner_.next_word().empty()) fail("", "a normal of three numbers");
    }
    expect("outer");
    expect("loop");
    const int first = static_cast<int>(mesh_.vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) {
        const std::string_view word = scanner_.next_word();
        if (word.empty()) fail(word, "a coordinate");
        point[k] = coordinate(word);
      }
      mesh_.vertices.push_back(point);
    }
    expect("endloop");
    expect("endfacet");
    mesh_.triangles.emplace_back(first, first + 1, first + 2);
  }

  double coordinate(std::string_view word) const { return scanner_.number(word); }

  void expect(const char* keyword) {
    const std::string_view word = scanner_.next_word();
    if (!is_keyword(word, keyword)) fail(word, "'" + std::string(keyword) + "'");
  }

  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    if (scanner_.at_end()) {  // a word may be cut in two
      throw_mesh_fault(source_, "E_MESH_TRUNCATED", scanner_.line(),
                       "the file ends, expected " + expected);
    }
    throw_mesh_fault(source_, "E_MESH_FORMAT", scanner_.line(),
                     "found '" + std::string(found.substr(0, 40)) + "', expected " + expected);
  }

  const MeshSource& source_;
  TextScanner scanner_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_binary_stl(const MeshSource& source) {
  const std::size_t size = source.bytes.size();
  if (size < kPreamble) {
    throw_mesh_fault(
        source, "E_MESH_TRUNCATED", 0,
        "found " + std::to_string(size) + " bytes, expected at least 84 of a binary STL");
  }
  const std::uint64_t count = little_endian(source.bytes.data() + kHeader);
  const std::uint64_t expected = kPreamble + count * kRecord;
  if (expected > size) {
    throw_mesh_fault(source, "E_MESH_TRUNCATED", 0,
                     "found " + std::to_string(size) + " bytes, expected " +
                         std::to_string(expected) + " of a binary STL of " + std::to_string(count) +
                         " triangles");
  }
  if (expected < size) {
    throw_mesh_fault(source, "E_MESH_FORMAT", 0,
                     "found " + std::to_string(size - expected) + " bytes after the last of " +
                         std::to_string(count) + " triangles, expected none");
  }
  require_few_triangles(source, count);
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::uint64_t t = 0; t < count; ++t) {
    throw_if_stopped();
    const char* record = source.bytes.data() + kPreamble + t * kRecord + 12;
    const int first = static_cast<int>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) point[k] = little_endian_float(record + 12 * corner + 4 * k);
      if (!point.allFinite()) {
        throw_mesh_fault(source, "E_NUMBER", 0,
                         "triangle " + std::to_string(t) + " has a vertex that is not finite");
      }
      mesh.vertices.push_back(point);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

TriangleMesh read_text_stl(const MeshSource& source) { return TextStl(source).read(); }

}  // namespace handey
