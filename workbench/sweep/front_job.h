// A search for a front in a background thread: the trials come one by one while it runs, so that a window can draw the
// front as it grows. The owner's thread calls all of it.
#pragma once

#include "workbench/sweep/front_search.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tangent::sweep {

/// On ticks that the search did not see: the preset that it would choose, and the first of its starts.
struct FrontVerdict {
  std::size_t chosen = 0;  ///< index of the trial: the front's balanced point
  Trial mine, start;
  bool clearly = false;  ///< mine is clearly better (clearly_better)
};

class FrontJob {
 public:
  static constexpr double kClearly = 0.02;  ///< as `tune` has it

  ~FrontJob();
  /// Cancels what runs. `load` makes the ground, in the thread; a quarter of its ticks is held back for the verdict.
  /// plan.stop and plan.tried are the job's own.
  void start(FrontPlan plan, std::function<Result<Ground>(const std::function<bool()>& stop)> load);
  /// At once: what the thread still does is thrown away.
  void cancel();
  bool running() const { return work_ != nullptr && !work_->taken_all; }
  /// Trials since the last call, in the order in which they were tried. `wait_for` > 0: waits until there are as many
  /// or the search has ended, and gives no more than those, so that who asks frame by frame always sees the same.
  std::vector<Trial> take(std::size_t wait_for = 0);
  /// Of the newest start; null, empty: not yet.
  std::shared_ptr<const Ground> ground() const;
  std::optional<FrontVerdict> verdict() const;
  std::string take_failure();  ///< why there is no ground; once

 private:
  struct Work {
    FrontPlan plan;
    std::atomic<bool> stop{false}, done{false};
    bool taken_all = false;  ///< of the owner
    std::mutex guard;        ///< of those below
    std::condition_variable news;
    std::deque<Trial> fresh;
    bool ended = false;
    std::string failure;
    std::shared_ptr<const Ground> ground;
    std::optional<FrontVerdict> verdict;
    std::thread thread;
  };
  static void search(Work& work, const std::function<Result<Ground>(const std::function<bool()>&)>& load);
  static void judge(Work& work, const std::vector<FrontGround>& grounds, const std::vector<Trial>& trials);
  void forget_ended();

  std::shared_ptr<Work> work_;
  std::vector<std::shared_ptr<Work>> cancelled_;  ///< that have not ended yet
};

}  // namespace tangent::sweep
