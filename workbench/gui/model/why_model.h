// Why the tick in view did what it did (core/lab/explain), found out by a thread of its own while the view is paused:
// the window never waits for it. Whoever shows it asks in every frame; only the newest question counts.
#pragma once

#include "core/lab/explain/explain_tick.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/gui/model/view_model.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tangent {

/// A tick as it was given.
struct WhyAsked {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  TickInput input;
  TickState before;
  std::uint64_t tick = 0;
};

struct Why {
  WhyAsked asked;
  TickExplanation told;
  double ms = 0.0;  ///< that it took; 0 in deterministic mode
};

class WhyModel {
 public:
  WhyModel(const AppOptions& options, TimeModel& time, PresetModel& presets, ViewModel& view, const SceneModel& scene,
           MessageLog& messages);
  ~WhyModel();

  /// Of the tick in view; asks for it where it is not known yet. Null: live, no tick, or not found out yet.
  const Why* of_tick_in_view();
  bool looking() const { return looking_; }  ///< it is being found out

  // What a person can do about it. Without an answer, or where there is nothing to do, a message says so.
  bool can_try() const;  ///< the cure that is known, on a recorded tick
  void try_cure();       ///< the past is solved with the cured value beside the one it had, as a ghost
  void set_cure();       ///< the value in use becomes the cured one, as one step of undo
  bool can_go() const;   ///< there is a place on the mesh in view
  void go_to_place();    ///< camera there, triangle picked

 private:
  void ask(WhyAsked asked);
  void work(const std::stop_token& stop);
  void take_answer();
  const TickCure* cure();

  TimeModel& time_;
  PresetModel& presets_;
  ViewModel& view_;
  const SceneModel& scene_;
  MessageLog& messages_;
  const bool threaded_;
  bool looking_ = false;
  std::optional<WhyAsked> asked_;     ///< the newest question
  std::shared_ptr<const Why> known_;  ///< the newest answer

  std::mutex guard_;  ///< of the two below
  std::condition_variable_any wake_;
  std::optional<WhyAsked> waiting_;
  std::shared_ptr<const Why> done_;
  std::jthread thread_;
};

}  // namespace tangent
