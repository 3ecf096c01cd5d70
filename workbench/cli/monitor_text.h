// Output of the monitor: a line while it runs, a report at the end.
#pragma once

#include "workbench/session/session.h"

#include <string>

namespace tangent {

/// One line, no newline: states, rate, position, force, display, age.
std::string monitor_line(const Session& session);
/// Rates, histograms, limits and clamps, the link's counters, raw values, the log.
std::string monitor_report(const Session& session);

}  // namespace tangent
