// Where the file is that a <mesh filename="..."> of a URDF names.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace handey::kinematics {

class MeshReferences {
 public:
  MeshReferences(const std::string& urdf_path, const std::map<std::string, std::string>& packages);

  /// The file's real path.
  /// @throws InvalidInput (E_PATH, E_UNSUPPORTED) with an empty place
  std::string resolve(const std::string& filename) const;

 private:
  std::filesystem::path package_folder(const std::string& name) const;

  std::filesystem::path folder_;                        ///< of the URDF, real
  std::map<std::string, std::filesystem::path> known_;  ///< packages, real
  std::vector<std::filesystem::path> trees_;  ///< a plain path must end inside one of these
};

}  // namespace handey::kinematics
