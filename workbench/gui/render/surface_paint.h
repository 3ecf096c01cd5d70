// What can be laid on the mesh: a map's values as colours, a cut, and a choice of triangles. Plain data.
#pragma once

#include "workbench/gui/theme/colour_map.h"

#include "core/base/vec.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tangent {

/// Values of a map over the surface (core/lab/measure/surface_map.h), one for each part of each usable triangle.
struct MapPaint {
  std::span<const float> values;  ///< has to live as long as `version` is shown
  std::uint64_t version = 0;      ///< another one: the values are others
  unsigned level = 1;
  double low = 0.0, high = 1.0;  ///< values of the first and the last colour; low < high
  bool logarithmic = false;      ///< then both above 0
  ColourMap colours = ColourMap::tide;
  bool reversed = false;

  bool same_look(const MapPaint& o) const {
    return version == o.version && level == o.level && low == o.low && high == o.high && logarithmic == o.logarithmic &&
           colours == o.colours && reversed == o.reversed;
  }
};

/// Where the value is on the colour bar, not clamped.
double map_share(const MapPaint& paint, double value);
double map_value_at(const MapPaint& paint, double share);
Rgba map_colour(const MapPaint& paint, double value);

/// What lies on the side that `normal` points to is cut away. World.
struct SlicePlane {
  Vec3 normal{1.0, 0.0, 0.0};  ///< unit
  double offset_m = 0.0;       ///< points on it: dot(normal, p) = offset
  bool operator==(const SlicePlane&) const = default;
  bool cuts(const Vec3& p) const { return glm::dot(normal, p) > offset_m; }
};

/// Triangles that alone are drawn.
struct Isolation {
  std::vector<std::uint8_t> kept;  ///< by triangle number: 1 stays
  std::uint64_t version = 0;
};

}  // namespace tangent
