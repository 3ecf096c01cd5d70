// Ticks worth coming back to: set by a person with a note, or by triggers that watch the records go by. Bounded: of
// those set by triggers the oldest go, and a trigger that fires tick after tick makes one bookmark that grows.
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
  std::uint64_t tick = 0, last_tick = 0;  ///< first and last that it stands for
  double t_s = 0.0;                       ///< of the first
  std::uint32_t ticks = 1;                ///< how many of them fired
  std::string note;                       ///< of a person, or what the trigger saw first
};

struct BookmarkTriggers {
  std::array<bool, kBookmarkKindCount> on{false, true, true, true, true, true};  ///< by kind; user: never
  std::int32_t iterations_over = 20;
  double force_over_n = 6.0;  ///< of the force sent to the device
};

class Bookmarks {
 public:
  static constexpr std::size_t kMostAutomatic = 500;
  static constexpr std::uint64_t kSameWithin = 200;  ///< ticks: firing again so soon is the same bookmark

  BookmarkTriggers triggers;

  /// Every record, in order. A tick not after the last one (another run) drops what triggers have set.
  void watch(const ServoRecord& record);
  /// A person's; on a tick that has one, that one. Returns its id.
  std::uint32_t add(std::uint64_t tick, double t_s);
  void set_note(std::uint32_t id, std::string note);
  void remove(std::uint32_t id);
  /// What triggers set on ticks that are gone goes too; what a person set stays.
  void forget_before(std::uint64_t tick);
  void clear_automatic();

  /// By tick.
  const std::vector<Bookmark>& all() const { return all_; }
  const Bookmark* find(std::uint32_t id) const;
  const Bookmark* after(std::uint64_t tick) const;  ///< null: none
  const Bookmark* before(std::uint64_t tick) const;

 private:
  void fire(BookmarkKind kind, const ServoRecord& record, std::string note);
  std::uint32_t insert(Bookmark mark);

  std::vector<Bookmark> all_;
  std::array<std::uint32_t, kBookmarkKindCount> latest_{};  ///< id of the newest of its kind; 0: none
  std::uint32_t next_id_ = 1;
  std::size_t automatic_ = 0;
  std::uint64_t last_tick_ = 0;
  bool any_ = false;
};

}  // namespace tangent
