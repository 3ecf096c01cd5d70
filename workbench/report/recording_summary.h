// What a recording was, in numbers: one pass over its ticks.
#pragma once

#include "workbench/recording/motion_numbers.h"
#include "workbench/recording/recording.h"

#include <array>
#include <functional>
#include <limits>
#include <map>

namespace tangent {

/// What may be wrong with a tick, each with a tick that is the worst of its kind.
enum class TickTrouble : std::uint8_t {
  unconverged,  ///< the search for a contact did not end; worst: the largest error
  facing,       ///< the surface offers no contact; worst: the largest error
  reseed,       ///< tracking was lost; worst, here and for the next two: the largest jump of the decided force
  deeper,       ///< another place was deeper (event `switch`)
  branch,       ///< the solution folded
  many_planes,  ///< converged without event, in more than 8 planes; worst: the most
};
inline constexpr std::array kTickTroubles{TickTrouble::unconverged, TickTrouble::facing, TickTrouble::reseed,
                                          TickTrouble::deeper,      TickTrouble::branch, TickTrouble::many_planes};
const char* to_string(TickTrouble trouble);  ///< "not converged"
/// The first kind that a tick is of.
std::optional<TickTrouble> trouble_of(const TickOutput& output);

struct WorstTick {
  std::uint64_t count = 0;  ///< ticks of this kind
  std::uint64_t tick = 0;   ///< the worst; meaningful where there is one
  double t_s = 0.0;
  double size = -1.0;  ///< m, N or planes
};

/// Quantiles of a time to 2 %, and its exact largest. Of ticks where it was measured.
struct TimeSpread {
  Spread spread;
  std::uint64_t count = 0;
  double most_ns = 0.0;
  void add(double ns);
  double quantile_ns(double q) const;
};

/// What is drawn over time, each as the least and largest of the ticks in a part of the recording.
enum class Drawn : std::uint8_t { force_n, sent_force_n, penetration_m, display_m, sent_display_m, error_m, planes };
inline constexpr std::size_t kDrawn = 7;
struct TimePart {
  std::uint64_t ticks = 0;
  double from_s = 0.0, to_s = 0.0;
  std::array<double, kDrawn> least{}, most{};
  void include(double t_s, const std::array<double, kDrawn>& values);
};

struct RecordingSummary {
  static constexpr std::size_t kParts = 600;

  std::uint64_t ticks = 0;
  std::array<std::uint64_t, kTickStatuses.size()> statuses{};
  std::array<std::uint64_t, kTickEvents.size()> events{};
  std::uint64_t touching = 0;  ///< ticks with a contact: status face, edge or vertex
  double contact_s = 0.0;      ///< their time, each the span to the next tick
  double deepest_m = -std::numeric_limits<double>::infinity();
  double most_force_n = 0.0;  ///< computed
  double mean_planes = 0.0, p99_planes = 0.0;
  std::int64_t most_planes = 0;
  double worst_error_m = 0.0;  ///< of converged ticks
  std::array<WorstTick, kTickTroubles.size()> worst{};

  TimeSpread period, late, tick, solve, latency;
  std::uint64_t missed_deadlines = 0;
  std::array<std::uint64_t, kGateActionCount> gate_actions{};  ///< ticks in which the gate did it
  std::uint64_t armed = 0;                                     ///< ticks in which the gate let force through
  std::uint64_t gate_faulted = 0, device_faulted = 0;          ///< ticks

  struct Use {
    std::uint64_t first_tick = 0, ticks = 0;
    double first_s = 0.0;
  };
  std::map<std::uint32_t, Use> presets, scenes;  ///< by id
  std::vector<TimePart> parts;
  RoughnessSpectrum spectrum;  ///< of force and display as computed
};

/// Fails as reading the ticks does; where `cancelled`, with an Error that says so.
Result<RecordingSummary> summarise(Recording& recording, const std::function<bool()>& cancelled);

}  // namespace tangent
