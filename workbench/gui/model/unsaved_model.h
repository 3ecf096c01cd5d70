// Work that is in no file: kept while the window is open, for the case that it crashes, and offered again after it did.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/record_model.h"
#include "workbench/gui/model/recorded_place.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/session/unsaved_work.h"

#include <functional>
#include <optional>
#include <string>

namespace tangent {

class UnsavedModel {
 public:
  /// What a recording was looked at with: it is opened, at that place.
  using Reopen = std::function<void(const RecordedPlace& place, const UnsavedWork& work)>;
  /// Kept in the folder `unsaved` beside the settings; without settings nothing is.
  UnsavedModel(const AppOptions& options, PresetModel& presets, TimeModel& time, const RecordModel& record,
               MessageLog& messages, Reopen reopen);
  /// A window that is closed with changes that are in no file, or with notes on bookmarks, leaves them to the next one.
  ~UnsavedModel();
  UnsavedModel(const UnsavedModel&) = delete;
  UnsavedModel& operator=(const UnsavedModel&) = delete;

  void update(double now_s);  ///< once per frame; keeps the work every two seconds
  void keep();

  /// What an earlier run left, as a sentence; empty: nothing.
  std::string offer() const;
  void take_up();  ///< presets, undo and bookmarks, and the recording; arms nothing
  void discard();

 private:
  bool would_be_lost() const;
  UnsavedWork work_now() const;
  void keep(const UnsavedWork& work);
  void reopen(const UnsavedWork& work);

  PresetModel& presets_;
  TimeModel& time_;
  const RecordModel& record_;
  MessageLog& messages_;
  const Reopen reopen_;
  std::filesystem::path folder_;
  std::optional<LeftWork> left_;
  UnsavedKeeper keeper_;
  double looked_at_s_ = 0.0;
};

}  // namespace tangent
