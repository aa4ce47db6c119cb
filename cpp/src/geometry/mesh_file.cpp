// From a path to a solid: the file is a regular one of bearable size, its kind is told by what it
// holds (not by its name), its numbers are metres of plausible size, its corners are welded, its
// surface is closed if it must be and faces outward. Every fault is named before any planner sees
// the mesh.
#include "handey/geometry/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "handey/errors.hpp"
#include "handey/stop.hpp"
#include "mesh_cleaning.hpp"
#include "mesh_edges.hpp"
#include "mesh_formats.hpp"
#include "self_crossing.hpp"

namespace handey {
namespace {

constexpr double kWeld = 1e-7;  // corners nearer than this are one [m]
constexpr double kGreatestCoordinate =
    1e6;  // beyond it a number is taken for nonsense, not for a unit [m]
constexpr double kSmallestSize = 1e-4;  // a smaller mesh gets a warning [m]
constexpr double kFlatVolume = 1e-9;    // a closed surface with less of size^3 encloses nothing

[[noreturn]] void fail(const char* code, const std::string& path, const std::string& message) {
  throw InvalidInput(code, path, message);
}

std::string read_bytes(const std::string& path, std::size_t most_bytes) {
  if (path.empty() || path.find('\0') != std::string::npos) {
    fail("E_PATH", path, "found an empty path or one with a NUL byte, expected the path of a file");
  }
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) fail("E_PATH", path, "no such file");
  if (error) fail("E_PATH", path, "cannot be followed to a file: " + error.message());
  if (status.type() != std::filesystem::file_type::regular) {
    fail("E_PATH", path,
         std::string(status.type() == std::filesystem::file_type::directory
                         ? "found a folder"
                         : "found a pipe, device or socket") +
             ", expected a regular file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail("E_PATH", path, "cannot be measured: " + error.message());
  if (size > most_bytes) {
    fail(
        "E_TOO_BIG", path,
        "found " + std::to_string(size) + " bytes, expected at most " + std::to_string(most_bytes));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail("E_PATH", path, "cannot be opened for reading");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size)
    fail("E_PATH", path, "cannot be read to its end");
  return bytes;
}

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// Formats that are known and refused, by their first bytes.
void refuse_other_formats(const MeshSource& source) {
  struct Signature {
    std::string_view bytes;
    const char* name;
  };
  static constexpr Signature kRefused[] = {{"PK\x03\x04", "a ZIP archive (or 3MF)"},
                                           {"\x1f\x8b", "a gzip archive"},
                                           {"BZh", "a bzip2 archive"},
                                           {"\xfd\x37zXZ", "an xz archive"},
                                           {"7z\xbc\xaf", "a 7z archive"},
                                           {"glTF", "a glTF file"},
                                           {"\x28\xb5\x2f\xfd", "a zstd archive"},
                                           {"<?xml", "an XML file (COLLADA?)"},
                                           {"<COLLADA", "a COLLADA file"},
                                           {"ISO-10303-21", "a STEP file"},
                                           {"OFF", "an OFF file"}};
  for (const Signature& refused : kRefused) {
    if (!starts_with(source.bytes, refused.bytes)) continue;
    fail("E_UNSUPPORTED", source.path,
         std::string("found ") + refused.name + ", expected an STL, OBJ or PLY mesh");
  }
}

bool is_text(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  return std::none_of(head.begin(), head.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 && !std::isspace(static_cast<unsigned char>(c));
  });
}

bool has_binary_stl_size(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  std::uint64_t count = 0;
  for (std::size_t i = 4; i-- > 0;)
    count = (count << 8) | static_cast<unsigned char>(bytes[80 + i]);
  return bytes.size() == 84 + 50 * count;
}

bool looks_like_obj(const MeshSource& source) {
  TextScanner scanner(source);
  std::vector<std::string_view> words;
  while (scanner.next_line(words)) {
    const std::string_view word = words[0];
    if (word == "v" || word == "f" || word == "vn" || word == "vt" || word == "vp") return true;
    const bool leading =
        word == "o" || word == "g" || word == "s" || word == "mtllib" || word == "usemtl";
    if (!leading) return false;
  }
  return false;
}

TriangleMesh read_by_content(const MeshSource& source) {
  const std::size_t first = source.bytes.find_first_not_of(" \t\r\n\v\f");
  if (first == std::string_view::npos)
    fail("E_MESH_EMPTY", source.path, "found an empty file, expected a mesh");
  refuse_other_formats(source);
  if (starts_with(source.bytes, "ply\n") || starts_with(source.bytes, "ply\r"))
    return read_ply(source);
  if (has_binary_stl_size(source.bytes)) return read_binary_stl(source);
  const std::string extension = lower_extension(source.path);
  if (is_text(source.bytes)) {
    std::string start(source.bytes.substr(first, 5));
    for (char& c : start) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (start == "solid") return read_text_stl(source);
    if (looks_like_obj(source) || extension == ".obj") return read_obj(source);
  }
  if (extension == ".stl" && !is_text(source.bytes)) return read_binary_stl(source);
  const bool known = extension == ".stl" || extension == ".obj" || extension == ".ply";
  fail(known ? "E_MESH_FORMAT" : "E_PATH", source.path,
       "found a file of no known kind, expected an STL (binary or text), OBJ or PLY mesh");
}

void require_options(const MeshFileOptions& options, const std::string& path) {
  if (!options.scale.allFinite() || options.scale.minCoeff() <= 0.0) {
    std::ostringstream text;
    text << "found scale [" << options.scale.transpose() << "], expected finite numbers > 0";
    fail("E_SCALE", path, text.str());
  }
  if (!(options.greatest_size > 0.0)) {
    fail("E_RANGE", path,
         "found greatest_size " + std::to_string(options.greatest_size) + ", expected > 0 [m]");
  }
}

void apply_scale(TriangleMesh& mesh, const Eigen::Vector3d& scale, const std::string& path) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] = mesh.vertices[i].cwiseProduct(scale);
    const double greatest = mesh.vertices[i].cwiseAbs().maxCoeff();
    if (greatest <= kGreatestCoordinate) continue;
    std::ostringstream text;
    text << "vertex " << i << " has a coordinate of " << greatest << " m, expected at most "
         << kGreatestCoordinate;
    fail("E_RANGE", path, text.str());
  }
}

void require_plausible_size(const LoadedMesh& loaded, const MeshFileOptions& options,
                            const std::string& path) {
  const double size = (loaded.surface.upper - loaded.surface.lower).maxCoeff();
  if (size <= options.greatest_size) return;
  std::ostringstream text;
  text << "found a mesh " << size << " m long at scale [" << options.scale.transpose()
       << "], expected at most " << options.greatest_size
       << " m; a file in millimetres needs scale 0.001";
  fail("E_UNITS", path, text.str());
}

// Edges with one triangle gape; edges of more than two have a triangle too many.
void require_closed(const LoadedMesh& loaded, const std::string& path) {
  int gaping = 0;
  int crowded = 0;
  for_each_edge(sorted_half_edges(loaded.mesh), [&](std::size_t begin, std::size_t end) {
    if (end - begin == 1) ++gaping;
    if (end - begin > 2) ++crowded;
  });
  if (gaping > 0) {
    fail("E_NOT_CLOSED", path,
         "found " + std::to_string(gaping) +
             " edges with a triangle on one side only, expected a closed surface");
  }
  const double size = (loaded.surface.upper - loaded.surface.lower).maxCoeff();
  if (std::abs(loaded.surface.volume) <= kFlatVolume * size * size * size) {
    fail("E_MESH_DEGENERATE", path, "found a surface that encloses no volume, expected a solid");
  }
  if (crowded > 0) {
    fail("E_NOT_MANIFOLD", path,
         "found " + std::to_string(crowded) +
             " edges that more than two triangles share, expected two");
  }
}

void orient_outward(LoadedMesh& loaded, bool must_be_closed, const std::string& path) {
  if (!loaded.surface.consistently_oriented) {
    if (orient_consistently(loaded.mesh)) {
      loaded.warnings.push_back("neighbouring triangles disagreed which side is out: turned");
    } else if (must_be_closed) {
      fail("E_NOT_MANIFOLD", path,
           "found triangles that cannot agree which side is out, expected a solid's surface");
    } else {
      loaded.warnings.push_back("neighbouring triangles disagree which side is out");
    }
    loaded.surface = inspect_surface(loaded.mesh);
  }
  if (loaded.surface.closed && loaded.surface.volume < 0.0) {
    for (Eigen::Vector3i& triangle : loaded.mesh.triangles) std::swap(triangle[1], triangle[2]);
    loaded.surface = inspect_surface(loaded.mesh);
    loaded.warnings.push_back("inside out: flipped");
  }
}

void add_warnings(LoadedMesh& loaded) {
  const SurfaceReport& surface = loaded.surface;
  if (!surface.closed) {
    loaded.warnings.push_back("the surface is open at " + std::to_string(surface.open_edges) +
                              " edges");
  }
  if (!surface.manifold) {
    loaded.warnings.push_back(std::to_string(surface.overfull_edges) +
                              " edges have more than two triangles");
  }
  if (surface.closed && crosses_itself(loaded.mesh)) {
    loaded.warnings.push_back("the surface crosses itself: its pieces are taken as one solid");
  }
  if ((surface.upper - surface.lower).maxCoeff() < kSmallestSize) {
    loaded.warnings.push_back("the mesh is smaller than 0.1 mm; is its scale right?");
  }
}

}  // namespace

LoadedMesh load_mesh(const std::string& path, const MeshFileOptions& options) {
  require_options(options, path);
  const std::string bytes = read_bytes(path, options.most_bytes);
  TriangleMesh raw = read_by_content({bytes, path, options.most_triangles});
  if (raw.triangles.empty())
    fail("E_MESH_EMPTY", path, "found no triangles, expected at least one");
  apply_scale(raw, options.scale, path);
  LoadedMesh loaded;
  loaded.mesh = drop_flat_triangles(weld(raw, kWeld));
  if (loaded.mesh.triangles.empty()) {
    fail("E_MESH_DEGENERATE", path, "found only triangles without area, expected a surface");
  }
  loaded.surface = inspect_surface(loaded.mesh);
  require_plausible_size(loaded, options, path);
  if (options.must_be_closed) require_closed(loaded, path);
  orient_outward(loaded, options.must_be_closed, path);
  add_warnings(loaded);
  return loaded;
}

}  // namespace handey
