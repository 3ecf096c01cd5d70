// Where on the mesh presets fail along a motion: by triangle, how many ticks were there and how many found no contact.
#pragma once

#include "workbench/sweep/inputs.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace tangent::sweep {

struct TicksThere {
  std::uint64_t ticks = 0, failed = 0;  ///< failed: did not converge, or no contact is offered (`facing`)
  bool operator==(const TicksThere&) const = default;
};

/// By triangle, over all presets: each solves the motion from a fresh state, as a cell does. A tick's place is that of
/// the contact that `robust` finds, so that it is where the finger was, also where a preset finds none. Empty: `stop`
/// said so. Precondition: no 2D scene.
std::optional<std::vector<TicksThere>> failure_places(const Ground& ground, std::span<const Preset> presets,
                                                      const std::function<bool()>& stop = {});

/// The same in a background thread. The owner's thread calls all of it.
class FailurePlacesJob {
 public:
  ~FailurePlacesJob() { cancel(); }
  /// Cancels what runs. `threaded` false: within this call.
  void start(Ground ground, std::vector<Preset> presets, bool threaded);
  void cancel();
  bool running() const { return thread_.joinable() && !done_.load(); }
  /// Once, when they are found.
  std::optional<std::vector<TicksThere>> take();

 private:
  std::atomic<bool> stop_{false}, done_{false};
  std::optional<std::vector<TicksThere>> found_;  ///< the thread's until `done_`
  std::thread thread_;
};

}  // namespace tangent::sweep
