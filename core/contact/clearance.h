// What is known of the places that the finger does not touch: until when none of them can be the deepest.
#pragma once

#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace tangent {

/// A part of a triangle that holds no deeper contact, but could before others do.
struct WatchedTriangle {
  std::uint32_t triangle : 28 = 0;
  std::uint32_t part : 3 = 0;         ///< SearchPart (prove/contact_hierarchy.h)
  std::uint32_t holds_rival : 1 = 0;  ///< a contact, or what may be one, that was not deep enough
  float margin_m = 0.0f;  ///< how far from Clearance::centre the finger may go before it must be looked at again
  bool operator==(const WatchedTriangle&) const = default;
};

/// Where a visit of the contact hierarchy begins, and where it broke off: a node of the tree over its parts, and of
/// that part four times a node and which of its four, counted from 1; 0: its beginning.
struct VisitPlace {
  std::uint32_t part = 0, node = 0;
};

/// Where no other place can be deeper than the tracked one: in a ball about the place where that was found out last.
/// Within it nothing is asked, however long the finger moves there. All distances are the finger's from `centre` and
/// `orientation` (prove/clearance_check.h: gone_m).
struct Clearance {
  static constexpr std::size_t kWatched = 57;
  Vec3 centre{0.0};  ///< local
  Quat orientation{1.0, 0.0, 0.0, 0.0};
  double free_m = -1.0;  ///< radius of the ball: up to here nothing needs to be looked at; negative: not known
  double margin_m =
      -1.0;               ///< up to here no triangle outside the tracked basin and the watched ones holds a contact ...
  double height_m = 0.0;  ///< ... of a rank below this
  /// The look-ahead, a ball that lies further on in the direction in which the finger moves: outside it nothing is
  /// known of triangles that are not watched. For a finger that is not round distances from it, too, count turning.
  Vec3 ahead_centre{0.0};
  double ahead_m = -1.0;
  double ahead_height_m = 0.0;  ///< what ranks behind this at ahead_centre was not looked at
  std::uint32_t watched_count : 16 = 0;
  std::uint32_t any_turn : 1 = 1;  ///< 0: holds at `orientation` alone; a finger that is not round and does not turn
  /// A search from `centre` and `orientation` is under way, and the next tick goes on with it at `next`. Until its end
  /// nothing is known (free_m < 0); margins are those so far, ahead_height_m the rank that is asked for.
  std::uint32_t under_way : 1 = 0;
  float ahead = 1.0f;  ///< how far the next search of everything looks ahead, as a ratio: further where that is cheap
  std::array<WatchedTriangle, kWatched> watched;  ///< the first watched_count, in no order
  VisitPlace next;

  std::span<WatchedTriangle> on_watch() { return {watched.data(), watched_count}; }
  std::span<const WatchedTriangle> on_watch() const { return {watched.data(), watched_count}; }

  /// No other place counts as deeper, however far the finger goes: the contact is only followed.
  static Clearance unlimited() {
    Clearance c;
    c.free_m = c.margin_m = c.height_m = c.ahead_m = c.ahead_height_m = std::numeric_limits<double>::infinity();
    return c;
  }
};

}  // namespace tangent
