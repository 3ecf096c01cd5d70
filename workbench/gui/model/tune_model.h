// Tuning in the window: a search for the front of several numbers (workbench/sweep), in the background, that is looked
// at while it grows: brushed, and single trials tried on the servo and the recorded past. No ImGui.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/gui/model/tune_brush.h"
#include "workbench/gui/model/tune_question.h"
#include "workbench/gui/render/surface_paint.h"
#include "workbench/sweep/failure_places.h"
#include "workbench/sweep/front_job.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

class TuneModel {
 public:
  TuneModel(const AppOptions& options, PresetModel& presets, TimeModel& time, const SceneModel& scene,
            MessageLog& messages);

  void update();  ///< once a frame: takes in what the workers finished

  // The question. Changes count from the next start.
  const TuneQuestion& question() const { return question_; }
  /// Null: none, which the first can't be. One that is there already changes places.
  void set_objective(std::size_t i, const sweep::NumberColumn* column);
  /// At the end of the list: one more. Empty: it is taken out. Fails as parse_constraint does.
  Status set_constraint(std::size_t i, std::string_view text);
  /// At the end of the list: one more, over its slider's range. Null: it is taken out.
  void set_key(std::size_t i, const PresetKey* key);
  void set_range(std::size_t i, double from, double to);
  void set_motion(TuneMotion motion) { question_.motion = motion; }
  void set_trials(std::size_t trials);
  void set_evolve(bool evolve) { question_.evolve = evolve; }
  bool can_evolve() const { return can_evolve_; }          ///< the program was built with pagmo
  void leave_out_search(bool out) { can_evolve_ = !out; }  ///< as if it was not
  std::vector<const PresetKey*> keys() const;              ///< that the method reads and that take numbers

  void start();
  void cancel();  ///< at once; what was found stays
  void clear();
  bool running() const { return job_.running(); }

  // What was found: trials in the order in which they came.
  const std::vector<sweep::Trial>& trials() const { return trials_; }
  const TuneQuestion& asked() const { return asked_; }              ///< of the trials
  const std::vector<std::size_t>& front() const { return front_; }  ///< by the first objective
  bool on_front(std::size_t trial) const;
  std::optional<std::size_t> balanced() const;                     ///< of the front; empty: no trials
  const std::string& motion_text() const { return motion_text_; }  ///< "10,000 ticks of ..."
  bool outdated() const;                                           ///< another value or mesh since the start
  const std::optional<sweep::FrontVerdict>& verdict() const { return verdict_; }
  std::optional<double> theory(std::size_t range) const;  ///< of asked().ranges; empty: names none

  // The brush.
  const std::optional<TuneBrush>& brush() const { return brush_; }
  void set_brush(const std::optional<TuneBrush>& brush);
  bool brushed(std::size_t trial) const { return brush_ && brush_->holds(trials_[trial]); }
  /// The brushed trials, without a brush the front; by the first objective.
  const std::vector<std::size_t>& listed() const { return listed_; }

  // Where on the mesh the listed trials fail.
  bool failures_shown() const { return show_failures_; }
  void show_failures(bool show);
  bool looking_for_failures() const { return places_.running(); }
  std::optional<MapPaint> paint(ColourMap colours) const;   ///< empty: not shown, or of another mesh
  std::size_t failures_of() const { return failures_of_; }  ///< trials that were looked at
  double most_failures() const { return most_failures_; }   ///< largest share of a triangle

  // One trial, tried.
  /// Its values go into the other one of A and B, beside what there was, and to the servo; while paused the past is
  /// solved with them.
  void try_trial(std::size_t trial);
  std::optional<std::size_t> tried() const;   ///< beside what there was; empty: none
  std::optional<std::size_t> in_use() const;  ///< tried or kept
  void keep();                                ///< both slots have its values
  void put_back();                            ///< to the slot there was before
  void trial_refused();                       ///< a change was not set: maybe it was the trial
  bool can_attach() const;                    ///< it was tuned on the mesh in view
  /// The motion of the trials as evidence names it, and its poses where they have to be written.
  EvidenceMotion evidence_motion(const std::filesystem::path& folder) const;
  std::span<const TickInput> poses() const;

 private:
  using Load = std::function<Result<sweep::Ground>(const std::function<bool()>& stop)>;
  Result<Load> choose_motion();
  Result<Load> chosen_ticks();
  void add(sweep::Trial trial);
  void list();
  void look_for_failures();
  void take_failures(const std::vector<sweep::TicksThere>& found);
  Preset preset_of(std::size_t trial) const;
  bool has_values_of(std::size_t trial) const;  ///< the preset in use

  PresetModel& presets_;
  TimeModel& time_;
  const SceneModel& scene_;
  MessageLog& messages_;
  const bool deterministic_;
  bool can_evolve_;
  TuneQuestion question_, asked_;
  bool ranges_chosen_ = false;  ///< by a person: they no longer follow the method
  sweep::FrontJob job_;
  Preset base_;
  std::shared_ptr<const sweep::Ground> ground_;
  std::string motion_text_;
  EvidenceMotion motion_;
  std::vector<sweep::Trial> trials_;
  std::vector<std::size_t> front_, listed_;
  std::optional<sweep::FrontVerdict> verdict_;
  std::optional<TuneBrush> brush_;
  bool show_failures_ = false;
  sweep::FailurePlacesJob places_;
  std::vector<float> failures_;  ///< by usable triangle
  std::size_t failures_of_ = 0, wanted_of_ = 0;
  double most_failures_ = 0.0;
  std::uint64_t failures_version_ = 0;
  std::optional<std::size_t> chosen_;      ///< tried last
  std::optional<std::size_t> tried_slot_;  ///< that it was put into; empty: it was kept or put back
};

}  // namespace tangent
