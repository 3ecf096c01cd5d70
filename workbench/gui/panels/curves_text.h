// Numbers and points of speed against error as text.
#pragma once

#include "workbench/bench/speed_curves.h"

#include <string>

namespace tangent {

std::string length_in_unit(double m);  ///< "2 nm"
std::string time_in_unit(double ns);   ///< "160 ns"

/// Setting, errors, times with their intervals, iterations and failures, a line each.
std::string curve_point_text(const bench::CurvePoint& p);
/// Precondition: it has an error.
std::string curve_peer_text(const bench::CurvePeer& p);

}  // namespace tangent
