// Bookmarked ticks: set by a person, with a note, or by triggers that check every record. Bounded: the oldest automatic
// bookmarks are dropped, and a trigger that fires tick after tick extends one bookmark. Not thread-safe.
#pragma once

#include "workbench/session/servo_record.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tangent {

enum class BookmarkKind : std::uint8_t { user, unconverged, reseeded, iterations, force, device_fault, count_ };
inline constexpr std::size_t kBookmarkKindCount = static_cast<std::size_t>(BookmarkKind::count_);
const char* to_string(BookmarkKind kind);

struct Bookmark {
  std::uint32_t id = 0;
  BookmarkKind kind = BookmarkKind::user;
  std::uint64_t tick = 0, last_tick = 0;  ///< first and last tick that it covers
  double t_s = 0.0;                       ///< time of the first
  std::uint32_t ticks = 1;                ///< number of ticks that fired
  std::string note;                       ///< by a person, or the trigger's value in the first tick
};

struct BookmarkTriggers {
  std::array<bool, kBookmarkKindCount> on{false, true, true, true, true, true};  ///< by kind; user is not a trigger
  std::int32_t iterations_over = 20;
  double force_over_n = 6.0;  ///< of the force sent to the device
};

class Bookmarks {
 public:
  static constexpr std::size_t kMostAutomatic = 500;
  static constexpr std::uint64_t kSameWithin = 200;  ///< ticks: firing again within these extends the bookmark

  BookmarkTriggers triggers;
  /// While set no automatic bookmark is removed for a newer one: the newer one is not set.
  bool hold = false;

  /// Checks the triggers on one record. Call with every record, in order. A tick number that does not increase means a
  /// new run: automatic bookmarks are then removed.
  void watch(const ServoRecord& record);
  /// Adds a person's bookmark, unless the tick already has one. Returns its id either way.
  std::uint32_t add(std::uint64_t tick, double t_s);
  /// Adds one that a trigger set elsewhere: in a recording. The newest of more than kMostAutomatic are left out.
  void add(BookmarkKind kind, std::uint64_t tick, double t_s, std::string note);
  /// Unknown ids are ignored here and in remove.
  void set_note(std::uint32_t id, std::string note);
  void remove(std::uint32_t id);
  /// Removes automatic bookmarks that end before `tick` (their records are gone); those of a person stay.
  void forget_before(std::uint64_t tick);
  void clear_automatic();

  /// All bookmarks, sorted by tick. Pointers and references are valid until the next change.
  const std::vector<Bookmark>& all() const { return all_; }
  const Bookmark* find(std::uint32_t id) const;      ///< null: none
  const Bookmark* after(std::uint64_t tick) const;   ///< the next one; null: none
  const Bookmark* before(std::uint64_t tick) const;  ///< the previous one; null: none

 private:
  void fire(BookmarkKind kind, const ServoRecord& record, std::string note);
  std::uint32_t insert(Bookmark mark);

  std::vector<Bookmark> all_;
  std::array<std::uint32_t, kBookmarkKindCount> latest_{};  ///< id of the newest of each kind; 0: none
  std::uint32_t next_id_ = 1;
  std::size_t automatic_ = 0;
  std::uint64_t last_tick_ = 0;
  bool any_ = false;
};

}  // namespace tangent
