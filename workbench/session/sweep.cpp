#include "workbench/session/sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {

SweepAxis sweep_axis(const PresetKey& key, double from, double to, std::size_t count) {
  SweepAxis axis{&key, {}};
  from = std::clamp(from, key.min, key.max);
  to = std::clamp(to, key.min, key.max);
  const bool factors = key.logarithmic && from > 0.0 && to > 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
    double value = factors ? from * std::pow(to / from, share) : from + share * (to - from);
    if (i + 1 == count && count > 1) value = to;
    if (key.kind != KeyKind::number) value = std::round(value);
    if (axis.values.empty() || axis.values.back() != value) axis.values.push_back(value);
  }
  return axis;
}

std::size_t SweepPlan::point_count() const {
  if (axes.empty()) return 0;
  std::size_t count = 1;
  for (const SweepAxis& axis : axes) count *= axis.values.size();
  return count;
}

std::vector<double> SweepPlan::values(std::size_t i) const {
  std::vector<double> out;
  for (const SweepAxis& axis : axes) {
    out.push_back(axis.values[i % axis.values.size()]);
    i /= axis.values.size();
  }
  return out;
}

Preset SweepPlan::preset(const std::vector<double>& values) const {
  Preset out = base;
  for (std::size_t a = 0; a < axes.size(); ++a) axes[a].key->set(out, values[a]);
  return out;
}

SweepPoint solve_sweep_point(const RunPart& part, const SweepPlan& plan, std::size_t i,
                             const std::function<bool()>& keep_going) {
  SweepPoint point{plan.values(i), {}};
  HistoryResolver resolver(part.run, plan.preset(point.values), false, part.first);
  for (std::size_t chunk = 0; chunk < resolver.chunk_count() && (!keep_going || keep_going()); ++chunk)
    resolver.solve_chunk(chunk);
  point.numbers = resolver.finish().resolved;
  return point;
}

SweepJob::~SweepJob() { cancel(); }

void SweepJob::cancel() {
  cancelled_.store(true);
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void SweepJob::start(RunPart part, SweepPlan plan, unsigned threads) {
  cancel();
  part_ = std::move(part);
  plan_ = std::move(plan);
  planned_ = plan_.point_count();
  finished_.clear();
  next_.store(0);
  done_.store(0);
  cancelled_.store(false);
  for (unsigned t = 0; t < threads; ++t) threads_.emplace_back([this] { work(); });
  if (threads == 0) work();
}

void SweepJob::work() {
  for (std::size_t i = next_.fetch_add(1); i < planned_ && !cancelled_.load(); i = next_.fetch_add(1)) {
    SweepPoint point = solve_sweep_point(part_, plan_, i, [this] { return !cancelled_.load(); });
    if (cancelled_.load()) return;
    const std::scoped_lock lock(guard_);
    finished_.push_back(std::move(point));
  }
}

std::vector<SweepPoint> SweepJob::take() {
  const std::scoped_lock lock(guard_);
  done_.fetch_add(finished_.size());  // here, so that who waits for the end has them all
  return std::exchange(finished_, {});
}

}  // namespace tangent
