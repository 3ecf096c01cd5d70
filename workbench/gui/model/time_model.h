// Time in the window: incoming records, the tick in view, bookmarks, and the past solved again. Pausing freezes the
// view, never the servo or the recording: what is in view stays there and can be solved, however long one looks at it.
// Whatever store() holds is recorded and can be solved.
//
// A recording that is opened takes the place of the live past until go_live(): paused, with plots, bookmarks and marks
// of its own. The servo and its history go on beside it.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/asked_range.h"
#include "workbench/gui/model/beside_tick.h"
#include "workbench/gui/model/device_model.h"
#include "workbench/gui/model/error_fan.h"
#include "workbench/gui/model/live_beside.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/opened_recording.h"
#include "workbench/gui/model/parameter_marks.h"
#include "workbench/gui/model/placed_tick.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/recorded_past.h"
#include "workbench/gui/model/tick_channels.h"
#include "workbench/gui/model/tick_view.h"
#include "workbench/gui/model/time_machine.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/session/bookmarks.h"
#include "workbench/session/unsaved_work.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

class TimeModel {
 public:
  TimeModel(const AppOptions& options, DeviceModel& devices, const PresetModel& presets, MessageLog& messages);

  // Called by the other parts.
  void take_records();  ///< takes in new records
  void show_tick();     ///< shows the newest, or the chosen one while paused
  void forget();        ///< a new run begins: live, with an empty history
  void preset_sent();   ///< presets.current() was sent: the ghost follows it
  /// presets.current() is held back and asked about while the devices have this one; null: they have it.
  void set_in_force(const Preset* in_force);

  /// Shows a recording, at its first tick.
  void show(std::unique_ptr<OpenedRecording> recording);
  const OpenedRecording* recording() const { return recording_.get(); }  ///< null: none is open
  /// Those of a session that was saved in place of a person's.
  void take_bookmarks(const std::vector<UnsavedBookmark>& marks);
  /// A mesh that was opened: the one that the recording asks for, perhaps.
  void offer_scene(const std::shared_ptr<const ContactScene>& scene);

  bool paused() const { return paused_; }
  void set_paused(bool paused);
  void go_live();                        ///< closes the recording that is open
  void step_tick(std::int64_t by);       ///< pauses; stops at the newest
  void select_tick(std::uint64_t tick);  ///< pauses on the nearest recorded tick
  void step_iteration(int by);           ///< through the iterations; past the ends to the next tick
  const TickView& tick() const { return tick_; }
  TickView& tick() { return tick_; }
  const ErrorFan& error_fan() const { return error_fan_; }  ///< of the ticks up to the one in view
  /// The tick in view under another preset: that of the ghost; without one, of the other slot if that is wanted.
  const BesideTick& beside() const { return beside_; }
  bool other_slot_beside = false;  ///< also while live
  /// Pale curves of the plots: the ghost, or while live those of the other slot if that is wanted. Null: none.
  std::shared_ptr<const ChannelStore> ghost_channels() const;
  const Preset* preset(std::uint32_t id) const;               ///< of a record in view; null: gone
  const Preset* preset_of_tick() const;                       ///< under which the tick in view ran; null: none
  std::shared_ptr<const ContactScene> scene_of_tick() const;  ///< on which it ran; null: none

  // A tick at a place, without waiting for the finger (placed_tick.h). It is in view until another tick is chosen.
  /// False where the finger can't rest there; a message says so.
  bool solve_at(const std::shared_ptr<const ContactScene>& scene, std::uint32_t triangle, double u, double v,
                const MoveOptions& options);
  const PlacedTick* placed() const { return placed_ ? &*placed_ : nullptr; }  ///< null: a recorded tick is in view
  void choose_move(std::size_t move);
  void leave_place();  ///< back to the recorded tick

  /// Of what is in view: of a recording its own.
  Bookmarks& bookmarks() { return recording_ ? recording_->bookmarks() : bookmarks_; }
  const Bookmarks& bookmarks() const { return recording_ ? recording_->bookmarks() : bookmarks_; }
  Bookmarks& live_bookmarks() { return bookmarks_; }
  const Bookmarks& live_bookmarks() const { return bookmarks_; }
  void add_bookmark();          ///< on the tick in view
  void go_to_bookmark(int by);  ///< the next (1) or previous (-1); a message when there is none
  std::span<const ParameterMark> parameter_marks() const {
    return recording_ ? recording_->parameter_marks() : std::span<const ParameterMark>(parameter_marks_);
  }

  /// The recorded ticks that can be shown. While paused they stay, and newer ones are added while there is room.
  const RecordedPast& past() const { return past_; }
  bool reaches(std::uint64_t tick) const;  ///< whether select_tick finds it
  std::size_t frozen_bytes() const;        ///< of records held beyond the history
  std::uint64_t newest_recorded() const;
  /// Cursors A and B, in any order: the ticks that comparison, sweep and advice work on. Empty: all of them.
  void set_selection(const std::optional<TickRange>& range);
  const std::optional<TickRange>& selection() const { return selection_; }
  bool selection_kept() const { return selection_ && past_.part_with(*selection_) != nullptr; }
  // Of a recording the selection is read when it is to be solved, if it is not there: it may lie anywhere, and be as
  // long as memory allows (asked_range.h).
  /// True: nothing has to be read. Otherwise it is being read, or a message says why it can't be.
  bool load_selection();
  bool selection_solvable() const { return selection_kept() || selection_to_load() || selection_loading(); }
  bool selection_to_load() const { return recording_ && selection_ && !selection_kept() && !selection_loading(); }
  bool selection_loading() const { return asked_ && asked_->loading(); }
  double selection_progress() const { return asked_ ? asked_->progress() : 0.0; }
  void cancel_loading();  ///< of the selection
  /// The selection, or without one all ticks of the part in view; empty: nothing is recorded.
  std::optional<TickRange> chosen_range() const;
  /// Its records, to be solved again. Empty: they are gone.
  std::optional<RunPart> run_over(const TickRange& range) const;

  const ChannelStore& store() const { return recording_ ? recording_->store() : kept_store_ ? *kept_store_ : store_; }
  TimeAxis& axis() { return axis_; }
  const TimeAxis& axis() const { return axis_; }
  std::uint64_t first_tick() const { return store().first_tick(); }
  std::uint64_t end_tick() const { return store().end_tick(); }
  double tick_period_s() const;
  std::size_t history_bytes() const, most_history_bytes() const;  ///< of the records, without the plots' store()

  // The past solved again: while paused, whenever the preset differs from the one at the pause.
  TimeMachine& time_machine() { return time_machine_; }
  const TimeMachine& time_machine() const { return time_machine_; }
  std::shared_ptr<const Ghost> ghost() const { return time_machine_.ghost(); }
  void solve_past_again();  ///< under the current preset, even if unchanged. Pauses
  /// Two presets over chosen_range(), the second one as the ghost. Pauses.
  struct NamedPreset {
    std::string name;
    Preset preset;
  };
  void compare(const NamedPreset& before, const NamedPreset& after);
  const std::string& name_before() const { return name_before_; }  ///< of time_machine().compared()
  const std::string& name_after() const { return name_after_; }

 private:
  const HistorySnapshot& records() const { return past_.shown().records; }
  RecordedRun run_of(const PastPart& part) const;
  const PastPart& part_to_solve() const;
  void solve_again(const Preset& under);
  void take_selection();
  void take_page();
  void show_page();
  void open_time_machine();
  void show_part();
  void forget_place();
  void take_in();
  void show_beside();
  void request_comparison();
  void mark_parameters(const ServoRecord& record);
  void update_axis();

  DeviceModel& devices_;
  const PresetModel& presets_;
  MessageLog& messages_;
  bool paused_ = false;
  std::optional<std::uint64_t> cursor_;  ///< the tick in view while paused
  TickView tick_;
  BesideTick beside_;
  LiveBeside live_beside_;
  std::optional<PlacedTick> placed_;
  ErrorFan error_fan_;
  std::unique_ptr<OpenedRecording> recording_;
  std::unique_ptr<AskedRange> asked_;      ///< of the recording; null: nothing was asked for
  std::optional<Preset> solve_when_read_;  ///< what was asked meanwhile
  const std::size_t solved_bytes_;
  const bool threaded_;
  RecordedPast past_, live_past_;  ///< live_past_: while a recording is open
  std::optional<TickRange> selection_;
  ChannelStore store_;
  std::unique_ptr<ChannelStore> kept_store_;  ///< of a kept part in view; null: none is
  TimeAxis axis_;
  Bookmarks bookmarks_;
  std::vector<ParameterMark> parameter_marks_;
  std::optional<std::uint32_t> last_preset_id_;  ///< of the newest record
  TimeMachine time_machine_;
  Preset paused_with_;              ///< preset in force when the view was paused
  std::optional<Preset> in_force_;  ///< presets.current() is only asked for
  std::optional<std::pair<NamedPreset, NamedPreset>> compared_by_hand_;
  std::string name_before_, name_after_;
};

}  // namespace tangent
