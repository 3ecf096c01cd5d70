#include "core/lab/measure/scene_statistics.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

bool all_finite(const TickOutput& o) {
  return is_finite(o.contact) && is_finite(o.normal) && is_finite(o.force_n) && std::isfinite(o.u) &&
         std::isfinite(o.v) && std::isfinite(o.penetration_m) && std::isfinite(o.cld_m) && std::isfinite(o.error_m);
}

RunStatistics run_statistics(std::span<const TickInput> inputs, std::span<const TickOutput> outputs,
                             std::span<const double> ns, double slow_m) {
  RunStatistics s;
  s.ticks = outputs.size();
  std::vector<double> iterations, all_iterations, eventless_ns, seeding_ns;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const TickOutput& o = outputs[i];
    ++s.statuses[static_cast<std::size_t>(o.status)];
    ++s.events[static_cast<std::size_t>(o.event)];
    if (!all_finite(o)) ++s.not_finite;
    const bool converged = is_converged(o.status);
    if (o.status == TickStatus::unconverged && s.unconverged() == 1) s.first_unconverged = i;
    if (converged) s.max_error_m = std::max(s.max_error_m, o.error_m);
    all_iterations.push_back(o.iterations);
    if (o.event == TickEvent::none) iterations.push_back(o.iterations);
    if (!ns.empty() && o.event == TickEvent::none) eventless_ns.push_back(ns[i]);
    if (!ns.empty() && (o.event == TickEvent::first || o.event == TickEvent::reseed)) seeding_ns.push_back(ns[i]);
    if (i == 0 || o.event != TickEvent::none || !converged || !is_converged(outputs[i - 1].status)) continue;
    const bool slow = length(inputs[i].finger.position - inputs[i - 1].finger.position) < slow_m;
    if (slow && glm::dot(o.normal, outputs[i - 1].normal) < kJumpCosine) ++s.unmarked_jumps;
  }
  s.iterations = distribution(std::move(iterations));
  s.all_iterations = distribution(std::move(all_iterations));
  s.ns = distribution({ns.begin(), ns.end()});
  s.eventless_ns = distribution(std::move(eventless_ns));
  s.seeding_ns = distribution(std::move(seeding_ns));
  return s;
}

OutputDifference difference(const TickOutput& a, const TickOutput& b) {
  return {length(a.contact - b.contact),
          std::atan2(length(glm::cross(a.normal, b.normal)), glm::dot(a.normal, b.normal)),
          length(a.force_n - b.force_n), std::abs(a.cld_m - b.cld_m)};
}

void RunComparison::reserve(std::size_t ticks) {
  for (auto* values : {&contact_m_, &normal_rad_, &force_n_, &display_m_}) values->reserve(ticks);
}

void RunComparison::add(const TickOutput& a, const TickOutput& b) {
  if (!is_converged(a.status) || !is_converged(b.status)) return leave_out();
  const OutputDifference d = difference(a, b);
  contact_m_.push_back(d.contact_m);
  normal_rad_.push_back(d.normal_rad);
  force_n_.push_back(d.force_n);
  display_m_.push_back(d.display_m);
}

RunDifference RunComparison::result() const {
  return {contact_m_.size(),        left_out_,
          distribution(contact_m_), distribution(normal_rad_),
          distribution(force_n_),   distribution(display_m_)};
}

}  // namespace tangent
