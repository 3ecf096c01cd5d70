#include "core/embed/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tangent {
namespace {

/// What the threads share.
struct Fingers {
  std::atomic<std::size_t> next{0};
  std::mutex lock;  // of `thrown`
  std::exception_ptr thrown;

  void keep(std::exception_ptr exception) {
    const std::lock_guard guard(lock);
    if (!thrown) thrown = std::move(exception);
  }
};

/// So many fingers are taken at once: few enough that no thread is left alone with the last of them, and so many that
/// taking them costs nothing.
std::size_t share_of(std::size_t fingers, std::size_t threads) {
  return std::clamp<std::size_t>(fingers / (16 * threads), 1, 64);
}

void run_worker(const std::shared_ptr<const ContactScene>& scene, std::size_t count, std::size_t share,
                const FingerWork& work, Fingers& fingers) {
  try {
    Stepper stepper(scene);
    for (;;) {
      const std::size_t first = fingers.next.fetch_add(share, std::memory_order_relaxed);
      if (first >= count) return;
      for (std::size_t i = first; i < std::min(count, first + share); ++i) work(stepper, i);
    }
  } catch (...) {
    fingers.keep(std::current_exception());
  }
}

}  // namespace

void for_each_finger(const std::shared_ptr<const ContactScene>& scene, std::size_t fingers, unsigned threads,
                     const FingerWork& work) {
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t most =
      std::clamp<std::size_t>(threads == 0 ? cores : threads, 1, std::max<std::size_t>(1, fingers));
  const std::size_t share = share_of(fingers, most);
  Fingers shared;
  {
    std::vector<std::jthread> others;
    others.reserve(most - 1);
    try {
      for (std::size_t i = 1; i < most; ++i)
        others.emplace_back([&] { run_worker(scene, fingers, share, work, shared); });
    } catch (const std::system_error&) {  // no more threads to be had: those that are there do it
    }
    run_worker(scene, fingers, share, work, shared);
  }
  if (shared.thrown) std::rethrow_exception(shared.thrown);
}

void solve_fingers(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                   std::span<const TickInput> inputs, std::span<TickOutput> outputs, std::size_t fingers,
                   unsigned threads) {
  if (fingers == 0) return;
  const std::size_t ticks = inputs.size() / fingers;
  for_each_finger(scene, fingers, threads, [&](Stepper& stepper, std::size_t finger) {
    TickState state;
    for (std::size_t i = finger * ticks; i < (finger + 1) * ticks; ++i)
      outputs[i] = stepper.step(preset, inputs[i], state);
  });
}

}  // namespace tangent
