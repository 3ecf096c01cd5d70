// tune with objectives by name: the front of presets none of which is better in everything, and one of them to write.
#pragma once

#include "workbench/cli/tune_kept.h"
#include "workbench/sweep/front_verdict.h"

#include <memory>
#include <span>
#include <string>

namespace CLI {
class App;
}

namespace tangent {

struct TuneFrontOptions {
  std::vector<sweep::Objective> objectives;  ///< empty: tune finds gains as it does without them
  std::vector<sweep::Constraint> constraints;
  std::vector<sweep::Range> ranges;  ///< empty: the gains of Eq. 1
  std::size_t evaluations = 500;
  std::uint64_t seed = 1;
  unsigned threads = 0;  ///< 0: one a core
  sweep::OverGrounds over_grounds = sweep::OverGrounds::worst;
  bool no_race = false;
  std::filesystem::path csv;  ///< the whole front; empty: none is written
};

/// --objective, --constraint, --range, --evaluations, --seed, --threads, --over-grounds, --no-race, --front. `options`
/// must outlive the parser.
void add_tune_front_options(CLI::App& app, TuneFrontOptions& options);
/// Wrong usage: options of a front without an objective, a limit named twice.
void check_tune_front(const TuneFrontOptions& options);

/// A sentence for each key that would be searched for nothing: no tick under `base` reads it.
std::vector<std::string> tune_ignored(const Preset& base, double gain_length_m, const TuneFrontOptions& options);

struct TunedFront {
  Preset preset;     ///< the one to write
  std::string text;  ///< for a person: the front, the choice and why, on the poses held back
  bool stopped = false;
};

/// Searches on the first three quarters of every ground's poses; the last quarter is held back and decides whether the
/// choice is clearly better, by 2 % in an objective and in none worse by that, than the gains that theory names (G_o 1,
/// G_k the finger's reach, G_d 0). If not, those are the choice: they are simpler. Fails where no trial keeps the
/// constraints, naming the nearest, and where the front or what is `kept` can't be written. `kept` is opened here, and
/// removed where no trial keeps the constraints.
Result<TunedFront> tune_front(std::vector<sweep::FrontGround> grounds, const Preset& base, double gain_length_m,
                              const TuneFrontOptions& options, TuneKept& kept);

}  // namespace tangent
