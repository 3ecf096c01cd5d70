#include "devices/gate/heat.h"

#include <algorithm>

namespace tangent {

namespace {

double full_store(double peak, double continuous) {
  return (peak * peak - continuous * continuous) * ForceBudget::kPeakHold_s;
}

}  // namespace

double ForceBudget::allowed(double peak, double continuous) const noexcept {
  if (continuous <= 0.0 || continuous >= peak) return peak;
  const double filled = store_n2s_ / full_store(peak, continuous);
  return peak + (continuous - peak) * std::clamp(2.0 * filled - 1.0, 0.0, 1.0);
}

void ForceBudget::spend(double force, double peak, double continuous, double dt_s) noexcept {
  if (continuous <= 0.0 || continuous >= peak) return;
  store_n2s_ =
      std::clamp(store_n2s_ + (force * force - continuous * continuous) * dt_s, 0.0, full_store(peak, continuous));
}

void HeatMemory::keep(const std::string& device, double store_n2s, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  kept_[device] = {store_n2s, now_ns};
}

double HeatMemory::recall(const std::string& device, double continuous_n, std::int64_t now_ns) const {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(device);
  if (found == kept_.end()) return 0.0;
  const double off_s = std::max(0.0, static_cast<double>(now_ns - found->second.at_ns) * 1e-9);
  return std::max(0.0, found->second.store_n2s - continuous_n * continuous_n * off_s);
}

HeatMemory& motor_heat() {
  static HeatMemory memory;
  return memory;
}

}  // namespace tangent
