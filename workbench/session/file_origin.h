// Where a picture, a figure or a table came from, kept within the file: mesh, preset, unit and the command that makes
// it again. Nothing of it shows: PNG text chunks, SVG metadata, the information dictionary of a PDF, comment lines of
// CSV.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tangent {

struct FileOrigin {
  std::string mesh = {};     ///< name, triangles, hash
  std::string preset = {};   ///< name
  std::string unit = {};     ///< of the mesh's file, and of lengths in this one
  std::string command = {};  ///< "workbench shot torus --view planes"

  /// "Mesh", "Preset", "Unit", "Command" and "Software", as far as they are known; text on one line each.
  std::vector<std::pair<std::string, std::string>> facts() const;
};

/// "torus, 1152 triangles, 0123456789abcdef".
std::string mesh_fact(const std::string& name, std::size_t triangles, std::uint64_t content_hash);
/// "1 unit = 0.001 m; SI here".
std::string unit_fact(double metres_per_unit);
/// A word as one types it in a shell: in quotes where it has to be.
std::string shell_word(const std::string& word);

/// Lines "# Mesh: ...", to stand before the header of a table.
std::string csv_comment(const FileOrigin& origin);
/// Chunks iTXt after the header of a PNG file. Other bytes come back as they are.
std::string png_with_origin(std::string_view png, const FileOrigin& origin);
/// An element <metadata> in an SVG file.
std::string svg_with_origin(std::string_view svg, const FileOrigin& origin);
/// A PDF file whose information dictionary says it too, added at the end as the format provides (ISO 32000-1, 7.5.6).
/// Fails on a file that has no classic table of references.
Result<std::string> pdf_with_origin(std::string_view pdf, const FileOrigin& origin);

}  // namespace tangent
