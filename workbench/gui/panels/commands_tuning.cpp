// Commands of comparing and tuning: two presets on the same ticks, ticks at a place, sweeps, the plots' channels; and
// of saving all that as files.
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/curves_plot.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/panels/wish.h"

#include <functional>
#include <string_view>

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
  out.plain({"read selection", "Time machine: read the recording from cursor A to B, to solve it again", "", "load"},
            [&model] { model.time().load_selection(); });
  out.plain({"cancel reading", "Time machine: stop reading from cursor A to B", "", "load stop"},
            when(
                model, [&model] { return model.time().selection_loading(); }, "nothing is being read",
                [&model] { model.time().cancel_loading(); }));
  press(out, model, menu, {"solve at bookmark", "Bookmarks: solve at this one", "", "place here"}, "bookmarks/solve");
  press(out, model, menu, {"leave place", "Iterations: back to the recorded tick", "", "solve here end"},
        "iterations/leave_place");
  press(out, model, menu, {"iteration columns", "Iterations: choose the table's columns", "", "show hide ratio stop"},
        "iterations/columns");
}

void add_why(CommandList& out, AppModel& model) {
  out.plain({"why", "Why: pause, and say why this tick did what it did", "", "explain cause reason failed"}, [&model] {
    model.time().set_paused(true);
    model.window().show_section("Why this tick", false);
  });
  out.plain({"why try", "Why: try the cure on the recorded ticks", "", "ghost what if explain"},
            [&model] { model.why().try_cure(); });
  out.plain({"why set", "Why: set the cure", "", "apply take explain"}, [&model] { model.why().set_cure(); });
  out.plain({"why go", "Why: go to the place of the cause", "", "defect triangle look explain"},
            [&model] { model.why().go_to_place(); });
}

/// Of two recordings, in the section Compare recordings.
void add_recordings(CommandList& out, AppModel& model) {
  RecordingPairModel& recordings = model.recording_pair();
  const auto show = [&model] { model.window().show_section("Compare recordings", false); };
  const auto file = [&](CommandNames names, std::filesystem::path& to) {
    out.text(std::move(names), "FILE", [&to, show](const std::string& path) {
      to = path;
      show();
      return Status();
    });
  };
  file({"first recording", "Recordings: the first one to compare", "", "file sqlite open"}, recordings.first);
  file({"second recording", "Recordings: the second one to compare", "", "file sqlite open"}, recordings.second);
  out.plain({"no second recording", "Recordings: compare the first with its motion under the present values", ""},
            [&recordings] { recordings.second.clear(); });
  out.choice({"align recordings", "Recordings: aligned by", "", "time tick contact bookmark"},
             {kAlignByNames.begin(), kAlignByNames.end()},
             [&recordings](std::size_t i) { recordings.by = static_cast<AlignBy>(i); });
  out.choice({"recordings curve", "Recordings: the curve that is drawn", "", "channel plot"},
             {kComparedChannels.begin(), kComparedChannels.end()},
             [&recordings](std::size_t i) { recordings.channel = i; });
  out.plain({"compare recordings", "Recordings: compare", "", "difference align replay"}, [&recordings, show] {
    show();
    recordings.compare();
  });
  out.plain({"largest difference", "Recordings: go to the largest difference", "", "worst jump"},
            [&recordings] { recordings.go_to_largest(); });
  out.number({"compared tick", "Recordings: show this tick of the first, in the window's time", "", "go jump open"}, "",
             0.0, 1e12, [&model](double tick) {
               model.recording_pair().choose(static_cast<std::uint64_t>(tick));
               model.show_compared(false);
             });
  out.plain({"compared in first", "Recordings: show the chosen difference in the first", "", "go jump open tick"},
            [&model] { model.show_compared(false); });
  out.plain({"compared in second", "Recordings: show the chosen difference in the second", "", "go jump open tick"},
            [&model] { model.show_compared(true); });
  out.plain({"whole recordings", "Recordings: compare all ticks again", ""},
            [&recordings] { recordings.show_whole(); });
  out.plain({"stop comparing", "Recordings: stop, keep what is found", "", "cancel"},
            when(
                model, [&recordings] { return recordings.running(); }, "no recordings are being compared",
                [&recordings] { recordings.stop(); }));
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
  press(out, model, menu, {"heat map", "Sweep: two values as a heat map", "", "field colours gains tune"},
        "sweep/heat_map");
  TuningModel& tuning = model.tuning();
  out.choice(
      {"sweep shows", "Sweep: colours of two values show", "", "heat map mean p99 failures"},
      {TuningModel::kShows.begin(), TuningModel::kShows.end()},
      [&tuning](std::size_t i) { tuning.shows = static_cast<TuningModel::Shows>(i); }, static_cast<int>(tuning.shows));
  out.plain({"sweep cancel", "Sweep: stop, keep the points so far", ""},
            when(
                model, [&model] { return model.tuning().sweep().running(); }, "no sweep is running",
                [&model] { model.tuning().cancel_sweep(); }));
  out.plain({"sweep clear", "Sweep: delete the points", "", "delete"},
            when(
                model, [&model] { return !model.tuning().points().empty(); }, "there are no points",
                [&model] { model.tuning().clear_points(); }));
}

void add_curves(CommandList& out, AppModel& model, MenuBar& menu) {
  constexpr const char* kWords = "bench benchmark methods accuracy precision work curve";
  press(out, model, menu, {"speed start", "Speed against error: measure the chosen ticks", "", kWords}, "speed/start");
  out.plain({"speed cancel", "Speed against error: stop, keep the rounds so far", "", kWords},
            when(
                model, [&model] { return model.curves().running(); }, "nothing is being measured",
                [&model] { model.curves().cancel(); }));
  out.plain({"speed clear", "Speed against error: delete the curves", "", kWords},
            when(
                model, [&model] { return model.curves().curves() != nullptr; }, "there are no curves",
                [&model] { model.curves().clear(); }));
  out.choice({"speed time", "Speed against error: the time that is drawn", "", kWords}, {"median", "mean", "99"},
             [&model](std::size_t i) { model.curves().shown_time = static_cast<CurvesModel::Time>(i); });
  out.choice({"speed error", "Speed against error: the error that is drawn", "", kWords}, {"median", "99", "worst"},
             [&model](std::size_t i) { model.curves().shown_error = static_cast<CurvesModel::Error>(i); });
  out.number({"speed point", "Speed against error: open the worst tick behind the point of this number", "", kWords},
             "", 1.0, 1000.0, [&model](double n) {
               model.window().show_section("Speed against error", false);
               open_curve_point(model, static_cast<std::size_t>(n) - 1);
             });
}

/// "PLOT CHANNEL" in two.
Status on_plot(const std::string& text, const std::function<Status(std::string_view, std::string_view)>& act) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string::npos) return fail("a plot and a channel are needed", {}, "as in: plot add error force_x");
  return act(std::string_view(text).substr(0, blank), std::string_view(text).substr(blank + 1));
}

void add_channels(CommandList& out, AppModel& model, MenuBar& menu) {
  PlotLists& lists = model.window().plots();
  constexpr const char* kWords = "curve derived difference derivative filter magnitude drag";
  press(out, model, menu, {"channels", "Plots: list of channels, on or off", "", kWords}, "plots/channels");
  out.text({"plot add", "Plots: show the channel in the plot too", "", kWords}, "PLOT CHANNEL",
           [&lists](const std::string& text) {
             return on_plot(text, [&](auto plot, auto channel) { return lists.add(plot, channel); });
           });
  out.text({"plot remove", "Plots: take the channel out of the plot", "", "hide delete curve"}, "PLOT CHANNEL",
           [&lists](const std::string& text) {
             return on_plot(text, [&](auto plot, auto channel) { return lists.remove(plot, channel); });
           });
  out.plain({"default plots", "Plots: the channels that they had at first", "", "reset curves"},
            [&lists] { lists.reset(); });
  out.text({"make channel", "Plots: a derived channel to choose from", "", kWords}, "CHANNEL",
           [&lists](const std::string& text) { return lists.make(text); });
  out.text({"forget channel", "Plots: delete the derived channel", "", "remove curve"}, "CHANNEL",
           [&lists](const std::string& text) { return lists.forget(text); });
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
  add_why(out, model);
  add_recordings(out, model);
  add_sweep(out, model, menu);
  add_curves(out, model, menu);
  add_channels(out, model, menu);
  add_saving(out, model);
}

}  // namespace tangent
