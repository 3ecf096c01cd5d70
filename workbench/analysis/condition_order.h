// Do conditions come in the paper's order: from the one that needs the most segments to feel smooth to the one that
// needs the fewest (Doxon et al., Table 2).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent::analysis {

/// Kendall's tau-b: 1 the same order, 0 none in common, -1 backwards; pairs that are equal on either side are allowed
/// for. None where a side has no two values that differ. Precondition: as many of each.
std::optional<double> kendall_tau(std::span<const double> a, std::span<const double> b);

struct OrderAgreement {
  double tau = 0.0;
  double low = 0.0, high = 0.0;  ///< 95 % interval: percentiles over participants drawn again (Efron & Tibshirani 1993)
  std::size_t participants = 0;  ///< those who settled under every condition
};

/// Conditions by name, `thresholds[condition][participant]`, segments; NaN: did not settle. Means of ln(segments)
/// against Table 2's angles. None with fewer than three conditions that are in the table, or two participants.
std::optional<OrderAgreement> agreement_with_paper(std::span<const std::string> conditions,
                                                   const std::vector<std::vector<double>>& thresholds);

}  // namespace tangent::analysis
