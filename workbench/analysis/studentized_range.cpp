#include "workbench/analysis/studentized_range.h"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent::analysis {
namespace {

using Rule = boost::math::quadrature::gauss<double, 20>;

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }
double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// In so many equal parts, each by Gauss and Legendre's rule.
template <class F>
double integral(F&& f, double from, double to, int parts) {
  const double width = (to - from) / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += Rule::integrate(f, from + i * width, from + (i + 1) * width);
  return sum;
}

/// Probability that k normal values of known deviation 1 lie within w.
double range_below(double w, int groups) {
  const auto part = [&](double z) { return density(z) * std::pow(below(z) - below(z - w), groups - 1); };
  return std::min(1.0, groups * integral(part, -8.5, 8.5 + w, 12));
}

/// Density of the square root of chi-square over its degrees of freedom.
double deviation_density(double s, double freedom) {
  const double half = 0.5 * freedom;
  return 2.0 *
         std::exp(half * std::log(half) - boost::math::lgamma(half) + (freedom - 1.0) * std::log(s) - half * s * s);
}

}  // namespace

double studentized_range_above(double q, int groups, double freedom) {
  if (q <= 0.0) return 1.0;
  // s lies about 1 with a deviation of 1 / sqrt(2 freedom); with few degrees it reaches down to 0.
  const double reach = 9.0 / std::sqrt(2.0 * freedom);
  const double from = std::max(0.0, 1.0 - reach), to = 1.0 + reach;
  const auto part = [&](double s) {
    return s > 0.0 ? deviation_density(s, freedom) * (1.0 - range_below(q * s, groups)) : 0.0;
  };
  return std::clamp(integral(part, from, to, 8), 0.0, 1.0);
}

double studentized_range_quantile(double above, int groups, double freedom) {
  const auto off = [&](double q) { return studentized_range_above(q, groups, freedom) - above; };
  double high = 4.0;
  while (off(high) > 0.0 && high < 1e6) high *= 2.0;
  std::uintmax_t most = 100;
  const auto root =
      boost::math::tools::toms748_solve(off, 0.0, high, boost::math::tools::eps_tolerance<double>(40), most);
  return 0.5 * (root.first + root.second);
}

}  // namespace tangent::analysis
