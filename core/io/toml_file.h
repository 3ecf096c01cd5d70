// Reading TOML, with errors that name file and line.
#pragma once

#include "core/base/result.h"

#include <toml++/toml.h>

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace tangent {

/// Fails with the parser's reason, `name` and the line, and what to do: `remedy`.
Result<toml::table> parse_toml(std::string_view text, std::string_view name, std::string_view remedy);

/// Reads a settings file; an empty table where `path` is empty or there is no such file. Fails as read_input_file and
/// parse_toml do.
Result<toml::table> read_settings_file(const std::filesystem::path& path, std::size_t max_bytes,
                                       std::string_view remedy);

}  // namespace tangent
