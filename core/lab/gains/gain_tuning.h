// Tunes the gains of Eq. 1 by measurement: the paper's iteration runs the same poses with the gains of a coarse grid,
// then walks from the best of them downhill on a fine one. Pure: no clock, thread or file, and the same arguments
// give the same gains, on any machine.
#pragma once

#include "core/tick/step.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tangent {

/// G_o, G_k and G_d of Eq. 1 (Doxon et al. 4.5).
struct Gains {
  double overall = 1.0;
  double curvature_m = 0.0;
  double distance_per_m = 0.0;
  bool operator==(const Gains&) const = default;
};
Gains gains_of(const SolverSettings& settings);
SolverSettings with_gains(SolverSettings settings, const Gains& gains);

/// Result of a preset on a run of poses. Counts, no times, so that it is the same on every machine.
struct RunScore {
  std::uint64_t ticks = 0;
  std::uint64_t unconverged = 0;
  std::uint64_t reseeded = 0;       ///< ticks that were seeded again, converged or not
  std::uint64_t iterations = 0;     ///< of all ticks
  std::int32_t p99_iterations = 0;  ///< nearest rank
  std::int32_t max_iterations = 0;
  double max_error_m = 0.0;  ///< of the converged ticks
  double mean_iterations() const { return ticks ? static_cast<double>(iterations) / static_cast<double>(ticks) : 0.0; }
};

/// Fewest unconverged ticks first, then the smaller mean of iterations, then the smaller 99th percentile.
bool better(const RunScore& a, const RunScore& b);

/// Steps all poses, starting with nothing tracked. `keep_going` is called every few hundred ticks with the counts so
/// far; when it returns false, the score covers the ticks so far (see `ticks`).
RunScore score_run(Stepper& stepper, const Preset& preset, std::span<const TickInput> poses,
                   const std::function<bool(const RunScore&)>& keep_going = {});

struct GainTrial {
  Gains gains;
  RunScore score;
};

/// The grids. Gains are integer multiples of `fine`, so that they are short numbers in a file.
struct GainGrid {
  std::vector<Gains> coarse;  ///< all of them are tried
  Gains fine;                 ///< resolution of the walk
  Gains largest;              ///< upper limit of the walk; the lower is 0
};

/// G_o 0.7 to 1.3, G_k 0 to 4 lengths, G_d 0 to 16 per length; resolution a hundredth, 1/200 of the length, and 1/50
/// per length, rounded to a power of ten times 1, 2 or 5. `length_m`: the finger's reach, which is about the ideal
/// G_k (the ideal factor along a principal direction of curvature k is 1/(1 + h k)); for a point finger a length scale
/// of the surface. Precondition: > 0.
GainGrid make_gain_grid(double length_m);

inline constexpr std::size_t kBestTrials = 10;

struct GainTuning {
  std::vector<GainTrial> best;  ///< up to kBestTrials, best first; empty: stopped before the first run was complete
  GainTrial untuned;            ///< G_o 1, G_k 0, G_d 0; ticks 0: stopped before it was complete
  std::size_t tried = 0;        ///< gains tried, including runs that ended early
  bool stopped = false;         ///< `keep_going` returned false; `best` holds the results so far
};

/// Called before every trial and regularly within one; `done` trials, and at least `planned` in all. False stops.
using KeepTuning = std::function<bool(std::size_t done, std::size_t planned)>;

/// For whoever keeps what was tried: a tuning that goes on with it gives the same as one that was never ended.
struct GainMemory {
  std::function<const RunScore*(const Gains&)> known;            ///< null: these were not tried
  std::function<void(const Gains&, const RunScore&)> keep = {};  ///< each that was not known, as it is done
};

/// Tunes the gains of the paper's iteration, starting with the untuned ones; other values are those of `base`, whose
/// method does not matter. Pattern search: the walk tries the six neighbours of the best point and halves all steps
/// where none is better, down to the grid's resolution. Runs that can no longer be among the best end early.
/// Precondition: poses not empty.
GainTuning tune_gains(std::shared_ptr<const ContactScene> scene, const Preset& base, std::span<const TickInput> poses,
                      const GainGrid& grid, const KeepTuning& keep_going = {}, const GainMemory& memory = {});

}  // namespace tangent
