#include "workbench/embed/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace tangent {
namespace {

/// What the threads share: the next finger that nobody has taken, and for each thread what its work threw.
struct Fingers {
  explicit Fingers(std::size_t threads) { thrown.resize(threads); }
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown;
};

/// 0: one per core. No more than fingers, nor so many that they eat up the memory for nothing.
std::size_t thread_count(unsigned threads, std::size_t fingers) {
  constexpr std::size_t kMostPerCore = 8;
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t wanted = threads == 0 ? cores : std::min<std::size_t>(threads, kMostPerCore * cores);
  return std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(1, fingers));
}

/// So many fingers are taken at once: few enough that no thread is left alone with the last of them, and so many that
/// taking them costs nothing.
std::size_t share_of(std::size_t fingers, std::size_t threads) {
  return std::clamp<std::size_t>(fingers / (16 * threads), 1, 64);
}

struct Batch {
  const std::shared_ptr<const ContactScene>& scene;
  std::size_t count, share;
  const FingerWork& work;
};

void run_worker(const Batch& batch, Fingers& fingers, std::exception_ptr& thrown) {
  try {
    Stepper stepper(batch.scene);
    for (;;) {
      const std::size_t first = fingers.next.fetch_add(batch.share, std::memory_order_relaxed);
      if (first >= batch.count) return;
      for (std::size_t i = first; i < std::min(batch.count, first + batch.share); ++i) batch.work(stepper, i);
    }
  } catch (...) {
    thrown = std::current_exception();
    fingers.next.store(batch.count, std::memory_order_relaxed);  // the others end, too
  }
}

}  // namespace

void for_each_finger(const std::shared_ptr<const ContactScene>& scene, std::size_t fingers, unsigned threads,
                     const FingerWork& work) {
  const std::size_t most = thread_count(threads, fingers);
  const Batch batch{scene, fingers, share_of(fingers, most), work};
  Fingers shared(most);
  {
    std::vector<std::jthread> others;
    others.reserve(most - 1);
    try {
      for (std::size_t i = 1; i < most; ++i)
        others.emplace_back([&, i] { run_worker(batch, shared, shared.thrown[i]); });
    } catch (const std::system_error&) {  // no more threads to be had: those that are there do it
    }
    run_worker(batch, shared, shared.thrown[0]);
  }
  for (const std::exception_ptr& thrown : shared.thrown)
    if (thrown) std::rethrow_exception(thrown);
}

void solve_fingers(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                   std::span<const TickInput> inputs, std::span<TickOutput> outputs, std::size_t fingers,
                   unsigned threads) {
  if (fingers == 0) return;
  const std::size_t ticks = inputs.size() / fingers;
  for_each_finger(scene, fingers, threads, [&](Stepper& stepper, std::size_t finger) {
    TickState state;
    for (std::size_t i = finger * ticks; i < (finger + 1) * ticks; ++i) {
      TickInput input = inputs[i];
      input.all_at_once = ticks == 1;
      outputs[i] = stepper.step(preset, input, state);
    }
  });
}

}  // namespace tangent
