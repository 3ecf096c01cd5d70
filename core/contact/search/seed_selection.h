// The best of many seeds, and those that failed.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/prove/triangle_proof.h"
#include "core/contact/search/seed.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace tangent {

/// In which order what a solve came to counts.
enum class SeedGroup : std::uint8_t { entered, unentered, unstable, none };

/// The best of many seeds: of the first of these groups, then of the least rank or error.
struct SeedSelection {
  const EnteredPlaces& entered;
  SeedResult result{};
  SeedGroup group = SeedGroup::none;
  double value = std::numeric_limits<double>::infinity();

  SeedGroup group_of(const ContactContext& context, const IterationResult& r) const {
    if (r.facing()) return SeedGroup::entered;
    if (r.converged()) return entered.go_on_at(r.plane, r.contact) ? SeedGroup::entered : SeedGroup::unentered;
    const bool exact = r.contact.error_m < context.settings.tolerance_m;
    return r.stop == StopReason::unstable && exact ? SeedGroup::unstable : SeedGroup::none;
  }
  /// Whether it converged.
  bool offer(const ContactContext& context, const IterationResult& r) {
    result.evaluations += r.evaluations;
    const SeedGroup here = group_of(context, r);
    const double rank = here == SeedGroup::none ? r.contact.error_m : contact_rank(context.finger, r.contact);
    if (here < group || (here == group && rank < value)) {
      group = here;
      value = rank;
      result.best = r;
    }
    result.found = found();
    return r.converged();
  }
  bool found() const { return group <= SeedGroup::unentered; }
  /// Whether only what ranks below `value` counts any more. Not of one that was not entered: shallower ones may have
  /// been.
  bool bounds_search() const { return group == SeedGroup::entered; }
  double bound_m(double unbounded_m) const { return bounds_search() ? value : unbounded_m; }
};

/// Parts of triangles that may hold a contact, but from which none was found. All others a search of everything has
/// excluded or solved for, unless it broke off.
class FailedStarts {
 public:
  bool full() const { return count_ == parts_.size(); }
  void add(std::uint32_t triangle, SearchPart part) {
    if (!full()) parts_[count_++] = {triangle, part};
  }
  bool has(std::uint32_t triangle, SearchPart part) const {
    return any([&](const PartOfTriangle& p) { return p.triangle == triangle && p.part == part; });
  }
  void break_off() { whole_ = false; }
  bool may_hold(std::uint32_t triangle) const {
    return full() || !whole_ || any([&](const PartOfTriangle& p) { return p.triangle == triangle; });
  }

 private:
  template <class Test>
  bool any(Test test) const {
    return std::any_of(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(count_), test);
  }
  std::array<PartOfTriangle, 64> parts_;
  std::size_t count_ = 0;
  bool whole_ = true;
};

}  // namespace tangent
