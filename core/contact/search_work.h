// What the parts of a search cost, counted and not timed, so that how much of it a tick does is the same on every
// machine and whatever is cached. The unit is about a nanosecond of the machine that the figures of the page on
// measurements are from: least squares over 26,465 searches in spot, the fandisk, the bunny and two scanned heads, of
// which 8 in 10 of over 20 us took 0.8 to 1.5 times what is counted for them.
#pragma once

#include <algorithm>

namespace tangent {

struct SearchWork {
  int node;        ///< a step down the tree, with both that are below
  int look;        ///< at a triangle
  int test;        ///< of its patch or a part of that
  int glance;      ///< at a triangle from the middle of the look-ahead
  int slope;       ///< whether a triangle leads to a known contact
  int evaluation;  ///< of the surface, in a solve
  /// A search for deeper places that is late does so many times a tick's work: where it has been for so many switch
  /// hystereses of the finger's way, in proportion where for less. Else a finger that goes on quickly leaves behind
  /// what was searched again and again. More, or sooner: late ticks; less: a deeper place goes unnoticed for as long as
  /// the finger moves.
  double late, most_late;

  static constexpr SearchWork of_round() { return {55, 100, 110, 100, 0, 150, 2.0, 25.0}; }
  static constexpr SearchWork of_core() { return {130, 100, 150, 300, 300, 600, 5.0, 100.0}; }
};

/// In one tick. A search that takes more goes on at the next. Larger: late ticks; smaller: more ticks that do not know
/// yet whether there is a deeper place.
inline constexpr int kTickWork = 40'000;

/// `times` of it where a search is late by `share` of what it may be, or more; in proportion where by less.
inline int tick_work(double times, double share) {
  return static_cast<int>(kTickWork * (1.0 + (times - 1.0) * std::min(1.0, share)));
}

/// The same of a search for a start, without which the finger has no contact; so many switch hystereses.
inline constexpr double kLateStartWork = 5.0, kMostLateStart = 100.0;

/// In a first tick, or one after a leap, ticks' work: up to the rank that its contact likely has, and of everything.
/// Larger: late ticks; smaller: a finger that is put deep into something starts at a shallower place more often, and
/// goes on to the deepest in the ticks after.
inline constexpr int kStartWork = 8, kStartWorkOfAll = 3;

}  // namespace tangent
