// From a typed line to the command that it names, and the page that lists them.
#include "core/io/csv_table.h"
#include "workbench/gui/panels/command_match.h"
#include "workbench/gui/panels/commands.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace tangent {

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return out;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

std::string joined(const std::vector<std::string>& texts, const char* between) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : between) + text;
  return out;
}

/// The commands that the line may have meant: "did you mean ..."; empty: nothing is near.
std::string nearest(std::span<const Command> commands, std::string_view line) {
  std::string out;
  int found = 0;
  for (const PaletteRow& row : matching_rows(palette_rows(commands), line)) {
    if (found++ == 3) break;
    out += (out.empty() ? "did you mean \"" : "\" or \"") + row.line;
  }
  return out.empty() ? "Ctrl+P and workbench/COMMANDS.md list all commands" : out + "\"?";
}

/// The argument as the command takes it: a choice as it is written, whatever the case. Fails where it can't be one.
Result<std::string> checked(const Command& command, const std::string& value) {
  const Argument& argument = command.argument;
  const std::string says = "write: " + usage(command);
  if (argument.kind == ArgumentKind::none && !value.empty())
    return fail("\"" + command.name + "\" takes nothing, not " + show_text(value), {}, says);
  if (value.empty() && argument.kind != ArgumentKind::none && argument.kind != ArgumentKind::on_off)
    return fail("\"" + command.name + "\" needs a value", {}, says);
  if (argument.choices.empty() || value.empty()) return value;
  for (const std::string& choice : argument.choices)
    if (lower(choice) == lower(value)) return choice;
  return fail(show_text(value) + " is not a choice of \"" + command.name + "\"", {},
              argument.choices.empty() ? says : "choose one of: " + joined(argument.choices, ", "));
}

}  // namespace

FoundCommand find_command(std::span<const Command> commands, std::string_view line) {
  const std::string typed = lower(trimmed(line));
  FoundCommand best;
  for (const Command& command : commands) {
    const std::string& name = command.name;
    const bool begins = typed.starts_with(name) && (typed.size() == name.size() || typed[name.size()] == ' ');
    if (!begins || (best.command != nullptr && best.command->name.size() >= name.size())) continue;
    best.command = &command;
    best.value = trimmed(trimmed(line).substr(name.size()));
  }
  return best;
}

Status run_line(std::span<const Command> commands, std::string_view line) {
  const FoundCommand found = find_command(commands, line);
  if (found.command == nullptr)
    return fail("there is no command " + show_text(trimmed(line)), {}, nearest(commands, line));
  const Result<std::string> value = checked(*found.command, found.value);
  if (!value) return tl::unexpected(value.error());
  return found.command->act(*value);
}

std::string usage(const Command& command) {
  const Argument& argument = command.argument;
  std::string shown = argument.shown;
  if (shown.empty() && argument.kind == ArgumentKind::choice) shown = joined(argument.choices, " | ");
  return shown.empty() ? command.name : command.name + " " + shown;
}

std::string commands_page(std::span<const Command> commands) {
  std::string out =
      "# The window's commands\n\nEvery action of the window is a command: typed after Ctrl-P, or a line of a script\n"
      "(`workbench gui --script F`, `workbench shot --script F`; [how](README.md#scripts)). Made by\n\n"
      "```sh\n./workbench/run gui --commands\n```\n";
  std::vector<std::string> order;
  std::map<std::string, std::string> groups;
  for (const Command& command : commands) {
    const std::size_t colon = command.title.find(':');
    const std::string group = command.title.substr(0, colon);
    std::string what =
        colon == std::string::npos ? command.title : std::string(trimmed(command.title.substr(colon + 1)));
    if (what.empty()) what = "choose it";
    if (groups.find(group) == groups.end()) order.push_back(group);
    std::string written = usage(command);
    for (std::size_t at = 0; (at = written.find('|', at)) != std::string::npos; at += 2) written.insert(at, "\\");
    groups[group] += "| `" + written + "` | " + what + " | " + (command.keys.empty() ? "" : command.keys) + " |\n";
  }
  for (const std::string& group : order)
    out += "\n## " + group + "\n\n| command | what it does | keys |\n|---|---|---|\n" + groups[group];
  return out;
}

}  // namespace tangent
