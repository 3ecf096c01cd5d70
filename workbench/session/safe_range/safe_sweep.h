// Safe ranges of a scene, a device and a preset, swept in threads of low priority beside the servo. A preset that is
// asked for is judged before the lines go on. What is known stays known, in memory and in the file of verdicts; another
// scene, device or value hangs on others. All calls come from the owner's thread; the verdicts are the same whatever
// the number of threads.
#pragma once

#include "workbench/session/safe_range/safe_range.h"

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace tangent {

/// What trials are made on.
struct TrialGround {
  std::shared_ptr<const ContactScene> scene;
  TrialDevice device;
  bool operator==(const TrialGround&) const = default;
};

/// Verdicts on one ground: the worst of all grips at all places; the first that shakes ends it. Not thread-safe.
class PresetTrials {
 public:
  explicit PresetTrials(TrialGround ground) : ground_(std::move(ground)) {}
  /// Empty: it was stopped. Takes tens of milliseconds, and a tenth of a second more for another finger.
  std::optional<Verdict> judge(const Preset& preset, const std::atomic<bool>* stop = nullptr);

 private:
  TrialGround ground_;
  Finger finger_;
  std::optional<ExplorationPath> path_;
  std::unique_ptr<LoopTrial> trial_;
};

class SafeSweep {
 public:
  /// `file`: of verdicts, in a folder of one's own; empty: they are kept in memory only. `build`: which build of the
  /// program judges (recording/build_identity.h): another one's verdicts in the file are not known here.
  explicit SafeSweep(std::filesystem::path file = {}, const std::string& build = {});
  ~SafeSweep();

  /// Sweeps every key's line through `base`. Lines of the last start that hold all the same stay; a running one is
  /// cancelled. `keys`: only these; empty: all that keys_with_range says.
  void start(const TrialGround& ground, const Preset& base, std::vector<const PresetKey*> keys = {},
             unsigned threads = 1);
  /// Judges this preset before anything else, also where no sweep runs; the latest wins. Precondition: start was
  /// called.
  void ask(const Preset& preset);
  void cancel();  ///< at the next tick of a trial; what is known stays
  void wait();    ///< until nothing is left to do

  bool running() const;
  std::size_t lines() const { return keys_.size(); }
  std::size_t done_lines() const;
  bool started() const { return ground_.scene != nullptr; }
  const TrialGround& ground() const { return ground_; }
  const Preset& base() const { return base_; }

  /// What is known of a preset on this ground: by its own verdict; or because it differs from the base in one key, by
  /// that key's line.
  Verdict known(const Preset& preset) const;
  /// It was judged by itself, whatever came of it.
  bool tried(const Preset& preset) const;
  /// A key's line through the base; empty: not swept yet.
  SafeRange range(const PresetKey& key) const;
  /// A trial of another kind: on a device, with a person.
  void learn(const Preset& preset, const Verdict& verdict);
  std::string take_problem();  ///< with the file, once; empty: none

 private:
  /// Between two runs: a thread's paths and scenes, and how many verdicts the file has.
  struct Kept;
  void work(PresetTrials& trials);
  std::optional<Verdict> judge(PresetTrials& trials, const Preset& preset);
  void begin_threads(unsigned count);
  void keep();

  std::filesystem::path file_;
  VerdictStore store_;
  TrialGround ground_;
  std::uint64_t build_hash_ = 0;
  std::uint64_t scene_hash_ = 0;  ///< of build and scene
  Preset base_;
  std::vector<const PresetKey*> keys_;
  mutable std::mutex mutex_;  ///< of what follows
  std::map<const PresetKey*, SafeRange> ranges_;
  std::optional<Preset> asked_;
  std::size_t next_line_ = 0, busy_ = 0;
  std::string problem_;
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace tangent
