// Lines of a tuning_file.h, as JSON.
#pragma once

#include "core/lab/gains/gain_tuning.h"
#include "workbench/sweep/trial_run.h"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tangent::sweep {

struct NumberedTrial {
  std::size_t number = 0;  ///< in the order of the search
  RacedTrial trial;
};
using TuningLine = std::variant<NumberedTrial, GainTrial, std::vector<TimeScale>>;

std::string tuning_name_line(const std::string& digest);
bool is_tuning_name_line(std::string_view text, const std::string& digest);

std::string trial_line(std::size_t number, const RacedTrial& trial);
std::string gains_line(const GainTrial& trial);
std::string scales_line(const std::vector<TimeScale>& scales);
/// False: it is none of these. Every number reads back to the bit.
bool parse_tuning_line(std::string_view text, TuningLine& line);

}  // namespace tangent::sweep
