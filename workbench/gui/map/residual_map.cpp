#include "workbench/gui/map/residual_map.h"

#include "core/finger/plane_contact.h"
#include "core/planar/polygon.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr double kLeastResidual = 1e-12;  ///< m: below rounding error on any hand-sized body

/// The third corner of a triangle to the left of the flat edge from -> to, from the lengths of its other two edges.
Vec2 third_corner(const Vec2& from, const Vec2& to, double from_third, double to_third) {
  const Vec2 edge = to - from;
  const double length = glm::length(edge);
  const double along = (from_third * from_third - to_third * to_third + length * length) / (2.0 * length);
  const double up = std::sqrt(std::max(0.0, from_third * from_third - along * along));
  return from + (along * edge + up * Vec2(-edge.y, edge.x)) / length;
}

}  // namespace

ResidualMap::ResidualMap(std::shared_ptr<const ContactScene> scene, std::uint32_t triangle, const Finger& finger,
                         NormalForm form, const TickInput& input)
    : scene_(std::move(scene)),
      finger_(finger),
      local_{input.finger.position - scene_->mesh().origin(), input.finger.orientation} {
  const ContactMesh& mesh = scene_->mesh();
  const auto length = [&](std::uint32_t t, std::uint32_t a, std::uint32_t b) {
    return glm::length(mesh.position(t, b) - mesh.position(t, a));
  };
  FlatTriangle base{triangle, {}};
  base.corners[1] = {length(triangle, 0, 1), 0.0};
  base.corners[2] = third_corner(base.corners[0], base.corners[1], length(triangle, 0, 2), length(triangle, 1, 2));
  triangles_.push_back(base);
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    const EdgeLink link = mesh.across(triangle, edge);
    if (link.triangle == kNone || link.triangle == triangle) continue;
    // The neighbour's edge may run either way (inconsistent orientation): corners are matched by vertex.
    const std::uint32_t a = link.edge, b = (link.edge + 1) % 3, c = (link.edge + 2) % 3;
    const bool reversed = mesh.vertex(link.triangle, a) == mesh.vertex(triangle, (edge + 1) % 3);
    const Vec2& from = base.corners[(edge + 1) % 3];
    const Vec2& to = base.corners[edge];
    FlatTriangle next{link.triangle, {}};
    next.corners[reversed ? a : b] = from;
    next.corners[reversed ? b : a] = to;
    next.corners[c] =
        third_corner(from, to, length(link.triangle, reversed ? a : b, c), length(link.triangle, reversed ? b : a, c));
    triangles_.push_back(next);
  }
  for (const FlatTriangle& t : triangles_) patches_.push_back(make_patch(mesh, t.triangle, form));
}

std::optional<Vec2> ResidualMap::place(std::uint32_t triangle, double u, double v) const {
  for (const FlatTriangle& t : triangles_) {
    if (t.triangle == triangle) return (1.0 - u - v) * t.corners[0] + u * t.corners[1] + v * t.corners[2];
  }
  return std::nullopt;
}

ResidualMap::Located ResidualMap::locate(const Vec2& at) const {
  Located best;
  best.outside = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& c = triangles_[i].corners;
    const double area = cross(c[1] - c[0], c[2] - c[0]);
    if (area == 0.0) continue;
    const double u = cross(at - c[0], c[2] - c[0]) / area, v = cross(c[1] - c[0], at - c[0]) / area;
    const double outside = std::max(0.0, -std::min({u, v, 1.0 - u - v}));
    if (outside < best.outside) best = {i, u, v, outside};
    if (outside == 0.0) break;
  }
  return best;
}

double ResidualMap::residual(const Vec2& at) const {
  const Located place = locate(at);
  const PnPatch& patch = patches_[place.index];
  return contact_on_plane(finger_, local_, evaluate_point(patch, place.u, place.v),
                          evaluate_normal(patch, place.u, place.v))
      .error_m;
}

bool ResidualMap::inside(const Vec2& at) const { return locate(at).outside == 0.0; }

FlatView ResidualMap::whole_view() const {
  const auto& c = triangles_[0].corners;
  const Vec2 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
  const Vec2 room = 0.18 * (high - low);
  return {low - room, high + room};
}

FlatView ResidualMap::path_view(std::span<const IterationRecord> path) const {
  Vec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const IterationRecord& it : path) {
    const auto p = place(it.triangle, it.u, it.v);
    if (!p) continue;
    low = glm::min(low, *p);
    high = glm::max(high, *p);
  }
  if (!(high.x >= low.x)) return whole_view();
  const FlatView whole = whole_view();
  const double least = 1e-4 * std::max(whole.size().x, whole.size().y);
  const double half = std::max(0.5 * std::max(high.x - low.x, high.y - low.y), least) * 1.35;
  const Vec2 middle = 0.5 * (low + high);
  return {middle - Vec2(half), middle + Vec2(half)};
}

void ResidualMap::sample(const FlatView& view, int columns, int rows) {
  view_ = view;
  columns_ = columns;
  rows_ = rows;
  log_.clear();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 share(static_cast<double>(column) / (columns - 1), static_cast<double>(row) / (rows - 1));
      log_.push_back(
          static_cast<float>(std::log10(std::max(residual(view.min + share * view.size()), kLeastResidual))));
    }
  }
}

// Marching triangles: each grid cell is two triangles, and a level cuts a triangle in at most one segment.
std::vector<ContourSegment> ResidualMap::contours() const {
  std::vector<ContourSegment> out;
  if (columns_ < 2 || rows_ < 2) return out;
  const auto at = [&](int column, int row) {
    return view_.min +
           Vec2(static_cast<double>(column) / (columns_ - 1), static_cast<double>(row) / (rows_ - 1)) * view_.size();
  };
  const auto value = [&](int column, int row) {
    return 2.0 * static_cast<double>(log_[static_cast<std::size_t>(row * columns_ + column)]);
  };
  const auto cut = [&](const std::array<Vec2, 3>& p, const std::array<double, 3>& f) {
    const auto [least, most] = std::minmax({f[0], f[1], f[2]});
    for (int level = static_cast<int>(std::ceil(least)); static_cast<double>(level) < most; ++level) {
      Vec2 ends[2];
      int found = 0;
      for (std::size_t k = 0; k < 3 && found < 2; ++k) {
        const double a = f[k] - level, b = f[(k + 1) % 3] - level;
        if ((a < 0.0) == (b < 0.0)) continue;
        ends[found++] = glm::mix(p[k], p[(k + 1) % 3], a / (a - b));
      }
      if (found == 2) out.push_back({ends[0], ends[1], level});
    }
  };
  for (int row = 0; row + 1 < rows_; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      const Vec2 a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1), d = at(column, row + 1);
      const double fa = value(column, row), fb = value(column + 1, row), fc = value(column + 1, row + 1),
                   fd = value(column, row + 1);
      cut({a, b, c}, {fa, fb, fc});
      cut({a, c, d}, {fa, fc, fd});
    }
  }
  return out;
}

}  // namespace tangent
