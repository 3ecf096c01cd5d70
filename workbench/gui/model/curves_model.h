// Speed against error of the recorded motion: every method at many tolerances and iteration limits on the chosen ticks
// (workbench/bench/speed_curves.h), and the worst tick behind each point.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/time_model.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace tangent {

namespace bench {
class CurvesJob;
struct SpeedCurves;
}  // namespace bench

class CurvesModel {
 public:
  /// Of a longer range the newest.
  static constexpr std::size_t kMostTicks = 20'000;

  CurvesModel(const AppOptions& options, PresetModel& presets, TimeModel& past, MessageLog& messages);
  ~CurvesModel();

  void start();  ///< over the chosen ticks, under the present preset; a message says why not
  void cancel();
  void clear();
  bool running() const;
  double progress() const;                                   ///< 0 to 1
  std::shared_ptr<const bench::SpeedCurves> curves() const;  ///< null: nothing measured
  const TickRange& range() const { return range_; }          ///< that was measured
  /// Another value than those that are swept has changed since.
  bool outdated() const;

  // What is drawn.
  enum class Error : std::uint8_t { p50, p99, worst };
  static constexpr std::array<std::string_view, 3> kErrorNames{"median error", "99 % error", "worst error"};
  enum class Time : std::uint8_t { p50, mean, p99 };
  static constexpr std::array<std::string_view, 3> kTimeNames{"median time", "mean time", "99 % time"};
  Error shown_error = Error::p99;
  Time shown_time = Time::mean;

  /// The worst tick behind a point, then behind a peer, as numbered in curves(). Empty: its motion is gone.
  std::optional<std::uint64_t> worst_tick(std::size_t i) const;
  /// Pauses on it with the point's method, tolerance and limit as the present values, so that its iterations are drawn
  /// beside the recorded ones; of a peer with the values as they are. A message where the tick is gone.
  void open(std::size_t i);

 private:
  PresetModel& presets_;
  TimeModel& time_;
  MessageLog& messages_;
  const bool deterministic_;
  std::unique_ptr<bench::CurvesJob> job_;
  TickRange range_;
  std::vector<std::uint64_t> ticks_;  ///< recorded tick of each pose
  Preset base_;
};

}  // namespace tangent
