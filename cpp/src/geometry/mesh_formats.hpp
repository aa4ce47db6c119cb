// The three mesh formats as readers from bytes to raw triangles, and the strict scanner of numbers
// that the textual ones share. Readers check syntax, indices and sizes; load_mesh checks geometry.
// Private to the library.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "handey/geometry/mesh_file.hpp"

namespace handey {

/// Where the reader is and what it may take.
struct MeshSource {
  std::string_view bytes;
  std::string path;
  std::size_t most_triangles;
};

TriangleMesh read_binary_stl(const MeshSource& source);
TriangleMesh read_text_stl(const MeshSource& source);
TriangleMesh read_obj(const MeshSource& source);
TriangleMesh read_ply(const MeshSource& source);

/// @throws InvalidInput with the place "path:line" (line 0: the path alone)
[[noreturn]] void throw_mesh_fault(const MeshSource& source, const char* code, std::size_t line,
                                   const std::string& message);

/// Takes words off a text, one line at a time or across lines.
class TextScanner {
 public:
  explicit TextScanner(const MeshSource& source, std::size_t first_line = 1)
      : source_(source), line_(first_line), next_line_(first_line) {}

  /// The words of the next line that has any, a comment from '#' on left out; false at the end.
  bool next_line(std::vector<std::string_view>& words);
  /// The next word, over line ends; empty at the end.
  std::string_view next_word();
  /// What is left of the current line.
  void skip_line();
  std::size_t line() const { return line_; }
  bool at_end() const { return at_ >= source_.bytes.size(); }

  /// @throws InvalidInput (E_NUMBER) unless the whole word is one finite number
  double number(std::string_view word) const;
  /// @throws InvalidInput (`code`) unless the whole word is one integer
  long long integer(std::string_view word, const char* code) const;

 private:
  const MeshSource& source_;
  std::size_t at_ = 0;
  std::size_t line_;       // of the word or line last returned
  std::size_t next_line_;  // of the text at at_
};

/// A polygon of vertex indices as triangles: a fan where convex, else by cutting ears.
void append_triangulated(const std::vector<int>& polygon, TriangleMesh& mesh);

/// @throws InvalidInput (E_TOO_BIG) if the mesh has more triangles than allowed
void require_few_triangles(const MeshSource& source, unsigned long long count);

}  // namespace handey
