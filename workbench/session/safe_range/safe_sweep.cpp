#include "workbench/session/safe_range/safe_sweep.h"

#include "core/base/fnv.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <utility>

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace tangent {

namespace {

/// Servo and window go first. On Linux niceness is a thread's.
void go_after_others() {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, 10);
#endif
}

}  // namespace

// --- One preset ----------------------------------------------------------------------------------------

std::optional<Verdict> PresetTrials::judge(const Preset& preset, const std::atomic<bool>* stop) {
  if (trial_ == nullptr || !(finger_ == preset.finger)) {
    ground_.scene->build_far_parts(run_in_turn);  // ticks would come to nothing there
    finger_ = preset.finger;
    path_ = ExplorationPath::build(*ground_.scene, pad_distance_m(finger_));
    trial_ = std::make_unique<LoopTrial>(ground_.scene, *path_, ground_.device);
  }
  if (wants_smooth(preset) && ground_.scene->planar() == nullptr) {
    ground_.scene->hierarchy();
    // Whoever made it may have left its parts, and ticks would come to nothing there.
    if (ground_.scene->unbuilt_parts() > 0) ground_.scene->build_far_parts(run_in_turn);
  }
  const double pad_m = pad_distance_m(finger_);
  Verdict worst{.safety = Safety::stable};
  for (std::size_t grip = kGrips.size(); grip-- > 0;) {  // nobody's first: it shakes soonest
    for (std::size_t place = 0; place < kTouchPlaces; ++place) {
      const double from_m = path_->length_m() * static_cast<double>(place) / kTouchPlaces;
      const TouchSite site = [&](double along_m, double press_m) {
        return path_->at(from_m + along_m, pad_m, press_m);
      };
      const TrialOutcome out = trial_->touch(preset, site, kGrips[grip], stop);
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return std::nullopt;
      const Verdict here{out.safety, static_cast<std::uint8_t>(place), static_cast<std::uint8_t>(grip), out.why};
      if (out.safety == Safety::shakes) return here;
      if (out.safety == Safety::unknown && worst.safety == Safety::stable) worst = here;
    }
  }
  return worst;
}

// --- All lines -----------------------------------------------------------------------------------------

struct SafeSweep::Kept {
  std::size_t in_file = 0;
  std::vector<std::unique_ptr<PresetTrials>> trials;  ///< by thread, of the ground there is
};

SafeSweep::SafeSweep(std::filesystem::path file, const std::string& build)
    : file_(std::move(file)), build_hash_(Fnv().add(build).value()), kept_(std::make_unique<Kept>()) {
  if (file_.empty()) return;
  if (const Status read = store_.read(file_); !read) problem_ = read.error().message();
  kept_->in_file = store_.size();
}

SafeSweep::~SafeSweep() {
  cancel();
  keep();
}

void SafeSweep::cancel() {
  stop_.store(true, std::memory_order_relaxed);
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  stop_.store(false, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  next_line_ = keys_.size();
  asked_.reset();
}

void SafeSweep::wait() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  keep();
}

void SafeSweep::keep() {
  if (file_.empty() || store_.size() == kept_->in_file) return;
  kept_->in_file = store_.size();
  if (const Status kept = store_.write(file_); !kept) {
    const std::lock_guard lock(mutex_);
    problem_ = kept.error().message();
  }
}

void SafeSweep::start(const TrialGround& ground, const Preset& base, std::vector<const PresetKey*> keys,
                      unsigned threads) {
  cancel();
  keep();
  const bool same_ground = ground == ground_;
  if (!same_ground) {
    scene_hash_ = Fnv().add_bits(build_hash_).add_bits(trial_scene_hash(*ground.scene)).value();
    kept_->trials.clear();
  }
  const Preset before = std::exchange(base_, base);
  ground_ = ground;
  keys_ = keys.empty() ? keys_with_range(base, ground.scene->planar() != nullptr) : std::move(keys);
  for (auto at = ranges_.begin(); at != ranges_.end();) {
    Preset moved = before;
    at->first->set(moved, at->first->get(base));
    at = same_ground && same_loop(moved, base) ? std::next(at) : ranges_.erase(at);
  }
  next_line_ = 0;
  begin_threads(threads);
}

void SafeSweep::ask(const Preset& preset) {
  {
    const std::lock_guard lock(mutex_);
    asked_ = preset;
    if (busy_ > 0) return;
  }
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  begin_threads(1);
}

void SafeSweep::begin_threads(unsigned count) {
  count = std::max(1u, count);
  while (kept_->trials.size() < count) kept_->trials.push_back(std::make_unique<PresetTrials>(ground_));
  busy_ = count;
  for (unsigned i = 0; i < count; ++i) threads_.emplace_back([this, i] { work(*kept_->trials[i]); });
}

std::optional<Verdict> SafeSweep::judge(PresetTrials& trials, const Preset& asked) {
  const Preset preset = rendered_by(ground_.device, asked);
  const std::uint64_t key = trial_key(scene_hash_, ground_.device, preset);
  if (const auto known = store_.find(key)) return known;
  const auto verdict = trials.judge(preset, &stop_);
  if (verdict) store_.put(key, *verdict);
  return verdict;
}

void SafeSweep::work(PresetTrials& trials) {
  go_after_others();
  const auto judge_asked_first = [&](const Preset& preset) {
    for (;;) {
      std::unique_lock lock(mutex_);
      const std::optional<Preset> asked = std::exchange(asked_, std::nullopt);
      lock.unlock();
      if (!asked) break;
      if (!judge(trials, *asked)) return std::optional<Verdict>();
    }
    return judge(trials, preset);
  };
  std::unique_lock lock(mutex_);
  while (!stop_.load(std::memory_order_relaxed) && (asked_ || next_line_ < keys_.size())) {
    if (const std::optional<Preset> asked = std::exchange(asked_, std::nullopt)) {
      lock.unlock();
      static_cast<void>(judge(trials, *asked));
      lock.lock();
      continue;
    }
    const PresetKey* key = keys_[next_line_++];
    if (ranges_.contains(key)) continue;
    lock.unlock();
    SafeRange range = sweep_line(base_, *key, judge_asked_first);
    lock.lock();
    if (!range.samples().empty()) ranges_[key] = std::move(range);
  }
  --busy_;
}

bool SafeSweep::running() const {
  const std::lock_guard lock(mutex_);
  return busy_ > 0;
}

std::size_t SafeSweep::done_lines() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::count_if(keys_.begin(), keys_.end(), [this](const PresetKey* key) { return ranges_.contains(key); }));
}

SafeRange SafeSweep::range(const PresetKey& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = ranges_.find(&key);
  return found == ranges_.end() ? SafeRange() : found->second;
}

Verdict SafeSweep::known(const Preset& preset) const {
  if (!started()) return {};
  const auto own = store_.find(trial_key(scene_hash_, ground_.device, rendered_by(ground_.device, preset)));
  if (own) return *own;
  const PresetKey* differs = nullptr;
  for (const PresetKey& key : preset_keys()) {
    if (!is_in_loop(key) || key.get(preset) == key.get(base_)) continue;
    if (differs != nullptr) return {};
    differs = &key;
  }
  if (differs == nullptr) return {};
  return {.safety = range(*differs).at(differs->get(preset))};
}

bool SafeSweep::tried(const Preset& preset) const {
  return started() && store_.find(trial_key(scene_hash_, ground_.device, rendered_by(ground_.device, preset)));
}

void SafeSweep::learn(const Preset& preset, const Verdict& verdict) {
  if (started()) store_.put(trial_key(scene_hash_, ground_.device, rendered_by(ground_.device, preset)), verdict);
}

std::string SafeSweep::take_problem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

}  // namespace tangent
