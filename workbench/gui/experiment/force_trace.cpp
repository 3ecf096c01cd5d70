#include "workbench/gui/experiment/force_trace.h"

#include <algorithm>
#include <cmath>

namespace tangent {

ForceTrace::ForceTrace(double length_s, std::size_t steps)
    : step_s_(length_s / static_cast<double>(steps)), ring_(steps, 0.0f) {}

void ForceTrace::add(double t_s, double force_n) {
  const auto step = static_cast<std::int64_t>(std::floor(std::max(0.0, t_s) / step_s_));
  const auto size = static_cast<std::int64_t>(ring_.size());
  if (step < newest_ || step - newest_ >= size) {
    std::fill(ring_.begin(), ring_.end(), 0.0f);
    newest_ = step;
  }
  while (newest_ < step) ring_[static_cast<std::size_t>(++newest_ % size)] = 0.0f;
  float& value = ring_[static_cast<std::size_t>(step % size)];
  value = std::max(value, static_cast<float>(force_n));
}

std::vector<float> ForceTrace::values() const {
  std::vector<float> out(ring_.size());
  const auto size = static_cast<std::int64_t>(ring_.size());
  for (std::int64_t i = 0; i < size; ++i)
    out[static_cast<std::size_t>(i)] = newest_ < 0 ? 0.0f : ring_[static_cast<std::size_t>((newest_ + 1 + i) % size)];
  return out;
}

}  // namespace tangent
