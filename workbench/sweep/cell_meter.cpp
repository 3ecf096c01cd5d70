#include "workbench/sweep/cell_meter.h"

#include "core/lab/measure/closed_work.h"
#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/roughness.h"
#include "core/lab/measure/scene_statistics.h"
#include "workbench/sweep/tick_work.h"

#include <algorithm>

namespace tangent::sweep {
namespace {

constexpr std::size_t kStopStride = 512;
constexpr int kCircleSteps = 64;
constexpr double kCircleShare = 1.0 / 40.0;  // radius, of the scene's longest side: 2 mm on 80 mm

CellNumbers counts_of(const RunStatistics& s) {
  CellNumbers n;
  n.ticks = s.ticks;
  n.unconverged = s.unconverged();
  n.facing = s.count(TickStatus::facing);
  n.events_first = s.count(TickEvent::first);
  n.events_reseed = s.count(TickEvent::reseed);
  n.events_switch = s.count(TickEvent::switched);
  n.events_branch = s.count(TickEvent::branch);
  n.not_finite = s.not_finite;
  n.unmarked_jumps = s.unmarked_jumps;
  n.residual_worst_m = s.max_error_m;
  return n;
}

void add_roughness(const Roughness& r, CellNumbers& n) {
  n.force_change_mean_n = r.force.mean;
  n.force_unexplained = r.force.unexplained;
  n.force_unexplained_worst_n = r.force.largest;
  n.display_change_mean_m = r.display.mean;
  n.display_unexplained = r.display.unexplained;
  n.display_unexplained_worst_m = r.display.largest;
}

/// Adds what adds up, and the largest of what is a largest. Percentiles and means over ticks come from the samples.
void add_block(const CellNumbers& block, CellNumbers& sum) {
  const auto pairs = [](const CellNumbers& n) { return n.ticks > 0 ? static_cast<double>(n.ticks - 1) : 0.0; };
  const double before = pairs(sum), more = pairs(block), all = std::max(1.0, before + more);
  sum.force_change_mean_n = (before * sum.force_change_mean_n + more * block.force_change_mean_n) / all;
  sum.display_change_mean_m = (before * sum.display_change_mean_m + more * block.display_change_mean_m) / all;
  for (const NumberColumn& column : number_columns()) {
    if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column.field))
      sum.*(*whole) += block.*(*whole);
    else if (const auto field = std::get<double CellNumbers::*>(column.field); column.grows)
      sum.*field = std::max(sum.*field, block.*field);
  }
}

}  // namespace

struct CellMeter::Run {
  TickState state, exact_state;
  std::vector<TickOutput> outputs;
  Samples samples;
};

CellMeter::CellMeter(Stepper& stepper, Stepper& exact, const Preset& preset)
    : stepper_(stepper), exact_(exact), preset_(preset), reference_(preset) {
  const double tolerance = converged_tolerance_m(stepper.scene(), preset.finger);
  tolerance_m_ = std::min(tolerance, 0.1 * preset.solver.tolerance_m);
  reference_.solver.method = Method::robust;
  reference_.solver.tolerance_m = tolerance_m_;
}

void CellMeter::compare(std::size_t i, const TickInput& input, const TickOutput& output, Run& run) {
  const bool looked_at = i % kComparedEvery == kComparedEvery - 1;
  std::optional<TickOutput> answer;
  if (!is_smooth(preset_.solver.method))
    answer = exact_.step(reference_, input, run.exact_state);  // every tick: it tracks the contact
  else if (looked_at && is_converged(output.status))
    answer = converged_answer(exact_, preset_, input, run.state, tolerance_m_);
  if (looked_at && answer && is_converged(output.status) && is_converged(answer->status))
    run.samples.error_m.push_back(difference(output, *answer).contact_m);
}

std::optional<CellNumbers> CellMeter::run(std::span<const TickInput> block, std::size_t circles,
                                          const std::function<bool()>& stop) {
  Run run;
  RoughnessCounter roughness;
  run.outputs.reserve(block.size());
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (stop && i % kStopStride == 0 && stop()) return std::nullopt;
    const Vec3 before = run.state.clearance.centre;  // every search of other places begins a new ball
    const TickOutput output = stepper_.step(preset_, block[i], run.state);
    run.outputs.push_back(output);
    run.samples.iterations.push_back(output.iterations);
    run.samples.counted_us.push_back(counted_us(output, before != run.state.clearance.centre));
    roughness.add(preset_, block[i], output);
    compare(i, block[i], output, run);
  }
  CellNumbers n = counts_of(run_statistics(block, run.outputs, {}));
  add_roughness(roughness.result(), n);
  add_closed_work(block, run, circles, n);
  for (const auto samples : {&Samples::iterations, &Samples::counted_us, &Samples::error_m}) {
    auto& all = samples_.*samples;
    const auto& more = run.samples.*samples;
    all.insert(all.end(), more.begin(), more.end());
  }
  add_percentiles(std::move(run.samples), n);
  if (blocks_++ == 0)
    sum_ = n;
  else
    add_block(n, sum_);
  return n;
}

void CellMeter::add_percentiles(Samples samples, CellNumbers& n) {
  const Distribution iterations = distribution(std::move(samples.iterations));
  n.mean_iterations = iterations.mean;
  n.p99_iterations = iterations.p99;
  n.most_iterations = iterations.max;
  const Distribution counted = distribution(std::move(samples.counted_us));
  n.mean_counted_us = counted.mean;
  n.p99_counted_us = counted.p99;
  const Distribution error = distribution(std::move(samples.error_m));
  n.compared = error.count;
  n.error_p50_m = error.p50;
  n.error_p99_m = error.p99;
  n.error_worst_m = error.max;
}

CellNumbers CellMeter::total() const {
  CellNumbers out = sum_;
  if (blocks_ > 1) add_percentiles(samples_, out);
  return out;
}

void CellMeter::add_closed_work(std::span<const TickInput> block, const Run& run, std::size_t circles, CellNumbers& n) {
  const Vec3 size = exact_.scene().mesh().bounds().size();
  const double radius = kCircleShare * std::max({size.x, size.y, size.z});
  for (std::size_t i = 0; i < circles; ++i) {
    const std::size_t tick = (2 * i + 1) * block.size() / (2 * circles);
    if (!is_converged(run.outputs[tick].status) || run.outputs[tick].penetration_m <= 0.0) continue;
    const ClosedWork work = work_around(
        stepper_, preset_, circle_of_poses(block[tick].finger, run.outputs[tick].normal, radius, kCircleSteps));
    if (work.broken || work.peak_energy_j <= 0.0) continue;
    ++n.loops;
    n.closed_work_share = std::max(n.closed_work_share, work.relative());
  }
}

}  // namespace tangent::sweep
