// Presets on one mesh and motion, each measured as a cell of a sweep (measure_cell), in background threads: what a
// window sweeps. The owner's thread calls all of it, take() once a frame.
#pragma once

#include "workbench/sweep/cell_numbers.h"
#include "workbench/sweep/inputs.h"

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace tangent::sweep {

class PresetJob {
 public:
  struct Measured {
    std::size_t index = 0;  ///< into the presets
    CellNumbers numbers;
  };

  ~PresetJob();
  /// Cancels what runs, and measures the presets in their order. `threads` 0: within this call.
  void start(Ground ground, std::vector<Preset> presets, unsigned threads);
  void cancel();
  bool running() const { return done_ < presets_.size() && !cancelled_.load(); }
  std::size_t done() const { return done_; }  ///< and taken
  std::size_t planned() const { return presets_.size(); }
  /// Those finished since the last call, in any order.
  std::vector<Measured> take();

 private:
  void work();

  Ground ground_;
  std::vector<Preset> presets_;
  std::size_t done_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> cancelled_{true};
  std::mutex guard_;
  std::vector<Measured> finished_;
  std::vector<std::thread> threads_;
};

}  // namespace tangent::sweep
