#include "workbench/gui/panels/commands.h"

#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr double kMostShown = 1e5;  // a limit larger than this is there for safety, and says nothing

}  // namespace

std::function<void()> when(AppModel& model, std::function<bool()> can, std::string why_not, std::function<void()> act) {
  return [&model, can = std::move(can), why_not = std::move(why_not), act = std::move(act)] {
    can() ? act() : model.messages().refuse(why_not);
  };
}

void CommandList::plain(CommandNames names, std::function<void()> act) {
  all.push_back({std::move(names), {}, [act = std::move(act)](const std::string&) -> Status {
                   act();
                   return {};
                 }});
}

void CommandList::on_off(CommandNames names, std::function<bool()> get, std::function<void(bool)> set) {
  Argument argument{ArgumentKind::on_off, "[on|off]", {"on", "off"}, true, get() ? "on" : "off"};
  all.push_back({std::move(names), std::move(argument),
                 [get = std::move(get), set = std::move(set)](const std::string& value) -> Status {
                   set(value.empty() ? !get() : value == "on");
                   return {};
                 }});
}

void CommandList::flag(CommandNames names, bool& on) {
  on_off(
      std::move(names), [&on] { return on; }, [&on](bool wanted) { on = wanted; });
}

void CommandList::choice(CommandNames names, std::vector<std::string> choices, std::function<void(std::size_t)> act,
                         int now) {
  Argument argument{ArgumentKind::choice, {}, choices, true, {}};
  if (now >= 0) argument.value = choices[static_cast<std::size_t>(now)];
  all.push_back({std::move(names), std::move(argument),
                 [act = std::move(act), choices = std::move(choices)](const std::string& value) -> Status {
                   act(static_cast<std::size_t>(std::find(choices.begin(), choices.end(), value) - choices.begin()));
                   return {};
                 }});
}

void CommandList::choice_of(CommandNames names, const char* shown, std::vector<std::string> choices,
                            std::function<void(std::size_t)> act) {
  choice(std::move(names), std::move(choices), std::move(act));
  all.back().argument.fixed = false;
  all.back().argument.shown = shown;
}

void CommandList::number(CommandNames names, const char* unit, double min, double max,
                         std::function<void(double)> act) {
  const std::string range = range_text(min, max, unit);
  all.push_back({std::move(names),
                 {ArgumentKind::number,
                  max < kMostShown  ? range
                  : unit[0] != '\0' ? "N " + std::string(unit)
                                    : "N",
                  {},
                  true,
                  {}},
                 [act = std::move(act), range, min, max, unit = std::string(unit)](std::string value) -> Status {
                   if (!unit.empty() && value.ends_with(" " + unit)) value.resize(value.size() - unit.size() - 1);
                   const auto typed = parse_finite_double(value);
                   if (!typed) return fail(show_text(value) + " is not a number", {}, "allowed: " + range);
                   if (*typed < min || *typed > max) return fail(value + " is out of range", {}, "allowed: " + range);
                   act(*typed);
                   return {};
                 }});
}

void CommandList::text(CommandNames names, const char* shown, std::function<Status(const std::string&)> act) {
  all.push_back({std::move(names), {ArgumentKind::text, shown, {}, true, {}}, std::move(act)});
}

std::vector<Command> window_commands(AppModel& model, MenuBar& menu) {
  CommandList out;
  add_time_commands(out, model, menu);
  add_preset_commands(out, model, menu);
  add_tune_commands(out, model, menu);
  add_tuning_commands(out, model, menu);
  add_view_commands(out, model, menu);
  add_mesh_commands(out, model, menu);
  add_window_commands(out, model, menu);
  add_widget_commands(out, model, menu);
  return std::move(out.all);
}

const std::vector<KeyNote>& further_keys() {
  static const std::vector<KeyNote> kNotes{
      {"Tab, Shift+Tab", "The next field or button, the one before; Enter presses it"},
      {"Left, Right", "On a field: slide its value (Shift: finer)"},
      {"F6, Shift+F6", "The next part of the window, the one before"},
      {"Esc", "Stop the force, always; then close what is open"},
      {"Left drag", "Orbit; slides a value (Shift: finer)"},
      {"Right drag, Shift drag", "Pan the view"},
      {"C, held", "Clutch: the device moves, the finger stays in the scene"},
      {"Wheel", "Zoom about the pointer: view, plots, time"},
      {"Click", "Pick a triangle; type a value"},
      {"Tab, typing", "Take the typed value and go on to the next"}};
  return kNotes;
}

}  // namespace tangent
