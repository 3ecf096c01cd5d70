#include "workbench/experiment/simulated_group.h"

#include "core/base/units.h"
#include "workbench/experiment/paper_results.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace tangent::experiment {
namespace {

constexpr double kSpread = 0.35, kLapse = 0.02;  // ours: the paper has no psychometric functions

struct Thresholds {
  double mean = 0.0, deviation = 0.0;  ///< segments, over participants
};

Thresholds of_table(const PaperThreshold& row) {
  const double n = kPaperDiscriminationParticipants;
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  return {row.segments, row.half_interval * std::sqrt(n) / t};
}

Thresholds thresholds_of(const std::string& condition, const Discrimination& design) {
  for (const PaperThreshold& row : kPaperThresholds)
    if (row.condition == condition) return of_table(row);
  const double degrees = condition == "P1" ? kPaperP1Degrees : kPaperP2Degrees;
  const double segments = 1.0 + design.angle_rad / kDegree / degrees;
  const Thresholds like = of_table(kPaperThresholds[3]);
  return {segments, segments * like.deviation / like.mean};
}

}  // namespace

KnownComparer comparer_like_the_papers(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed) {
  KnownComparer out;
  for (const ComparisonCondition& condition : protocol.discrimination()->conditions) {
    const Thresholds paper = thresholds_of(condition.name, *protocol.discrimination());
    const double ratio = paper.deviation / paper.mean, width = std::sqrt(std::log(1.0 + ratio * ratio));
    std::uint64_t place = participant;
    for (const char c : condition.name) place = place * 131 + static_cast<unsigned char>(c);
    const double share = std::clamp(SplitMix(seed, place).unit(), 1e-9, 1.0 - 1e-9);
    const double at = boost::math::quantile(boost::math::normal(), share);
    Psychometric function{1.0, kSpread, kLapse};
    const double threshold = paper.mean * std::exp(width * at - 0.5 * width * width);
    function.middle = threshold / function.segments_at(balance_point(condition.staircase));
    out.functions[condition.name] = function;
  }
  return out;
}

KnownNamer namer_like_the_papers(const Identification& design) {
  KnownNamer out;
  const auto row_of = [](const std::string& name) {
    return static_cast<std::size_t>(std::find(kPaperObjects.begin(), kPaperObjects.end(), name) -
                                    kPaperObjects.begin());
  };
  for (const std::string& shown : design.objects) {
    std::vector<double> shares;
    double sum = 0.0;
    for (const std::string& named : design.objects) {
      const std::size_t i = row_of(shown), j = row_of(named);
      const bool known = i < kPaperObjects.size() && j < kPaperObjects.size();
      shares.push_back(known ? kPaperConfusionPercent[i][j] : 1.0);
      sum += shares.back();
    }
    for (double& share : shares) share /= sum;
    out.shares.push_back(std::move(shares));
  }
  return out;
}

}  // namespace tangent::experiment
