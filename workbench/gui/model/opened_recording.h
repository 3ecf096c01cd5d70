// A recording in the window. Of all its ticks there are the minima and maxima that the file keeps of every 256 (or of
// more where it is longer than 18 hours at 1 kHz); those around the tick in view are loaded whole, each with what it
// was handed, so that they can be solved again: a page. It is as long as the history of a live window. The file is only
// read.
//
// Pages are loaded in a worker thread: a minute around the place first, then all. A tick outside the page is loaded at
// once, with a quarter of a second on either side.
#pragma once

#include "workbench/gui/model/parameter_marks.h"
#include "workbench/gui/model/recorded_past.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/recording/solvable_ticks.h"
#include "workbench/session/bookmarks.h"

#include <atomic>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent {

class OpenedRecording {
 public:
  struct Options {
    std::size_t page_ticks = 600'000;
    bool threaded = true;  ///< false: pages are loaded by the call that wants them
    /// Taken for every scene of the file that has its hash, so that it need not be built again. Null: none.
    std::shared_ptr<const ContactScene> scene;
  };
  /// Takes a second or two for ten hours; any thread. Fails where the file is no recording (Recording::open), or has
  /// no tick.
  static Result<std::unique_ptr<OpenedRecording>> open(const std::filesystem::path& path, Options options);
  ~OpenedRecording();

  const std::filesystem::path& path() const { return path_; }
  const RecordingInfo& info() const { return info_; }
  double tick_period_s() const { return tick_period_s_; }
  /// What is to be known of it besides: that it was cut short, ticks that are missing, another version.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// Why its ticks can't be solved again, and what to do about it; empty: they can.
  std::string unsolvable() const;
  /// The scene of its first tick, and what it was built from. Null: the file has none, and `options.scene` is another.
  const std::shared_ptr<const ContactScene>& scene() const { return first_scene_; }
  const SceneSource* source() const { return first_scene_ != nullptr ? source_of(*first_scene_) : nullptr; }
  /// Of any of its scenes; null: it was not built from the file.
  const SceneSource* source_of(const ContactScene& scene) const;
  const SolvableTicks::Scenes& scenes() const { return scenes_; }
  /// A scene that was recorded without its mesh and is not there yet; null: none.
  const RecordedScene* missing_scene() const;
  /// Takes a scene from elsewhere if it is the missing one, by its hash. The page is then loaded again.
  bool offer_scene(const std::shared_ptr<const ContactScene>& scene);

  const std::vector<Preset>& presets() const { return presets_; }  ///< by id
  const Preset* preset(std::uint32_t id) const { return id < presets_.size() ? &presets_[id] : nullptr; }
  Bookmarks& bookmarks() { return bookmarks_; }
  const Bookmarks& bookmarks() const { return bookmarks_; }
  std::span<const ParameterMark> parameter_marks() const { return marks_; }

  const PastPart& page() const { return page_.part; }
  const ChannelStore& store() const { return *page_.store; }
  /// The tick is in the page then. True: the page is another one.
  bool see_tick(std::uint64_t tick);
  /// Asks for a page with these ticks, unless they are more than a page has.
  void see_range(double from, double to);
  /// Once a frame: takes in a page that was loaded. True: the page is another one.
  bool update();
  bool loading() const { return job_.valid() || !wanted_.empty(); }
  /// Ticks of the page, and before it in the second of its kept state, that this program computes otherwise.
  std::uint64_t different() const { return page_.different; }
  /// Why the last page could not be loaded, once; empty: it could.
  std::string take_problem() { return std::exchange(problem_, {}); }

 private:
  struct Page {
    TickRange range;
    PastPart part;
    std::unique_ptr<ChannelStore> store;
    std::uint64_t different = 0;
  };
  using PageResult = Result<Page>;

  OpenedRecording(std::filesystem::path path, Options options) : path_(std::move(path)), options_(std::move(options)) {}
  Status read(Recording& recording);
  Status read_presets(const Recording& recording);
  Status read_scenes(Recording& recording);
  Status read_overview(Recording& recording);
  Status read_newest(Recording& recording, std::uint64_t from, int level, ChannelStore& blocks) const;
  Status read_events(Recording& recording);
  void remark(Recording& recording);
  TickRange around(std::uint64_t tick, std::size_t ticks) const;
  void want(std::uint64_t middle);
  PageResult load(SolvableTicks& ticks, const TickRange& range) const;
  PageResult load_new(const TickRange& range) const;
  void take(PageResult page);
  void cancel();

  const std::filesystem::path path_;
  const Options options_;
  RecordingInfo info_;
  double tick_period_s_ = 1e-3;
  std::vector<std::string> remarks_;
  std::vector<RecordedScene> recorded_scenes_;
  SolvableTicks::Scenes scenes_;
  std::shared_ptr<const ContactScene> first_scene_;
  std::map<std::uint32_t, SceneSource> sources_;  ///< by the scene's id
  std::vector<Preset> presets_;
  Bookmarks bookmarks_;
  std::vector<ParameterMark> marks_;
  ChannelStore::Coarse coarse_;
  Page page_;
  std::deque<TickRange> wanted_;
  TickRange target_;  ///< of the pages that are wanted or being loaded
  std::future<PageResult> job_;
  mutable std::atomic<bool> cancelled_{false};
  std::optional<SolvableTicks> at_once_;  ///< of the window's thread
  std::string problem_;
};

}  // namespace tangent
