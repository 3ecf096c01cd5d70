// What can be shown on the mesh: a map's values as colours, a slice plane, an isolated set of triangles. Plain data.
#pragma once

#include "workbench/gui/theme/colour_map.h"

#include "core/base/vec.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tangent {

/// Values of a map over the surface (core/lab/measure/surface_map.h), one per part of each usable triangle.
struct MapPaint {
  std::span<const float> values;  ///< must stay valid while `version` is shown
  std::uint64_t version = 0;      ///< changes with the values
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

/// Position of a value on the colour bar, 0 to 1 in range, not clamped.
double map_share(const MapPaint& paint, double value);
double map_value_at(const MapPaint& paint, double share);
Rgba map_colour(const MapPaint& paint, double value);

/// Hides the side to which `normal` points. World frame.
struct SlicePlane {
  Vec3 normal{1.0, 0.0, 0.0};  ///< unit
  double offset_m = 0.0;       ///< points on it: dot(normal, p) = offset
  bool operator==(const SlicePlane&) const = default;
  bool cuts(const Vec3& p) const { return glm::dot(normal, p) > offset_m; }
};

/// Restricts drawing to some triangles.
struct Isolation {
  std::vector<std::uint8_t> kept;  ///< by triangle number: 1 is drawn
  std::uint64_t version = 0;
};

}  // namespace tangent
