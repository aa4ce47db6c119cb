// An XML file as a tree of elements, each with its line. Only what a robot file needs: valid UTF-8,
// at most 16 MiB, at most 64 levels, no DOCTYPE (and so no entities), regular files.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handey::kinematics {

struct XmlElement {
  std::string name;
  int line = 0;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<std::unique_ptr<XmlElement>> children;
  bool has_text = false;  ///< text that is not blank stands directly inside

  /// Null if there is no such attribute.
  const std::string* attribute(const std::string& key) const;
  /// The attribute's value, "" if there is none.
  std::string value(const std::string& key) const;
  /// The first child of that name, or null.
  const XmlElement* child(const std::string& tag) const;
  std::vector<const XmlElement*> all(const std::string& tag) const;
};

struct XmlDocument {
  std::string text;  ///< the whole file
  std::unique_ptr<XmlElement> root;
};

/// @throws InvalidInput (E_PATH, E_TOO_BIG, E_ENCODING, E_XML, E_DOCTYPE, E_DEPTH) with file name
/// and line
XmlDocument read_xml(const std::string& path);

}  // namespace handey::kinematics
