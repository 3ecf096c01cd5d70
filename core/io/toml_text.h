// Values as TOML writes them, and what a value is called in messages.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace tangent {

/// "a whole number", "text": after "is" in a message.
std::string_view type_name(const toml::node& node);

/// Text as a basic string on one line.
std::string quoted(const std::string& text);
/// The same for a key, without quotes where it needs none.
std::string quoted_key(const std::string& key);
/// A float, always with a point or an exponent; reads back as the same double.
std::string float_text(double value);

}  // namespace tangent
