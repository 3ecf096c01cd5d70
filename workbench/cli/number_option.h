// Options that take a number or one of a few words. A number must be finite and in its range; anything else
// is refused with a message that names the option and what it allows.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

struct NumberRange {
  double min = 0.0, max = 0.0;  ///< in the option's own unit, both ends allowed
  std::string_view unit = {};
  bool whole = false;
};

/// `set` gets the number in the option's own unit. `name`: "--tolerance-um".
CLI::Option* add_number_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                               std::function<void(double)> set);

/// `set` gets the index into `choices`, which must outlive the parser.
CLI::Option* add_choice_option(CLI::App& app, const std::string& name, std::span<const std::string_view> choices,
                               const std::string& doc, std::function<void(int)> set);

}  // namespace tangent
