#include "workbench/session/safe_range/safe_range.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace tangent {

namespace {

/// A slider's places: even, or even in the logarithm. A range from 0 begins a millionth of its end above it, as in the
/// window.
class Spacing {
 public:
  explicit Spacing(const PresetKey& key)
      : log_(key.logarithmic && key.slider_max > 0.0), low_(key.slider_min), high_(key.slider_max) {
    if (log_ && low_ <= 0.0) low_ = 1e-6 * high_;
  }
  double at(double share) const { return log_ ? low_ * std::pow(high_ / low_, share) : low_ + share * (high_ - low_); }
  double middle(double a, double b) const { return log_ && a > 0.0 && b > 0.0 ? std::sqrt(a * b) : a + 0.5 * (b - a); }

 private:
  bool log_;
  double low_, high_;
};

std::set<double> first_values(const Preset& base, const PresetKey& key) {
  std::set<double> values;
  if (key.kind == KeyKind::choice) {
    for (std::size_t i = 0; i < key.choices.size(); ++i) values.insert(static_cast<double>(i));
    return values;
  }
  const Spacing spacing(key);
  for (std::size_t i = 0; i < SafeRange::kFirst; ++i) {
    const double value = spacing.at(static_cast<double>(i) / (SafeRange::kFirst - 1));
    values.insert(std::clamp(key.kind == KeyKind::integer ? std::round(value) : value, key.min, key.max));
  }
  if (key.slider_min == 0.0) values.insert(0.0);
  values.insert(key.get(base));
  return values;
}

bool alike(const Verdict& a, const Verdict& b) { return a.safety == b.safety; }

/// Between neighbours that differ; empty: nothing is.
std::vector<double> middles(const std::vector<SafeRange::Sample>& samples, const PresetKey& key) {
  std::vector<double> out;
  if (key.kind == KeyKind::choice) return out;
  const Spacing spacing(key);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (alike(samples[i - 1].verdict, samples[i].verdict)) continue;
    const double a = samples[i - 1].value, b = samples[i].value;
    double middle = spacing.middle(a, b);
    if (key.kind == KeyKind::integer) middle = std::round(middle);
    if (middle > a && middle < b) out.push_back(middle);
  }
  return out;
}

}  // namespace

Safety SafeRange::at(double value) const {
  const auto above =
      std::lower_bound(samples_.begin(), samples_.end(), value, [](const Sample& s, double v) { return s.value < v; });
  if (above == samples_.end()) return Safety::unknown;
  if (above->value == value) return above->verdict.safety;
  if (above == samples_.begin()) return Safety::unknown;
  const Verdict &a = std::prev(above)->verdict, &b = above->verdict;
  return alike(a, b) ? a.safety : Safety::unknown;
}

std::vector<RangePiece> SafeRange::pieces() const {
  std::vector<RangePiece> out;
  const auto add = [&](double from, double to, Safety safety) {
    if (!out.empty() && out.back().safety == safety && out.back().to >= from)
      out.back().to = to;
    else
      out.push_back({from, to, safety});
  };
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double value = samples_[i].value;
    if (steps_) {
      add(value - 0.5, value + 0.5, samples_[i].verdict.safety);
      continue;
    }
    if (i > 0) add(samples_[i - 1].value, value, at(samples_[i - 1].value + 0.5 * (value - samples_[i - 1].value)));
  }
  return out;
}

std::vector<const PresetKey*> keys_with_range(const Preset& preset, bool planar) {
  std::vector<const PresetKey*> out;
  for (const PresetKey& key : preset_keys()) {
    const bool read = key.read_by == kNoMethod || key.read_by.has(preset.solver.method);
    const bool counts = key.condition.holds == nullptr || key.condition.holds(preset);
    if (is_in_loop(key) && key.table != "finger" && read && counts && (planar || !key.planar_only)) out.push_back(&key);
  }
  return out;
}

SafeRange sweep_line(const Preset& base, const PresetKey& key, const JudgePreset& judge) {
  std::vector<SafeRange::Sample> samples;
  const auto try_at = [&](double value) {
    Preset preset = base;
    key.set(preset, value);
    const auto verdict = judge(preset);
    if (!verdict) return false;
    const auto at = std::lower_bound(samples.begin(), samples.end(), value,
                                     [](const SafeRange::Sample& s, double v) { return s.value < v; });
    samples.insert(at, {value, *verdict});
    return true;
  };
  for (const double value : first_values(base, key))
    if (!try_at(value)) return {};
  for (int i = 0; i < SafeRange::kHalvings; ++i)
    for (const double value : middles(samples, key))
      if (!try_at(value)) return {};
  return {std::move(samples), key.kind == KeyKind::choice};
}

std::string range_words(const SafeRange& range, const std::function<std::string(double)>& text) {
  std::string out;
  if (range.samples().empty()) return out;
  for (const RangePiece& piece : range.pieces()) {
    if (piece.safety == Safety::unknown) continue;
    out += (out.empty() ? "" : ", ") + std::string(to_string(piece.safety)) + " from " + text(piece.from) + " to " +
           text(piece.to);
  }
  return out.empty() ? "nothing is known to be stable" : out;
}

double passive_stiffness(double b_n_s_per_m, double wall_n_s_per_m, double period_s) {
  return std::max(0.0, 2.0 * (b_n_s_per_m - std::abs(wall_n_s_per_m)) / period_s);
}

}  // namespace tangent
