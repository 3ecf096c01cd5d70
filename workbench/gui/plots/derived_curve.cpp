#include "workbench/gui/plots/derived_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tangent {

namespace {

std::size_t parts_of(const ChannelExpression& expression) {
  std::size_t count = 1;
  for (const ChannelExpression& operand : expression.of) count += parts_of(operand);
  return count;
}

}  // namespace

double DerivedCurve::value(const ChannelExpression& expression, const ChannelStore& source, std::uint64_t tick,
                           std::size_t& place) {
  double& before = before_[place++];
  if (expression.how == Derivation::none) return static_cast<double>(source.value(expression.channel, tick));
  std::array<double, 3> of{};
  for (std::size_t i = 0; i < expression.of.size(); ++i) of[i] = value(expression.of[i], source, tick, place);
  switch (expression.how) {
    case Derivation::difference:
      return of[0] - of[1];
    case Derivation::derivative:
      return (of[0] - std::exchange(before, of[0])) / tick_period_s_;
    case Derivation::low_pass:
      before =
          std::isnan(before)
              ? of[0]
              : before - std::expm1(-2.0 * std::numbers::pi * expression.cutoff_hz * tick_period_s_) * (of[0] - before);
      return before;
    case Derivation::magnitude:
      return std::hypot(of[0], of[1], of[2]);
    case Derivation::none:
      break;
  }
  return std::nan("");
}

float DerivedCurve::next(const ChannelStore& source, std::uint64_t tick) {
  std::size_t place = 0;
  return static_cast<float>(value(expression_, source, tick, place));
}

void DerivedCurve::begin(const ChannelStore& source, const ChannelExpression& expression, double tick_period_s) {
  expression_ = expression;
  tick_period_s_ = tick_period_s;
  generation_ = source.generation();
  store_ = std::make_unique<ChannelStore>(1, source.capacity());
  before_.assign(parts_of(expression), std::nan(""));
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(source.end_kept() - source.first_kept()));
  for (std::uint64_t tick = source.first_kept(); tick < source.end_kept(); ++tick) values.push_back(next(source, tick));
  store_->assign(source.first_kept(), values);
}

const ChannelStore& DerivedCurve::update(const ChannelStore& source, const ChannelExpression& expression,
                                         double tick_period_s) {
  const bool again = store_ == nullptr || !(expression == expression_) || tick_period_s != tick_period_s_ ||
                     generation_ != source.generation() || store_->end_tick() < source.first_kept();
  const std::uint64_t from = again ? source.first_kept() : store_->end_tick();
  if (again) begin(source, expression, tick_period_s);
  for (std::uint64_t tick = store_->end_tick(); tick < source.end_kept(); ++tick) {
    const float sample = next(source, tick);
    store_->push(tick, {&sample, 1});
  }
  store_->drop_before(source.first_kept());  // what is forgotten is not drawn
  computed_ = std::max(from, source.end_kept()) - from;
  return *store_;
}

}  // namespace tangent
