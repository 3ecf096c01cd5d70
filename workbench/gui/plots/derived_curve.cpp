#include "workbench/gui/plots/derived_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

std::array<float, 2> DerivedCurve::next(const ChannelStore& source, std::uint64_t tick) {
  const auto value = [&](std::size_t k) { return static_cast<double>(source.value(spec_.channels[k], tick)); };
  const double a = value(0);
  double out = std::nan("");
  switch (spec_.how) {
    case Derivation::difference:
      out = a - value(1);
      break;
    case Derivation::derivative:
      out = (a - before_) / spec_.tick_period_s;
      before_ = a;
      break;
    case Derivation::low_pass:
      out = std::isnan(before_)
                ? a
                : before_ - std::expm1(-2.0 * std::numbers::pi * spec_.cutoff_hz * spec_.tick_period_s) * (a - before_);
      before_ = out;
      break;
    case Derivation::magnitude:
      out = std::hypot(a, value(1), value(2));
      break;
  }
  return {static_cast<float>(a), static_cast<float>(out)};
}

const ChannelStore& DerivedCurve::update(const ChannelStore& source, const DerivedSpec& spec) {
  const bool again = store_ == nullptr || !(spec == spec_) || generation_ != source.generation() ||
                     store_->end_tick() < source.first_kept();
  if (again) {
    spec_ = spec;
    generation_ = source.generation();
    store_ = std::make_unique<ChannelStore>(2, source.capacity());
    before_ = std::nan("");
    std::vector<float> rows;
    rows.reserve(2 * static_cast<std::size_t>(source.end_kept() - source.first_kept()));
    for (std::uint64_t tick = source.first_kept(); tick < source.end_kept(); ++tick) {
      const auto row = next(source, tick);
      rows.insert(rows.end(), row.begin(), row.end());
    }
    store_->assign(source.first_kept(), rows);
    computed_ = source.end_kept() - source.first_kept();
    return *store_;
  }
  const std::uint64_t from = store_->end_tick();
  for (std::uint64_t tick = from; tick < source.end_kept(); ++tick) store_->push(tick, next(source, tick));
  computed_ = source.end_kept() > from ? source.end_kept() - from : 0;
  return *store_;
}

}  // namespace tangent
