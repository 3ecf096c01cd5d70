#include "workbench/cli/calibrate_device.h"

#include "core/io/csv_table.h"
#include "workbench/bringup/force_calibration.h"
#include "workbench/bringup/guided_runner.h"
#include "workbench/bringup/scale_calibration.h"
#include "workbench/cli/answer_keys.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/usb_packet_log.h"
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
    // A question that was not put yet isn't answered.
    if (!view.asks() || !runner_.settled() || view.questions != asked_) return {};
    return view.ask == CalibrationAsk::reading ? take_reading() : take_answer();
  }

 private:
  void put_question(const CalibrationView& view) {
    asked_ = view.questions;
    if (!runner_.capabilities().simulated) keys_.drop();  // what was typed before it was asked for
    const bool number = view.ask == CalibrationAsk::reading;
    std::printf("%s [%s%s]\n", question_text(view, runner_.capabilities()).c_str(),
                number             ? "a number and Enter"
                : keys_.terminal() ? "y yes, n no"
                                   : "yes, no",
                keys_.terminal() ? ", Escape stop" : ", stop");
    std::fflush(stdout);
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

struct CalibrationEnd {
  CalibrationView view;
  std::string serial;  // of the device that was there
};

/// Until it has ended.
Result<CalibrationEnd> go_through(std::unique_ptr<ForceDevice> device, bool threaded, UsbPacketLog& packets) {
  auto runner = CalibrationRunner::start(std::move(device), {.limits = {}, .threaded = threaded});
  if (!runner) return tl::unexpected(runner.error());
  CalibrationTalk talk(**runner);
  Status status;
  while (!(*runner)->view().ended) {
    if (threaded)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    else
      (*runner)->advance(kTicksPerQuestion);
    if (const Status looked = talk.look(); !looked) status = looked;
  }
  if ((*runner)->view().why == BringUpWhy::hangs) packets.leave_behind();
  if (!status) return tl::unexpected(status.error());
  return CalibrationEnd{(*runner)->view(), (*runner)->serial()};
}

}  // namespace

Result<int> calibrate_device(const DeviceCalibration& calibration) {
  auto packets = UsbPacketLog::create(calibration.packets);
  if (!packets) return tl::unexpected(packets.error());
  DeviceOptions drivers = calibration.drivers;
  drivers.tap = packets->tap();
  auto made = scale_calibration(calibration.kind, drivers, falcon_setups_path());
  if (!made) return tl::unexpected(made.error());
  const double used = made->used_scale;
  const bool rehearsal = made->rehearsal;
  const InterruptGuard guard;
  std::printf("%s: begins with %.0f counts for 1 N m\n", made->device->capabilities().name.c_str(), used);
  if (!rehearsal) std::printf("Keep a hand on its power switch: it may hold its last force when this program dies\n");
  const auto end = go_through(std::move(made->device), !calibration.without_waiting, *packets);
  if (!end) return tl::unexpected(end.error());
  const CalibrationView& view = end->view;
  const auto scale = calibrated_scale(view, used);
  if (!scale) return tl::unexpected(scale.error());
  for (std::size_t i = 0; i < view.reading_count; ++i)
    std::printf("asked for %.2f N, read %.2f N\n", view.readings[i].asked_n, view.readings[i].read_n);
  std::printf("Torque scale: %.0f counts for 1 N m\n", *scale);
  const auto kept = rehearsal ? Result<std::string>("A rehearsal: nothing is kept")
                              : keep_scale(falcon_setups_path(), end->serial, *scale);
  if (!kept) return tl::unexpected(kept.error());
  std::printf("%s\n", kept->c_str());
  if (const Status logged = packets->complete(); !logged) return tl::unexpected(logged.error());
  return kDone;
}

}  // namespace tangent
