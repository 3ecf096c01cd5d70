// A recording, read. What it holds is checked where it is used: a file may be cut short, damaged, or made by somebody
// who wishes us ill, and all that is an Error. Not thread-safe: a thread opens its own.
#pragma once

#include "core/preset/preset.h"
#include "workbench/recording/database.h"
#include "workbench/recording/overview.h"
#include "workbench/recording/recorded_event.h"
#include "workbench/recording/recorded_values.h"
#include "workbench/recording/scene_bytes.h"
#include "workbench/recording/tick_reader.h"

#include <map>
#include <optional>
#include <vector>

namespace tangent {

struct RecordedScene {
  std::uint32_t id = 0;
  std::string name;
  bool planar = false;
  std::string hash;        ///< scene_hash
  bool has_bytes = false;  ///< false: recorded with --no-mesh
};

struct KeptState {
  std::uint64_t tick = 0;
  bool touched = false;  ///< not what the tick before left
};

struct RecordedGap {
  std::uint64_t first_tick = 0, ticks = 0;
};

struct RecordingInfo {
  std::int64_t format = 0;
  std::string version, build;  ///< of the program that made it
  bool states_usable = false;  ///< kept states have this program's layout
  std::string started_utc, ended_utc;
  bool closed = false;                                     ///< false: it was cut short, or is still being made
  std::uint64_t first_tick = 0, last_tick = 0, ticks = 0;  ///< none: ticks == 0
  double first_s = 0.0, last_s = 0.0;
  std::uint64_t missing = 0;  ///< ticks between first and last that were not recorded
  /// Of the servo; 0 where there are less than two ticks.
  double rate_hz() const {
    return last_s > first_s ? static_cast<double>(last_tick - first_tick) / (last_s - first_s) : 0.0;
  }
};

class Recording {
 public:
  static constexpr std::int64_t kMostEvents = 100'000;
  static constexpr std::uint64_t kMostTick = std::uint64_t{1} << 62;  ///< the largest number of a tick

  /// Fails on what is no recording, is newer than this program, or lacks what every recording has.
  static Result<Recording> open(const std::filesystem::path& path);

  const RecordingInfo& info() const { return info_; }
  const std::map<std::uint32_t, Preset>& presets() const { return presets_; }
  const std::vector<RecordedScene>& scenes() const { return scenes_; }
  const std::filesystem::path& path() const { return database_.path(); }

  /// What it was built from, and how. Fails where it was recorded without its bytes, or they are not what was recorded.
  Result<SceneSource> scene_source(std::uint32_t id);
  /// Builds it again. Fails where it was recorded without its bytes, or they are not what was recorded.
  Result<std::shared_ptr<const ContactScene>> scene(std::uint32_t id);
  /// Whether this is the scene that was recorded: for one that comes from elsewhere.
  Status is_scene(const RecordedScene& recorded, const ContactScene& scene) const;

  Result<std::vector<KeptState>> states();
  Result<TickState> state(std::uint64_t tick, const ContactScene& scene);
  Result<std::vector<RecordedGap>> gaps();
  /// In the order of their ticks; at most the first kMostEvents.
  Result<std::vector<RecordedEvent>> events();
  /// What was true before the first tick: of "force", "display" or the "run". None: it is not there, or no number.
  Result<std::optional<double>> value(const std::string& of, const std::string& name);
  /// What it says of its devices and its run.
  Result<std::vector<RecordedValue>> values();
  /// From `first` to `last`, both included.
  Result<TickReader> ticks(std::uint64_t first, std::uint64_t last);
  /// The first tick at that time or later; one past the last where there is none.
  Result<std::uint64_t> tick_at(double t_s);
  /// Rows that touch these ticks, of a level. The newest ticks of a recording that was cut short are in none.
  Result<std::vector<OverviewRow>> overview(int level, std::uint64_t first, std::uint64_t last);

 private:
  explicit Recording(Database database) : database_(std::move(database)) {}
  Status check_format();
  Status check_tables();
  Status read_info();
  Status read_presets();
  Status read_scenes();
  Result<std::string> meta(const std::string& key);
  Result<std::vector<unsigned char>> bytes_of(const RecordedScene& scene);
  tl::unexpected<Error> damaged(const std::string& what) const;

  Database database_;
  RecordingInfo info_;
  std::map<std::uint32_t, Preset> presets_;
  std::vector<RecordedScene> scenes_;
  std::map<std::string, bool> has_column_;  ///< of tick_rows and device_rows
};

}  // namespace tangent
