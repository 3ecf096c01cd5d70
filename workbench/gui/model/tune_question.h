// What the window's Tune section searches for: numbers to make small, what to keep to, keys and where to look for
// them, on which motion. And what theory says of a key.
#pragma once

#include "workbench/session/unit_labels.h"
#include "workbench/sweep/objective.h"
#include "workbench/sweep/plan.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

enum class TuneMotion : std::uint8_t {
  ticks,        ///< between cursors A and B; without them those in view
  recording,    ///< the recording that is open, from its first tick
  exploration,  ///< made by the program: all over the mesh (exploration_poses.h)
};
inline constexpr std::array<std::string_view, 3> kTuneMotions{"ticks", "recording", "exploration"};

struct TuneQuestion {
  static constexpr std::size_t kMostObjectives = 3, kMostConstraints = 4, kMostRanges = 6;
  static constexpr std::size_t kFewestTrials = 10, kMostTrials = 5000;

  std::vector<sweep::Objective> objectives;
  std::vector<sweep::Constraint> constraints;
  std::vector<sweep::Range> ranges;
  TuneMotion motion = TuneMotion::ticks;
  std::size_t trials = 300;
  bool evolve = true;  ///< by NSGA-II; false: even draws
};

/// Few planes, small error, every tick converged.
TuneQuestion usual_question();
/// Keys that decide under this method and finger: the gains, where the method has any, each where the scalar tuning
/// looks, too; and the tolerance.
std::vector<sweep::Range> usual_ranges(const Preset& preset);
/// The key over its slider's range.
sweep::Range slider_range(const PresetKey& key);

/// The value that theory names for a key: G_o 1, G_k the finger's reach, G_d 0 (core/lab/gains/gain_advice.h). Empty:
/// it names none, as for a point finger's G_k.
std::optional<double> theory_value(const PresetKey& key, const Finger& finger);
/// The preset with those values.
Preset by_theory(Preset preset);

/// "error p99", its unit apart: as axes and tables show a number of a cell.
std::string column_label(const sweep::NumberColumn& column);
UnitLabel column_unit(const sweep::NumberColumn& column);
/// "error p99, um" with the unit's own letters.
std::string column_with_unit(const sweep::NumberColumn& column);

}  // namespace tangent
