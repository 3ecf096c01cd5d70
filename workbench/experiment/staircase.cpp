#include "workbench/experiment/staircase.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent::experiment {

double balance_point(const StaircaseRule& rule) { return std::pow(0.5, 1.0 / rule.down); }

int Staircase::segments() const { return static_cast<int>(std::lround(level_)); }

bool Staircase::done() const { return settled() || trials_ >= rule_.most_trials; }

void Staircase::step(int direction) {
  const bool large = reversals_.size() < static_cast<std::size_t>(rule_.large_reversals);
  const double size = large ? rule_.large_step : rule_.small_step;
  const double next =
      rule_.scale == StepScale::ratio ? level_ * (direction > 0 ? size : 1.0 / size) : level_ + direction * size;
  const int shown = segments();
  level_ = std::clamp(next, rule_.fewest, rule_.most);
  // Few segments times a small ratio round to as many: a step that shows the same is none (5.2.4).
  if (segments() == shown) level_ = std::clamp(static_cast<double>(shown + direction), rule_.fewest, rule_.most);
}

bool Staircase::answer(bool right) {
  ++trials_;
  right_in_row_ = right ? right_in_row_ + 1 : 0;
  if (right && right_in_row_ < rule_.down) return false;
  right_in_row_ = 0;
  const int direction = right ? 1 : -1;
  const bool turned = direction_ != 0 && direction != direction_;
  const double shown = segments();
  step(direction);  // before the reversal counts: the step that makes the last of the large ones is large
  direction_ = direction;
  if (turned) reversals_.push_back(shown);
  return turned;
}

double Staircase::threshold() const {
  const auto averaged = static_cast<std::ptrdiff_t>(rule_.averaged);
  return std::accumulate(reversals_.end() - averaged, reversals_.end(), 0.0) / rule_.averaged;
}

}  // namespace tangent::experiment
