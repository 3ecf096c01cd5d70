// Commands of comparing and tuning: two presets on the same ticks, ticks at a place, sweeps, derived curves; and of
// saving all that as files.
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/panels/wish.h"

namespace tangent {

namespace {

/// A command that presses a widget.
void press(CommandList& out, AppModel& model, MenuBar& menu, CommandNames names, const char* path) {
  out.plain(std::move(names), [&model, &menu, path] { wish(model, menu, path); });
}

/// A command that gives a widget a value.
void enter(CommandList& out, AppModel& model, MenuBar& menu, CommandNames names, const char* shown, std::string path) {
  out.text(std::move(names), shown, [&model, &menu, path = std::move(path)](const std::string& value) {
    return wish(model, menu, path, value), Status();
  });
}

void add_comparing(CommandList& out, AppModel& model, MenuBar& menu) {
  press(out, model, menu, {"compare solve", "Compare: solve the ticks with both presets", "", "before after faster"},
        "compare/solve");
  out.flag({"other beside", "Compare: show both A and B for the tick in view", "", "ghost live both"},
           model.time().other_slot_beside);
  press(out, model, menu, {"search gains", "Solver: search gains for the chosen ticks", "", "tune advice optimise"},
        "solver/advice/search");
  press(out, model, menu, {"selection", "Time machine: to the ticks between cursors A and B", "", "range kept"},
        "time_machine/selection");
  press(out, model, menu, {"solve at bookmark", "Bookmarks: solve at this one", "", "place here"}, "bookmarks/solve");
  press(out, model, menu, {"leave place", "Iterations: back to the recorded tick", "", "solve here end"},
        "iterations/leave_place");
  press(out, model, menu, {"iteration columns", "Iterations: choose the table's columns", "", "show hide ratio stop"},
        "iterations/columns");
}

void add_sweep(CommandList& out, AppModel& model, MenuBar& menu) {
  for (const char* which : {"0", "1"}) {
    const bool first = which[0] == '0';
    const std::string name = first ? "sweep" : "sweep second", title = first ? "Sweep: " : "Sweep, second: ";
    const auto path = [which](const char* field) { return std::string("sweep/") + field + "/" + which; };
    enter(out, model, menu, {name + " key", title + "the value to vary", "", "tune parameter"}, "NAME", path("key"));
    enter(out, model, menu, {name + " from", title + "first value", "", "range"}, "N", path("from"));
    enter(out, model, menu, {name + " to", title + "last value", "", "range"}, "N", path("to"));
    enter(out, model, menu, {name + " count", title + "number of values", "", "steps"}, "N", path("count"));
  }
  press(out, model, menu, {"sweep start", "Sweep: the chosen ticks, with every value", "", "run vary tune"},
        "sweep/start");
  out.plain({"sweep cancel", "Sweep: stop, keep the points so far", ""}, [&model] { model.tuning().cancel_sweep(); });
  out.plain({"sweep clear", "Sweep: delete the points", "", "delete"}, [&model] { model.tuning().clear_points(); });
}

void add_derived(CommandList& out, AppModel& model, MenuBar& menu) {
  enter(out, model, menu, {"derived curve", "Plots: derived curve", "", "difference derivative filter magnitude"},
        "NAME", "plots/derived/how");
  for (const char* operand : {"a", "b", "c"})
    enter(out, model, menu,
          {std::string("derived ") + operand, std::string("Plots: curve ") + operand + " of the derived one", "",
           "channel"},
          "NAME", std::string("plots/derived/") + operand);
  enter(out, model, menu, {"derived cutoff", "Plots: the derived curve's low-pass, up to", "", "filter frequency"},
        "NAME", "plots/derived/cutoff");
  press(out, model, menu, {"legend", "Plots: what bands and marks mean", "", "flags colours key"}, "plots/legend");
}

void add_saving(CommandList& out, AppModel& model) {
  struct Saved {
    const char* name;
    const char* title;
    SaveWhat what;
  };
  for (const Saved& saved : {Saved{"save plots", "Plots: save as SVG or PDF...", SaveWhat::plots},
                             Saved{"save scene", "View: save a picture of the scene...", SaveWhat::scene},
                             Saved{"save map", "Map: save as CSV...", SaveWhat::map},
                             Saved{"save planes", "Iterations: save the planes as CSV...", SaveWhat::planes}})
    out.plain({saved.name, saved.title, "", "export write file figure paper table"},
              [&model, what = saved.what] { ask_to_save(model, what); });
}

}  // namespace

void add_tuning_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_comparing(out, model, menu);
  add_sweep(out, model, menu);
  add_derived(out, model, menu);
  add_saving(out, model);
}

}  // namespace tangent
