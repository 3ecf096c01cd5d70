// The key `format` of the project's TOML files: the version of their keys. Older files are migrated step by step when
// read; files are written in the newest format.
#pragma once

#include "core/base/result.h"
#include "core/io/toml_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

inline constexpr std::string_view kFormatKey = "format";

/// Converts a file of one format to the next. Untouched keys keep their line numbers for messages.
using MigrationStep = void (*)(toml::table&);

/// A step that only changes the number. Format 0 is a file without the key.
inline void only_number(toml::table&) {}

/// The formats of one kind of file. `steps[i]` leads from format i to i + 1.
struct FileFormats {
  std::string_view kind;  ///< "preset"
  std::span<const MigrationStep> steps;
  std::int64_t newest() const { return static_cast<std::int64_t>(steps.size()); }
  /// "format = 1\n", the first line of the file.
  std::string line() const;
};

/// Migrates what was read from `name` to the newest format and removes the key. Fails on a newer format, naming both,
/// and on one that is not an integer.
Status migrate(toml::table& root, const FileFormats& formats, std::string_view name);

}  // namespace tangent
