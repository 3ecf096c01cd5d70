#include "workbench/gui/model/calibration_model.h"

#include "core/io/csv_table.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/bringup/scale_calibration.h"

#include <algorithm>
#include <utility>

namespace tangent {

CalibrationModel::CalibrationModel(DeviceModel& devices, MessageLog& messages, bool deterministic,
                                   std::filesystem::path kept)
    : devices_(devices), messages_(messages), deterministic_(deterministic), kept_(std::move(kept)) {
  devices_.also_stop([this] { stop(); });
}

bool CalibrationModel::possible() const {
  const auto& names = calibrated_names();
  return std::find(names.begin(), names.end(), devices_.names().force) != names.end();
}

void CalibrationModel::begin() {
  if (open() || devices_.lent()) return;
  auto made = scale_calibration(devices_.names().force, devices_.drivers(), kept_);
  if (!made) return messages_.say(Severity::error, made.error().message());
  devices_.lend();
  auto runner =
      GuidedRunner<ForceCalibration>::start(std::move(made->device), {.limits = {}, .threaded = !deterministic_});
  if (!runner) {
    messages_.say(Severity::error, runner.error().message());
    return devices_.give_back();
  }
  runner_ = std::move(*runner);
  used_scale_ = made->used_scale;
  rehearsal_ = made->rehearsal;
  scale_.reset();
  typed_n_.reset();
  kept_text_.clear();
  asked_.forget();
  view_ = runner_->view();
}

void CalibrationModel::end() {
  if (!open()) return;
  runner_.reset();
  devices_.give_back();
}

void CalibrationModel::stop() {
  if (open()) runner_->stop();
}

void CalibrationModel::update() {
  if (!open()) return;
  view_ = runner_->view();
  if (asked_.look(view_.questions, view_.t_s)) typed_n_.reset();  // the number was for another pull
  if (view_.ended && !scale_) finish();
}

void CalibrationModel::finish() {
  scale_ = calibrated_scale(view_, used_scale_);
  if (!*scale_) {
    const Severity how = view_.why == BringUpWhy::stopped ? Severity::note : Severity::error;
    return messages_.say(how, scale_->error().message());
  }
  if (rehearsal_) return;
  const auto kept = keep_scale(kept_, runner_->serial(), **scale_);
  if (kept) kept_text_ = *kept;
  messages_.say(kept ? Severity::note : Severity::error, kept ? *kept : kept.error().message());
}

void CalibrationModel::advance(std::uint64_t ticks) {
  if (!open()) return;
  runner_->advance(ticks);
  update();
}

void CalibrationModel::answer(BringUpAnswer answer) {
  if (open()) runner_->answer({answer, 0.0});
}

void CalibrationModel::type_reading(const std::string& text) {
  typed_n_ = newtons_of_line(text);
  if (!typed_n_) messages_.say(Severity::error, show_text(text) + " is no reading: write newtons, as 0.27, up to 100");
}

void CalibrationModel::take_reading() {
  if (open() && typed_n_) runner_->answer({BringUpAnswer::yes, *typed_n_});
}

}  // namespace tangent
