#include "workbench/gui/model/recorded_past.h"

#include <algorithm>

namespace tangent {

void RecordedPast::follow(const Session& session) {
  const History& history = session.history();
  if (!frozen_ || main_.records.empty()) {
    main_ = {history.snapshot(), session.scenes()};
    return;
  }
  if (history.empty() || history.oldest().tick.tick != main_.records.oldest().tick.tick) return;
  main_.records = history.snapshot();
  main_.scenes.insert(session.scenes().begin(), session.scenes().end());
}

void RecordedPast::keep(const Bookmarks& bookmarks, const std::optional<TickRange>& selection) {
  std::erase_if(kept_, [&](const auto& kept) {
    if (kept.first == kept_in_view_) return false;
    return kept.first == kSelection ? !selection || !(kept.second.range == *selection)
                                    : bookmarks.find(kept.first) == nullptr;
  });
  for (const Bookmark& mark : bookmarks.all()) {
    if (mark.kind == BookmarkKind::user)
      keep_range(mark.id, {mark.tick > kBefore ? mark.tick - kBefore : 0, mark.tick + kAfter});
  }
  if (selection) keep_range(kSelection, *selection);
}

void RecordedPast::keep_range(std::uint32_t key, const TickRange& range) {
  const auto known = kept_.find(key);
  if (known != kept_.end() && known->second.complete) return;
  const HistorySnapshot& all = main_.records;
  const std::uint64_t from = key == kSelection && range.from > kLeadIn ? range.from - kLeadIn : range.from;
  const std::size_t begin = all.lower_bound(from), end = all.lower_bound(range.to + 1);
  const std::size_t had = known != kept_.end() ? known->second.part.records.size() : 0;
  if (begin >= end || end - begin <= had) return;  // not recorded, or what there was is dropped already
  Kept& kept = kept_[key];
  kept.range = range;
  kept.part.records = all.slice(begin, end);
  kept.part.scenes = main_.scenes;
  kept.complete = all.newest().tick.tick >= range.to;
}

void RecordedPast::thaw() {
  frozen_ = false;
  kept_in_view_.reset();
}

void RecordedPast::show_page(PastPart page) {
  main_ = std::move(page);
  kept_in_view_.reset();
  frozen_ = true;
}

void RecordedPast::keep_selection(const TickRange& range, PastPart part) {
  kept_[kSelection] = {range, std::move(part), true, true};
}

void RecordedPast::drop_selection() {
  if (kept_in_view_ == kSelection) kept_in_view_.reset();
  kept_.erase(kSelection);
}

const PastPart* RecordedPast::kept_selection() const {
  const auto found = kept_.find(kSelection);
  return found != kept_.end() ? &found->second.part : nullptr;
}

void RecordedPast::forget() {
  main_ = {};
  kept_.clear();
  thaw();
}

bool RecordedPast::show(std::uint64_t tick) {
  if (main_.covers(tick)) {
    kept_in_view_.reset();
    return true;
  }
  for (const auto& [key, kept] : kept_) {
    if (!kept.part.covers(tick)) continue;
    kept_in_view_ = key;
    return true;
  }
  return false;
}

bool RecordedPast::reaches(std::uint64_t tick) const {
  return main_.covers(tick) ||
         std::any_of(kept_.begin(), kept_.end(), [tick](const auto& kept) { return kept.second.part.covers(tick); });
}

const PastPart* RecordedPast::part_with(const TickRange& range) const {
  const auto holds = [&range](const PastPart& part) { return part.covers(range.from) && part.covers(range.to); };
  if (holds(main_)) return &main_;
  const auto selected = kept_.find(kSelection);
  if (selected != kept_.end() && selected->second.read && selected->second.range == range)
    return &selected->second.part;
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&holds](const auto& kept) { return holds(kept.second.part); });
  return found != kept_.end() ? &found->second.part : nullptr;
}

std::size_t RecordedPast::extra_bytes(const Session& session) const {
  std::map<const ServoRecord*, std::size_t> held, live;
  main_.records.collect_blocks(held);
  for (const auto& [key, kept] : kept_) kept.part.records.collect_blocks(held);
  session.history().snapshot().collect_blocks(live);
  std::size_t bytes = 0;
  for (const auto& [block, size] : held) bytes += live.contains(block) ? 0 : size;
  return bytes;
}

Result<TickOutput> RecordedPast::re_step(const ServoRecord& record, const Preset* with, IterationTrace& trace) {
  const std::string tick = "tick " + std::to_string(record.tick.tick);
  if (with == nullptr) return fail("preset " + std::to_string(record.tick.preset_id) + " is not of this session", tick);
  const auto scene = shown().scenes.find(record.scene_id);
  if (scene == shown().scenes.end())
    return fail("the scene it ran on was replaced and is gone", tick, "look at a newer tick");
  return again_.step(scene->second, *with, record, trace);
}

}  // namespace tangent
