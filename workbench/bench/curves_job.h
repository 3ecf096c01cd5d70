// Speed against error measured by a thread of its own, for a window that never waits for it.
#pragma once

#include "workbench/bench/speed_curves.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

namespace tangent::bench {

class CurvesJob {
 public:
  ~CurvesJob();
  /// Cancels what runs, and forgets its result. `threaded` false: within this call.
  void start(std::vector<MotionPart> parts, SpeedCurvesOptions options, bool threaded);
  void cancel() { stop_.store(true); }  ///< the rounds until then stay; the thread ends within milliseconds
  bool running() const { return running_.load() && !stop_.load(); }
  double progress() const { return progress_.load(); }  ///< 0 to 1
  std::shared_ptr<const SpeedCurves> result() const;    ///< of the rounds so far; null: none
  void forget();                                        ///< the result

 private:
  void work(const std::vector<MotionPart>& parts, SpeedCurvesOptions options);
  void publish(const SpeedCurves& curves);

  std::atomic<bool> stop_{false}, running_{false};
  std::atomic<double> progress_{0.0};
  mutable std::mutex guard_;
  std::shared_ptr<const SpeedCurves> result_;
  std::thread thread_;
};

}  // namespace tangent::bench
