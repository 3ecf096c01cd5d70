// Parts of the figures' drawings as tables of points, mm.
#pragma once

#include "core/planar/curve.h"
#include "workbench/session/figure_table.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace tangent::drawn {

inline std::vector<double> mm(const Vec2& v) { return {1e3 * v.x, 1e3 * v.y}; }
inline Vec2 flat(const Vec3& v) { return {v.x, v.y}; }

inline FigureTable points() { return {{"x_mm", "y_mm"}, {}}; }

inline FigureTable polygon_table(const PlanarPolygon& polygon) {
  FigureTable table = points();
  for (const Vec2& v : polygon.vertices) table.rows.push_back(mm(v));
  if (polygon.closed) table.rows.push_back(mm(polygon.vertices.front()));
  return table;
}

inline FigureTable circle_table(const Vec2& centre, double radius) {
  FigureTable table = points();
  for (int i = 0; i <= 180; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 180.0;
    table.rows.push_back(mm(centre + radius * Vec2(std::cos(a), std::sin(a))));
  }
  return table;
}

/// The rendered curve, patch by patch.
inline FigureTable curve_table(const PlanarCurve& curve) {
  FigureTable table = points();
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i)
    for (int k = 0; k <= 40; ++k)
      table.rows.push_back(mm(curve.origin() + curve.sample(i, LocalCentre::bisectors, k / 40.0).place));
  return table;
}

/// A patch's region: its control polygon and the curve back.
inline void add_patch_region(const PlanarCurve& curve, std::uint32_t i, FigureTable& table) {
  const CurvePatch& p = curve.patch(i);
  for (const Vec2& v : {p.first, p.vertex, p.last}) table.rows.push_back(mm(curve.origin() + v));
  for (int k = 40; k >= 0; --k)
    table.rows.push_back(mm(curve.origin() + curve.sample(i, LocalCentre::bisectors, k / 40.0).place));
  table.part();
}

inline constexpr const char* kPicture = "set size ratio -1\nset grid\nset xlabel 'x (mm)'\nset ylabel 'y (mm)'\n";

}  // namespace tangent::drawn
