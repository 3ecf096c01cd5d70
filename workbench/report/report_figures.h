// The figures of a report. They carry no name that a person typed.
#pragma once

#include "workbench/report/report_data.h"
#include "workbench/session/figure_table.h"

namespace tangent {

/// "A", "B", ...: how figure, picture and text name the worst ticks, in the order of RecordingReport::explained.
std::string letter_of(std::size_t explained);

/// Force, penetration, display, error and planes over time; the worst ticks are marked by their letters. `name`: a
/// word, that of the figure.
Figure time_figure(const RecordingReport& report, const std::string& name);

/// Time of a typical tick against the contact's error, for every method: a point at the 99th percentile of the error, a
/// line from its median, and the interval of the time.
Figure methods_figure(const bench::MethodComparison& methods, const std::string& name);

}  // namespace tangent
