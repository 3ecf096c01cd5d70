// Commands of time, plots, force and devices.
#include "devices/device_set.h"
#include "devices/fault_injection.h"
#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/panels/wish.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kLargestTick = 1e12;

std::vector<std::string> strings(std::span<const std::string_view> names) { return {names.begin(), names.end()}; }

/// Where there is such a tick.
void go_to_tick(AppModel& model, double tick) {
  TimeModel& time = model.time();
  const OpenedRecording* const recording = time.recording();
  const std::uint64_t first = recording != nullptr ? recording->info().first_tick : time.first_tick();
  const std::uint64_t end = recording != nullptr ? recording->info().last_tick + 1 : time.end_tick();
  if (tick >= static_cast<double>(first) && tick < static_cast<double>(end))
    return time.select_tick(static_cast<std::uint64_t>(tick));
  model.messages().refuse(end > first ? "there is no tick " + printed("%.0f", tick) + ": they are " +
                                            std::to_string(first) + " to " + std::to_string(end - 1)
                                      : "there are no ticks yet");
}

void go_to_iteration(AppModel& model, double row) {
  TimeModel& time = model.time();
  time.set_paused(true);
  time.tick().select(static_cast<std::size_t>(row));
  if (!time.tick().selected())
    model.messages().refuse("this tick has no iteration " + printed("%.0f", row) + ": it has " +
                            std::to_string(time.tick().iterations().size()) + ", from 0");
}

void add_stepping(CommandList& out, AppModel& model) {
  TimeModel& time = model.time();
  out.on_off(
      {"pause", "Time: pause or go on", "Space", "freeze hold play stop"}, [&time] { return time.paused(); },
      [&time](bool on) { time.set_paused(on); });
  out.plain({"live", "Time: newest tick, live", "End", "follow now"}, [&time] { time.go_live(); });
  out.plain({"oldest", "Time: oldest tick", "Home", "first begin"}, [&time] { time.select_tick(time.first_tick()); });
  out.number({"tick", "Time: go to the tick", "", "select jump"}, "", 0.0, kLargestTick,
             [&model](double tick) { go_to_tick(model, tick); });
  out.number({"time", "Time: go to the time", "", "select jump seconds"}, "s", 0.0, kLargestTick,
             [&model](double t_s) { go_to_tick(model, std::round(t_s / model.time().tick_period_s())); });
  out.number({"step", "Time: step by ticks", "Left, Right", "next previous forward back"}, "", -kLargestTick,
             kLargestTick, [&time](double by) { time.step_tick(static_cast<std::int64_t>(by)); });
  out.number({"step iteration", "Time: step by iterations", ", and .", "next previous plane"}, "", -1000.0, 1000.0,
             [&time](double by) { time.step_iteration(static_cast<int>(by)); });
  out.number({"iteration", "Time: select the iteration", "", "plane row"}, "", 0.0, 1e6,
             [&model](double row) { go_to_iteration(model, row); });
}

bool has_automatic(const Bookmarks& bookmarks) {
  return std::any_of(bookmarks.all().begin(), bookmarks.all().end(),
                     [](const Bookmark& mark) { return mark.kind != BookmarkKind::user; });
}

void add_bookmarks(CommandList& out, AppModel& model) {
  TimeModel& time = model.time();
  out.plain({"bookmark", "Time: bookmark this tick", "K", "mark add"}, [&time] { time.add_bookmark(); });
  out.text({"bookmark note", "Time: bookmark this tick with a note", "", "mark comment"}, "TEXT",
           [&time](const std::string& note) -> Status {
             const ServoRecord* record = time.tick().record();
             if (record == nullptr) return fail("there is no tick to bookmark", {}, "let the servo run first");
             const TickRecord& tick = record->tick;
             time.bookmarks().set_note(time.bookmarks().add(tick.tick, tick.input.t_s), note);
             return {};
           });
  out.plain({"previous bookmark", "Time: previous bookmark", "[", "back"}, [&time] { time.go_to_bookmark(-1); });
  out.plain({"next bookmark", "Time: next bookmark", "]", "forward"}, [&time] { time.go_to_bookmark(1); });
  out.plain({"clear triggered", "Bookmarks: clear those that triggers set", "", "remove delete automatic"},
            when(
                model, [&time] { return has_automatic(time.bookmarks()); }, "no trigger has set a bookmark",
                [&time] { time.bookmarks().clear_automatic(); }));
  BookmarkTriggers& triggers = time.live_bookmarks().triggers;
  for (std::size_t k = 1; k < kBookmarkKindCount; ++k) {
    const std::string kind = to_string(static_cast<BookmarkKind>(k));
    out.flag({"trigger " + kind, "Bookmarks: set by " + kind, "", "trigger automatic"}, triggers.on[k]);
  }
  out.number({"trigger iterations over", "Bookmarks: iterations over", "", "trigger threshold"}, "", 0.0, 200.0,
             [&triggers](double over) { triggers.iterations_over = static_cast<std::int32_t>(over); });
  out.number({"trigger force over", "Bookmarks: force over", "", "trigger threshold"}, "N", 0.0, 20.0,
             [&triggers](double over) { triggers.force_over_n = over; });
}

void add_recordings(CommandList& out, AppModel& model, MenuBar& menu) {
  RecordModel& record = model.record();
  out.on_off(
      {"record", "Recording: every tick from now on, into a new file", "R", "write sqlite red"},
      [&record] { return record.recording(); }, [&record](bool on) { on ? record.start() : record.stop(); });
  const auto into = [&out](CommandNames names, auto act) {
    out.text(std::move(names), "FILE", [act](const std::string& file) -> Status {
      act(std::filesystem::path(file));
      return {};
    });
  };
  into({"record to", "Recording: every tick from now on, into the file", "", "write sqlite"},
       [&record](const std::filesystem::path& file) { record.start(file); });
  out.plain({"record history", "Recording: all that is in the history", "", "write past whole sqlite"},
            [&record] { record.write_history(); });
  into({"record history to", "Recording: all that is in the history, into the file", "", "write past sqlite"},
       [&record](const std::filesystem::path& file) { record.write_history(file); });
  out.plain({"record selection", "Recording: from cursor A to B", "", "write part sqlite"},
            [&record] { record.write_selection(); });
  into({"record selection to", "Recording: from cursor A to B, into the file", "", "write part sqlite"},
       [&record](const std::filesystem::path& file) { record.write_selection(file); });
  out.text({"save session", "Session: save it in the file, with what is not recorded yet beside it", "",
            "write layout camera bookmarks"},
           "FILE", [&menu](const std::string& file) -> Status {
             menu.wish.session = file;
             return {};
           });
  out.plain({"save session as", "Session: save it in a file that one chooses", "", "write layout dialogue"},
            [&model] { ask_to_save(model, SaveWhat::session); });
  out.plain({"open recording", "Recording: open a file", "Ctrl+O", "load read replay sqlite"},
            [&menu] { menu.path.open = menu.path.focus = true; });
  out.plain({"close recording", "Recording: close it, back to live", "End", "leave replay"},
            when(
                model, [&model] { return model.time().recording() != nullptr; }, "no recording is open",
                [&model] { model.time().go_live(); }));
}

void add_plots(CommandList& out, AppModel& model, MenuBar& menu) {
  out.plain({"solve past", "Time: solve the past with the current values", "", "again ghost what if"},
            [&model] { model.time().solve_past_again(); });
  out.plain({"export ticks", "Plots: ticks in view as CSV", "", "save write file samples table"}, [&model] {
    const auto [from, to] = ticks_in_view(model.time());
    model.exports().write_ticks(model.time().past().shown().records, from, to, file_origin(model));
  });
  out.plain({"cancel export", "Plots: stop writing the file", "", "save stop"},
            when(
                model, [&model] { return model.exports().writing(); }, "no file is being written",
                [&model] { model.exports().cancel(); }));
  out.plain({"export plots", "Plots: picture of the plots as PNG", "", "save write file image"},
            [&model, &menu] { wish(model, menu, "plots/png"); });
  out.choice({"plots", "Plots:", "", "show kind mode"}, {"Time", "X-Y", "Spectrum", "Histogram"},
             [&model, &menu](std::size_t i) {
               constexpr const char* kPaths[]{"plots/mode/Time", "plots/mode/X-Y", "plots/mode/Spectrum",
                                              "plots/mode/Histogram"};
               wish(model, menu, kPaths[i]);
             });
  out.plain({"plot values", "Plots: table of values, on or off", "", "numbers mean rms"},
            [&model, &menu] { wish(model, menu, "plots/values"); });
  out.plain({"cursor a", "Plots: cursor A at this tick, or none", "", "measure"},
            [&model, &menu] { wish(model, menu, "plots/cursor_a"); });
  out.plain({"cursor b", "Plots: cursor B at this tick, or none", "", "measure"},
            [&model, &menu] { wish(model, menu, "plots/cursor_b"); });
  out.text({"curve across", "Plots: curve of X-Y across, of spectrum and histogram", "", "channel x"}, "NAME",
           [&model, &menu](const std::string& name) { return wish(model, menu, "plots/curve_x", name), Status(); });
  out.text({"curve up", "Plots: curve of X-Y up", "", "channel y"}, "NAME",
           [&model, &menu](const std::string& name) { return wish(model, menu, "plots/curve_y", name), Status(); });
  out.plain({"hold plots", "Plots: hold the axes", "", "freeze"}, [&time = model.time()] {
    time.set_paused(false);
    time.axis().hold();
  });
  out.plain({"whole time", "Plots: all that is recorded", "", "show everything zoom out"},
            [&time = model.time()] { time.axis().show_all(); });
  out.number({"last", "Plots: this much of the time, up to the newest tick", "", "zoom seconds span"}, "s", 0.008, 1e5,
             [&time = model.time()](double span_s) {
               const auto end = static_cast<double>(time.end_tick());
               time.axis().show(end - span_s / time.tick_period_s(), end);
             });
}

void add_devices(CommandList& out, AppModel& model, MenuBar& menu) {
  DeviceModel& devices = model.devices();
  out.plain({"stop", "Force: stop", "Esc", "halt emergency off disarm"}, [&devices] { devices.stop(); });
  out.plain({"arm", "Force: arm", "", "on enable clear faults"}, [&devices] { devices.arm(); });
  out.plain({"home", "Devices: home both, without force", "", "reference calibrate"}, [&devices] {
    if (devices.session() != nullptr) devices.session()->home();
  });
  out.choice_of({"force device", "Force device:"}, "NAME", force_device_names(), [&devices](std::size_t i) {
    devices.choose({force_device_names()[i], devices.names().display});
  });
  out.choice_of({"contact display", "Contact display:"}, "NAME", contact_display_names(), [&devices](std::size_t i) {
    devices.choose({devices.names().force, contact_display_names()[i]});
  });
  out.on_off(
      {"hand follows mouse", "Hand: follows the mouse, or explores by itself", "M", "lead drag"},
      [&devices] { return devices.hand_follows_mouse(); }, [&devices](bool on) { devices.set_hand_follows_mouse(on); });
  for (const bool display : {false, true}) {
    const std::string which = display ? "display" : "force device";
    out.choice({"inject into " + which, "Fault of the simulated " + which + ":", "", "inject test"},
               strings(injected_fault_names()), [&devices, &menu, display](std::size_t i) {
                 menu.wish.time_passes = true;
                 const auto kind = injected_fault(injected_fault_names()[i]);
                 if (kind && devices.session() != nullptr) devices.session()->inject({*kind, 100}, display);
               });
  }
}

void add_placement(CommandList& out, AppModel& model, MenuBar& menu) {
  DeviceModel& devices = model.devices();
  const auto field = [&](CommandNames names, const char* path, const char* unit, double min, double max) {
    out.number(std::move(names), unit, min, max, [&model, &menu, path = std::string(path)](double value) {
      wish(model, menu, path, printed("%.15g", value));
    });
  };
  field({"hand speed", "Hand: speed along its path"}, "devices/hand_speed", "mm/s", 0.0, 500.0);
  field({"hand depth", "Hand: how deep it aims"}, "devices/hand_press", "mm", 0.0, 10.0);
  out.plain({"fit to workspace", "Placement: fit the scene to the device's workspace"},
            [&devices] { devices.fit_to_workspace(); });
  out.flag({"clutch", "Placement: clutch, hold or let go", ""}, devices.clutch().latched);
  field({"placement scale", "Placement: scale"}, "placement/scale", "", 0.001, 1000.0);
  for (const char* axis : {"x", "y", "z"}) {
    const std::string a = axis;
    field({"placement " + a, "Placement: device at " + a}, ("placement/offset_" + a).c_str(), "mm", -1e6, 1e6);
    field({"placement turn " + a, "Placement: turned about " + a}, ("placement/rotate_" + a).c_str(), "deg", -360.0,
          360.0);
  }
}

void add_guard(CommandList& out, AppModel& model) {
  GuardModel& guard = model.guard();
  out.flag({"guarded tuning", "Guard: ask before what is not known to be safe, undo what makes the gate act", "",
            "live safe"},
           guard.on);
  out.plain({"guard find", "Guard: find safe ranges in the simulated hand", "", "sweep stable shakes"},
            [&guard] { guard.find_ranges(); });
  out.plain(
      {"guard cancel", "Guard: stop finding, keep what is known", "", "safe ranges"},
      when(
          model, [&guard] { return guard.finding(); }, "no safe ranges are being found", [&guard] { guard.cancel(); }));
  out.plain({"guard no", "Guard: no, keep the values of the devices", "Enter", "answer question"},
            [&guard] { guard.answer(false); });
  out.plain({"guard yes", "Guard: yes, send the change to the armed device", "", "answer question"},
            [&guard] { guard.answer(true); });
}

}  // namespace

void add_time_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_stepping(out, model);
  add_bookmarks(out, model);
  add_recordings(out, model, menu);
  add_plots(out, model, menu);
  add_devices(out, model, menu);
  add_placement(out, model, menu);
  add_guard(out, model);
}

}  // namespace tangent
