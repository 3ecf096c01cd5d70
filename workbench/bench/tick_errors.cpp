#include "workbench/bench/tick_errors.h"

#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/scene_statistics.h"

#include <utility>

namespace tangent::bench {
namespace {

constexpr std::size_t kStopTicks = 64;  // between checks of the stop

/// The errors of one part under one setting.
class PartErrors {
 public:
  PartErrors(const MotionPart& part, const Preset& preset, std::span<const TickOutput> exact)
      : part_(part),
        preset_(preset),
        exact_(exact),
        tolerance_m_(converged_tolerance_m(*part.scene, part.preset.finger)),
        stepper_(part.scene),
        iterating_on_(part.scene) {}

  TickError step(std::size_t part, std::size_t i) {
    const TickOutput output = stepper_.step(preset_, part_.poses[i], state_);
    TickError out{{part, i}, std::nullopt, is_converged(output.status), output.iterations};
    if (out.converged && is_smooth(preset_.solver.method)) {
      const auto own = converged_answer(iterating_on_, preset_, part_.poses[i], state_, tolerance_m_);
      if (own) out.error_m = difference(output, *own).contact_m;
    } else if (is_converged(exact_[i].status)) {
      out.error_m = difference(output, exact_[i]).contact_m;
    }
    return out;
  }

 private:
  const MotionPart& part_;
  const Preset& preset_;
  std::span<const TickOutput> exact_;
  double tolerance_m_;
  Stepper stepper_, iterating_on_;
  TickState state_;
};

}  // namespace

std::optional<ExactRun> exact_run(std::span<const MotionPart> parts, const Stop& stop) {
  ExactRun out;
  for (const MotionPart& part : parts) {
    Preset exact = part.preset;
    exact.solver.method = Method::robust;
    exact.solver.tolerance_m = converged_tolerance_m(*part.scene, part.preset.finger);
    Stepper stepper(part.scene);
    TickState state;
    out.emplace_back();
    for (const TickInput& pose : part.poses) {
      if (out.back().size() % kStopTicks == 0 && stop()) return std::nullopt;
      out.back().push_back(stepper.step(exact, pose, state));
    }
  }
  return out;
}

std::optional<std::vector<TickError>> tick_errors(std::span<const MotionPart> parts, const ExactRun& exact,
                                                  const std::function<Preset(const Preset&)>& apply, const Stop& stop) {
  std::vector<TickError> out;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Preset preset = apply(parts[p].preset);
    PartErrors errors(parts[p], preset, exact[p]);
    for (std::size_t i = 0; i < parts[p].poses.size(); ++i) {
      if (i % kStopTicks == 0 && stop()) return std::nullopt;
      out.push_back(errors.step(p, i));
    }
  }
  return out;
}

ErrorSummary summary_of(std::span<const TickError> errors) {
  ErrorSummary out;
  std::vector<double> iterations, all, converged;
  double worst_m = -1.0;
  for (const TickError& tick : errors) {
    ++out.ticks;
    out.unconverged += tick.converged ? 0 : 1;
    iterations.push_back(tick.iterations);
    if (!tick.error_m) {
      ++out.without_exact;
      continue;
    }
    all.push_back(*tick.error_m);
    if (tick.converged) converged.push_back(*tick.error_m);
    if (*tick.error_m <= worst_m) continue;
    worst_m = *tick.error_m;
    out.worst = tick.at;
  }
  out.iterations = distribution(std::move(iterations));
  out.error_m = distribution(std::move(all));
  out.converged_error_m = distribution(std::move(converged));
  return out;
}

}  // namespace tangent::bench
