// Do groups differ: Student's and Welch's t, one-way and repeated-measures analysis of variance, Tukey's test.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent::analysis {

struct TTest {
  double t = 0.0;
  double freedom = 0.0;
  double p = 1.0;                ///< both sides
  double difference = 0.0;       ///< of the means, first less second
  double low = 0.0, high = 0.0;  ///< its 95 % interval
};
/// None where a side has fewer than two values, or none varies.
std::optional<TTest> student_t_test(std::span<const double> a, std::span<const double> b);  ///< equal variances
std::optional<TTest> welch_t_test(std::span<const double> a, std::span<const double> b);
/// Precondition: as many of each.
std::optional<TTest> paired_t_test(std::span<const double> a, std::span<const double> b);

struct VarianceAnalysis {
  double f = 0.0;
  double freedom_between = 0.0, freedom_error = 0.0;
  double mean_square_error = 0.0;
  double p = 1.0;
};
/// Groups of independent values. None where they are fewer than two, have no values to spare, or do not vary.
std::optional<VarianceAnalysis> one_way_anova(std::span<const std::vector<double>> groups);
/// The same participants in every group, in the same order: what is theirs is taken out. Precondition: groups of one
/// size.
std::optional<VarianceAnalysis> repeated_measures_anova(std::span<const std::vector<double>> groups);

/// One pair of groups under Tukey's honestly significant difference.
struct TukeyPair {
  std::size_t first = 0, second = 0;
  double difference = 0.0;       ///< of the means, first less second
  double low = 0.0, high = 0.0;  ///< its 95 % interval, for all pairs at once
  double p = 1.0;
};
/// Groups may differ in size (Tukey & Kramer). Precondition: `anova` is of these groups.
std::vector<TukeyPair> tukey_test(std::span<const std::vector<double>> groups, const VarianceAnalysis& anova);

}  // namespace tangent::analysis
