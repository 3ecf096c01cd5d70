#include "workbench/gui/model/asked_range.h"

#include "workbench/gui/model/ghost_channels.h"
#include "workbench/session/resolve_history.h"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>

namespace tangent {

namespace {

constexpr std::size_t kMemoryUnknown = std::size_t{2} << 30;

std::string text_of_ticks_and_bytes(std::uint64_t ticks, double bytes) {
  char text[80];
  std::snprintf(text, sizeof text, "%llu ticks, %.3g GB", static_cast<unsigned long long>(ticks), bytes / 1e9);
  return text;
}

}  // namespace

std::size_t bytes_of_solved_tick() {
  return sizeof(ServoRecord) + 2 * sizeof(ResolvedTick) + 2 * kGhostChannelCount * sizeof(float);
}

std::size_t usable_memory_bytes() {
  std::ifstream facts("/proc/meminfo");
  std::string name;
  for (std::size_t kib = 0; facts >> name >> kib; facts.ignore(64, '\n'))
    if (name == "MemAvailable:") return kib * 1024 / 2;
  return kMemoryUnknown;
}

AskedRange::AskedRange(std::filesystem::path path, SolvableTicks::Scenes scenes, std::size_t most_bytes, bool threaded)
    : path_(std::move(path)), scenes_(std::move(scenes)), most_bytes_(most_bytes), threaded_(threaded) {}

AskedRange::~AskedRange() { cancel(); }

Status AskedRange::load(const TickRange& range) {
  cancel();
  const std::uint64_t ticks = range.to - range.from + 1;
  const std::size_t most_bytes = most_bytes_ > 0 ? most_bytes_ : usable_memory_bytes();
  const std::uint64_t most = most_bytes / bytes_of_solved_tick();
  const auto each = static_cast<double>(bytes_of_solved_tick());
  if (ticks > most)
    return fail(
        "is too long to be solved at once: " + text_of_ticks_and_bytes(ticks, each * static_cast<double>(ticks)) +
            "; there is room for " + text_of_ticks_and_bytes(most, static_cast<double>(most_bytes)),
        "from A to B", "set the cursors nearer to each other");
  range_ = range;
  read_ = 0;
  job_ = std::async(threaded_ ? std::launch::async : std::launch::deferred, [this, range] { return read(range); });
  if (!threaded_) job_.wait();
  return {};
}

Result<PastPart> AskedRange::read(const TickRange& range) {
  Result<SolvableTicks> ticks = SolvableTicks::open(path_, scenes_);
  if (!ticks) return tl::unexpected(ticks.error());
  History history(range.to - range.from + 1);
  const Status done = ticks->read(range.from, range.to, [&](const ServoRecord& record) {
    history.push(record);
    read_.store(record.tick.tick - range.from, std::memory_order_relaxed);
    return !cancelled_.load(std::memory_order_relaxed);
  });
  if (!done) return tl::unexpected(done.error());
  return PastPart{history.snapshot(), scenes_};
}

void AskedRange::cancel() {
  if (!job_.valid()) return;
  cancelled_ = true;
  job_.wait();
  job_ = {};
  cancelled_ = false;
}

double AskedRange::progress() const {
  return static_cast<double>(read_.load(std::memory_order_relaxed)) / static_cast<double>(range_.to - range_.from + 1);
}

std::optional<Result<PastPart>> AskedRange::take() {
  if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return job_.get();
}

}  // namespace tangent
