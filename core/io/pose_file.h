// Finger poses from a CSV file: columns `t_s,x_m,y_m,z_m` and, all or none, `qw,qx,qy,qz`, by name in any order, others
// ignored; one pose per line. World frame, SI; the quaternion maps the finger frame to the world (identity when
// absent).
#pragma once

#include "core/base/result.h"
#include "core/tick/step.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace tangent {

/// A quaternion's length may differ from 1 by this much (rounded decimals); it is then normalised.
inline constexpr double kQuaternionLengthTolerance = 1e-3;
/// Positions further out than this, m, are refused as a wrong unit or a damaged file.
inline constexpr double kFarthestPose = 1e9;
/// Time from a pose to the next, at least, s: 1 MHz, a hundred times the fastest servo.
inline constexpr double kLeastStampStep = 1e-6;

/// `name` stands for the file in messages. Errors name the line: a column that is missing, another number of fields,
/// anything that is not a finite number, time that does not increase by kLeastStampStep, a quaternion that is not a
/// rotation, no poses.
Result<std::vector<TickInput>> parse_poses(std::string_view text, std::string_view name);
/// A file of more than 1 GiB is refused, more than 256 MiB through a pipe, and what has no end as soon as it shows that
/// it is no text (input_file.h).
Result<std::vector<TickInput>> read_poses(const std::filesystem::path& path);

}  // namespace tangent
