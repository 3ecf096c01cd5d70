// Gains of Eq. 1 for a finger at a contact, and the reason: a unit step along a principal direction of
// curvature k leaves a residual of h k, so the ideal factor is 1/(1 + h k), which Eq. 1 gives with G_o = 1, G_k = h,
// G_d = 0. h is about the finger's reach. Doxon et al., Eq. 1.
#pragma once

#include "core/lab/gains/gain_tuning.h"
#include "core/tick/step.h"

#include <optional>

namespace tangent {

struct GainAdvice {
  double gain_curvature_m = 0.0;  ///< G_k by the rule: about h, m
  double height_m = 0.0;          ///< h from which it follows
  // At a contact on a face; NaN without one.
  double k1_per_m = 0.0, k2_per_m = 0.0;      ///< principal curvatures, k1 >= k2, positive convex
  double ideal1 = 0.0, ideal2 = 0.0;          ///< ideal factors 1/(1 + h k) for k1 and k2
  double left_now = 0.0, left_advised = 0.0;  ///< share of the error that a plane leaves (paper_contraction)
  Gains advised;                              ///< the rule's, or those of a walk downhill from there, all three
  bool local = false;                         ///< the above hold

  /// Whether the advised gains leave less, in whole percent: as it is shown.
  bool better() const;
};

/// `at`: the contact to advise on; if empty, or on an edge or vertex, the advice is the finger's reach. A point finger
/// has no reach: G_k 0. `walk`: looks for gains that leave less than the rule's, some hundred evaluations.
GainAdvice advise_gains(const ContactMesh& mesh, const Preset& preset, const std::optional<TickOutput>& at,
                        bool walk = true);

}  // namespace tangent
