// The two forces of a tick as every view draws them: computed by the solver, and felt, which is what the safety gate
// lets through to the device. Where they agree one arrow stands for both.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tangent {

struct ForceArrows {
  double computed_n = 0.0, felt_n = 0.0;  ///< N; 0: no arrow
  bool same = true;                       ///< within a hundredth of the larger, or 5 mN
};

/// `felt`: N, world; none where there is no gate, and then the computed force is felt.
inline ForceArrows force_arrows(const Vec3& computed, const std::optional<Vec3>& felt) {
  const auto size = [](const Vec3& f) {
    const double n = glm::length(f);
    return std::isfinite(n) ? n : 0.0;
  };
  ForceArrows out{size(computed), felt ? size(*felt) : size(computed), true};
  const double apart = felt && out.computed_n > 0.0 && out.felt_n > 0.0 ? glm::length(*felt - computed)
                                                                        : std::abs(out.computed_n - out.felt_n);
  out.same = apart <= std::max(0.01 * std::max(out.computed_n, out.felt_n), 5e-3);
  return out;
}

}  // namespace tangent
