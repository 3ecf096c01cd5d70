// The studentized range: the largest difference among k means of normal values, over their standard error with
// `freedom` degrees of freedom. Tukey's test asks it; Boost.Math does not have it.
//
// P(q) = int_0^inf f(s) R(q s) ds, R(w) = k int phi(z) (Phi(z) - Phi(z - w))^(k-1) dz, where s is the square root of a
// chi-square over its degrees of freedom (Copenhaver & Holland 1988).
#pragma once

namespace tangent::analysis {

/// Probability of a range of at least q. Precondition: q >= 0, groups >= 2, freedom >= 1.
double studentized_range_above(double q, int groups, double freedom);

/// The range that is passed with probability `above`. Precondition: 0 < above < 1.
double studentized_range_quantile(double above, int groups, double freedom);

}  // namespace tangent::analysis
