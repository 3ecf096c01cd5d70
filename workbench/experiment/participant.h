// Simulated participants. Those whose answers follow a known law feel nothing: they are there to try protocols and
// their analysis, and to plan how many people a difference needs. One who feels (feeling.h) touches what a protocol
// shows.
#pragma once

#include "core/base/split_mix.h"
#include "workbench/experiment/comparison_run.h"
#include "workbench/experiment/feeling.h"
#include "workbench/experiment/feeling_namer.h"
#include "workbench/experiment/naming_run.h"
#include "workbench/experiment/psychometric.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tangent::experiment {

/// Answers comparisons by a psychometric function for each condition.
struct KnownComparer {
  std::map<std::string, Psychometric> functions;  ///< by condition
  double drift = 0.0;  ///< of ln(middle) from the first to the hundredth trial of a condition: below 0 tires
};

/// Names objects by a table of what is taken for what, row by stimulus, each summing to 1.
struct KnownNamer {
  std::vector<std::vector<double>> shares;
  double seconds = 8.0;         ///< from the first touch to the answer, on average
  double touching_share = 0.7;  ///< of that
};

/// Takes a whole run, or what is left of it, to its end, and hands each row over as it is made.
void take_part(ComparisonRun& run, const KnownComparer& participant, std::uint64_t seed,
               const std::function<void(const ComparisonRow&)>& row);
/// Fails where a stimulus can't be made.
Status take_part(ComparisonRun& run, FeelingComparer& participant, std::uint64_t seed,
                 const std::function<void(const ComparisonRow&)>& row);
/// One session. Fails where a stimulus can't be made.
Status take_part(NamingRun& run, const Identification& design, FeelingNamer& participant, std::uint64_t seed,
                 const std::function<void(const NamingRow&)>& row);
/// One session.
void take_part(NamingRun& run, const Identification& design, const KnownNamer& participant, std::uint64_t seed,
               const std::function<void(const NamingRow&)>& row);

}  // namespace tangent::experiment
