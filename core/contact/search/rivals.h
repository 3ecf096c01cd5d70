// Watches for contacts elsewhere that are, or may become, deeper than the tracked one.
//
// A search looks at every triangle that could hold one and notes how far the finger may go until it could: for the
// few triangles that are soonest one by one, for all others together. So most ticks ask nothing, and most of
// those that ask look at a triangle or two.
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
};

/// `bound_m`: rank that a rival must be below to take over. `margin_m`: how far one would like to go without
/// searching again. `known`: the last search; the finger is `gone` from there. Beyond its margin all is searched,
/// within it only the watched triangles whose time has come. Uses the `robust` rule whatever the method. `touched`:
/// places that are followed besides the tracked one, and all others below the bound are asked for; null: only the
/// deepest is.
RivalResult find_rival(ContactContext& context, const SearchStructures& search, const IterationResult& tracked,
                       double bound_m, double margin_m, const Clearance& known, double gone,
                       const TouchedContacts* touched = nullptr);

}  // namespace tangent
