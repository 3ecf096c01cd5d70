// The map over the mesh as the window has it: which quantity, computed for which preset, the values so far with their
// range, histogram and worst places, and how they are coloured. No ImGui, no GL.
#pragma once

#include "workbench/gui/render/surface_paint.h"
#include "workbench/session/surface_map_job.h"
#include "workbench/session/unit_labels.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace tangent {

/// In which a quantity's values are shown.
inline UnitLabel unit_of(MapQuantity quantity) { return shown_unit(info_of(quantity).unit, info_of(quantity).typical); }

struct MapPlace {
  std::uint32_t triangle = kNone;
  unsigned part = 0;
  double value = 0.0;
  Vec3 point_world{0.0};
  Vec3 normal{0.0, 0.0, 1.0};
};

struct MapStatistics {
  static constexpr std::size_t kBins = 64;
  std::size_t values = 0, none = 0, pending = 0;  ///< places with a value, without one, not computed yet
  double min = 0.0, max = 0.0, mean = 0.0, p99 = 0.0;
  double share_beyond_limit = 0.0;          ///< share of values on the wrong side of MapView::limit()
  std::array<std::uint32_t, kBins> bins{};  ///< over the colour bar's range; what lies outside is in the end bins
  std::uint32_t fullest = 0;
};

class MapView {
 public:
  // What the panel sets.
  bool on = false;
  MapQuantity quantity = MapQuantity::iterations_worst;
  ColourMap colours = ColourMap::tide;  ///< of quantities that are not about zero
  bool follow_changes = true;           ///< computes anew when the preset changes
  MapOptions options;                   ///< the level is chosen by the mesh's size

  void set_quantity(MapQuantity q);
  bool logarithmic() const { return logarithmic_; }
  void set_logarithmic(bool yes);
  /// The colour bar's ends; low < high, above 0 if logarithmic, else they are left alone.
  void set_range(double low, double high);
  void set_automatic_range();
  bool automatic_range() const { return automatic_range_; }
  /// Marked on the colour bar, wherever its ends are: touch radius 1, gain margin 0, the facet angle that can be felt.
  /// None for the others.
  std::optional<double> limit() const;
  /// Angle between facets from which on a finger feels them, rad; it depends on the rendering condition.
  void set_felt_angle(double rad);
  double low() const { return low_; }
  double high() const { return high_; }

  /// Once a frame. Starts what has to be computed and takes in what is done. `hold`: something is being dragged, wait.
  /// `at_once`: computes here and now.
  void update(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, double now_s, bool hold,
              bool at_once);
  void compute_again() { wanted_again_ = true; }
  void cancel();
  bool running() const;
  bool cancelled() const { return cancelled_; }
  double progress() const;
  bool stale() const { return stale_; }  ///< the values are of another preset than the present one

  /// To lay on the mesh; none when off or nothing was started.
  std::optional<MapPaint> paint() const;
  const MapStatistics& statistics() const { return statistics_; }
  /// The value shown at a place; none where there is none yet.
  std::optional<double> value_at(std::uint32_t triangle, double u, double v) const;
  /// Up to eight, worst first, apart from one another.
  const std::vector<MapPlace>& worst() const { return worst_; }

 private:
  /// What the values of a group depend on.
  struct Inputs {
    const ContactScene* scene = nullptr;
    SolverSettings solver;
    Finger finger;
    MapOptions options;
    bool operator==(const Inputs&) const = default;
  };
  struct Group {
    SurfaceMapJob job;
    Inputs inputs;
    std::shared_ptr<const ContactScene> scene;
  };
  Inputs inputs_for(MapGroup group, const std::shared_ptr<const ContactScene>& scene, const Preset& preset) const;
  Group& group() { return groups_[static_cast<std::size_t>(group_of(quantity))]; }
  const Group& group() const { return groups_[static_cast<std::size_t>(group_of(quantity))]; }
  void take_values(double now_s, bool at_once);
  void refresh_range();
  void refresh_histogram();
  void refresh_worst();

  std::array<Group, kMapGroupCount> groups_;
  std::vector<float> values_;
  std::optional<MapQuantity> values_of_;
  std::size_t values_done_ = 0;
  std::uint64_t version_ = 0;
  double copied_at_s_ = -1e9;
  std::optional<Inputs> seen_;  ///< last wanted inputs, and since when
  double seen_at_s_ = 0.0;
  bool wanted_again_ = false, cancelled_ = false, stale_ = false;
  bool automatic_range_ = true, logarithmic_ = false;
  double felt_angle_rad_ = 0.0;
  double low_ = 0.0, high_ = 1.0;
  double usual_low_ = 0.0, usual_high_ = 1.0;  ///< 0.5 and 99.5 percentile
  MapStatistics statistics_;
  std::vector<MapPlace> worst_;
  std::vector<std::uint32_t> index_of_;  ///< usable index of a triangle; empty: its own number
  const ContactScene* indexed_ = nullptr;
};

}  // namespace tangent
