#include "workbench/sweep/tuning_lines.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace tangent::sweep {
namespace {

using nlohmann::json;

constexpr int kTuningFormat = 1;

json whole_line(std::string_view text) { return json::parse(text, nullptr, false); }

/// JSON has no infinity.
json number_json(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double number_of(const json& at) {
  if (!at.is_string()) return at.get<double>();
  const auto text = at.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return text == "-inf" ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

json numbers_json(const std::vector<double>& values) {
  json out = json::array();
  for (const double value : values) out.push_back(number_json(value));
  return out;
}

std::vector<double> numbers_of(const json& at) {
  std::vector<double> out;
  for (const json& value : at) out.push_back(number_of(value));
  return out;
}

json cell_json(const CellNumbers& numbers) {
  json out = json::array();
  for (const NumberColumn& column : number_columns()) {
    if (const auto* const whole = std::get_if<std::uint64_t CellNumbers::*>(&column.field))
      out.push_back(numbers.*(*whole));
    else
      out.push_back(number_json(numbers.*(std::get<double CellNumbers::*>(column.field))));
  }
  return out;
}

CellNumbers cell_of(const json& at) {
  CellNumbers out;
  for (std::size_t i = 0; i < number_columns().size(); ++i) {
    const auto& field = number_columns()[i].field;
    if (const auto* const whole = std::get_if<std::uint64_t CellNumbers::*>(&field))
      out.*(*whole) = at.at(i).get<std::uint64_t>();
    else
      out.*(std::get<double CellNumbers::*>(field)) = number_of(at.at(i));
  }
  return out;
}

RacedTrial raced_of(const json& at) {
  RacedTrial out;
  Trial& trial = out.trial;
  trial.values = numbers_of(at.at("values"));
  trial.objectives = numbers_of(at.at("objectives"));
  trial.missed = number_of(at.at("missed"));
  trial.ticks = at.at("ticks").get<std::size_t>();
  trial.dropped = at.at("dropped").get<bool>();
  trial.numbers = cell_of(at.at("numbers"));
  for (const json& ground : at.at("grounds")) trial.ground_numbers.push_back(cell_of(ground));
  for (const json& ground : at.at("costs")) {
    out.costs.emplace_back();
    for (const json& block : ground) out.costs.back().push_back(numbers_of(block));
  }
  return out;
}

GainTrial gains_of_line(const json& at) {
  const std::vector<double> gains = numbers_of(at.at("gains"));
  GainTrial out;
  out.gains = {gains.at(0), gains.at(1), gains.at(2)};
  RunScore& score = out.score;
  score.ticks = at.at("ticks").get<std::uint64_t>();
  score.unconverged = at.at("unconverged").get<std::uint64_t>();
  score.reseeded = at.at("reseeded").get<std::uint64_t>();
  score.iterations = at.at("iterations").get<std::uint64_t>();
  score.p99_iterations = at.at("p99_iterations").get<std::int32_t>();
  score.max_iterations = at.at("max_iterations").get<std::int32_t>();
  score.max_error_m = number_of(at.at("max_error_m"));
  return out;
}

std::vector<TimeScale> scales_of(const json& at) {
  std::vector<TimeScale> out;
  for (const json& scale : at) out.push_back({number_of(scale.at(0)), number_of(scale.at(1))});
  return out;
}

}  // namespace

std::string tuning_name_line(const std::string& digest) {
  return json{{"format", kTuningFormat}, {"tuning", digest}}.dump();
}

bool is_tuning_name_line(std::string_view text, const std::string& digest) { return text == tuning_name_line(digest); }

std::string trial_line(std::size_t number, const RacedTrial& raced) {
  const Trial& trial = raced.trial;
  json out{{"trial", number},
           {"values", numbers_json(trial.values)},
           {"objectives", numbers_json(trial.objectives)},
           {"ticks", trial.ticks},
           {"missed", number_json(trial.missed)},
           {"dropped", trial.dropped},
           {"numbers", cell_json(trial.numbers)}};
  json& grounds = out["grounds"] = json::array();
  for (const CellNumbers& numbers : trial.ground_numbers) grounds.push_back(cell_json(numbers));
  json& costs = out["costs"] = json::array();
  for (const BlockCosts& ground : raced.costs) {
    json& blocks = costs.emplace_back(json::array());
    for (const std::vector<double>& block : ground) blocks.push_back(numbers_json(block));
  }
  return out.dump();
}

std::string gains_line(const GainTrial& trial) {
  const RunScore& score = trial.score;
  return json{{"gains", numbers_json({trial.gains.overall, trial.gains.curvature_m, trial.gains.distance_per_m})},
              {"ticks", score.ticks},
              {"unconverged", score.unconverged},
              {"reseeded", score.reseeded},
              {"iterations", score.iterations},
              {"p99_iterations", score.p99_iterations},
              {"max_iterations", score.max_iterations},
              {"max_error_m", number_json(score.max_error_m)}}
      .dump();
}

std::string scales_line(const std::vector<TimeScale>& scales) {
  json list = json::array();
  for (const TimeScale& scale : scales) list.push_back(numbers_json({scale.mean, scale.p99}));
  return json{{"scales", list}}.dump();
}

bool parse_tuning_line(std::string_view text, TuningLine& line) {
  const json at = whole_line(text);
  if (!at.is_object()) return false;
  try {  // the checksum held: only another program's line fails here
    if (at.contains("trial"))
      line = NumberedTrial{at.at("trial").get<std::size_t>(), raced_of(at)};
    else if (at.contains("gains"))
      line = gains_of_line(at);
    else
      line = scales_of(at.at("scales"));
  } catch (const json::exception&) {
    return false;
  } catch (const std::out_of_range&) {  // fewer than three gains
    return false;
  }
  return true;
}

}  // namespace tangent::sweep
