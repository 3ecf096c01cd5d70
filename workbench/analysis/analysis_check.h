// Do protocol and analysis keep what they say: simulated participants whose law is known, through the whole of them,
// and what came out beside what should have.
#pragma once

#include "workbench/experiment/protocol.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tangent::analysis {

inline constexpr double kNothingAsked = std::numeric_limits<double>::quiet_NaN();

struct CheckRow {
  std::string what, unit;
  std::uint64_t count = 0;       ///< that it was found from
  double found = 0.0;            ///< mean, share or ratio
  double low = 0.0, high = 0.0;  ///< 95 % interval of `found`; not finite: none
  double expected = kNothingAsked;
  double seconds = 0.0;  ///< that it took
};

/// `participants`: simulated ones through the protocol; what is dearer takes fewer. Rows hang on the number alone, but
/// for the seconds. Stops early, with fewer rows, when `stop` says so.
std::vector<CheckRow> check_analysis(const experiment::Protocol& protocol, int participants,
                                     const std::function<bool()>& stop = {});

}  // namespace tangent::analysis
