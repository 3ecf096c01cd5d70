// Watches for contacts elsewhere that are, or may become, deeper than the tracked one.
//
// A search looks at every triangle that could hold one and notes how far the finger may go until it could: for the
// few triangles that are soonest one by one, for all others together. So most ticks ask nothing, and most of
// those that ask look at a triangle or two.
//
// A tick does so much of a search (search_work.h). One that takes more goes on in the next ticks, from the pose that it
// began at: its margins count from there. It looks at what is nearest first.
#pragma once

#include "core/contact/clearance.h"
#include "core/contact/follow/iterate.h"
#include "core/contact/search/search_structures.h"
#include "core/contact/touched.h"

namespace tangent {

/// How far ahead a search looks, m: some ticks at the finger's present speed, within shares of the tracked contact's
/// `rank`, and at least `ahead` times kWatchReach (Clearance::ahead).
double look_ahead_m(const ContactContext& context, double rank, double ahead);

struct RivalResult {
  bool deeper = false;  ///< `best` is a stable contact whose rank is below the wanted bound
  IterationResult best;
  int evaluations = 0;
  TouchedContacts touched;  ///< new ones below the bound, where they were asked for
  Clearance clearance;      ///< until when nothing needs to be looked at again
  bool searching = false;   ///< not everything has been looked at that had to be: the next ticks go on
};

/// What a search is asked.
struct RivalQuestion {
  double bound_m = 0.0;      ///< rank that a rival must be below to take over
  double margin_m = 0.0;     ///< how far one would like to go without searching again
  bool bound_stays = false;  ///< it is not expected to rise while the finger moves on
  /// Places that are followed besides the tracked one: all others below the bound are asked for, too. Null: only the
  /// deepest is.
  const TouchedContacts* touched = nullptr;
};

/// How far the finger is from where the last search was (prove/clearance_check.h: gone_m), now and at the last tick, m.
struct Gone {
  double now_m = 0.0, before_m = 0.0;
};

/// `known`: the last search. Beyond its margin all is searched, within it only the watched triangles whose time has
/// come. Uses the `robust` rule whatever the method.
RivalResult find_rival(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
                       const RivalQuestion& question, const Clearance& known, const Gone& gone);

}  // namespace tangent
