// The recorded ticks that the window can show and solve again. Live, these are the session's history. Paused, they are
// frozen: what the history drops from then on stays. The ticks around a person's bookmarks and those from cursor A to B
// are kept as well, after the history has dropped them. Of a recording, they are the page that is loaded.
//
// Records are shared with the history in blocks, so keeping them costs memory only once the history has dropped them:
// extra_bytes().
#pragma once

#include "workbench/session/bookmarks.h"
#include "workbench/session/session.h"
#include "workbench/session/tick_again.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

namespace tangent {

/// Consecutive records, and the scenes they ran on.
struct PastPart {
  HistorySnapshot records;
  std::map<std::uint32_t, std::shared_ptr<const ContactScene>> scenes;

  bool covers(std::uint64_t tick) const {
    return !records.empty() && records.oldest().tick.tick <= tick && tick <= records.newest().tick.tick;
  }
};

/// From `from` to `to`, both included.
struct TickRange {
  std::uint64_t from = 0, to = 0;
  bool operator==(const TickRange&) const = default;
};

class RecordedPast {
 public:
  /// Ticks kept before and after a person's bookmark.
  static constexpr std::uint64_t kBefore = 500, kAfter = 100;
  /// Ticks kept before cursor A, from which a run over the selection starts.
  static constexpr std::uint64_t kLeadIn = 100;

  /// Takes in the session's history. Frozen: only until the history drops its oldest record.
  void follow(const Session& session);
  /// Keeps what bookmarks and selection need, and lets go of what they no longer need.
  void keep(const Bookmarks& bookmarks, const std::optional<TickRange>& selection);
  void freeze() { frozen_ = true; }
  void thaw();
  /// Shows a part of a recording in place of the history, frozen.
  void show_page(PastPart page);
  /// Of a recording: the selection, read whole, is kept beside the page until it is let go of.
  void keep_selection(const TickRange& range, PastPart part);
  void drop_selection();
  /// As it was read from a recording; null: it was not.
  const PastPart* kept_selection() const;
  void forget();  ///< a new session: nothing is recorded

  bool frozen() const { return frozen_; }
  /// History, live or frozen.
  const PastPart& main() const { return main_; }
  /// The part in view: main(), or a kept one after show().
  const PastPart& shown() const { return kept_in_view_ ? kept_.at(*kept_in_view_).part : main_; }
  bool shows_kept() const { return kept_in_view_.has_value(); }
  /// Chooses the part that covers the tick, main() first; false, and no change, if there is none.
  bool show(std::uint64_t tick);
  bool reaches(std::uint64_t tick) const;  ///< whether show() would find it
  /// The part that holds all of a range; null: none.
  const PastPart* part_with(const TickRange& range) const;

  /// Memory held beyond the session's history.
  std::size_t extra_bytes(const Session& session) const;

  /// Computes a tick of shown() again with every iteration, under `with`. Fails when its scene is gone, or `with` is
  /// null: its preset is.
  Result<TickOutput> re_step(const ServoRecord& record, const Preset* with, IterationTrace& trace);

 private:
  struct Kept {
    TickRange range;
    PastPart part;
    bool complete = false;
    bool read = false;  ///< all that a recording has of it
  };
  static constexpr std::uint32_t kSelection = 0;  ///< key in kept_; bookmarks' ids begin at 1
  void keep_range(std::uint32_t key, const TickRange& range);

  PastPart main_;
  bool frozen_ = false;
  std::map<std::uint32_t, Kept> kept_;  ///< by bookmark
  std::optional<std::uint32_t> kept_in_view_;
  TickAgain again_;
};

}  // namespace tangent
