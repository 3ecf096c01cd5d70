// A sweep's plan: which presets are tried on which meshes, motions, methods and fingers. One combination is a cell.
//
// As a file it is TOML:
//   [plan]
//   meshes = ["a.obj", "b.obj"]       # and how they are read: unit, fit_mm, normals, crease_deg, turn_over
//   poses = ["walk.csv", "around"]    # pose files, recordings (.sqlite), or paths that are made: around, strokes
//   methods = ["paper", "robust"]     # default: the preset's
//   preset = "base.toml"              # what the ranges leave alone; default: the built-in values
//   sampling = "grid"                 # or random, latin-hypercube, sobol, with samples = N and seed = N
//   ticks = 20000                     # at most so many of every motion; default: all
//   [ranges]
//   "solver.gain_curvature_m" = [0.01, 0.02, 0.04]
//   "solver.tolerance_m" = { from = 1e-8, to = 1e-5, count = 4, scale = "log" }
//   [[fingers]]                       # default: the preset's
//   shape = "sphere"
//   radius_m = 0.005
#pragma once

#include "core/base/result.h"
#include "core/mesh/contact_mesh.h"
#include "core/preset/schema.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tangent::sweep {

enum class Sampling : std::uint8_t {
  grid,             ///< every value of every range with every other
  random,           ///< each range by itself, uniformly
  latin_hypercube,  ///< likewise, but every range is met in equal parts, one sample in each (McKay et al., 1979)
  sobol,            ///< Sobol's sequence: the samples fill the ranges evenly, however many are taken (Joe, Kuo 2008)
};
inline constexpr std::array<std::string_view, 4> kSamplingNames{"grid", "random", "latin-hypercube", "sobol"};

/// The values that one key takes. Values travel as double, as in the schema.
struct Range {
  const PresetKey* key = nullptr;
  std::vector<double> values;  ///< as listed; empty: from ... to
  double from = 0.0, to = 0.0;
  std::size_t count = 0;  ///< values of a grid; 0 in a sampled plan
  bool logarithmic = false;

  /// The value at `share` of the way, 0 to 1 (of a list: the one that it falls on). Whole numbers where the key takes
  /// them.
  double at(double share) const;
  /// The share whose value that is, where the range has it: `at` of it, but for rounding.
  std::optional<double> share_of(double value) const;
  /// Values of a grid, in order; fewer than `count` where whole numbers coincide.
  std::vector<double> grid() const;
};

struct Plan {
  std::vector<std::filesystem::path> meshes;
  double metres_per_unit = 1e-3;
  ContactMeshOptions reading;
  std::vector<std::string> poses;  ///< files, or names of kMadePoses
  std::vector<Method> methods;
  std::vector<Finger> fingers;
  Preset base;
  std::vector<Range> ranges;
  Sampling sampling = Sampling::grid;
  std::size_t samples = 0;  ///< of a sampled plan
  std::uint64_t seed = 1;
  std::size_t ticks = 0;  ///< of a motion at most; 0: all
};
/// Motions that need no file (workbench/session: exploration path and strokes). "around:0.5mm" is 0.5 mm deep in the
/// mean; the depth swings about that by kExplorationPressSwing.
inline constexpr std::array<std::string_view, 2> kMadePoses{"around", "strokes"};
struct MadeMotion {
  std::size_t kind = 0;                ///< of kMadePoses
  std::optional<double> press_m = {};  ///< none: as deep as usual
};
/// Empty: this names a file.
std::optional<MadeMotion> made_motion(std::string_view poses);
/// Fails on what begins as a made motion and can't be made: a depth that is none.
Status check_made_motion(std::string_view poses);
inline bool is_made(std::string_view poses) { return made_motion(poses).has_value(); }

/// Paths in it are as written, or relative to the plan's folder. Unknown keys, wrong types, empty ranges, values that a
/// key does not allow and what contradicts itself are errors that name key and line.
Result<Plan> parse_plan(std::string_view text, const std::filesystem::path& file);
Result<Plan> read_plan(const std::filesystem::path& file);

/// A plan that can be run: meshes, poses, methods and fingers are there, ranges fit the sampling. Of one that comes
/// from options.
Status check_plan(const Plan& plan);

/// The plan as TOML with every value stated: reads back as the same plan. `files`: the names to write in place of
/// meshes, then of poses; empty: as they are.
std::string format_plan(const Plan& plan, const std::vector<std::string>& files = {});

}  // namespace tangent::sweep
