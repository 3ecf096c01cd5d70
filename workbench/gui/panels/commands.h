// Every action of the window as a command with its argument: what the command palette, scripts and the page of commands
// show and run. A line is a command's name and its argument: "curvature gain 12 mm", "map failures", "pause on".
#pragma once

#include "core/base/result.h"
#include "workbench/gui/panels/panels.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

enum class ArgumentKind : std::uint8_t {
  none,
  on_off,  ///< may be left out: the other one
  choice,
  number,
  text,
};

struct Argument {
  ArgumentKind kind = ArgumentKind::none;
  std::string shown;                 ///< for a person: "NAME", "0 to 10", "MM"
  std::vector<std::string> choices;  ///< of a choice
  bool fixed = true;                 ///< the choices are the same on every machine and for every mesh
  std::string value;                 ///< as it is now; empty: unknown
};

/// Names of a command. All but the keys are searched.
struct CommandNames {
  std::string name;        ///< as it is typed: "pause"
  std::string title;       ///< as the palette shows it: "Time: pause or go on"
  std::string keys = {};   ///< "Ctrl+Z"; empty: none
  std::string words = {};  ///< by which it is found, too
};

struct Command : CommandNames {
  Argument argument;
  std::function<Status(const std::string& value)> act;  ///< precondition: checked by run_line
};

/// Builds a list, with the checks that all arguments of a kind have in common.
class CommandList {
 public:
  std::vector<Command> all;

  void plain(CommandNames names, std::function<void()> act);
  void on_off(CommandNames names, std::function<bool()> get, std::function<void(bool)> set);
  void flag(CommandNames names, bool& on);
  /// `act` gets the index. `now`: of the present one, or a negative number.
  void choice(CommandNames names, std::vector<std::string> choices, std::function<void(std::size_t)> act, int now = -1);
  /// The same with choices that are not the same everywhere; `shown` stands for them in the page.
  void choice_of(CommandNames names, const char* shown, std::vector<std::string> choices,
                 std::function<void(std::size_t)> act);
  /// Fails outside [min, max].
  void number(CommandNames names, const char* unit, double min, double max, std::function<void(double)> act);
  void text(CommandNames names, const char* shown, std::function<Status(const std::string&)> act);
};

/// Does it where it can; where it can't, the window says why, and a line of a script has failed.
std::function<void()> when(AppModel& model, std::function<bool()> can, std::string why_not, std::function<void()> act);

// One file each. `model` and `menu` must outlive the list.
void add_time_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_preset_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_view_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_mesh_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_window_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_tune_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_tuning_commands(CommandList& out, AppModel& model, MenuBar& menu);
void add_widget_commands(CommandList& out, AppModel& model, MenuBar& menu);

/// All commands available now, including presets, recent files and maps.
std::vector<Command> window_commands(AppModel& model, MenuBar& menu);

/// The command whose name begins the line, and the rest of the line: its argument. Null: none.
struct FoundCommand {
  const Command* command = nullptr;
  std::string value;
};
FoundCommand find_command(std::span<const Command> commands, std::string_view line);

/// Runs the line. Fails on an unknown command and on an argument that is missing, unknown or out of range, saying what
/// is allowed. What the window does in the frames that follow is in MenuBar::wish; failures later on are messages.
Status run_line(std::span<const Command> commands, std::string_view line);

/// "curvature gain 0 to 10 mm": the name with its argument. "pause [on|off]".
std::string usage(const Command& command);
/// workbench/COMMANDS.md: the same wherever it is made.
std::string commands_page(std::span<const Command> commands);

/// Keys and mouse actions that are not commands, with their description.
struct KeyNote {
  const char* keys;
  const char* what;
};
const std::vector<KeyNote>& further_keys();

}  // namespace tangent
