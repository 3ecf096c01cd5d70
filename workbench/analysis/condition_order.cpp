#include "workbench/analysis/condition_order.h"

#include "core/base/split_mix.h"
#include "core/lab/measure/perception_thresholds.h"

#include <algorithm>
#include <cmath>

namespace tangent::analysis {
namespace {

constexpr int kRepeats = 2000;

/// Minus the mean logarithm, by condition: as angles go.
std::vector<double> heights(const std::vector<std::vector<double>>& logs, std::span<const std::size_t> participants) {
  std::vector<double> out;
  for (const auto& condition : logs) {
    double sum = 0.0;
    for (const std::size_t p : participants) sum -= condition[p];
    out.push_back(sum);
  }
  return out;
}

}  // namespace

std::optional<double> kendall_tau(std::span<const double> a, std::span<const double> b) {
  double agree = 0.0, of_a = 0.0, of_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i + 1; j < a.size(); ++j) {
      const int x = (a[i] > a[j]) - (a[i] < a[j]), y = (b[i] > b[j]) - (b[i] < b[j]);
      agree += x * y;
      of_a += x * x;
      of_b += y * y;
    }
  }
  if (of_a == 0.0 || of_b == 0.0) return std::nullopt;
  return agree / std::sqrt(of_a * of_b);
}

std::optional<OrderAgreement> agreement_with_paper(std::span<const std::string> conditions,
                                                   const std::vector<std::vector<double>>& thresholds) {
  std::vector<double> paper;
  std::vector<std::vector<double>> logs;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    for (const PerceptionThreshold& row : kPerceptionThresholds) {
      if (row.condition != conditions[i]) continue;
      paper.push_back(row.mean_deg);
      logs.emplace_back();
      for (const double segments : thresholds[i]) logs.back().push_back(std::log(segments));
    }
  }
  if (paper.size() < 3) return std::nullopt;
  std::vector<std::size_t> all;
  for (std::size_t p = 0; p < logs.front().size(); ++p) {
    const auto settled = [p](const auto& condition) { return std::isfinite(condition[p]); };
    if (std::all_of(logs.begin(), logs.end(), settled)) all.push_back(p);
  }
  if (all.size() < 2) return std::nullopt;
  const auto tau = kendall_tau(heights(logs, all), paper);
  if (!tau) return std::nullopt;
  std::vector<double> taus;
  SplitMix random(1);
  for (int i = 0; i < kRepeats; ++i) {
    std::vector<std::size_t> drawn;
    for (std::size_t n = 0; n < all.size(); ++n) drawn.push_back(all[random.below(all.size())]);
    if (const auto again = kendall_tau(heights(logs, drawn), paper)) taus.push_back(*again);
  }
  if (taus.empty()) return std::nullopt;
  std::sort(taus.begin(), taus.end());
  const auto at = [&](double share) {
    return taus[static_cast<std::size_t>(share * static_cast<double>(taus.size()))];
  };
  return OrderAgreement{*tau, at(0.025), at(0.975), all.size()};
}

}  // namespace tangent::analysis
