// State of the map over the mesh: quantity, the preset it was computed for, the values so far with range, histogram and
// worst places, and the colours. No ImGui, no GL.
#pragma once

#include "workbench/gui/render/surface_paint.h"
#include "workbench/session/surface_map_job.h"
#include "workbench/session/unit_labels.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace tangent {

/// Unit in which a quantity's values are shown.
inline UnitLabel unit_of(MapQuantity quantity) { return shown_unit(info_of(quantity).unit, info_of(quantity).typical); }

struct MapPlace {
  std::uint32_t triangle = kNone;
  unsigned part = 0;
  double u = 0.0, v = 0.0;  ///< of the part's centroid
  double value = 0.0;
  Vec3 point_world{0.0};
  Vec3 normal{0.0, 0.0, 1.0};
};

struct MapStatistics {
  static constexpr std::size_t kBins = 64;
  std::size_t values = 0, none = 0, pending = 0;  ///< places with a value, without one, not computed yet
  double min = 0.0, max = 0.0, mean = 0.0, p99 = 0.0;
  double share_beyond_limit = 0.0;          ///< share of values on the wrong side of MapView::limit()
  std::array<std::uint32_t, kBins> bins{};  ///< over the colour bar's range; values outside are in the end bins
  std::uint32_t fullest = 0;
};

class MapView {
 public:
  // Set by the panel.
  bool on = false;
  MapQuantity quantity = MapQuantity::iterations_worst;
  ColourMap colours = ColourMap::tide;  ///< for quantities without a natural zero
  bool follow_changes = true;           ///< recompute when the preset changes
  MapOptions options;                   ///< the level follows from the mesh's size

  void set_quantity(MapQuantity q);
  bool logarithmic() const { return logarithmic_; }
  void set_logarithmic(bool yes);
  /// Ends of the colour bar; ignored unless low < high, and low > 0 if logarithmic.
  void set_range(double low, double high);
  void set_automatic_range();
  bool automatic_range() const { return automatic_range_; }
  /// The quantity's limit, marked on the colour bar: touch radius 1, gain margin 0, the facet angle that can be felt.
  /// Empty for quantities without one.
  std::optional<double> limit() const;
  /// Smallest angle between facets that a finger feels, rad; depends on the rendering condition.
  void set_felt_angle(double rad);
  double low() const { return low_; }
  double high() const { return high_; }

  /// Call once per frame: starts computations and takes in finished values. `hold`: a value is being dragged, wait.
  /// `at_once`: computes in this call.
  void update(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, double now_s, bool hold,
              bool at_once);
  void compute_again() { wanted_again_ = true; }
  void cancel();
  bool running() const;
  bool cancelled() const { return cancelled_; }
  double progress() const;
  bool stale() const { return stale_; }  ///< the values were computed for another preset

  /// The map for the renderer; empty when off or nothing was started.
  std::optional<MapPaint> paint() const;
  const MapStatistics& statistics() const { return statistics_; }
  /// The value shown at a place; empty where there is none yet.
  std::optional<double> value_at(std::uint32_t triangle, double u, double v) const;
  /// Up to eight places, worst first, at a distance from one another.
  const std::vector<MapPlace>& worst() const { return worst_; }

 private:
  /// Inputs that determine the values of a group.
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
  std::optional<Inputs> seen_;  ///< last requested inputs, and since when
  double seen_at_s_ = 0.0;
  bool wanted_again_ = false, cancelled_ = false, stale_ = false;
  bool automatic_range_ = true, logarithmic_ = false;
  double felt_angle_rad_ = 0.0;
  double low_ = 0.0, high_ = 1.0;
  double usual_low_ = 0.0, usual_high_ = 1.0;  ///< 0.5 and 99.5 percentile
  MapStatistics statistics_;
  std::vector<MapPlace> worst_;
  std::vector<std::uint32_t> index_of_;  ///< index among usable triangles; empty: the triangle's number
  const ContactScene* indexed_ = nullptr;
};

}  // namespace tangent
