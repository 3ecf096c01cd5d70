// Histogram of durations on a logarithmic axis.
#pragma once

#include "devices/base/log_histogram.h"
#include "workbench/gui/widgets/ui_context.h"

#include <vector>

namespace tangent {

/// Counts in 8 columns per decade.
struct DecadeColumns {
  static constexpr int kPerDecade = 8;
  int first = 0;                      ///< the first column starts at 10^(first / kPerDecade)
  std::vector<std::uint64_t> counts;  ///< empty: nothing was counted
  std::uint64_t most = 0;
};
/// `least`: smaller values are counted as this one.
DecadeColumns decade_columns(const LogHistogram& histogram, std::uint64_t least = 1);

/// Title with median and 99th percentile, bars, axis in milliseconds. `ns_per_count`: of the histogram's values.
void draw_duration_histogram(const UiContext& ui, const char* title, const LogHistogram& histogram, double ns_per_count,
                             ImU32 ink, float height);

}  // namespace tangent
