// Wavefront OBJ: vertices and faces. Texture, normals, groups and materials are passed over; a
// material library is never opened.
#include <array>
#include <string>

#include "mesh_formats.hpp"

namespace handey {
namespace {

constexpr std::array<std::string_view, 21> kIgnored = {
    "vn",       "vt",         "vp",        "o",      "g",      "s",     "l",
    "p",        "mtllib",     "usemtl",    "mg",     "lod",    "bevel", "c_interp",
    "d_interp", "shadow_obj", "trace_obj", "usemap", "maplib", "call",  "csh"};

constexpr std::size_t kMostCorners = 1000;  // of one face; ears are cut in quadratic time

bool is_ignored(std::string_view keyword) {
  for (const std::string_view known : kIgnored) {
    if (keyword == known) return true;
  }
  return false;
}

class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source) : source_(source), scanner_(source) {}

  TriangleMesh read() {
    std::vector<std::string_view> words;
    while (scanner_.next_line(words)) {
      if (words[0] == "v") {
        read_vertex(words);
      } else if (words[0] == "f") {
        read_face(words);
      } else if (!is_ignored(words[0])) {
        throw_mesh_fault(source_, "E_MESH_FORMAT", scanner_.line(),
                         "found '" + std::string(words[0].substr(0, 40)) +
                             "', expected 'v', 'f' or another OBJ keyword");
      }
    }
    triangulate_faces();
    return std::move(mesh_);
  }

 private:
  struct Face {
    std::vector<long long> corners;  // zero-based
    std::size_t line;
  };

  void read_vertex(const std::vector<std::string_view>& words) {
    // x y z, perhaps a weight or a colour.
    if (words.size() < 4 || words.size() > 8) {
      throw_mesh_fault(
          source_, "E_NUMBER", scanner_.line(),
          "found a vertex of " + std::to_string(words.size() - 1) + " numbers, expected 3");
    }
    Eigen::Vector3d point;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const double value = scanner_.number(words[k]);
      if (k <= 3) point[static_cast<Eigen::Index>(k - 1)] = value;
    }
    mesh_.vertices.push_back(point);
  }

  void read_face(const std::vector<std::string_view>& words) {
    if (words.size() < 4) {
      throw_mesh_fault(
          source_, "E_MESH_FORMAT", scanner_.line(),
          "found a face of " + std::to_string(words.size() - 1) + " corners, expected at least 3");
    }
    if (words.size() - 1 > kMostCorners) {
      throw_mesh_fault(source_, "E_TOO_BIG", scanner_.line(),
                       "found a face of " + std::to_string(words.size() - 1) +
                           " corners, expected at most " + std::to_string(kMostCorners));
    }
    triangles_ += words.size() - 3;
    require_few_triangles(source_, triangles_);
    Face face{{}, scanner_.line()};
    for (std::size_t k = 1; k < words.size(); ++k) {
      const std::string_view position = words[k].substr(0, words[k].find('/'));
      const long long index = scanner_.integer(position, "E_INDEX");
      const long long seen = static_cast<long long>(mesh_.vertices.size());
      const long long corner =
          index > 0 ? index - 1 : seen + index;  // negative: back from the last vertex
      if (index == 0 || corner < 0) throw_index(index, face.line);
      face.corners.push_back(corner);
    }
    faces_.push_back(std::move(face));
  }

  // Faces may stand before their vertices, so indices are checked last.
  void triangulate_faces() {
    const long long count = static_cast<long long>(mesh_.vertices.size());
    for (const Face& face : faces_) {
      std::vector<int> polygon;
      for (const long long corner : face.corners) {
        if (corner >= count) throw_index(corner + 1, face.line);
        polygon.push_back(static_cast<int>(corner));
      }
      append_triangulated(polygon, mesh_);
    }
  }

  [[noreturn]] void throw_index(long long index, std::size_t line) const {
    const std::string count = std::to_string(mesh_.vertices.size());
    throw_mesh_fault(source_, "E_INDEX", line,
                     "found vertex index " + std::to_string(index) + ", expected 1 to " + count +
                         " or -" + count + " to -1");
  }

  const MeshSource& source_;
  TextScanner scanner_;
  TriangleMesh mesh_;
  std::vector<Face> faces_;
  std::size_t triangles_ = 0;
};

}  // namespace

TriangleMesh read_obj(const MeshSource& source) {
  // A backslash at the end of a line continues it.
  std::string joined(source.bytes);
  if (joined.find("\\\n") == std::string::npos && joined.find("\\\r\n") == std::string::npos) {
    return ObjReader(source).read();
  }
  for (const char* mark : {"\\\r\n", "\\\n"}) {
    const std::size_t length = std::string_view(mark).size();
    for (std::size_t at = joined.find(mark); at != std::string::npos; at = joined.find(mark, at)) {
      joined.replace(at, length, length, ' ');
    }
  }
  const MeshSource continued{joined, source.path, source.most_triangles};
  return ObjReader(continued).read();
}

}  // namespace handey
