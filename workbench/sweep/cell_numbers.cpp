#include "workbench/sweep/cell_numbers.h"

#include "core/lab/measure/closed_work.h"
#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/roughness.h"
#include "core/lab/measure/scene_statistics.h"

#include <algorithm>
#include <vector>

namespace tangent::sweep {
namespace {

constexpr std::size_t kStopStride = 512;
constexpr std::size_t kLoops = 4;
constexpr int kLoopSteps = 64;
constexpr double kLoopShare = 1.0 / 40.0;  // radius, of the scene's longest side: 2 mm on 80 mm

constexpr std::array kColumns{
    NumberColumn{"ticks", "ticks solved", &CellNumbers::ticks},
    NumberColumn{"unconverged", "ticks that did not converge", &CellNumbers::unconverged},
    NumberColumn{"facing", "ticks at which the surface offers no contact", &CellNumbers::facing},
    NumberColumn{"events_first", "ticks by event: the first contact", &CellNumbers::events_first},
    NumberColumn{"events_reseed", "looked for anew", &CellNumbers::events_reseed},
    NumberColumn{"events_switch", "a deeper place took over", &CellNumbers::events_switch},
    NumberColumn{"events_branch", "the solution folded", &CellNumbers::events_branch},
    NumberColumn{"not_finite", "ticks with a NaN or an infinity", &CellNumbers::not_finite},
    NumberColumn{"unmarked_jumps", "ticks without event whose normal leapt", &CellNumbers::unmarked_jumps},
    NumberColumn{"mean_iterations", "planes a tick", &CellNumbers::mean_iterations},
    NumberColumn{"p99_iterations", "planes, 99th percentile", &CellNumbers::p99_iterations},
    NumberColumn{"most_iterations", "planes, most", &CellNumbers::most_iterations},
    NumberColumn{"residual_worst_m", "the method's own error, worst converged tick", &CellNumbers::residual_worst_m},
    NumberColumn{"compared", "ticks compared with the exact solution", &CellNumbers::compared},
    NumberColumn{"error_p50_m", "distance from it, median", &CellNumbers::error_p50_m},
    NumberColumn{"error_p99_m", "99th percentile", &CellNumbers::error_p99_m},
    NumberColumn{"error_worst_m", "worst", &CellNumbers::error_worst_m},
    NumberColumn{"force_change_mean_n", "change of the force from tick to tick", &CellNumbers::force_change_mean_n},
    NumberColumn{"force_unexplained", "ticks at which it leapt", &CellNumbers::force_unexplained},
    NumberColumn{"force_unexplained_worst_n", "by most", &CellNumbers::force_unexplained_worst_n},
    NumberColumn{"display_change_mean_m", "change of the display from tick to tick",
                 &CellNumbers::display_change_mean_m},
    NumberColumn{"display_unexplained", "ticks at which it leapt", &CellNumbers::display_unexplained},
    NumberColumn{"display_unexplained_worst_m", "by most", &CellNumbers::display_unexplained_worst_m},
    NumberColumn{"loops", "circles with a contact all the way round", &CellNumbers::loops},
    NumberColumn{"closed_work_share", "largest work round one, over its peak energy", &CellNumbers::closed_work_share},
};

/// Follows the motion and gathers what run_statistics needs; compares some ticks with the exact solution.
class CellRun {
 public:
  CellRun(Stepper& stepper, Stepper& exact, const Preset& preset)
      : stepper_(stepper), exact_(exact), preset_(preset), reference_(preset) {
    const double tolerance = converged_tolerance_m(stepper.scene(), preset.finger);
    tolerance_m_ = std::min(tolerance, 0.1 * preset.solver.tolerance_m);
    reference_.solver.method = Method::robust;
    reference_.solver.tolerance_m = tolerance_m_;
  }

  void add(std::size_t i, const TickInput& input) {
    const TickOutput output = stepper_.step(preset_, input, state_);
    outputs_.push_back(output);
    roughness_.add(preset_, input, output);
    const bool looked_at = i % kComparedEvery == kComparedEvery - 1;
    if (!is_smooth(preset_.solver.method)) {
      const TickOutput other = exact_.step(reference_, input, exact_state_);  // every tick: it tracks the contact
      if (looked_at) comparison_.add(output, other);
    } else if (looked_at && is_converged(output.status)) {
      const auto answer = converged_answer(exact_, preset_, input, state_, tolerance_m_);
      if (answer) comparison_.add(output, *answer);
    }
  }

  CellNumbers done(std::span<const TickInput> motion) {
    CellNumbers n;
    const RunStatistics s = run_statistics(motion, outputs_, {});
    n.ticks = s.ticks;
    n.unconverged = s.unconverged();
    n.facing = s.count(TickStatus::facing);
    n.events_first = s.count(TickEvent::first);
    n.events_reseed = s.count(TickEvent::reseed);
    n.events_switch = s.count(TickEvent::switched);
    n.events_branch = s.count(TickEvent::branch);
    n.not_finite = s.not_finite;
    n.unmarked_jumps = s.unmarked_jumps;
    n.mean_iterations = s.all_iterations.mean;
    n.p99_iterations = s.all_iterations.p99;
    n.most_iterations = s.all_iterations.max;
    n.residual_worst_m = s.max_error_m;
    const RunDifference d = comparison_.result();
    n.compared = d.compared;
    n.error_p50_m = d.contact_m.p50;
    n.error_p99_m = d.contact_m.p99;
    n.error_worst_m = d.contact_m.max;
    add_roughness(n);
    add_closed_work(n, motion);
    return n;
  }

 private:
  void add_roughness(CellNumbers& n) const {
    const Roughness& r = roughness_.result();
    n.force_change_mean_n = r.force.mean;
    n.force_unexplained = r.force.unexplained;
    n.force_unexplained_worst_n = r.force.largest;
    n.display_change_mean_m = r.display.mean;
    n.display_unexplained = r.display.unexplained;
    n.display_unexplained_worst_m = r.display.largest;
  }

  void add_closed_work(CellNumbers& n, std::span<const TickInput> motion) {
    const Vec3 size = exact_.scene().mesh().bounds().size();
    const double radius = kLoopShare * std::max({size.x, size.y, size.z});
    for (std::size_t i = 0; i < kLoops; ++i) {
      const std::size_t tick = (2 * i + 1) * motion.size() / (2 * kLoops);
      if (!is_converged(outputs_[tick].status) || outputs_[tick].penetration_m <= 0.0) continue;
      const ClosedWork work = work_around(
          stepper_, preset_, circle_of_poses(motion[tick].finger, outputs_[tick].normal, radius, kLoopSteps));
      if (work.broken || work.peak_energy_j <= 0.0) continue;
      ++n.loops;
      n.closed_work_share = std::max(n.closed_work_share, work.relative());
    }
  }

  Stepper &stepper_, &exact_;
  const Preset& preset_;
  Preset reference_;
  double tolerance_m_ = 0.0;
  TickState state_, exact_state_;
  std::vector<TickOutput> outputs_;
  RunComparison comparison_;
  RoughnessCounter roughness_;
};

}  // namespace

std::span<const NumberColumn> number_columns() { return kColumns; }

std::optional<CellNumbers> measure_cell(Stepper& stepper, Stepper& exact, const Preset& preset,
                                        std::span<const TickInput> motion, const std::function<bool()>& stop) {
  CellRun run(stepper, exact, preset);
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (stop && i % kStopStride == 0 && stop()) return std::nullopt;
    run.add(i, motion[i]);
  }
  return run.done(motion);
}

}  // namespace tangent::sweep
