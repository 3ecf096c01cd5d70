#include "core/io/toml_file.h"

#include "core/io/input_file.h"

#include <string>
#include <system_error>

namespace tangent {

Result<toml::table> parse_toml(std::string_view text, std::string_view name, std::string_view remedy) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    return fail(std::string(error.description()), std::string(name) + ":" + std::to_string(error.source().begin.line),
                std::string(remedy));
  }
}

Result<toml::table> read_settings_file(const std::filesystem::path& path, std::size_t max_bytes,
                                       std::string_view remedy) {
  std::error_code ignored;
  if (path.empty() || !std::filesystem::exists(path, ignored)) return toml::table{};
  const auto text = read_input_file(path, max_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse_toml(*text, path.string(), remedy);
}

}  // namespace tangent
