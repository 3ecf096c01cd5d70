// The key `format` of the project's TOML files: which layout of keys a file has. Files of an older one are brought up
// step by step as they are read; what is written has the newest.
#pragma once

#include "core/base/result.h"
#include "core/io/toml_file.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

inline constexpr std::string_view kFormatKey = "format";

/// Turns a file of one format into one of the next. What it leaves alone keeps its line for messages.
using MigrationStep = void (*)(toml::table&);

/// For a step that changes nothing but the number: format 0 is a file without the key, as all were before it.
inline void only_number(toml::table&) {}

/// The formats of one kind of file. `steps[i]` leads from format i to i + 1.
struct FileFormats {
  std::string_view kind;  ///< "preset"
  std::span<const MigrationStep> steps;
  std::int64_t newest() const { return static_cast<std::int64_t>(steps.size()); }
  /// "format = 1\n": to be written above everything else.
  std::string line() const;
};

/// Brings what was read from `name` to the newest format and takes the key out. Fails on a newer one, naming both
/// formats, and on one that is no whole number.
Status migrate(toml::table& root, const FileFormats& formats, std::string_view name);

}  // namespace tangent
