// What the theory says of the gains of Eq. 1 beside what was found, and where they part, why.
//
// The rule is G_o 1, G_k the finger's reach, G_d 0: the ideal factor of a step is 1/(1 + h k) along a principal
// direction of curvature k, with h the height of the finger's centre. On a rounded edge of radius r, where one
// direction has h/r and the other 0, gains that don't overshoot across it leave (h/r)/(2 + h/r) of the error a plane
// (core/lab/gains/paper_contraction.h).
#pragma once

#include "core/lab/gains/gain_tuning.h"
#include "core/lab/gains/ground.h"

#include <functional>
#include <optional>
#include <string>

namespace tangent::sweep {

/// Why found gains are others than the rule's.
enum class GainCause : std::uint8_t {
  no_matter,      ///< they make no clear difference: mean planes by less than 2 %
  other_aims,     ///< they take more planes: something else was asked for
  rounded_edges,  ///< on tight ground, where one factor can't serve both directions, they leave less
  depth,          ///< h is the reach less the penetration: they are nearer to the mean h
  same_step,      ///< at the mean curvature they make the same step, to 5 %: G_o makes up for G_k
  other,          ///< none of these
};
inline constexpr std::array<std::string_view, 6> kGainCauses{"no matter", "other aims", "rounded edges",
                                                             "depth",     "same step",  "none of the known causes"};

struct GainTheory {
  Gains found, rule;
  double planes_found = 0.0, planes_rule = 0.0;  ///< a tick, of `paper`
  GroundCounts grounds_found, grounds_rule;
  double height_mean_m = 0.0;         ///< h at the contacts on faces
  double curvature_mean_per_m = 0.0;  ///< larger principal curvature there, its size
  // On tight ground (ground.h), medians; 0: there is none. Theory's contraction is of an edge: edge_roundness 0.
  double edge_turn = 0.0;                    ///< h/r
  double edge_theory = 0.0;                  ///< (h/r)/(2 + h/r)
  double edge_roundness = 0.0;               ///< smaller over larger curvature
  double edge_rule = 0.0, edge_found = 0.0;  ///< left of the error a plane, by paper_contraction
  std::vector<GainCause> causes;             ///< empty: they are the same
};

/// Runs `paper` over the motion with both. Empty: told to stop. Precondition: `found` has a finger with a reach.
std::optional<GainTheory> gain_theory(const std::shared_ptr<const ContactScene>& scene, const Preset& found,
                                      std::span<const TickInput> motion, const std::function<bool()>& stop = {});

/// Lines for people, with the number of each cause.
std::string gain_theory_text(const GainTheory& theory);

}  // namespace tangent::sweep
