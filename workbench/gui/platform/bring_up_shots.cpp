#include "workbench/gui/platform/bring_up_shots.h"

#include "workbench/gui/model/app_model.h"

#include <cstdio>

namespace tangent {
namespace {

constexpr std::uint64_t kTurn = 20;     // ticks between two looks
constexpr int kMostTurns = 20'000;      // 400 s of simulated time
constexpr std::size_t kShown_push = 2;  // before it there are so many
constexpr std::size_t kShown_reading = 2;

void begin_bring_up(AppModel& model) {
  model.view().device_monitor = true;
  model.bring_up().begin();
}

/// Yes to everything, until `shown` is asked.
template <class Shown>
void answer_until(AppModel& model, const Shown& shown) {
  BringUpModel& bring_up = model.bring_up();
  for (int i = 0; i < kMostTurns && bring_up.under_way(); ++i) {
    if (bring_up.view().asks() && bring_up.settled()) {
      if (shown(bring_up.view())) return;
      bring_up.answer(BringUpAnswer::yes);
    }
    bring_up.advance(kTurn);
  }
}

}  // namespace

void show_bring_up_home(AppModel& model) {
  begin_bring_up(model);
  answer_until(model, [](const BringUpView&) { return true; });
}

void show_bring_up_axes(AppModel& model) {
  begin_bring_up(model);
  answer_until(model, [](const BringUpView& view) { return view.ask == BringUpAsk::move && view.axis == 1; });
}

void show_bring_up_push(AppModel& model) {
  begin_bring_up(model);
  answer_until(model, [](const BringUpView& view) {
    return view.ask == BringUpAsk::push && view.facts.push_count == kShown_push;
  });
}

void show_bring_up_result(AppModel& model) {
  begin_bring_up(model);
  answer_until(model, [](const BringUpView&) { return false; });
}

void show_calibration(AppModel& model) {
  model.view().device_monitor = true;
  CalibrationModel& calibration = model.calibration();
  calibration.begin();
  for (int i = 0; i < kMostTurns && calibration.under_way(); ++i) {
    const CalibrationView& view = calibration.view();
    if (view.asks() && calibration.settled()) {
      if (view.ask == CalibrationAsk::reading) {
        char typed[16];
        std::snprintf(typed, sizeof typed, "%.2f", 0.98 * view.sent_n.z * -1.0);
        calibration.type_reading(typed);
        if (view.reading_count == kShown_reading) return;
        calibration.take_reading();
      } else {
        calibration.answer(BringUpAnswer::yes);
      }
    }
    calibration.advance(kTurn);
  }
}

}  // namespace tangent
