#include "workbench/cli/calibrate_device.h"

#include "core/io/csv_table.h"
#include "workbench/bringup/force_calibration.h"
#include "workbench/bringup/guided_runner.h"
#include "workbench/cli/answer_keys.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/session/falcon_setups.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <utility>

namespace tangent {
namespace {

using CalibrationRunner = GuidedRunner<ForceCalibration>;

constexpr std::uint64_t kTicksPerQuestion = 16;  // between two looks, in simulated time
constexpr const char* kFalcon = "falcon";

CalibrationAnswer calibration_answer(AnswerKey key) {
  return {key == AnswerKey::yes  ? BringUpAnswer::yes
          : key == AnswerKey::no ? BringUpAnswer::no
                                 : BringUpAnswer::skip,
          0.0};
}

class CalibrationTalk {
 public:
  explicit CalibrationTalk(CalibrationRunner& runner) : runner_(runner) {}
  /// Says what is new, and passes on an answer where one came. Fails on one that is none.
  Status look() {
    const CalibrationView& view = runner_.view();
    if (view.asks() && view.questions != asked_) put_question(view);
    if (InterruptGuard::requested() || keys_.wants_stop()) return runner_.stop(), Status{};
    // `settled` may bring a newer view: a question that was not put yet isn't answered.
    if (!view.asks() || !runner_.settled() || view.questions != asked_) return {};
    return view.ask == CalibrationAsk::reading ? take_reading() : take_answer();
  }

 private:
  void put_question(const CalibrationView& view) {
    asked_ = view.questions;
    const bool number = view.ask == CalibrationAsk::reading;
    std::printf("%s [%s%s]\n", question_text(view, runner_.capabilities()).c_str(),
                number             ? "a number and Enter"
                : keys_.terminal() ? "y yes, n no"
                                   : "yes, no",
                keys_.terminal() ? ", Escape stop" : ", stop");
    std::fflush(stdout);
    if (!runner_.capabilities().simulated) keys_.drop();  // what was typed before it was asked for
  }
  Status take_answer() {
    const auto key = keys_.next();
    if (!key) return runner_.stop(), tl::unexpected(key.error());
    if (*key == AnswerKey::stop || (!*key && keys_.ended()))
      runner_.stop();
    else if (*key)
      runner_.answer(calibration_answer(**key));
    return {};
  }
  Status take_reading() {
    const auto line = keys_.next_line();
    if (!line && keys_.ended()) runner_.stop();
    if (!line) return {};
    if (*line == "no" || *line == "skip") return runner_.answer({BringUpAnswer::no, 0.0}), Status{};
    const auto read_n = newtons_of_line(*line);
    if (read_n) return runner_.answer({BringUpAnswer::yes, *read_n}), Status{};
    if (keys_.terminal()) return std::printf("%s is no reading in newtons\n", show_text(*line).c_str()), Status{};
    runner_.stop();
    return fail(show_text(*line) + " is no reading", "standard input", "write newtons, as 0.27");
  }

  CalibrationRunner& runner_;
  AnswerKeys keys_;
  std::uint32_t asked_ = 0;
};

/// Until it has ended.
Result<CalibrationView> go_through(std::unique_ptr<ForceDevice> device, bool threaded) {
  auto runner = CalibrationRunner::start(std::move(device), {.limits = {}, .threaded = threaded});
  if (!runner) return tl::unexpected(runner.error());
  CalibrationTalk talk(**runner);
  Status status;
  while (!(*runner)->view().ended) {
    if (threaded)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    else
      (*runner)->advance(kTicksPerQuestion);
    if ((*runner)->hangs())
      return fail("its driver does not come back from an exchange", (*runner)->capabilities().name,
                  "take the device's power away, then start again");
    if (const Status looked = talk.look(); !looked) status = looked;
  }
  if (!status) return tl::unexpected(status.error());
  return (*runner)->view();
}

Status keep_scale(const std::string& serial, double scale) {
  const std::filesystem::path path = falcon_setups_path();
  if (serial.empty() || path.empty()) {
    std::printf("No serial number to keep it by: give --falcon-torque-scale %.0f each time\n", scale);
    return {};
  }
  if (const Status kept = keep_falcon_scale(path, serial, scale); !kept) return kept;
  std::printf("%s: kept for serial number %s\n", path.c_str(), serial.c_str());
  return {};
}

}  // namespace

const std::vector<std::string_view>& calibrated_names() {
  static const std::vector<std::string_view> names{kFalcon, "simulated"};
  return names;
}

Result<int> calibrate_device(const DeviceCalibration& calibration) {
  DeviceOptions drivers = calibration.drivers;
  const bool real = calibration.kind == kFalcon;
  const double given = drivers.falcon.torque_counts_per_nm;  // what is kept may be what is wrong
  if (real) {
    auto falcon = chosen_falcon_options(drivers.falcon, falcon_setups_path());
    if (!falcon) return tl::unexpected(falcon.error());
    drivers.falcon = std::move(*falcon);
    drivers.falcon.torque_counts_per_nm = given;
  }
  auto made = make_devices({calibration.kind, "none"}, drivers);
  if (!made) return tl::unexpected(made.error());
  const InterruptGuard guard;
  const double used = given > 0.0 ? given : kFalconUncalibratedScale;
  std::printf("%s: begins with %.0f counts for 1 N m\n", made->force->capabilities().name.c_str(), used);
  if (real) std::printf("Keep a hand on its power switch: it may hold its last force when this program dies\n");
  const auto view = go_through(std::move(made->force), !calibration.without_waiting);
  if (!view) return tl::unexpected(view.error());
  const auto scale = calibrated_scale(*view, used);
  if (!scale) return tl::unexpected(scale.error());
  for (std::size_t i = 0; i < view->reading_count; ++i)
    std::printf("asked for %.2f N, read %.2f N\n", view->readings[i].asked_n, view->readings[i].read_n);
  std::printf("Torque scale: %.0f counts for 1 N m\n", *scale);
  if (!real) std::printf("A rehearsal: nothing is kept\n");
  if (const Status kept = real ? keep_scale(drivers.falcon.serial, std::round(*scale)) : Status{}; !kept)
    return tl::unexpected(kept.error());
  return kDone;
}

}  // namespace tangent
