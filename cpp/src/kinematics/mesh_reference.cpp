// A mesh must be a regular STL, OBJ or PLY file inside the URDF's folder, inside the package that
// the URDF belongs to, or inside the package that it names: a robot file from a stranger cannot
// make us read elsewhere. A package is known by the caller's table, or as a folder with a
// package.xml: one that the URDF lies in, or one beside these.
#include "mesh_reference.hpp"

#include <algorithm>
#include <system_error>

#include "handey/errors.hpp"
#include "numbers.hpp"

namespace handey::kinematics {
namespace fs = std::filesystem;
namespace {

constexpr int kMostParents =
    4;  // Choice: package/urdf/family/robot.urdf, and a workspace around it

[[noreturn]] void refuse(const std::string& message) { throw InvalidInput("E_PATH", "", message); }

bool is_inside(const fs::path& path, const fs::path& tree) {
  const auto [at, rest] = std::mismatch(tree.begin(), tree.end(), path.begin(), path.end());
  return at == tree.end();
}

fs::path real_path(const fs::path& path, const std::string& filename) {
  std::error_code error;
  fs::path real = fs::canonical(path, error);  // fails for missing files and for rings of links
  if (error) refuse("mesh '" + filename + "' leads to no file: " + error.message());
  return real;
}

void require_mesh_kind(const fs::path& path, const std::string& filename) {
  if (!fs::is_regular_file(path)) refuse("mesh '" + filename + "' is not a regular file");
  std::string kind = path.extension().string();
  for (char& c : kind) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (kind == ".stl" || kind == ".obj" || kind == ".ply") return;
  const bool foreign = kind == ".dae" || kind == ".3mf" || kind == ".zip" || kind == ".bz2" ||
                       kind == ".gz" || kind == ".step" || kind == ".stp" || kind == ".glb" ||
                       kind == ".gltf";
  if (!foreign) refuse("mesh '" + filename + "' is of no known kind; expected .stl, .obj or .ply");
  throw InvalidInput(
      "E_UNSUPPORTED", "",
      "mesh '" + filename + "': " + kind + " is not read; convert it to .stl, .obj or .ply");
}

}  // namespace

MeshReferences::MeshReferences(const std::string& urdf_path,
                               const std::map<std::string, std::string>& packages) {
  std::error_code error;
  folder_ = fs::canonical(fs::path(urdf_path), error).parent_path();
  trees_.push_back(folder_);
  fs::path at = folder_;
  for (int i = 0; i <= kMostParents && at != at.root_path(); ++i, at = at.parent_path()) {
    if (!fs::is_regular_file(at / "package.xml", error) && at != folder_) continue;
    known_.emplace(at.filename().string(), at);
    if (at != folder_) {
      trees_.push_back(at);
      break;  // the URDF's own package; what lies above is not its own
    }
  }
  for (const auto& [name, folder] : packages) {
    const fs::path real = fs::canonical(folder, error);
    if (error || !fs::is_directory(real, error)) {
      throw InvalidInput("E_PATH", "packages." + name, "'" + folder + "' is not a folder");
    }
    known_[name] = real;
  }
}

fs::path MeshReferences::package_folder(const std::string& name) const {
  if (const auto found = known_.find(name); found != known_.end()) return found->second;
  std::error_code error;
  fs::path at = folder_;
  const bool plain = !name.empty() && name != "." && name != "..";
  for (int i = 0; plain && i <= kMostParents; ++i, at = at.parent_path()) {
    const fs::path beside = fs::canonical(at / name, error);
    if (!error && fs::is_regular_file(beside / "package.xml", error)) return beside;
    if (at == at.root_path()) break;
  }
  std::vector<std::string> names;
  for (const auto& [known, folder] : known_) names.push_back(known);
  refuse("package '" + name + "' is unknown; known are " + quoted_list(names));
}

std::string MeshReferences::resolve(const std::string& filename) const {
  const std::string package_scheme = "package://", file_scheme = "file://";
  fs::path path;
  std::vector<fs::path> trees = trees_;
  if (filename.rfind(package_scheme, 0) == 0) {
    const std::string rest = filename.substr(package_scheme.size());
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const fs::path folder = package_folder(rest.substr(0, slash));
    path = folder / rest.substr(std::min(slash + 1, rest.size()));
    trees = {folder};
  } else if (filename.rfind(file_scheme, 0) == 0) {
    path = filename.substr(file_scheme.size());
  } else if (filename.find("://") != std::string::npos) {
    refuse("mesh '" + filename + "' is not a local file; expected a relative path or package://");
  } else {
    path = folder_ / filename;
  }
  const fs::path real = real_path(path, filename);
  if (std::none_of(trees.begin(), trees.end(),
                   [&](const fs::path& tree) { return is_inside(real, tree); })) {
    refuse("mesh '" + filename + "' leads out of '" + trees.back().filename().string() +
           "', the folder that it must stay in");
  }
  require_mesh_kind(real, filename);
  return real.string();
}

}  // namespace handey::kinematics
