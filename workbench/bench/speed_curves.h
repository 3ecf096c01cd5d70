// Speed against error on one motion: every method as two curves, one over the tolerance and one over the iteration
// limit, and other libraries as points. All take turns (turns.h), so that what the machine does besides falls on all.
#pragma once

#include "workbench/bench/compare_methods.h"
#include "workbench/bench/peers.h"

#include <array>
#include <string_view>

namespace tangent::bench {

enum class Swept : std::uint8_t {
  nothing,     ///< as the preset has it
  tolerance,   ///< with kLastIterations as the limit, where the preset's is lower
  iterations,  ///< at the preset's tolerance
};
inline constexpr std::array<std::string_view, 3> kSweptNames{"nothing", "tolerance", "iterations"};

struct CurveSetting {
  Method method = Method::robust;
  Swept swept = Swept::nothing;
  double tolerance_m = 0.0;
  int max_iterations = 0;
};

/// The preset with the setting's values.
Preset with_setting(Preset preset, const CurveSetting& setting);

struct CurvePoint {
  CurveSetting setting;
  ErrorSummary errors;  ///< error_m: all ticks; those that did not converge by the place where they were given up
  TickTimes times;
};

struct CurvePeer {
  Peer peer;
  std::uint64_t answered = 0;  ///< ticks with an answer
  /// Of its point from the exact contact of the smooth surface; of fingers that are not round none.
  std::optional<Distribution> error_m;
  PartTick worst;
  TickTimes times;
};

/// Of a method the fastest of its points that leave fewest ticks unconverged, with a p99 of the error within the level.
struct LevelEntry {
  std::size_t point = 0;
  RatioInterval to_fastest;
  bool tie = false;
};
struct ErrorLevel {
  double error_m = 0.0;
  std::vector<LevelEntry> methods;  ///< the fastest first; methods without such a point are left out
};

struct SpeedCurves {
  std::vector<CurvePoint> points;  ///< by method, then nothing, tolerances and limits in order
  std::vector<CurvePeer> peers;
  std::vector<ErrorLevel> levels;  ///< the largest error first
  std::uint64_t ticks = 0, seed = 1;
  int rounds = 0;
  double coverage = 0.0;  ///< of the intervals of TickTimes
  double clock_overhead_ns = 0.0;
};

struct SpeedCurvesOptions {
  std::vector<Method> methods{kMeasuredMethods.begin(), kMeasuredMethods.end()};
  std::vector<double> tolerances_m{1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  std::vector<int> limits{1, 2, 3, 5, 8, 12, 20, 50};
  bool peers = true;
  int rounds = 9;        ///< each there and back
  double most_s = 60.0;  ///< no round begins later, but for the first kLeastRounds
  std::uint64_t seed = 1;
  Stop stop = [] { return false; };
  /// After each setting's errors and each pass: how much of it all is done.
  std::function<void(std::size_t done, std::size_t planned)> progress = [](std::size_t, std::size_t) {};
  /// After each round: what there is so far.
  std::function<void(const SpeedCurves&)> after_round = [](const SpeedCurves&) {};
};

/// From so many rounds on the intervals hold the median in at least 95 %.
inline constexpr int kLeastRounds = 6;
inline constexpr int kLastIterations = 500;  ///< the paper's iteration converges linearly

/// Precondition: every part is on a mesh. Stopped after a round: what there is. Empty: stopped before, or no ticks.
std::optional<SpeedCurves> measure_speed_curves(std::span<const MotionPart> parts, const TickClock& clock,
                                                const SpeedCurvesOptions& options = {});

}  // namespace tangent::bench
