#include "workbench/sweep/front_job.h"

#include "workbench/session/background_thread.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace tangent::sweep {

FrontJob::~FrontJob() {
  cancel();
  for (const auto& work : cancelled_) work->thread.join();
}

void FrontJob::cancel() {
  if (work_ == nullptr) return;
  work_->stop.store(true);
  cancelled_.push_back(std::exchange(work_, nullptr));
  forget_ended();
}

void FrontJob::forget_ended() {
  std::erase_if(cancelled_, [](const std::shared_ptr<Work>& work) {
    if (!work->done.load()) return false;
    work->thread.join();
    return true;
  });
}

void FrontJob::start(FrontPlan plan, std::function<Result<Ground>(const std::function<bool()>& stop)> load) {
  cancel();
  work_ = std::make_shared<Work>();
  Work* const work = work_.get();
  work->plan = std::move(plan);
  work->plan.stop = [work] { return work->stop.load(); };
  work->plan.tried = [work](const Trial& trial) {
    const std::scoped_lock lock(work->guard);
    work->fresh.push_back(trial);
    work->news.notify_one();
  };
  // The thread holds its work, which may outlive this object's interest in it.
  work->thread = std::thread([held = work_, load = std::move(load)] {
    yield_to_servo_and_window();
    try {
      search(*held, load);
    } catch (const std::exception& problem) {  // no memory
      const std::scoped_lock lock(held->guard);
      held->failure = problem.what();
    }
    {
      const std::scoped_lock lock(held->guard);
      held->ended = true;
      held->news.notify_one();
    }
    held->done.store(true);
  });
}

void FrontJob::search(Work& work, const std::function<Result<Ground>(const std::function<bool()>&)>& load) {
  const Result<Ground> ground = load(work.plan.stop);
  if (work.stop.load()) return;
  if (!ground || ground->motion->size() < 4) {
    const std::scoped_lock lock(work.guard);
    work.failure = ground ? "the motion is too short to be searched on: 4 ticks at least" : ground.error().message();
    return;
  }
  {
    const std::scoped_lock lock(work.guard);
    work.ground = std::make_shared<const Ground>(*ground);
  }
  const std::vector<FrontGround> grounds{{*ground, ground->motion->size() * 3 / 4}};
  const FrontResult found = search_front(work.plan, grounds);
  if (!found.stopped && !found.trials.empty()) judge(work, grounds, found.trials);
}

void FrontJob::judge(Work& work, const std::vector<FrontGround>& grounds, const std::vector<Trial>& trials) {
  FrontVerdict verdict;
  verdict.chosen = balanced(trials, front_of(trials));
  Preset mine = work.plan.base;
  for (std::size_t r = 0; r < work.plan.ranges.size(); ++r)
    work.plan.ranges[r].key->set(mine, trials[verdict.chosen].values[r]);
  verdict.mine = try_preset(work.plan, grounds, mine, true);
  verdict.start = try_preset(work.plan, grounds, work.plan.starts.empty() ? work.plan.base : work.plan.starts[0], true);
  if (verdict.mine.objectives.empty() || verdict.start.objectives.empty()) return;
  verdict.clearly = clearly_better(verdict.mine, verdict.start, kClearly);
  const std::scoped_lock lock(work.guard);
  work.verdict = std::move(verdict);
}

std::vector<Trial> FrontJob::take(std::size_t wait_for) {
  forget_ended();
  if (work_ == nullptr) return {};
  Work& work = *work_;
  std::unique_lock lock(work.guard);
  if (wait_for > 0) work.news.wait(lock, [&] { return work.ended || work.fresh.size() >= wait_for; });
  const std::size_t count = wait_for > 0 ? std::min(wait_for, work.fresh.size()) : work.fresh.size();
  const auto end = work.fresh.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<Trial> out(std::make_move_iterator(work.fresh.begin()), std::make_move_iterator(end));
  work.fresh.erase(work.fresh.begin(), end);
  work.taken_all = work.ended && work.fresh.empty();
  return out;
}

std::shared_ptr<const Ground> FrontJob::ground() const {
  if (work_ == nullptr) return nullptr;
  const std::scoped_lock lock(work_->guard);
  return work_->ground;
}

std::optional<FrontVerdict> FrontJob::verdict() const {
  if (work_ == nullptr) return std::nullopt;
  const std::scoped_lock lock(work_->guard);
  return work_->verdict;
}

std::string FrontJob::take_failure() {
  if (work_ == nullptr) return {};
  const std::scoped_lock lock(work_->guard);
  return std::exchange(work_->failure, {});
}

}  // namespace tangent::sweep
