// How many participants a difference needs: simulated groups through a protocol's rule and the test that the analysis
// makes, beside what theory says of normal values (noncentral t and F).
#pragma once

#include "core/base/result.h"
#include "workbench/experiment/protocol.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tangent::analysis {

/// What is assumed of participants: ours, as the paper says nothing of it.
inline constexpr double kPowerBetween = 0.35;  ///< deviation of ln(threshold) over participants, as Table 1's C3 and C4
inline constexpr double kPowerShared = 0.5;    ///< of its variance, what one participant has in all conditions alike

struct PowerRow {
  std::string test;         ///< "paired t", "analysis of variance"
  double difference = 0.0;  ///< that there is: a ratio of thresholds, or of right answers in percent
  int participants = 0;
  double found = 0.0, low = 0.0, high = 0.0;  ///< share of simulated groups in which it is found at 5 %, 95 % interval
  double theory = 0.0;
};

struct PowerTable {
  std::string difference;  ///< what it is of: "threshold, ratio"
  std::vector<PowerRow> rows;
};

/// `groups`: simulated for each difference. Of a discrimination, two conditions of which one has a threshold so many
/// times the other's (paired t of ln(threshold)), and all conditions, one of them so much higher (analysis of variance
/// within participants). Of an identification, right answers under two kinds of trials
/// (paired t). Deterministic. Stops early, with fewer rows, when `stop` says so: it is asked before each
/// simulated participant. Fails where the protocol's staircase does not settle.
Result<PowerTable> power_table(const experiment::Protocol& protocol, int groups,
                               const std::function<bool()>& stop = {});

/// Probability that a paired t test of `count` differences at 5 % finds a mean difference of `effect` deviations.
double paired_t_power(double effect, int count);
/// That an analysis of variance within `count` participants does; `squares`: sum of the squared deviations of the
/// conditions' means from theirs, in variances of what is left when participants are taken out.
double anova_power(double squares, int conditions, int count);

}  // namespace tangent::analysis
