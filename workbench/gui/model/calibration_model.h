// A guided calibration of the chosen force device's torque scale by a spring scale (workbench/bringup/), which the
// session gives up meanwhile.
#pragma once

#include "workbench/bringup/force_calibration.h"
#include "workbench/bringup/guided_runner.h"
#include "workbench/gui/model/asked_since.h"
#include "workbench/gui/model/device_model.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace tangent {

class CalibrationModel {
 public:
  /// `deterministic`: in simulated time, by `advance`. `kept`: file of the torque scales; empty: none is kept.
  CalibrationModel(DeviceModel& devices, MessageLog& messages, bool deterministic, std::filesystem::path kept);

  /// The chosen force device has a torque scale to be calibrated, or is a simulated one to rehearse it on.
  bool possible() const;
  /// The session ends, and the device is opened. Nothing moves. A message where it can't be.
  void begin();
  /// Zero force; the device goes back to a session, which arms nothing, with the scale that was kept.
  void end();
  void stop();  ///< zero force; nothing is kept
  bool open() const { return runner_ != nullptr; }
  bool under_way() const { return open() && !view().ended; }

  void update();  ///< once a frame
  void advance(std::uint64_t ticks);
  void answer(BringUpAnswer answer);
  /// An answer makes sense now: not right after the question before, with a real device.
  bool settled() const { return open() && runner_->settled() && (capabilities().simulated || asked_.long_enough()); }
  /// What the scale shows, as typed: "0.27". A message where it is no reading.
  void type_reading(const std::string& text);
  const std::optional<double>& typed_n() const { return typed_n_; }
  void take_reading();  ///< the typed one is the answer
  const CalibrationView& view() const { return view_; }
  const ForceCapabilities& capabilities() const { return runner_->capabilities(); }
  std::string serial() const { return runner_->serial(); }
  double used_scale() const { return used_scale_; }  ///< counts for 1 N m that it pulls with
  bool rehearsal() const { return rehearsal_; }
  /// After the end: the scale, or why there is none.
  const std::optional<Result<double>>& scale() const { return scale_; }
  const std::string& kept_text() const { return kept_text_; }  ///< where it is kept; empty: it is not

 private:
  void finish();

  DeviceModel& devices_;
  MessageLog& messages_;
  bool deterministic_;
  std::filesystem::path kept_;
  std::unique_ptr<GuidedRunner<ForceCalibration>> runner_;
  CalibrationView view_;
  double used_scale_ = 0.0;
  bool rehearsal_ = false;
  std::optional<double> typed_n_;
  AskedSince asked_;
  std::optional<Result<double>> scale_;
  std::string kept_text_;
};

}  // namespace tangent
