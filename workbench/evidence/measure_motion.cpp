#include "workbench/evidence/measure_motion.h"

#include "core/base/float_state.h"
#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/distribution.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace tangent {
namespace {

constexpr std::size_t kTicksBetweenAsking = 256;
constexpr double kMicrometre = 1e-6;

/// Sums and lists of the ticks so far.
class MotionCounts {
 public:
  void add(const TickOutput& out) {
    numbers_.ticks += 1.0;
    planes_.push_back(out.iterations);
    if (out.event != TickEvent::none) numbers_.events += 1.0;
    if (out.event == TickEvent::reseed) numbers_.reseeded_ticks += 1.0;
    if (out.status == TickStatus::free) return;
    numbers_.touching_ticks += 1.0;
    if (is_converged(out.status))
      numbers_.residual_worst_um = std::max(numbers_.residual_worst_um, out.error_m / kMicrometre);
    else
      numbers_.unconverged_ticks += 1.0;
    const double force = glm::length(out.force_n);
    force_n_ += force;
    numbers_.force_worst_n = std::max(numbers_.force_worst_n, force);
    display_m_ += std::abs(out.cld_m);
  }
  void add_error(double error_m) { errors_um_.push_back(error_m / kMicrometre); }
  void add_time(double ns) { ns_.push_back(ns); }

  EvidenceNumbers result() {
    EvidenceNumbers n = numbers_;
    const Distribution planes = distribution(std::move(planes_)), errors = distribution(std::move(errors_um_));
    n.mean_planes = planes.mean;
    n.p99_planes = planes.p99;
    n.worst_planes = planes.max;
    n.compared_ticks = static_cast<double>(errors.count);
    n.error_median_um = errors.p50;
    n.error_p99_um = errors.p99;
    n.error_worst_um = errors.max;
    if (n.touching_ticks > 0.0) {
      n.force_mean_n = force_n_ / n.touching_ticks;
      n.display_mean_mm = display_m_ / kMillimetre / n.touching_ticks;
    }
    n.median_solve_ns = std::round(distribution(std::move(ns_)).p50);
    return n;
  }

 private:
  EvidenceNumbers numbers_;
  std::vector<double> planes_, errors_um_, ns_;
  double force_n_ = 0.0, display_m_ = 0.0;
};

}  // namespace

std::optional<EvidenceNumbers> measure_motion(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                                              std::span<const TickInput> motion, bool timed,
                                              const std::function<bool()>& keep_going) {
  using Clock = std::chrono::steady_clock;
  const FloatState as_tested;
  const bool has_exact = scene->planar() == nullptr && is_smooth(preset.solver.method);
  const double tolerance = has_exact ? converged_tolerance_m(*scene, preset.finger) : 0.0;
  Stepper stepper(scene), exact(scene);
  MotionCounts counts;
  TickState state;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (i % kTicksBetweenAsking == 0 && !keep_going()) return std::nullopt;
    const Clock::time_point begin = timed ? Clock::now() : Clock::time_point();
    const TickOutput out = stepper.step(preset, motion[i], state);
    if (timed) counts.add_time(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
    counts.add(out);
    if (!has_exact || !is_converged(out.status) || out.triangle == kNone) continue;
    if (const auto answer = converged_answer(exact, preset, motion[i], state, tolerance))
      counts.add_error(glm::length(out.contact - answer->contact));
  }
  return counts.result();
}

}  // namespace tangent
