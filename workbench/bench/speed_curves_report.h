// Speed against error as a table, as JSON and as a figure. Columns and fields: workbench/bench/README.md.
#pragma once

#include "workbench/bench/speed_curves.h"
#include "workbench/session/figure_table.h"
#include "workbench/session/file_origin.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tangent::bench {

/// A line a point, those of the peers last, after the origin as comments.
std::string curves_csv(const SpeedCurves& curves, const FileOrigin& origin);

nlohmann::ordered_json curves_json(const SpeedCurves& curves, const FileOrigin& origin);

/// Time of a tick's mean against the 99th percentile of the error, log-log: bars are the time's interval. A curve over
/// the tolerance is a line, one over the iteration limit dashed, a peer a diamond.
Figure curves_figure(const SpeedCurves& curves);

/// "tolerance 1e-09 m", "limit 8", "preset".
std::string setting_text(const CurveSetting& setting);

}  // namespace tangent::bench
