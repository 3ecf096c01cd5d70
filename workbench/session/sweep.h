// A sweep: recorded ticks solved under a preset in which one or two keys take many values. Solves on the same motion,
// as compare_presets.h does, so it compares solvers, not feel. SweepPlan and solve_sweep_point are the engine; SweepJob
// runs them in background threads for a window. A command line calls the engine itself.
#pragma once

#include "core/preset/schema.h"
#include "workbench/session/compare_presets.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tangent {

struct SweepAxis {
  const PresetKey* key = nullptr;
  std::vector<double> values;  ///< SI, each allowed by the key
  bool operator==(const SweepAxis&) const = default;
};
/// `count` values from one end to the other, both included; equal factors where the key is logarithmic and both ends
/// are positive. Whole numbers where the key takes them, each once. The ends are brought into the key's range.
SweepAxis sweep_axis(const PresetKey& key, double from, double to, std::size_t count);

struct SweepPlan {
  Preset base;
  std::vector<SweepAxis> axes;  ///< one or two; the first changes fastest

  std::size_t point_count() const;
  /// Values of point `i`, one an axis.
  std::vector<double> values(std::size_t i) const;
  Preset preset(const std::vector<double>& values) const;
};

struct SweepPoint {
  std::vector<double> values;  ///< one an axis
  RunNumbers numbers;
};

/// One point of a plan over a part of a recorded run. `keep_going`: asked every 2048 ticks; the numbers then cover the
/// ticks so far.
SweepPoint solve_sweep_point(const RunPart& part, const SweepPlan& plan, std::size_t i,
                             const std::function<bool()>& keep_going = {});

class SweepJob {
 public:
  ~SweepJob();
  /// Cancels what runs, and solves all points. `threads` 0: within this call.
  void start(RunPart part, SweepPlan plan, unsigned threads);
  void cancel();
  bool running() const { return done_.load() < planned_ && !cancelled_.load(); }
  std::size_t done() const { return done_.load(); }
  std::size_t planned() const { return planned_; }
  /// The points finished since the last call, in any order.
  std::vector<SweepPoint> take();

 private:
  void work();

  RunPart part_;
  SweepPlan plan_;
  std::size_t planned_ = 0;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> cancelled_{true};
  std::mutex guard_;
  std::vector<SweepPoint> finished_;
  std::vector<std::thread> threads_;
};

}  // namespace tangent
