#include "workbench/recording/recorder.h"

#include <algorithm>
#include <utility>

namespace tangent {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kRetry{1};
constexpr std::chrono::seconds kMoveEvery{1};
constexpr std::chrono::seconds kLongestWait{1};  // for a preset or scene that a tick names
constexpr std::size_t kMostEvents = 10'000;

}  // namespace

Recorder::Recorder(RecordingFile file, std::function<bool(ServoRecord&)> pop)
    : file_(std::move(file)), pop_(std::move(pop)) {
  pending_.ticks.reserve(kMostPending);
}

Recorder::~Recorder() { static_cast<void>(stop()); }

void Recorder::start() {
  if (thread_.joinable()) return;
  if (file_.leave_moving_to_others()) moving_ = std::thread([this] { move_written(); });
  thread_ = std::thread([this] { run(); });
}

void Recorder::pump() { round(); }

void Recorder::run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    round();
    lock.lock();
    wake_.wait_for(lock, kEvery, [this] { return stopping_; });
  }
}

// A failure shows where ticks are written.
void Recorder::move_written() {
  Result<Database> database = Database::open_to_write(file_.path());
  std::unique_lock lock(mutex_);
  while (database && !wake_.wait_for(lock, kMoveEvery, [this] { return stopping_; })) {
    lock.unlock();
    static_cast<void>(RecordingFile::move_written(*database));
    lock.lock();
  }
}

Status Recorder::stop() {
  if (closed_) return {};
  closed_ = true;
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (moving_.joinable()) moving_.join();
  retry_ = {};
  waits_ = true;
  waiting_since_ = {};  // nobody adds what a tick still waits for
  std::size_t left = 0;
  do {  // more than one batch may be waiting in the ring
    round();
    left = pending_.ticks.size();
    if (failed_) break;
    take_records();
  } while (!pending_.ticks.empty() && !failed_);
  if (failed_) {
    const RecorderStatus now = status();
    return fail("the newest " + std::to_string(left) + " ticks are not in it: " + now.trouble, file_.path().string(),
                "what was written before can be read");
  }
  const Status closed = file_.close();
  set_trouble(closed);
  return closed;
}

void Recorder::add_preset(std::uint32_t id, const Preset& preset) {
  const std::scoped_lock lock(mutex_);
  new_notes_.push_back({.id = id, .preset = preset, .scene = nullptr, .name = {}, .source = {}});
}

void Recorder::add_scene(std::uint32_t id, std::shared_ptr<const ContactScene> scene, std::string name,
                         SceneSource source) {
  const std::scoped_lock lock(mutex_);
  new_notes_.push_back({.id = id,
                        .preset = std::nullopt,
                        .scene = std::move(scene),
                        .name = std::move(name),
                        .source = std::move(source)});
}

void Recorder::add_event(RecordedEvent event) {
  const std::scoped_lock lock(mutex_);
  if (new_events_.size() < kMostEvents) new_events_.push_back(std::move(event));
}

RecorderStatus Recorder::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

void Recorder::set_trouble(const Status& status) {
  failed_ = !status.has_value();
  if (failed_) {
    ++failures_;
    retry_ = Clock::now() + kRetry;
  }
  const std::scoped_lock lock(mutex_);
  status_ = {file_.ticks_written(), file_.ticks_missing(), pending_.ticks.size(), failures_,
             failed_ ? status.error().message() : std::string()};
}

void Recorder::take_records() {
  ServoRecord record;
  while (pending_.ticks.size() < kMostPending && pop_(record)) pending_.ticks.push_back(record);
}

Status Recorder::write_notes() {
  while (!notes_.empty()) {
    const Note& note = notes_.front();
    const bool keeps = note.source.mesh || note.source.polygon;
    const Status ok = note.preset ? file_.add_preset(note.id, *note.preset)
                                  : file_.add_scene(note.id, *note.scene, note.name, keeps ? &note.source : nullptr);
    if (!ok) return ok;
    (note.preset ? presets_ : scenes_).insert(note.id);
    notes_.erase(notes_.begin());
  }
  return {};
}

bool Recorder::is_known(const ServoRecord& record) const {
  return presets_.contains(record.tick.preset_id) && scenes_.contains(record.scene_id);
}

Status Recorder::write_ticks() {
  const auto unknown =
      std::find_if(pending_.ticks.begin(), pending_.ticks.end(), [this](const auto& r) { return !is_known(r); });
  std::vector<ServoRecord> later;
  const bool some_wait = unknown != pending_.ticks.end();
  if (some_wait && !std::exchange(waits_, true)) waiting_since_ = Clock::now();
  waits_ = some_wait;
  if (some_wait && Clock::now() - waiting_since_ < kLongestWait) {
    later.assign(unknown, pending_.ticks.end());
    pending_.ticks.erase(unknown, pending_.ticks.end());
  }
  const Status written = pending_.empty() ? Status{} : file_.write(pending_);
  if (written) {
    pending_.ticks.clear();
    pending_.events.clear();
  }
  pending_.ticks.insert(pending_.ticks.end(), later.begin(), later.end());
  return written;
}

/// An event that goes into the file with the ticks that could not be written, at the first of them.
void Recorder::note_trouble() {
  if (noted_ || pending_.ticks.empty()) return;
  noted_ = true;
  const TickRecord& first = pending_.ticks.front().tick;
  pending_.events.push_back(
      {first.tick, first.input.t_s, "recorder", "from here on the file could not be written for a while"});
}

void Recorder::round() {
  {
    const std::scoped_lock lock(mutex_);
    notes_.insert(notes_.end(), std::make_move_iterator(new_notes_.begin()), std::make_move_iterator(new_notes_.end()));
    new_notes_.clear();
    pending_.events.insert(pending_.events.end(), std::make_move_iterator(new_events_.begin()),
                           std::make_move_iterator(new_events_.end()));
    new_events_.clear();
  }
  take_records();
  if (Clock::now() < retry_) return;
  if (failed_) note_trouble();
  Status done = write_notes();
  if (done) done = write_ticks();
  set_trouble(done);
  if (!failed_) noted_ = false;
}

}  // namespace tangent
