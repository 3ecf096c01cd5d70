#include "workbench/cli/number_option.h"

#include "core/base/text.h"
#include "core/preset/schema.h"

#include <algorithm>
#include <cmath>

namespace tangent {

CLI::Option* add_number_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                               std::function<void(double)> set) {
  const std::string allowed =
      (range.whole ? "a whole number from " : "") + range_text(range.min, range.max, range.unit);
  const auto parse = [=, set = std::move(set)](const std::string& text) {
    const std::optional<double> value = parse_finite_double(text);
    if (!value) throw CLI::ValidationError(name, "'" + text + "' is not a finite number; allowed: " + allowed);
    if (range.whole && std::floor(*value) != *value) {
      throw CLI::ValidationError(name, text + " is not a whole number; allowed: " + allowed);
    }
    if (!(*value >= range.min && *value <= range.max)) {
      throw CLI::ValidationError(name, text + " is out of range; allowed: " + allowed);
    }
    set(*value);
  };
  return app.add_option_function<std::string>(name, parse, doc)->type_name(range.whole ? "N" : "X");
}

CLI::Option* add_choice_option(CLI::App& app, const std::string& name, std::span<const std::string_view> choices,
                               const std::string& doc, std::function<void(int)> set) {
  const auto parse = [=, set = std::move(set)](const std::string& text) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) {
      throw CLI::ValidationError(name, "'" + text + "' is unknown; allowed: " + choices_text(choices));
    }
    set(static_cast<int>(found - choices.begin()));
  };
  std::string words;
  for (const std::string_view choice : choices) words.append(words.empty() ? "" : "|").append(choice);
  return app.add_option_function<std::string>(name, parse, doc)->type_name(words);
}

}  // namespace tangent
