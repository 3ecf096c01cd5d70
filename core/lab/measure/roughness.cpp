#include "core/lab/measure/roughness.h"

#include "core/shading/blend.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Room for rounding where a fade goes at exactly its rate.
constexpr double kRounding = 1e-9;

}  // namespace

void SignalRoughness::add(double change, double most, std::uint64_t pairs) {
  mean += (change - mean) / static_cast<double>(pairs);
  const double over = change - most;
  if (over <= kRounding * (most + change)) return;
  ++unexplained;
  largest = std::max(largest, over);
}

void RoughnessCounter::add(const Preset& preset, const TickInput& input, const TickOutput& output) {
  if (any_) {
    const std::uint64_t n = ++sum_.pairs;
    const FingerWay way{input.finger.position - input_.finger.position, std::max(0.0, input.t_s - input_.t_s)};
    const double force = most_force_change_n(preset, way), display = most_display_change_m(preset, way);
    sum_.force.add(glm::distance(output.force_n, output_.force_n), force, n);
    sum_.decided_force.add(glm::distance(output.decided_force_n, output_.decided_force_n), force, n);
    sum_.display.add(std::abs(output.cld_m - output_.cld_m), display, n);
    sum_.decided_display.add(std::abs(output.decided_cld_m - output_.decided_cld_m), display, n);
  }
  any_ = true;
  input_ = input;
  output_ = output;
}

}  // namespace tangent
