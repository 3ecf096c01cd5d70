// The evidence of the preset in use: checked in the background whenever another one is opened, and made of the selected
// ticks when a preset is saved. No ImGui.
#pragma once

#include "workbench/evidence/evidence_job.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/model/time_model.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tangent {

class EvidenceModel {
 public:
  EvidenceModel(const AppOptions& options, PresetModel& presets, const SceneModel& scene, const TimeModel& time,
                MessageLog& messages);

  /// Once a frame: takes in what the worker finished, and checks a preset that was opened since. In simulated time
  /// nothing is checked unasked: pictures would depend on it.
  void update();

  void check();   ///< the file of the active slot, now
  void cancel();  ///< at once
  bool running() const { return job_.running(); }
  const PresetCheck* result() const { return result_ ? &*result_ : nullptr; }  ///< of that file; null: not checked
  std::string label() const;                                                   ///< "holds"; empty: not checked

  /// Whether saving attaches the selection.
  bool wanted() const { return wanted_; }
  void set_wanted(bool wanted) { wanted_ = wanted; }
  /// Ticks are selected that ran on the mesh in view.
  bool can_attach() const { return selected_run().has_value(); }
  /// To the preset that was saved just now: writes the selected poses beside it, and measures in the background.
  void attach_selection();
  /// Likewise, a motion that was tuned on. `poses`: to write beside the preset, of the kind `poses`.
  void attach(EvidenceMotion motion, std::span<const TickInput> poses);

 private:
  std::optional<RunPart> selected_run() const;
  PresetEvidence asked_for(EvidenceMotion motion, const std::filesystem::path& folder) const;
  void take(Result<PresetFile> attached);

  PresetModel& presets_;
  const SceneModel& scene_;
  const TimeModel& time_;
  MessageLog& messages_;
  const bool deterministic_;
  bool wanted_ = true;
  EvidenceJob job_;
  std::optional<PresetCheck> result_;
  std::filesystem::path checked_path_, attached_to_;
  PresetFile checked_;
};

}  // namespace tangent
