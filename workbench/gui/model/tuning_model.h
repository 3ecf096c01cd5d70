// Tuning on recorded ticks: a sweep over one or two keys, whose tried values stay as points, and gains of Eq. 1 that
// are better than the present ones, at the tick in view and over the chosen ticks.
#pragma once

#include "core/lab/gains/gain_advice.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/session/gain_search.h"
#include "workbench/sweep/plan.h"
#include "workbench/sweep/preset_job.h"

#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace tangent {

class TuningModel {
 public:
  TuningModel(const AppOptions& options, PresetModel& presets, TimeModel& time, MessageLog& messages);

  void update();  ///< once a frame: takes in what the workers finished

  // Sweep.
  struct Axis {
    const PresetKey* key = nullptr;  ///< null: no second key
    double from = 0.0, to = 0.0;     ///< SI
    std::size_t count = 13;
    bool operator==(const Axis&) const = default;
  };
  const std::array<Axis, 2>& axes() const { return axes_; }
  /// Another key takes its slider's range and forgets the points.
  void set_key(std::size_t axis, const PresetKey* key);
  void set_range(std::size_t axis, double from, double to);
  void set_count(std::size_t axis, std::size_t count);
  /// Keys that the method reads and that take numbers.
  std::vector<const PresetKey*> keys_to_sweep() const;
  /// Over the chosen ticks, coarse first; points of the same ticks and other values stay.
  void start_sweep();
  void cancel_sweep();
  bool waits() const { return waits_ != Waits::none; }  ///< for ticks of a recording that are being read
  const sweep::PresetJob& sweep() const { return sweep_; }
  void clear_points() { points_.clear(); }
  void start_heat_map();  ///< as start_sweep, of two keys: G_k and G_d where there is no second one

  struct Point {
    std::vector<double> values;  ///< one an axis
    sweep::CellNumbers numbers;
    bool by_hand = false;  ///< tried by dragging a value while paused
  };
  /// Ticks of it without a contact.
  static std::uint64_t failures(const Point& point) { return point.numbers.unconverged + point.numbers.facing; }
  /// What the colours of two keys show.
  enum class Shows : std::uint8_t { mean, p99, failures };
  static constexpr std::array<std::string_view, 3> kShows{"mean", "p99", "failures"};
  Shows shows = Shows::mean;
  /// Of an axis, as it was swept last.
  const std::vector<double>& grid(std::size_t axis) const { return grid_[axis]; }
  /// What theory names for the key of an axis (tune_question.h).
  std::optional<double> theory(std::size_t axis) const;
  /// By value, each value once.
  const std::vector<Point>& points() const { return points_; }
  const TickRange& points_range() const { return points_range_; }
  bool outdated() const;          ///< another value than the swept ones has changed since
  void try_point(std::size_t i);  ///< the preset takes its values

  // Gains of Eq. 1.
  /// At the tick in view; while time runs only the rule of thumb. Empty: no contact on a face there.
  std::optional<GainAdvice> advice_here();
  void search_gains();  ///< over the chosen ticks, in the background
  GainSearch& search() { return search_; }
  /// Of the last search while it holds: same ticks if some are selected, and same other values. Null: none.
  std::shared_ptr<const GainSearchResult> found() const;
  void set_gains(const Gains& gains);

 private:
  std::optional<sweep::Ground> ground_over(const TickRange& range) const;
  Preset preset_at(const std::vector<double>& values) const;
  void add(Point point);
  void take_by_hand();

  PresetModel& presets_;
  TimeModel& time_;
  MessageLog& messages_;
  const bool deterministic_;
  std::array<Axis, 2> axes_;
  sweep::PresetJob sweep_, by_hand_;
  std::optional<sweep::Ground> ground_;  ///< of the points
  std::array<std::vector<double>, 2> grid_;
  std::vector<std::vector<double>> planned_;  ///< values, in the order of the job
  std::vector<double> by_hand_values_;
  std::vector<Point> points_;
  TickRange points_range_;
  Preset points_base_;
  enum class Waits : std::uint8_t { none, sweep, search };
  Waits waits_ = Waits::none;
  bool ticks_are_there(Waits otherwise);
  std::shared_ptr<const PresetsCompared> seen_;
  GainSearch search_;
  std::optional<TickRange> searched_selection_;
  struct AdviceFor {
    std::uint64_t tick = 0;
    double t_s = 0.0, u = 0.0, v = 0.0;
    std::uint32_t triangle = kNone;
    const ContactScene* scene = nullptr;
    SolverSettings solver;
    Finger finger;
    bool walk = false;
    bool operator==(const AdviceFor&) const = default;
  };
  std::optional<AdviceFor> advised_for_;
  GainAdvice advice_;
};

}  // namespace tangent
