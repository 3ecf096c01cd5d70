#include "core/lab/explain/find_cure.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tangent {
namespace {

constexpr int kFirstPower = -6, kLastPower = 30;  // of two: changes tried, against the scale
constexpr int kHalvings = 6, kMostHalved = 10;

/// `value` with three digits, rounded away from `from`.
double rounded_away(double from, double value) {
  if (value == 0.0) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  const double steps = value / unit, whole = value > from ? std::ceil(steps) : std::floor(steps);
  char text[32];  // the decimal nearest to it, since a power of ten is not exact
  std::snprintf(text, sizeof text, "%.2e", whole * unit);
  return parse_finite_double(text).value_or(value);
}

}  // namespace

TickCure find_cure_of(const Preset& preset, const CureCandidate& candidate,
                      const std::function<TickOutput(double)>& solve,
                      const std::function<bool(const TickOutput&)>& plain) {
  TickCure cure;
  cure.outcome = CureOutcome::none_in_range;
  const PresetKey& key = *find_preset_key(candidate.key);
  const double from = key.get(preset);
  const auto allowed = [&](double x) {
    x = std::clamp(x, key.min, key.max);
    return key.kind == KeyKind::integer ? std::round(x) : x;
  };
  const auto cures = [&](double x) {
    const TickOutput out = solve(x);
    if (!plain(out)) return false;
    cure = {CureOutcome::found, &key, from, x, false, out};
    return true;
  };
  double failed = from, last = from;
  int halved = 0;
  for (int power = kFirstPower; power <= kLastPower && cure.outcome != CureOutcome::found; ++power) {
    double x = allowed(from + candidate.side * candidate.scale * std::ldexp(1.0, power));
    if (candidate.side < 0 && x < 0.5 * from)  // towards 0 by halves, so that nothing lies far between
      x = ++halved <= kMostHalved ? allowed(std::ldexp(from, -halved)) : key.min;
    if (x == last) {
      if (x == (candidate.side > 0 ? key.max : key.min)) break;
      continue;
    }
    last = x;
    if (!cures(x)) failed = x;
  }
  if (cure.outcome != CureOutcome::found) return cure;
  for (int i = 0; i < kHalvings; ++i) {
    const double x = allowed(0.5 * (failed + cure.to));
    if (x == failed || x == cure.to) break;
    if (!cures(x)) failed = x;
  }
  const double rounded = allowed(rounded_away(from, cure.to));
  if (rounded != cure.to) cures(rounded);
  return cure;
}

TickCure find_cure(TickTrials& trials, std::span<const CureCandidate> candidates, CuredWhen when) {
  TickCure best;
  best.outcome = CureOutcome::none_in_range;
  double least = std::numeric_limits<double>::infinity();
  for (const CureCandidate& candidate : candidates) {
    const PresetKey& key = *find_preset_key(candidate.key);
    const TickCure cure = find_cure_of(
        trials.preset, candidate,
        [&](double x) {
          Preset changed = trials.preset;
          key.set(changed, x);
          return trials.solve(changed);
        },
        [&](TickOutput out) {
          if (when == CuredWhen::converged) out.iterations = 0;
          return trials.plain(out, trials.is_first());
        });
    const double change = std::abs(cure.to - cure.from) / candidate.scale;
    if (cure.outcome != CureOutcome::found || !(change < least)) continue;
    least = change;
    best = cure;
  }
  return best;
}

}  // namespace tangent
