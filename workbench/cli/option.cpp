#include "workbench/cli/option.h"

#include "core/base/text.h"
#include "core/preset/schema.h"
#include "workbench/cli/own_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace tangent {

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& doc, const std::string& footer) {
  CLI::App* command = app.add_subcommand(name, doc);
  if (!footer.empty()) command->footer(footer);  // otherwise the program's
  return command;
}

namespace {

/// Reports and tables beside what a command reads: one that names a file which the command was given replaces it, and a
/// recording is gone. Not --out, which some commands may be given to write back what they read.
void refuse_outputs_over_inputs(const CLI::App& command) {
  constexpr std::array<std::string_view, 5> kOutputs{"--json", "--csv", "--front", "--plot", "--packets"};
  const std::vector<GivenOption> given = given_options(command);
  for (const GivenOption& output : given) {
    if (std::find(kOutputs.begin(), kOutputs.end(), output.name) == kOutputs.end()) continue;
    for (const GivenOption& other : given) {
      std::error_code error;
      const bool same = other.value == output.value || std::filesystem::equivalent(output.value, other.value, error);
      if (&other == &output || !same || output.value.starts_with("/dev/")) continue;
      refuse_option(output.name, "names the same file as " + (other.name.empty() ? other.value : other.name));
    }
  }
}

/// Elsewhere standard output is meant by it.
void refuse_dashes(const CLI::App& command) {
  constexpr std::array<std::string_view, 10> kOutputs{"--out",     "--json",    "--csv",        "--front",
                                                      "--plot",    "--summary", "--iterations", "--figures",
                                                      "--packets", "--heat-map"};
  for (const GivenOption& output : given_options(command))
    if (output.value == "-" && std::find(kOutputs.begin(), kOutputs.end(), output.name) != kOutputs.end())
      refuse_option(output.name,
                    "- would be a file of that name, not standard output: name a file, ./- if it is meant");
}

}  // namespace

void on_run(CLI::App& command, std::function<void()> run) {
  command.callback([&command, run = std::move(run)] {
    refuse_dashes(command);
    refuse_outputs_over_inputs(command);
    check_own_outputs(command);
    run();
  });
}

void add_text_option(CLI::App& app, const std::string& name, std::string& value, const std::string& doc,
                     const std::string& shown_as, Needed needed) {
  app.add_option(name, value, doc)->required(needed == Needed::yes)->type_name(shown_as);
}

void add_text_option(CLI::App& app, const std::string& name, std::filesystem::path& value, const std::string& doc,
                     const std::string& shown_as, Needed needed) {
  app.add_option(name, value, doc)->required(needed == Needed::yes)->type_name(shown_as);
}

void add_paths_option(CLI::App& app, const std::string& name, std::vector<std::filesystem::path>& paths,
                      const std::string& doc, const std::string& shown_as) {
  app.add_option(name, paths, doc)->type_name(shown_as)->required();
}

void add_repeated_option(CLI::App& app, const std::string& name, const std::string& doc, const std::string& shown_as,
                         const std::function<void(const std::vector<std::string>&)>& set) {
  app.add_option_function<std::vector<std::string>>(name, set, doc)->type_name(shown_as)->allow_extra_args(false);
}

void add_list_option(CLI::App& app, const std::string& name, std::vector<std::string>& values, const std::string& doc,
                     const std::string& shown_as) {
  app.add_option(name, values, doc)->type_name(shown_as);
}

void add_flag(CLI::App& app, const std::string& name, bool& value, const std::string& doc) {
  app.add_flag(name, value, doc);
}

namespace {

double checked_number(const std::string& name, const std::string& text, const NumberRange& range) {
  const std::string allowed =
      (range.whole ? "a whole number from " : "") + range_text(range.min, range.max, range.unit);
  const std::optional<double> value = parse_finite_double(text);
  if (!value) refuse_option(name, "'" + text + "' is not a finite number; allowed: " + allowed);
  if (range.whole && std::floor(*value) != *value) {
    refuse_option(name, text + " is not a whole number; allowed: " + allowed);
  }
  if (!(*value >= range.min && *value <= range.max)) {
    refuse_option(name, text + " is out of range; allowed: " + allowed);
  }
  return *value;
}

}  // namespace

void add_vector_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                       std::function<void(const std::array<double, 3>&)> set) {
  const auto parse = [=, set = std::move(set)](const std::vector<std::string>& texts) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = checked_number(name, texts.at(i), range);
    set(values);
  };
  app.add_option_function<std::vector<std::string>>(name, parse, doc)->expected(3)->type_name("X Y Z");
}

void add_number_option(CLI::App& app, const std::string& name, NumberRange range, const std::string& doc,
                       std::function<void(double)> set) {
  const auto parse = [=, set = std::move(set)](const std::string& text) { set(checked_number(name, text, range)); };
  app.add_option_function<std::string>(name, parse, doc)->type_name(range.whole ? "N" : "X");
}

void add_choice_option(CLI::App& app, const std::string& name, std::span<const std::string_view> choices,
                       const std::string& doc, std::function<void(int)> set) {
  const auto parse = [=, set = std::move(set)](const std::string& text) {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end()) {
      refuse_option(name, "'" + text + "' is unknown; allowed: " + choices_text(choices));
    }
    set(static_cast<int>(found - choices.begin()));
  };
  std::string words;
  for (const std::string_view choice : choices) words.append(words.empty() ? "" : "|").append(choice);
  app.add_option_function<std::string>(name, parse, doc)->type_name(words);
}

void require_together(CLI::App& app, const std::string& name, const std::string& other) {
  app.get_option(name)->needs(app.get_option(other));
  app.get_option(other)->needs(app.get_option(name));
}

void exclude_each_other(CLI::App& app, const std::string& name, const std::string& other) {
  app.get_option(name)->excludes(app.get_option(other));
}

void refuse_option(const std::string& name, const std::string& why) { throw CLI::ValidationError(name, why); }

std::vector<GivenOption> given_options(const CLI::App& command) {
  std::vector<GivenOption> given;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      given.push_back({option->get_positional() ? std::string() : option->get_name(), value});
    }
  }
  return given;
}

}  // namespace tangent
