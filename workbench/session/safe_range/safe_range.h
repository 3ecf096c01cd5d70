// Where a value is known to be safe: verdicts of presets that differ in it alone, and what they say about the values
// between. SI units.
//
// A line: presets that are `base` but for one key, whose slider is tried at kFirst even places (every choice; every
// whole number up to that many), and at base's own value; then between two neighbours that are not alike kHalvings
// times in the middle. Between two stable neighbours a value is taken for stable, between two that shake for shaking,
// and for unknown between others and outside.
#pragma once

#include "workbench/session/safe_range/verdict_store.h"

#include <functional>
#include <vector>

namespace tangent {

struct RangePiece {
  double from = 0.0, to = 0.0;
  Safety safety = Safety::unknown;
  bool operator==(const RangePiece&) const = default;
};

class SafeRange {
 public:
  static constexpr std::size_t kFirst = 9;
  static constexpr int kHalvings = 3;

  struct Sample {
    double value = 0.0;
    Verdict verdict;
    bool operator==(const Sample&) const = default;
  };
  SafeRange() = default;
  /// Sorted by value, each value once. `steps`: whole numbers or choices, nothing is between them.
  SafeRange(std::vector<Sample> samples, bool steps) : samples_(std::move(samples)), steps_(steps) {}

  Safety at(double value) const;
  const std::vector<Sample>& samples() const { return samples_; }
  /// From the first sample to the last, neighbours of one kind joined; a choice reaches half a step to either side.
  std::vector<RangePiece> pieces() const;
  bool operator==(const SafeRange&) const = default;

 private:
  std::vector<Sample> samples_;
  bool steps_ = false;
};

/// Keys with a line of their own: those in the loop that this preset reads, without the finger, which everything hangs
/// on. In the order of the schema.
std::vector<const PresetKey*> keys_with_range(const Preset& preset, bool planar);

/// `judge` is asked for one preset after the other. Empty when it returns nothing: it was cancelled.
using JudgePreset = std::function<std::optional<Verdict>(const Preset&)>;
SafeRange sweep_line(const Preset& base, const PresetKey& key, const JudgePreset& judge);

/// "stable from 100 to 2400 N/m, shakes from 3000 N/m on": for a person; values by `text`. Empty: nothing is known.
std::string range_words(const SafeRange& range, const std::function<std::string(double)>& text);

/// Largest stiffness that is passive for every operator: b > K T / 2 + |B|, J. E. Colgate and J. M. Brown, Factors
/// Affecting the Z-Width of a Haptic Display, IEEE ICRA 1994. `b`: damping of device and hand, N s/m; `wall`: damping
/// of the wall. 0: none is.
double passive_stiffness(double b_n_s_per_m, double wall_n_s_per_m, double period_s);

}  // namespace tangent
