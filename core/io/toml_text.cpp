#include "core/io/toml_text.h"

#include "core/base/text.h"

#include <algorithm>
#include <sstream>

namespace tangent {

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  // always a basic string, never a literal or multi-line one
  out << toml::toml_formatter{toml::value<std::string>(text),
                              toml::toml_formatter::default_flags & ~(toml::format_flags::allow_literal_strings |
                                                                      toml::format_flags::allow_multi_line_strings)};
  return out.str();
}

std::string quoted_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string float_text(double value) {
  std::string text;
  append_double(text, value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace tangent
