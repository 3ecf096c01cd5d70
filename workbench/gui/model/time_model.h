// Time in the window: incoming records, the tick in view, bookmarks, and the past solved again. Pausing freezes the
// view, never the servo or the recording.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/device_model.h"
#include "workbench/gui/model/error_fan.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/tick_channels.h"
#include "workbench/gui/model/tick_view.h"
#include "workbench/gui/model/time_machine.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/session/bookmarks.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent {

/// The preset changed at this tick.
struct ParameterMark {
  std::uint64_t tick = 0;
  std::string text;  ///< "Curvature gain G_k 20 -> 13 mm", or the number of keys
};

class TimeModel {
 public:
  TimeModel(const AppOptions& options, DeviceModel& devices, const PresetModel& presets, MessageLog& messages);

  // Called by the other parts.
  void take_records();  ///< takes in new records
  void show_tick();     ///< shows the newest, or the chosen one while paused
  void forget();        ///< a new run begins: live, with an empty history
  void preset_sent();   ///< presets.current() was sent: the ghost follows it

  bool paused() const { return paused_; }
  void set_paused(bool paused);
  void go_live();
  void step_tick(std::int64_t by);       ///< pauses; stops at the newest
  void select_tick(std::uint64_t tick);  ///< pauses on the nearest recorded tick
  void step_iteration(int by);           ///< through the iterations; past the ends to the next tick
  const TickView& tick() const { return tick_; }
  TickView& tick() { return tick_; }
  const ErrorFan& error_fan() const { return error_fan_; }  ///< of the ticks up to the one in view

  Bookmarks& bookmarks() { return bookmarks_; }
  const Bookmarks& bookmarks() const { return bookmarks_; }
  void add_bookmark();          ///< on the tick in view
  void go_to_bookmark(int by);  ///< the next (1) or previous (-1); a message when there is none
  std::span<const ParameterMark> parameter_marks() const { return parameter_marks_; }

  const ChannelStore& store() const { return store_; }
  TimeAxis& axis() { return axis_; }
  const TimeAxis& axis() const { return axis_; }
  std::uint64_t first_tick() const { return store_.first_tick(); }
  std::uint64_t end_tick() const { return store_.end_tick(); }
  double tick_period_s() const;
  std::size_t history_bytes() const, most_history_bytes() const;  ///< of the records, without the plots' store()

  // The past solved again: while paused, whenever the preset differs from the one at the pause.
  TimeMachine& time_machine() { return time_machine_; }
  const TimeMachine& time_machine() const { return time_machine_; }
  std::shared_ptr<const Ghost> ghost() const { return time_machine_.ghost(); }
  void solve_past_again();  ///< under the current preset, even if unchanged. Pauses

 private:
  const History* history() const;  ///< null: nothing is recorded
  void mark_parameters(const ServoRecord& record);
  void update_axis();

  DeviceModel& devices_;
  const PresetModel& presets_;
  MessageLog& messages_;
  bool paused_ = false;
  std::optional<std::uint64_t> cursor_;  ///< the tick in view while paused
  TickView tick_;
  ErrorFan error_fan_;
  ChannelStore store_;
  TimeAxis axis_;
  Bookmarks bookmarks_;
  std::vector<ParameterMark> parameter_marks_;
  std::optional<std::uint32_t> last_preset_id_;  ///< of the newest record
  TimeMachine time_machine_;
  Preset paused_with_;  ///< preset when the view was paused
};

}  // namespace tangent
