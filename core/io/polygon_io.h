// Polygons from files: a CSV with columns `x_m` and `y_m`, by name, or an OBJ with one polyline.
#pragma once

#include "core/planar/polygon.h"

#include <filesystem>
#include <string_view>

namespace tangent {

/// Whether a file contains a 2D scene: any .csv, and an .obj with a line element and no face. False if unreadable.
bool is_planar_file(const std::filesystem::path& path);

/// CSV: metres, one vertex per line. OBJ: coordinates times `metres_per_unit`; one `l` element or several connected
/// ones; z must be the same for all. A comment "# exact arc: X Y RADIUS HALF_ANGLE_RAD RUN_OUT" makes it that arc,
/// which no polyline is; other programs read the polyline. Closed if the last vertex repeats the first. Checked by
/// check_polygon. Errors name file and line.
Result<PlanarPolygon> read_polygon(const std::filesystem::path& path, double metres_per_unit);

Result<PlanarPolygon> parse_polygon_csv(std::string_view text, const std::string& name);
Result<PlanarPolygon> parse_polygon_obj(std::string_view text, const std::string& name, double metres_per_unit);

/// CSV, or, where the name ends in .obj, an OBJ with one line element, in units of `metres_per_unit`. A closed polygon
/// repeats its first vertex. Fails on an exact arc as CSV. Atomic.
Status write_polygon(const PlanarPolygon& polygon, const std::filesystem::path& path, double metres_per_unit = 1.0);

}  // namespace tangent
