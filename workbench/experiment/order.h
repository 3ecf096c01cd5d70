// In which order things are put before a participant: by number and seed alone.
#pragma once

#include "core/lab/objects/generate.h"
#include "workbench/experiment/protocol.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent::experiment {

/// The number that a participant's name ends with: 7 for "7", "P07" and "sub-7"; none: it ends with no digit.
std::optional<std::uint64_t> participant_number(std::string_view participant);

/// Order of `conditions` conditions for a participant: a row of a Latin square in which each follows each other equally
/// often (Williams 1949), so that what one condition leaves behind falls on all alike. For an odd count the second half
/// of the rows is the first backwards.
std::vector<std::size_t> latin_row(std::size_t conditions, std::uint64_t participant);

/// Whether the exact arc comes first in comparison `trial` of condition `condition`.
bool reference_first(std::uint64_t seed, std::size_t condition, std::size_t trial);

/// One object to be named.
struct ObjectTrial {
  int session = 0, block = 0, run = 0;  ///< from 0; block of its session, run of its block
  std::size_t object = 0;               ///< of Identification::objects
  bool shaded = false;                  ///< rounded edges and smooth contact; else facets
  bool tactile = false;                 ///< the display moves; else it is held
  Facing facing = Facing::right;
};

/// All trials of a participant in their order: each run has every object shaded and unshaded, in a random order. In the
/// runs of a block the objects that look different both ways point left and right equally often.
std::vector<ObjectTrial> object_trials(const Identification& design, std::uint64_t participant, std::uint64_t seed);

}  // namespace tangent::experiment
