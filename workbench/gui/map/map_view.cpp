#include "workbench/gui/map/map_view.h"

#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent {
namespace {

constexpr std::size_t kSolvePlaces = 60'000, kShapePlaces = 250'000, kTouchPlaces = 60'000;  // at most, on small meshes
constexpr double kPatience_s = 0.3;             // a changed preset must be stable for this long
constexpr double kCopyEvery_s = 0.25;           // while values come in
constexpr std::size_t kStatisticsOf = 400'000;  // number of values used for percentiles
constexpr std::size_t kWorstShown = 8, kWorstTried = 4'000;
constexpr double kWorstApart = 0.05;  // of the mesh's diagonal
constexpr double kMostDecades = 6.0;  // of an automatic logarithmic range

std::size_t places_budget(MapGroup group) {
  switch (group) {
    case MapGroup::solve:
      return kSolvePlaces;
    case MapGroup::touch:
      return kTouchPlaces;
    default:
      return kShapePlaces;
  }
}

double nth(std::vector<float>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

}  // namespace

std::optional<double> MapView::limit() const {
  switch (quantity) {
    case MapQuantity::touch_radius:
      return 1.0;
    case MapQuantity::gain_margin:
      return 0.0;
    case MapQuantity::facet_angle:
      return felt_angle_rad_;
    default:
      return std::nullopt;
  }
}

void MapView::set_felt_angle(double rad) {
  if (rad == felt_angle_rad_) return;
  felt_angle_rad_ = rad;
  if (quantity == MapQuantity::facet_angle && values_of_ == quantity) refresh_range();
}

void MapView::set_quantity(MapQuantity q) {
  if (q == quantity) return;
  quantity = q;
  logarithmic_ = info_of(q).logarithmic;
  automatic_range_ = true;
  cancelled_ = false;
}

void MapView::set_logarithmic(bool yes) {
  logarithmic_ = yes;
  if (yes && low_ <= 0.0) automatic_range_ = true;
  refresh_range();
}

void MapView::set_range(double low, double high) {
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high) || (logarithmic_ && low <= 0.0)) return;
  automatic_range_ = false;
  low_ = low;
  high_ = high;
  refresh_histogram();
}

void MapView::set_automatic_range() {
  automatic_range_ = true;
  refresh_range();
}

MapView::Inputs MapView::inputs_for(MapGroup wanted, const std::shared_ptr<const ContactScene>& scene,
                                    const Preset& preset) const {
  Inputs in{scene.get(), preset.solver, preset.finger, options};
  in.options.level = map_level_within(places_budget(wanted), scene->mesh().usable_triangle_count());
  if (wanted == MapGroup::touch) {  // of all solver settings only the form of the normals matters
    in.solver = {};
    in.solver.normal_form = preset.solver.normal_form;
  }
  return in;
}

void MapView::update(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, double now_s, bool hold,
                     bool at_once) {
  if (!on || scene == nullptr) {
    for (Group& g : groups_) {
      if (g.job.running()) g.job.cancel();
    }
    return;
  }
  Group& g = group();
  for (Group& other : groups_) {
    if (&other != &g && other.job.running()) other.job.cancel();
  }
  const Inputs wanted = inputs_for(group_of(quantity), scene, preset);
  if (!seen_ || !(*seen_ == wanted)) {
    seen_ = wanted;
    seen_at_s_ = now_s;
  }
  const bool fits = g.inputs == wanted && g.job.places() > 0;
  const bool broken_off = fits && !g.job.running() && g.job.done_places() < g.job.places();
  const bool first = g.inputs.scene != scene.get() || g.job.places() == 0;
  const bool ripe = at_once || first || (!hold && now_s - seen_at_s_ >= kPatience_s);
  if (wanted_again_ || (!cancelled_ && (!fits || broken_off) && ripe && (follow_changes || first || broken_off))) {
    wanted_again_ = cancelled_ = false;
    g.inputs = wanted;
    g.scene = scene;
    g.job.start(scene, preset, wanted.options, group_of(quantity));
    values_of_.reset();
    if (at_once) g.job.wait();
  }
  if (g.inputs.scene != scene.get()) return;
  stale_ = !(g.inputs == wanted);
  take_values(now_s, at_once);
}

void MapView::cancel() {
  group().job.cancel();
  cancelled_ = true;
}

bool MapView::running() const { return on && group().job.running(); }
double MapView::progress() const { return group().job.progress(); }

void MapView::take_values(double now_s, bool at_once) {
  const SurfaceMapJob& job = group().job;
  const std::size_t done = job.done_places();
  const bool same = values_of_ == quantity;
  if (same && done == values_done_) return;
  const double wait = job.places() > 1'000'000 ? 4.0 * kCopyEvery_s : kCopyEvery_s;
  if (same && !at_once && done < job.places() && now_s - copied_at_s_ < wait) return;
  job.copy_values(quantity, values_);
  values_of_ = quantity;
  values_done_ = done;
  copied_at_s_ = now_s;
  ++version_;
  if (indexed_ != group().scene.get()) {
    indexed_ = group().scene.get();
    index_of_.clear();
    const ContactMesh& mesh = indexed_->mesh();
    if (mesh.usable_triangle_count() != mesh.triangle_count()) {
      index_of_.assign(mesh.triangle_count(), kNone);
      for (std::uint32_t i = 0; i < job.triangles().size(); ++i) index_of_[job.triangles()[i]] = i;
    }
  }
  refresh_range();
  // Sorting millions of values takes longer than a frame: only once, at the end.
  if (values_.size() <= kStatisticsOf || done == job.places())
    refresh_worst();
  else
    worst_.clear();
}

void MapView::refresh_range() {
  MapStatistics& s = statistics_;
  s = {};
  std::vector<float> some;
  const std::size_t stride = 1 + values_.size() / kStatisticsOf;
  double sum = 0.0;
  std::size_t beyond = 0;
  s.min = 1e300, s.max = -1e300;
  const auto wrong_side_of = limit();
  const bool low_is_worse = info_of(quantity).low_is_worse;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const float value = values_[i];
    if (!is_map_value(value)) {
      ++(value == kMapNoValue ? s.none : s.pending);
      continue;
    }
    const double v = static_cast<double>(value);
    ++s.values;
    sum += v;
    s.min = std::min(s.min, v), s.max = std::max(s.max, v);
    if (wrong_side_of && (low_is_worse ? v < *wrong_side_of : v > *wrong_side_of)) ++beyond;
    if (i % stride == 0) some.push_back(value);
  }
  if (s.values == 0 || some.empty()) {
    s.min = s.max = 0.0;
    return;
  }
  s.mean = sum / static_cast<double>(s.values);
  s.share_beyond_limit = static_cast<double>(beyond) / static_cast<double>(s.values);
  s.p99 = nth(some, 0.99);
  usual_low_ = nth(some, 0.005), usual_high_ = nth(some, 0.995);
  if (automatic_range_) {
    const MapQuantityInfo& info = info_of(quantity);
    const bool counts = group_of(quantity) == MapGroup::solve && quantity != MapQuantity::error;
    low_ = counts ? s.min : usual_low_;
    high_ = counts ? s.max : usual_high_;
    if (info.about_zero) {
      high_ = std::max(std::abs(low_), std::abs(high_));
      low_ = -high_;
    }
    if (logarithmic_) {
      high_ = std::max(high_, 1e-30);
      low_ = std::max(low_, high_ * std::pow(10.0, -kMostDecades));
      if (!(low_ < high_)) low_ = 0.1 * high_;
    }
    if (!(high_ - low_ > 1e-9 * std::abs(high_))) {
      low_ = counts ? std::max(0.0, low_ - 1.0) : low_ - 0.5 * std::max(std::abs(low_), 1e-12);
      high_ = counts ? low_ + 1.0 : high_ + 0.5 * std::max(std::abs(high_), 1e-12);
    }
  }
  refresh_histogram();
}

void MapView::refresh_histogram() {
  MapStatistics& s = statistics_;
  s.bins.fill(0);
  const auto shown = paint();
  if (!shown) return;
  const std::size_t stride = 1 + values_.size() / kStatisticsOf;
  for (std::size_t i = 0; i < values_.size(); i += stride) {
    if (!is_map_value(values_[i])) continue;
    const double share = map_share(*shown, static_cast<double>(values_[i]));
    if (std::isnan(share)) continue;  // the range is a single value
    const auto bin =
        static_cast<std::size_t>(std::clamp(share * MapStatistics::kBins, 0.0, MapStatistics::kBins - 1.0));
    ++s.bins[bin];
  }
  s.fullest = *std::max_element(s.bins.begin(), s.bins.end());
}

void MapView::refresh_worst() {
  worst_.clear();
  const MapQuantityInfo& info = info_of(quantity);
  const auto worse = [&](std::uint32_t a, std::uint32_t b) {
    const float x = values_[a], y = values_[b];
    return x != y ? (info.low_is_worse ? x < y : x > y) : a < b;
  };
  // Places no worse than the mean are not listed.
  const auto mean = static_cast<float>(statistics_.mean);
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < values_.size(); ++i) {
    if (is_map_value(values_[i]) && (info.low_is_worse ? values_[i] < mean : values_[i] > mean)) order.push_back(i);
  }
  const std::size_t tried = std::min(kWorstTried, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(tried), order.end(), worse);
  const ContactMesh& mesh = group().scene->mesh();
  const unsigned level = group().job.options().level, parts = level * level;
  const double apart = kWorstApart * glm::length(mesh.bounds().size());
  for (std::size_t i = 0; i < tried && worst_.size() < kWorstShown; ++i) {
    MapPlace place;
    place.triangle = group().job.triangles()[order[i] / parts];
    place.part = order[i] % parts;
    place.value = static_cast<double>(values_[order[i]]);
    const PnPatch patch = make_patch(mesh, place.triangle, group().inputs.solver.normal_form);
    const Vec2 uv = map_part_centroid(level, place.part);
    place.u = uv.x, place.v = uv.y;
    place.point_world = mesh.origin() + evaluate_point(patch, uv.x, uv.y);
    place.normal = evaluate_normal(patch, uv.x, uv.y);
    const bool near_another = std::any_of(worst_.begin(), worst_.end(), [&](const MapPlace& other) {
      return glm::length(other.point_world - place.point_world) < apart;
    });
    if (!near_another) worst_.push_back(place);
  }
}

std::optional<MapPaint> MapView::paint() const {
  if (!on || values_of_ != quantity || values_.empty()) return std::nullopt;
  MapPaint out;
  out.values = values_;
  out.version = version_;
  out.level = group().job.options().level;
  out.low = low_;
  out.high = high_;
  out.logarithmic = logarithmic_;
  const MapQuantityInfo& info = info_of(quantity);
  out.colours = info.about_zero ? ColourMap::balance : colours;
  // Worse values are brighter; in diverging maps the warm side is worse.
  out.reversed = info.low_is_worse;
  return out;
}

std::optional<double> MapView::value_at(std::uint32_t triangle, double u, double v) const {
  if (!on || values_of_ != quantity || group().scene == nullptr || triangle >= group().scene->mesh().triangle_count())
    return std::nullopt;
  const std::size_t index = index_of_.empty() ? triangle : index_of_[triangle];
  if (index == kNone) return std::nullopt;
  const unsigned level = group().job.options().level;
  const std::size_t at = index * level * level + map_part_at(level, u, v);
  if (at >= values_.size() || !is_map_value(values_[at])) return std::nullopt;
  return static_cast<double>(values_[at]);
}

}  // namespace tangent
