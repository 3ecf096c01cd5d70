#include "workbench/sweep/run_cells.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace tangent::sweep {
namespace {

/// What one thread keeps from cell to cell: steppers of the scene that it is on.
class CellWorker {
 public:
  std::optional<CellResult> solve(const Cells& cells, Inputs& inputs, std::uint64_t index,
                                  const std::function<bool()>& stop) {
    const Cell cell = cells.at(index);
    CellResult result{index, {}, {}};
    const Result<Ground> ground = inputs.ground(cell.mesh, cell.poses, cell.finger);
    if (!ground) {
      result.failed = ground.error().message();
      return result;
    }
    if (!stepper_ || stepper_->shared_scene() != ground->scene) {
      stepper_.emplace(ground->scene);
      exact_.emplace(ground->scene);
    }
    const auto numbers = measure_cell(*stepper_, *exact_, cells.preset(cell), *ground->motion, stop);
    if (!numbers) return std::nullopt;
    result.numbers = *numbers;
    return result;
  }

 private:
  std::optional<Stepper> stepper_, exact_;
};

/// The threads of one run.
class CellRunner {
 public:
  CellRunner(const Cells& cells, Inputs& inputs, std::uint64_t first, std::uint64_t end, const std::vector<bool>& done,
             const KeepCell& keep, const RunCells& options)
      : cells_(cells),
        inputs_(inputs),
        first_(first),
        end_(end),
        done_(done),
        keep_(keep),
        options_(options),
        next_(first) {}

  Status run() {
    std::vector<std::thread> threads;
    for (unsigned t = 1; t < options_.threads; ++t) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    if (thrown_) std::rethrow_exception(thrown_);
    return status_;
  }

 private:
  bool stopped() const { return ended_.load() || (options_.stop && options_.stop()); }

  void work() noexcept {
    try {
      solve_cells();
    } catch (...) {  // no memory
      const std::scoped_lock lock(guard_);
      thrown_ = std::current_exception();
      ended_.store(true);
    }
  }

  void solve_cells() {
    CellWorker worker;
    for (std::uint64_t i = next_.fetch_add(1); i < end_ && !stopped(); i = next_.fetch_add(1)) {
      if (done_[i - first_]) continue;
      const auto result = worker.solve(cells_, inputs_, i, [this] { return stopped(); });
      if (!result) return;
      const std::scoped_lock lock(guard_);
      if (ended_.load()) return;
      status_ = keep_(*result);
      if (!status_) ended_.store(true);
    }
  }

  const Cells& cells_;
  Inputs& inputs_;
  const std::uint64_t first_, end_;
  const std::vector<bool>& done_;
  const KeepCell& keep_;
  const RunCells& options_;
  std::atomic<std::uint64_t> next_;
  std::atomic<bool> ended_{false};
  std::mutex guard_;
  Status status_;
  std::exception_ptr thrown_;
};

}  // namespace

void Failures::add(const CellResult& result) {
  if (result.failed.empty()) return;
  ++cells;
  const auto at = std::find_if(reasons.begin(), reasons.end(), [&](const Reason& r) { return r.why == result.failed; });
  if (at != reasons.end()) {
    ++at->cells;
    at->first = std::min(at->first, result.cell);
  } else if (reasons.size() < kMostReasons) {
    reasons.push_back({result.failed, 1, result.cell});
  }
}

Status run_cells(const Cells& cells, Inputs& inputs, std::uint64_t first, std::uint64_t end,
                 const std::vector<bool>& done, const KeepCell& keep, const RunCells& options) {
  return CellRunner(cells, inputs, first, end, done, keep, options).run();
}

}  // namespace tangent::sweep
