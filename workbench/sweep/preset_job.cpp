#include "workbench/sweep/preset_job.h"

#include "workbench/session/background_thread.h"

#include <utility>

namespace tangent::sweep {

PresetJob::~PresetJob() { cancel(); }

void PresetJob::cancel() {
  cancelled_.store(true);
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void PresetJob::start(Ground ground, std::vector<Preset> presets, unsigned threads) {
  cancel();
  ground_ = std::move(ground);
  presets_ = std::move(presets);
  finished_.clear();
  next_.store(0);
  done_ = 0;
  cancelled_.store(false);
  for (unsigned t = 0; t < threads; ++t)
    threads_.emplace_back([this] {
      yield_to_servo_and_window();
      work();
    });
  if (threads == 0) work();
}

void PresetJob::work() {
  Stepper stepper(ground_.scene), exact(ground_.scene);
  for (std::size_t i = next_.fetch_add(1); i < presets_.size(); i = next_.fetch_add(1)) {
    const auto numbers =
        measure_cell(stepper, exact, presets_[i], *ground_.motion, [this] { return cancelled_.load(); });
    if (!numbers || cancelled_.load()) return;
    const std::scoped_lock lock(guard_);
    finished_.push_back({i, *numbers});
  }
}

std::vector<PresetJob::Measured> PresetJob::take() {
  const std::scoped_lock lock(guard_);
  done_ += finished_.size();  // here, so that who waits for the end has them all
  return std::exchange(finished_, {});
}

}  // namespace tangent::sweep
