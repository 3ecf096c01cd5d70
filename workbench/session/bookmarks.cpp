#include "workbench/session/bookmarks.h"

#include <algorithm>
#include <cstdio>

namespace tangent {

namespace {

std::string text_of(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string fault_of(const DeviceTelemetry& device) {
  const bool undone = ((device.gate_actions >> static_cast<unsigned>(GateAction::preset_undone)) & 1u) != 0;
  if (undone) return "the safety gate acted: preset undone";
  if (device.gate_fault != GateFault::none) return std::string("safety gate: ") + to_string(device.gate_fault);
  if (device.force_fault != DeviceFault::none) return std::string("force device: ") + to_string(device.force_fault);
  if (device.display_fault != DeviceFault::none)
    return std::string("contact display: ") + to_string(device.display_fault);
  return {};
}

}  // namespace

const char* to_string(BookmarkKind kind) {
  switch (kind) {
    case BookmarkKind::user:
      return "bookmark";
    case BookmarkKind::unconverged:
      return "unconverged";
    case BookmarkKind::reseeded:
      return "reseeded";
    case BookmarkKind::iterations:
      return "iterations";
    case BookmarkKind::force:
      return "force";
    case BookmarkKind::device_fault:
      return "device fault";
    case BookmarkKind::count_:
      break;
  }
  return "bookmark";
}

void Bookmarks::watch(const ServoRecord& record) {
  if (any_ && record.tick.tick <= last_tick_) clear_automatic();
  any_ = true;
  last_tick_ = record.tick.tick;
  const TickOutput& out = record.tick.output;
  const auto wants = [this](BookmarkKind kind) { return triggers.on[static_cast<std::size_t>(kind)]; };
  if (!is_converged(out.status) && wants(BookmarkKind::unconverged)) {
    const char* pattern = out.status == TickStatus::facing ? "facing, off by %.3g \u00b5m" : "error %.3g \u00b5m";
    fire(BookmarkKind::unconverged, record, text_of(pattern, out.error_m * 1e6));
  }
  if (out.event == TickEvent::reseed && wants(BookmarkKind::reseeded))
    fire(BookmarkKind::reseeded, record, text_of("%.0f iterations", out.iterations));
  if (out.iterations > triggers.iterations_over && wants(BookmarkKind::iterations))
    fire(BookmarkKind::iterations, record, text_of("%.0f in one tick", out.iterations));
  const double force = glm::length(record.device.force_command_n);
  if (force > triggers.force_over_n && wants(BookmarkKind::force))
    fire(BookmarkKind::force, record, text_of("%.2f N", force));
  if (wants(BookmarkKind::device_fault)) {
    if (std::string fault = fault_of(record.device); !fault.empty())
      fire(BookmarkKind::device_fault, record, std::move(fault));
  }
}

void Bookmarks::fire(BookmarkKind kind, const ServoRecord& record, std::string note) {
  std::uint32_t& latest = latest_[static_cast<std::size_t>(kind)];
  const auto found = std::find_if(all_.rbegin(), all_.rend(), [&](const Bookmark& b) { return b.id == latest; });
  if (latest != 0 && found != all_.rend() && record.tick.tick <= found->last_tick + kSameWithin) {
    found->last_tick = record.tick.tick;
    ++found->ticks;
    return;
  }
  if (automatic_ == kMostAutomatic && hold) return;
  if (automatic_ == kMostAutomatic) {
    const auto oldest =
        std::find_if(all_.begin(), all_.end(), [](const Bookmark& b) { return b.kind != BookmarkKind::user; });
    remove(oldest->id);
  }
  latest = insert({0, kind, record.tick.tick, record.tick.tick, record.tick.input.t_s, 1, std::move(note)});
  ++automatic_;
}

std::uint32_t Bookmarks::insert(Bookmark mark) {
  mark.id = next_id_++;
  const auto at = std::upper_bound(all_.begin(), all_.end(), mark.tick,
                                   [](std::uint64_t tick, const Bookmark& b) { return tick < b.tick; });
  return all_.insert(at, std::move(mark))->id;
}

std::uint32_t Bookmarks::add(std::uint64_t tick, double t_s) {
  for (const Bookmark& b : all_) {
    if (b.kind == BookmarkKind::user && b.tick == tick) return b.id;
  }
  return insert({0, BookmarkKind::user, tick, tick, t_s, 1, {}});
}

void Bookmarks::add(BookmarkKind kind, std::uint64_t tick, double t_s, std::string note) {
  if (automatic_ == kMostAutomatic) return;
  insert({0, kind, tick, tick, t_s, 1, std::move(note)});
  ++automatic_;
}

void Bookmarks::set_note(std::uint32_t id, std::string note) {
  for (Bookmark& b : all_) {
    if (b.id != id) continue;
    b.note = std::move(note);
    return;
  }
}

void Bookmarks::remove(std::uint32_t id) {
  const auto found = std::find_if(all_.begin(), all_.end(), [id](const Bookmark& b) { return b.id == id; });
  if (found == all_.end()) return;
  if (found->kind != BookmarkKind::user) --automatic_;
  all_.erase(found);
}

void Bookmarks::forget_before(std::uint64_t tick) {
  if (all_.empty() || all_.front().last_tick >= tick) return;
  automatic_ -=
      std::erase_if(all_, [tick](const Bookmark& b) { return b.kind != BookmarkKind::user && b.last_tick < tick; });
}

void Bookmarks::clear_automatic() {
  std::erase_if(all_, [](const Bookmark& b) { return b.kind != BookmarkKind::user; });
  automatic_ = 0;
  latest_.fill(0);
}

const Bookmark* Bookmarks::find(std::uint32_t id) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [id](const Bookmark& b) { return b.id == id; });
  return found == all_.end() ? nullptr : &*found;
}

const Bookmark* Bookmarks::after(std::uint64_t tick) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [tick](const Bookmark& b) { return b.tick > tick; });
  return found == all_.end() ? nullptr : &*found;
}

const Bookmark* Bookmarks::before(std::uint64_t tick) const {
  const auto found = std::find_if(all_.rbegin(), all_.rend(), [tick](const Bookmark& b) { return b.tick < tick; });
  return found == all_.rend() ? nullptr : &*found;
}

}  // namespace tangent
