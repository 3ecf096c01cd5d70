// What a cell of a sweep is measured by. All of it is counted or solved, nothing is timed: the same bits on any
// machine, in any order and thread.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace tangent::sweep {

struct CellNumbers {
  std::uint64_t ticks = 0;
  std::uint64_t unconverged = 0, facing = 0;  ///< ticks without a contact
  std::uint64_t events_first = 0, events_reseed = 0, events_switch = 0, events_branch = 0;
  std::uint64_t not_finite = 0, unmarked_jumps = 0;  ///< core/lab/measure/scene_statistics.h
  double mean_iterations = 0.0, p99_iterations = 0.0, most_iterations = 0.0;
  double mean_counted_us = 0.0, p99_counted_us = 0.0;  ///< time of a tick by the work that it does (tick_work.h)
  double residual_worst_m = 0.0;                       ///< largest error_m of a converged tick
  /// Distance of the contact from the solution near it, iterated to 1e-12 of the scene (converged_answer.h); of a
  /// method without a smooth contact, from the contact of `robust` at that tolerance. On every 16th tick.
  std::uint64_t compared = 0;
  double error_p50_m = 0.0, error_p99_m = 0.0, error_worst_m = 0.0;
  double force_change_mean_n = 0.0;          ///< from tick to tick
  std::uint64_t force_unexplained = 0;       ///< ticks whose change the finger's motion does not explain (roughness.h)
  double force_unexplained_worst_n = 0.0;    ///< the most over what it explains
  double display_change_mean_m = 0.0;        ///< likewise
  std::uint64_t display_unexplained = 0;     ///<
  double display_unexplained_worst_m = 0.0;  ///<
  std::uint64_t loops = 0;                   ///< circles on which a contact was held all the way round
  double closed_work_share = 0.0;            ///< largest |work| round one of them, over its peak energy

  bool operator==(const CellNumbers&) const = default;
};

/// A column of the results: name (with its unit), meaning, and where it is. `grows`: more ticks never make it smaller,
/// as all counts and everything that is a largest.
struct NumberColumn {
  std::string_view name, meaning;
  std::variant<std::uint64_t CellNumbers::*, double CellNumbers::*> field;
  bool grows = field.index() == 0;
};
std::span<const NumberColumn> number_columns();

/// Ticks from one comparison with the exact solution to the next.
inline constexpr std::size_t kComparedEvery = 16;

/// Solves the motion from a fresh state. `stop` is asked every 512 ticks; empty: it said so. Precondition: stepper and
/// exact are of the same scene, and no other thread uses them.
std::optional<CellNumbers> measure_cell(Stepper& stepper, Stepper& exact, const Preset& preset,
                                        std::span<const TickInput> motion, const std::function<bool()>& stop = {});

}  // namespace tangent::sweep
