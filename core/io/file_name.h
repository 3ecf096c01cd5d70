// Names of files as text. On Linux a name is any bytes; TOML and JSON hold UTF-8 only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent {

/// Well-formed UTF-8 as in RFC 3629: no overlong forms, no surrogates.
bool is_utf8(std::string_view text);

/// The name itself where that is UTF-8, else its bytes as a URI, "file:mesh-%E9.obj" (RFC 3986). Always UTF-8, and
/// `file_named` takes it back.
std::string file_name_text(const std::filesystem::path& file);
/// What `file_name_text` was given. Any text is some file's name.
std::filesystem::path file_named(std::string_view text);

}  // namespace tangent
