#include "workbench/sweep/failure_places.h"

#include "workbench/session/background_thread.h"

#include <utility>

namespace tangent::sweep {
namespace {

constexpr std::size_t kAskedEvery = 512;  // ticks

}  // namespace

std::optional<std::vector<TicksThere>> failure_places(const Ground& ground, std::span<const Preset> presets,
                                                      const std::function<bool()>& stop) {
  std::vector<TicksThere> out(ground.scene->mesh().triangle_count());
  if (presets.empty()) return out;
  const std::vector<TickInput>& motion = *ground.motion;
  const auto stopped = [&](std::size_t i) { return stop && i % kAskedEvery == 0 && stop(); };
  Stepper stepper(ground.scene);
  // Where the finger is, whatever a preset makes of it.
  Preset exact = presets.front();
  exact.solver.method = Method::robust;
  std::vector<std::uint32_t> place(motion.size(), kNone);
  TickState exact_state;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (stopped(i)) return std::nullopt;
    place[i] = stepper.step(exact, motion[i], exact_state).triangle;
    if (place[i] >= out.size()) place[i] = i > 0 ? place[i - 1] : kNone;
  }
  for (const Preset& preset : presets) {
    TickState state;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      if (stopped(i)) return std::nullopt;
      const TickStatus status = stepper.step(preset, motion[i], state).status;
      if (place[i] == kNone) continue;
      ++out[place[i]].ticks;
      out[place[i]].failed += status == TickStatus::unconverged || status == TickStatus::facing ? 1 : 0;
    }
  }
  return out;
}

void FailurePlacesJob::cancel() {
  stop_.store(true);
  if (thread_.joinable()) thread_.join();
}

void FailurePlacesJob::start(Ground ground, std::vector<Preset> presets, bool threaded) {
  cancel();
  stop_.store(false);
  done_.store(false);
  found_.reset();
  const auto find = [this, ground = std::move(ground), presets = std::move(presets)] {
    found_ = failure_places(ground, presets, [this] { return stop_.load(); });
    done_.store(true);
  };
  if (!threaded) return find();
  thread_ = std::thread([find] {
    yield_to_servo_and_window();
    find();
  });
}

std::optional<std::vector<TicksThere>> FailurePlacesJob::take() {
  if (!done_.load()) return std::nullopt;
  return std::exchange(found_, std::nullopt);
}

}  // namespace tangent::sweep
