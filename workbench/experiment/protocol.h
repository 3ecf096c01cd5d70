// A protocol: what is shown to a participant, in which order, and when it ends. As a file it is TOML
// (presets/experiments holds the paper's two); every number is in the file, with the paper's section beside it.
//
//   [protocol]     kind = "discrimination" or "identification", name, version
//   [sound]        noise_db (RMS), cue_db (peak), below full scale
//   [preset]       keys of a preset in quotes: "finger.radius_m" = 0.02, "force.limit_n" = 6.0
// and, of the first kind (5.2: which of two arcs is the smooth one),
//   [arc]          radius_m, angle_rad, placement
//   [staircase]    reversals, large_reversals, averaged, down, scale, fewest, most, most_trials
//   [[conditions]] name = "C1", start, large_step, small_step: one staircase each
// of the second (5.3: which of seven objects is this),
//   [objects]      names: key 1 is the first; rounding_m; practice; both_ways: those that face left or right;
//                  facet_deg
//   [runs]         sessions, hours_between, blocks (a session's), runs (a block's); tactile_first = "even"
//   [start]        place_m, radius_m, hold_s, guide_n_per_m, guide_limit_n
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"
#include "core/lab/objects/arc.h"
#include "core/preset/preset.h"
#include "workbench/experiment/sound/sound_settings.h"
#include "workbench/experiment/staircase.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tangent::experiment {

/// One staircase of experiment 1.
struct ComparisonCondition {
  std::string name;  ///< of core/io/rendering_condition.h
  StaircaseRule staircase;
};

/// Experiment 1 of the paper: two intervals, one of them the exact arc, the other of segments.
struct Discrimination {
  double radius_m = kPaperArcRadius;
  double angle_rad = kPaperArcRad;
  ArcPlacement placement = ArcPlacement::tangent;
  std::vector<ComparisonCondition> conditions;
};

/// Experiment 2 of the paper: an object at a time, named from a list.
struct Identification {
  std::vector<std::string> objects;    ///< key 1 is the first
  std::vector<std::string> both_ways;  ///< those that are shown pointing left and right
  std::string practice;                ///< shown in view before each kind of feedback; empty: none
  double rounding_m = 1.5e-3;          ///< of the edges of shaded objects
  double facet_deg = 0.2;              ///< unshaded cone, cylinder and sphere: their facets turn by less than this
  int sessions = 2;
  double hours_between_sessions = 24.0;  ///< from the beginning of one to that of the next, at least
  int blocks = 2;                        ///< of a session; tactile feedback changes between blocks
  int runs = 2;                          ///< of a block, with the same objects, in an order of their own
  bool tactile_first_even = true;        ///< participants of even number begin with tactile feedback, others without
  Vec3 start_m{0.0};                     ///< where the finger waits, world
  double start_radius_m = 5e-3;
  double hold_s = 1.0;
  double guide_n_per_m = 30.0, guide_limit_n = 1.0;  ///< of the weak pull to the start
};

struct Protocol {
  std::string name;
  int version = 1;
  Preset preset;        ///< finger, force and limits; the conditions replace the sources of force and display
  SoundSettings sound;  ///< levels of what is heard; the seed is the participant's
  std::variant<Discrimination, Identification> kind;

  const Discrimination* discrimination() const { return std::get_if<Discrimination>(&kind); }
  const Identification* identification() const { return std::get_if<Identification>(&kind); }
};
inline constexpr std::array<std::string_view, 2> kProtocolKinds{"discrimination", "identification"};

/// Unknown keys, wrong types, numbers out of range and what contradicts itself are errors that name file, line and key.
Result<Protocol> parse_protocol(std::string_view text, const std::filesystem::path& file);
Result<Protocol> read_protocol(const std::filesystem::path& file);

/// 16 hex digits of every value: two protocols with the same digest put the same before a participant. Comments, order
/// and spelling of the file do not count.
std::string protocol_digest(const Protocol& protocol);
/// The same of a preset.
std::string preset_digest(const Preset& preset);

}  // namespace tangent::experiment
