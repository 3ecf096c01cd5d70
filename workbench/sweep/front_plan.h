// What a search for presets is asked: what to vary, what to make small, what to keep to, and on what.
#pragma once

#include "workbench/sweep/cells.h"
#include "workbench/sweep/front.h"
#include "workbench/sweep/inputs.h"

#include <array>
#include <functional>
#include <optional>
#include <string>

namespace tangent::sweep {

struct RacedTrial;

/// A mesh and motion to be good on.
struct FrontGround {
  Ground ground;
  std::size_t ticks = 0;                        ///< the motion's first: those after it are held back for the verdict
  std::optional<Finger> finger = std::nullopt;  ///< in place of the preset's
  TimeScale scale = {};                         ///< for constraints of time
  std::string name = {};                        ///< for people
};

/// The preset with the ground's finger.
Preset on_ground(Preset preset, const FrontGround& on);

/// What an objective is over several grounds. A constraint has to hold on each of them.
enum class OverGrounds : std::uint8_t {
  worst,  ///< of the ground where it is largest: no easy ground can pay for a hard one
  mean,   ///< over the grounds
};
inline constexpr std::array<std::string_view, 2> kOverGroundsNames{"worst", "mean"};

struct FrontPlan {
  Preset base;
  std::vector<Range> ranges;  ///< each from ... to
  std::vector<Objective> objectives;
  std::vector<Constraint> constraints;
  std::vector<Preset> starts;     ///< tried first, as they are: theory's gains, what there was before
  std::size_t evaluations = 500;  ///< trials in all
  std::uint64_t seed = 1;
  unsigned threads = 1;
  OverGrounds over_grounds = OverGrounds::worst;
  bool race = true;    ///< false: every trial sees all ticks
  bool evolve = true;  ///< false: even draws only, as without pagmo
  // For whoever watches, called by the threads that try.
  std::function<bool()> stop;               ///< asked often; true: the search ends at once, keeps the finished trials
  std::function<void(const Trial&)> tried;  ///< each trial as it is done; of several threads in any order
  // For whoever keeps what was tried, to go on with a search that was ended (tuning_file.h). Trials have numbers, from
  // 0.
  /// Null: was not tried with these values. Called by any thread.
  std::function<const RacedTrial*(std::size_t number, const std::vector<double>& values)> known;
  std::function<void(std::size_t number, const RacedTrial&)> keep;  ///< each that was not known, by any thread
};

}  // namespace tangent::sweep
