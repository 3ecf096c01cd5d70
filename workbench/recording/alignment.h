// Which tick of one recording goes with which of another.
#pragma once

#include "workbench/recording/recording.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace tangent {

enum class AlignBy : std::uint8_t {
  time,      ///< the same t_s
  tick,      ///< the same number
  contact,   ///< the first tick that touches
  bookmark,  ///< a bookmark of the same note, or the first of each
};
inline constexpr std::array<std::string_view, 4> kAlignByNames{"time", "tick", "contact", "bookmark"};

struct Alignment {
  AlignBy by = AlignBy::time;
  std::string why_not;                ///< empty: they are aligned
  std::int64_t shift = 0;             ///< a tick of B is one of A and this
  std::uint64_t first = 0, last = 0;  ///< ticks of A that both have, or would but for gaps
  double rate_hz = 1000.0;            ///< of both

  bool aligned() const { return why_not.empty(); }
  std::uint64_t ticks() const { return aligned() ? last - first + 1 : 0; }
  std::uint64_t in_b(std::uint64_t tick_of_a) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(tick_of_a) + shift);
  }
};

/// `note`: of the bookmarks; empty: the first of each. That they can't be aligned is a result. Fails on damaged files.
Result<Alignment> align(Recording& a, Recording& b, AlignBy by, const std::string& note = {});

}  // namespace tangent
