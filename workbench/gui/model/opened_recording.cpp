#include "workbench/gui/model/opened_recording.h"

#include "workbench/gui/model/tick_channels.h"
#include "workbench/recording/build_identity.h"
#include "workbench/session/two_threads.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr std::uint64_t kAtOnce = 512;    ///< ticks of a page that is loaded while one waits
constexpr std::uint64_t kFirst = 60'000;  ///< of the first page that the worker loads
constexpr std::uint64_t kMostBlocks = 1 << 18;
constexpr std::uint64_t kMostNewest = 1 << 16;  ///< ticks that are in no row of the overview
constexpr std::size_t kMostPresetIds = 1 << 18;

std::string seconds_text(double t_s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3f s", t_s);
  return text;
}

/// "preset 3": the number.
std::optional<std::uint32_t> preset_of(const std::string& text) {
  constexpr std::string_view kBegin = "preset ";
  std::uint32_t id = 0;
  if (!text.starts_with(kBegin)) return std::nullopt;
  const char *from = text.data() + kBegin.size(), *end = text.data() + text.size();
  const auto read = std::from_chars(from, end, id);
  return read.ec == std::errc() && read.ptr == end ? std::optional(id) : std::nullopt;
}

}  // namespace

// --- Opening -------------------------------------------------------------------------------------------

Result<std::unique_ptr<OpenedRecording>> OpenedRecording::open(const std::filesystem::path& path, Options options) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  if (recording->info().ticks == 0)
    return fail("holds no tick", path.string(), "it ended before its first batch was written");
  std::unique_ptr<OpenedRecording> opened(new OpenedRecording(path, std::move(options)));
  if (Status ok = opened->read(*recording); !ok) return tl::unexpected(ok.error());
  return opened;
}

OpenedRecording::~OpenedRecording() { cancel(); }

Status OpenedRecording::read(Recording& recording) {
  info_ = recording.info();
  const Result<std::optional<double>> hz = recording.value("run", "servo_hz");
  if (!hz) return tl::unexpected(hz.error());
  const double ticks = static_cast<double>(info_.last_tick - info_.first_tick);
  if (*hz && **hz >= 1.0 && **hz <= 1e6)
    tick_period_s_ = 1.0 / **hz;
  else if (ticks > 0.0 && info_.last_s > info_.first_s)
    tick_period_s_ = (info_.last_s - info_.first_s) / ticks;
  for (Status (OpenedRecording::*step)(Recording&) :
       {&OpenedRecording::read_scenes, &OpenedRecording::read_overview, &OpenedRecording::read_events})
    if (Status ok = (this->*step)(recording); !ok) return ok;
  remark(recording);
  PageResult page = load_new(around(info_.first_tick, options_.threaded ? kAtOnce : options_.page_ticks));
  if (!page) return tl::unexpected(page.error());
  take(std::move(page));
  if (options_.threaded) want(info_.first_tick);
  return {};
}

Status OpenedRecording::read_presets(const Recording& recording) {
  if (recording.presets().empty())
    return fail("has no preset", path_.string(), "the file is damaged: copy it from where it was recorded again");
  const std::size_t last = recording.presets().rbegin()->first;
  if (last >= kMostPresetIds)
    return fail("has a preset of number " + std::to_string(last), path_.string(),
                "the file is damaged: copy it from where it was recorded again");
  presets_.resize(last + 1);
  for (const auto& [id, preset] : recording.presets()) presets_[id] = preset;
  return {};
}

/// Those whose mesh is in the file, or is the one given; the others are asked for (missing_scene).
Status OpenedRecording::read_scenes(Recording& recording) {
  if (Status ok = read_presets(recording); !ok) return ok;
  recorded_scenes_ = recording.scenes();
  std::optional<std::uint32_t> first;
  Result<TickReader> reader = recording.ticks(info_.first_tick, info_.first_tick);
  if (!reader) return tl::unexpected(reader.error());
  RecordedTick tick;
  const Result<bool> any = reader->next(tick);
  if (!any) return tl::unexpected(any.error());
  if (*any) first = tick.record.scene_id;
  for (const RecordedScene& recorded : recorded_scenes_) {
    if (options_.scene != nullptr && scene_hash(*options_.scene) == recorded.hash) {
      scenes_[recorded.id] = options_.scene;
      if (recorded.has_bytes && recorded.id != first)
        if (Result<SceneSource> source = recording.scene_source(recorded.id))
          sources_[recorded.id] = std::move(*source);
    } else if (recorded.has_bytes) {
      Result<SceneSource> source = recording.scene_source(recorded.id);
      if (!source) return tl::unexpected(source.error());
      // Ticks build what they come to; the rest of a large mesh is not waited for.
      Result<std::shared_ptr<const ContactScene>> scene =
          build_scene(*source, {.far_parts = false}, run_on_two_threads);
      if (!scene) return tl::unexpected(scene.error());
      if (Status same = recording.is_scene(recorded, **scene); !same) return same;
      scenes_[recorded.id] = *scene;
      sources_[recorded.id] = std::move(*source);
    }
    if (recorded.id == first && scenes_.contains(recorded.id)) first_scene_ = scenes_.at(recorded.id);
  }
  return {};
}

Status OpenedRecording::read_overview(Recording& recording) {
  int level = 0;
  const auto blocks_of = [this](int of) { return (info_.last_tick - info_.first_tick) / overview_length(of) + 2; };
  while (level + 1 < kOverviewLevels && blocks_of(level) > kMostBlocks) ++level;
  if (blocks_of(level) > kMostBlocks)
    return fail("spans ticks " + std::to_string(info_.first_tick) + " to " + std::to_string(info_.last_tick),
                path_.string(), "that is more than the window shows: give a part of it");
  const Result<std::vector<OverviewRow>> rows = recording.overview(level, info_.first_tick, info_.last_tick);
  if (!rows) return tl::unexpected(rows.error());
  auto blocks = std::make_shared<ChannelStore>(2 * kChannelCount, blocks_of(level));
  const std::uint64_t length = overview_length(level), first_block = info_.first_tick / length;
  // A row that is missing is a gap; one that is out of its place is of a damaged file, and passed over.
  for (const OverviewRow& row : *rows)
    if (row.first_tick / length >= first_block && (blocks->empty() || row.first_tick / length >= blocks->end_tick()))
      blocks->push(row.first_tick / length, channel_ranges(row));
  const std::uint64_t known = blocks->empty() ? info_.first_tick : blocks->end_tick() * length;
  if (Status ok = read_newest(recording, std::max(known, info_.first_tick), level, *blocks); !ok) return ok;
  coarse_ = {std::move(blocks), length, info_.first_tick, info_.last_tick + 1};
  return {};
}

/// The newest ticks of a recording that was cut short are in no row yet.
Status OpenedRecording::read_newest(Recording& recording, std::uint64_t from, int level, ChannelStore& blocks) const {
  if (from > info_.last_tick) return {};
  from = std::max(from, info_.last_tick - std::min(info_.last_tick, kMostNewest));
  Result<TickReader> ticks = recording.ticks(from, info_.last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  Overview pyramid;
  const auto keep = [&blocks, level, length = overview_length(level)](const OverviewRow& row) -> Status {
    if (row.level == level && (blocks.empty() || row.first_tick / length >= blocks.end_tick()))
      blocks.push(row.first_tick / length, channel_ranges(row));
    return {};
  };
  for (RecordedTick tick;;) {
    const Result<bool> any = ticks->next(tick);
    if (!any) return tl::unexpected(any.error());
    if (!*any) return pyramid.finish(keep);
    if (Status ok = pyramid.add(tick, keep); !ok) return ok;
  }
}

Status OpenedRecording::read_events(Recording& recording) {
  const Result<std::vector<RecordedEvent>> events = recording.events();
  if (!events) return tl::unexpected(events.error());
  std::uint32_t last_preset = 0;
  for (const RecordedEvent& event : *events) {
    if (event.tick < info_.first_tick || event.tick > info_.last_tick) continue;
    if (event.kind == "bookmark") bookmarks_.set_note(bookmarks_.add(event.tick, event.t_s), event.text);
    if (event.kind == "unbookmark") bookmarks_.remove(bookmarks_.add(event.tick, event.t_s));
    if (event.kind == "fault" || event.kind == "recorder")
      bookmarks_.add(BookmarkKind::device_fault, event.tick, event.t_s, event.text);
    if (event.kind != "preset") continue;
    const std::optional<std::uint32_t> id = preset_of(event.text);
    if (!id || preset(*id) == nullptr || *id == last_preset) continue;
    marks_.push_back({event.tick, change_text(presets_[last_preset], presets_[*id])});
    last_preset = *id;
  }
  return {};
}

void OpenedRecording::remark(Recording& recording) {
  const std::string name = path_.filename().string();
  if (!info_.closed)
    remarks_.push_back(name + " was cut short, or is still being recorded: it ends with its last whole batch, at " +
                       seconds_text(info_.last_s));
  if (info_.missing > 0) {
    const Result<std::vector<RecordedGap>> gaps = recording.gaps();
    remarks_.push_back(std::to_string(info_.missing) + " ticks are missing in " + name +
                       (gaps ? ", in " + std::to_string(gaps->size()) + " gaps" : std::string()));
  }
  if (info_.build != build_identity())
    remarks_.push_back(name + " was made by another build (" + info_.version +
                       "): solved again, a tick may differ in its last bits");
}

// --- Scenes --------------------------------------------------------------------------------------------

const SceneSource* OpenedRecording::source_of(const ContactScene& scene) const {
  for (const auto& [id, known] : scenes_)
    if (const auto source = sources_.find(id); known.get() == &scene && source != sources_.end())
      return &source->second;
  return nullptr;
}

const RecordedScene* OpenedRecording::missing_scene() const {
  const auto found = std::find_if(recorded_scenes_.begin(), recorded_scenes_.end(),
                                  [this](const RecordedScene& scene) { return !scenes_.contains(scene.id); });
  return found != recorded_scenes_.end() ? &*found : nullptr;
}

std::string OpenedRecording::unsolvable() const {
  if (!info_.states_usable)
    return "it was made by version " + info_.version +
           ", whose kept states this version can't use: its ticks can be looked at, not solved again";
  if (const RecordedScene* missing = missing_scene())
    return "it was recorded without its mesh: open " + missing->name + " (hash " + missing->hash +
           "), as it was read then";
  return {};
}

bool OpenedRecording::offer_scene(const std::shared_ptr<const ContactScene>& scene) {
  if (scene == nullptr || missing_scene() == nullptr) return false;
  const std::string hash = scene_hash(*scene);
  bool taken = false;
  for (const RecordedScene& recorded : recorded_scenes_) {
    if (recorded.hash != hash || scenes_.contains(recorded.id)) continue;
    scenes_[recorded.id] = scene;
    taken = true;
  }
  if (!taken) return false;
  if (first_scene_ == nullptr) first_scene_ = scene;
  cancel();
  at_once_.reset();
  const std::uint64_t middle = page_.range.from + (page_.range.to - page_.range.from) / 2;
  if (options_.threaded) take(load_new(around(middle, kAtOnce)));
  want(middle);
  return true;
}

// --- Pages ---------------------------------------------------------------------------------------------

TickRange OpenedRecording::around(std::uint64_t tick, std::size_t ticks) const {
  tick = std::clamp(tick, info_.first_tick, info_.last_tick);
  const std::uint64_t all = info_.last_tick - info_.first_tick + 1, count = std::min<std::uint64_t>(ticks, all);
  const std::uint64_t before = std::min(count / 2, tick - info_.first_tick);
  const std::uint64_t from = std::min(tick - before, info_.last_tick + 1 - count);
  return {from, from + count - 1};
}

OpenedRecording::PageResult OpenedRecording::load(SolvableTicks& ticks, const TickRange& range) const {
  const std::size_t count = range.to - range.from + 1;
  History history(count);
  std::vector<float> rows(count * kChannelCount, std::numeric_limits<float>::quiet_NaN());
  const std::uint64_t different = ticks.different();
  const Status done = ticks.read(range.from, range.to, [&](const ServoRecord& record) {
    history.push(record);
    const auto row = channel_row(record);
    std::copy(row.begin(), row.end(),
              rows.begin() + static_cast<std::ptrdiff_t>((record.tick.tick - range.from) * kChannelCount));
    return !cancelled_.load(std::memory_order_relaxed);
  });
  if (!done) return tl::unexpected(done.error());
  Page page{range,
            {history.snapshot(), scenes_},
            std::make_unique<ChannelStore>(kChannelCount, count),
            ticks.different() - different};
  page.store->assign(range.from, rows);
  page.store->set_coarse(coarse_);
  return page;
}

OpenedRecording::PageResult OpenedRecording::load_new(const TickRange& range) const {
  Result<SolvableTicks> ticks = SolvableTicks::open(path_, scenes_);
  if (!ticks) return tl::unexpected(ticks.error());
  return load(*ticks, range);
}

void OpenedRecording::take(PageResult page) {
  if (page)
    page_ = std::move(*page);
  else
    problem_ = page.error().message();
}

void OpenedRecording::cancel() {
  wanted_.clear();
  if (!job_.valid()) return;
  cancelled_ = true;
  job_.wait();
  job_ = {};
  cancelled_ = false;
}

void OpenedRecording::want(std::uint64_t middle) {
  cancel();
  target_ = around(middle, options_.page_ticks);
  if (!options_.threaded) return take(load_new(target_));
  if (target_.to - target_.from > 2 * kFirst) wanted_.push_back(around(middle, kFirst));
  wanted_.push_back(target_);
}

bool OpenedRecording::see_tick(std::uint64_t tick) {
  tick = std::clamp(tick, info_.first_tick, info_.last_tick);
  if (page_.range.from <= tick && tick <= page_.range.to) return false;
  if (options_.threaded) {
    cancel();
    if (!at_once_) {
      Result<SolvableTicks> ticks = SolvableTicks::open(path_, scenes_);
      if (!ticks) return take(tl::unexpected(ticks.error())), false;
      at_once_.emplace(std::move(*ticks));
    }
    take(load(*at_once_, around(tick, kAtOnce)));
  }
  want(tick);
  return true;
}

void OpenedRecording::see_range(double from, double to) {
  const auto tick = [this](double t) {
    return std::clamp(static_cast<std::uint64_t>(std::max(0.0, t)), info_.first_tick, info_.last_tick);
  };
  const TickRange seen{tick(from), tick(to)};
  const auto has = [&seen](const TickRange& range) { return range.from <= seen.from && seen.to <= range.to; };
  if (seen.to - seen.from + 2 >= options_.page_ticks || has(page_.range) || (loading() && has(target_))) return;
  want(seen.from + (seen.to - seen.from) / 2);
}

bool OpenedRecording::update() {
  if (!job_.valid() && !wanted_.empty()) {
    job_ = std::async(std::launch::async, [this, range = wanted_.front()] { return load_new(range); });
    wanted_.pop_front();
  }
  if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  take(job_.get());
  return true;
}

}  // namespace tangent
