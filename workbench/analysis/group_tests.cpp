#include "workbench/analysis/group_tests.h"

#include "workbench/analysis/studentized_range.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>
#include <numeric>

namespace tangent::analysis {
namespace {

constexpr double kConfidence = 0.95;

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
/// Sum of squares about `mean`.
double squares_about(std::span<const double> values, double mean) {
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum;
}

std::optional<TTest> t_test(double difference, double error, double freedom) {
  if (!(error > 0.0) || !(freedom > 0.0)) return std::nullopt;
  const boost::math::students_t t(freedom);
  const double half = boost::math::quantile(boost::math::complement(t, 0.5 * (1.0 - kConfidence))) * error;
  TTest out{difference / error, freedom, 1.0, difference, difference - half, difference + half};
  out.p = 2.0 * boost::math::cdf(boost::math::complement(t, std::abs(out.t)));
  return out;
}

std::optional<VarianceAnalysis> f_test(double between, double freedom_between, double error, double freedom_error) {
  if (!(freedom_between > 0.0) || !(freedom_error > 0.0) || !(error > 0.0)) return std::nullopt;
  VarianceAnalysis out;
  out.freedom_between = freedom_between;
  out.freedom_error = freedom_error;
  out.mean_square_error = error / freedom_error;
  out.f = between / freedom_between / out.mean_square_error;
  out.p = boost::math::cdf(boost::math::complement(boost::math::fisher_f(freedom_between, freedom_error), out.f));
  return out;
}

struct Squares {
  double count = 0.0, mean = 0.0, between = 0.0, within = 0.0;
};

Squares squares_of(std::span<const std::vector<double>> groups) {
  Squares out;
  double sum = 0.0;
  for (const auto& group : groups) {
    out.count += static_cast<double>(group.size());
    sum += std::accumulate(group.begin(), group.end(), 0.0);
  }
  out.mean = sum / out.count;
  for (const auto& group : groups) {
    const double mean = mean_of(group);
    out.between += static_cast<double>(group.size()) * (mean - out.mean) * (mean - out.mean);
    out.within += squares_about(group, mean);
  }
  return out;
}

bool comparable(std::span<const std::vector<double>> groups) {
  if (groups.size() < 2) return false;
  for (const auto& group : groups)
    if (group.empty()) return false;
  return true;
}

}  // namespace

std::optional<TTest> student_t_test(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const double ma = mean_of(a), mb = mean_of(b), freedom = na + nb - 2.0;
  const double variance = (squares_about(a, ma) + squares_about(b, mb)) / freedom;
  return t_test(ma - mb, std::sqrt(variance * (1.0 / na + 1.0 / nb)), freedom);
}

std::optional<TTest> welch_t_test(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  const auto na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  const double ma = mean_of(a), mb = mean_of(b);
  const double va = squares_about(a, ma) / (na - 1.0) / na, vb = squares_about(b, mb) / (nb - 1.0) / nb;
  if (!(va + vb > 0.0)) return std::nullopt;
  const double freedom = (va + vb) * (va + vb) / (va * va / (na - 1.0) + vb * vb / (nb - 1.0));
  return t_test(ma - mb, std::sqrt(va + vb), freedom);
}

std::optional<TTest> paired_t_test(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 2) return std::nullopt;
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
  const auto n = static_cast<double>(a.size());
  const double mean = mean_of(differences);
  return t_test(mean, std::sqrt(squares_about(differences, mean) / (n - 1.0) / n), n - 1.0);
}

std::optional<VarianceAnalysis> one_way_anova(std::span<const std::vector<double>> groups) {
  if (!comparable(groups)) return std::nullopt;
  const Squares s = squares_of(groups);
  const auto k = static_cast<double>(groups.size());
  return f_test(s.between, k - 1.0, s.within, s.count - k);
}

std::optional<VarianceAnalysis> repeated_measures_anova(std::span<const std::vector<double>> groups) {
  if (!comparable(groups)) return std::nullopt;
  const Squares s = squares_of(groups);
  const auto k = static_cast<double>(groups.size());
  const std::size_t participants = groups.front().size();
  double of_participants = 0.0;
  for (std::size_t i = 0; i < participants; ++i) {
    double mean = 0.0;
    for (const auto& group : groups) mean += group[i] / k;
    of_participants += k * (mean - s.mean) * (mean - s.mean);
  }
  const double freedom = (k - 1.0) * (static_cast<double>(participants) - 1.0);
  return f_test(s.between, k - 1.0, s.within - of_participants, freedom);
}

std::vector<TukeyPair> tukey_test(std::span<const std::vector<double>> groups, const VarianceAnalysis& anova) {
  const int k = static_cast<int>(groups.size());
  const double critical = studentized_range_quantile(1.0 - kConfidence, k, anova.freedom_error);
  std::vector<TukeyPair> out;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (std::size_t j = i + 1; j < groups.size(); ++j) {
      const double sizes = 1.0 / static_cast<double>(groups[i].size()) + 1.0 / static_cast<double>(groups[j].size());
      const double error = std::sqrt(0.5 * anova.mean_square_error * sizes);
      TukeyPair& pair = out.emplace_back();
      pair.first = i;
      pair.second = j;
      pair.difference = mean_of(groups[i]) - mean_of(groups[j]);
      pair.low = pair.difference - critical * error;
      pair.high = pair.difference + critical * error;
      pair.p = studentized_range_above(std::abs(pair.difference) / error, k, anova.freedom_error);
    }
  }
  return out;
}

}  // namespace tangent::analysis
