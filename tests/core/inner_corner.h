// Two walls that meet in an inner edge.
#pragma once

#include "tests/core/scenes.h"

namespace tangent::test {

/// Two walls of 50 mm that meet in a crease along y, `opening` between them: the first faces up.
struct InnerCorner {
  double opening;
  Vec3 first{0.0, 0.0, 1.0}, second, along_second;  ///< normals, and from the crease along the second wall

  explicit InnerCorner(double angle)
      : opening(angle),
        second(std::sin(angle), 0.0, -std::cos(angle)),
        along_second(std::cos(angle), 0.0, std::sin(angle)) {}

  /// Of cells x cells squares a wall.
  ScenePtr scene(int cells = 1) const {
    PolygonMesh mesh;
    add_wall(mesh, Vec3(1.0, 0.0, 0.0), cells, false);
    add_wall(mesh, along_second, cells, true);
    return scene_of(mesh);
  }

  /// `depth` under the walls: along the first to the crease, round it, and on along the second, in steps of `step`.
  std::vector<Vec3> way_under(double depth, double step) const {
    std::vector<Vec3> way;
    for (double s = 0.01; s > 0.0; s -= step) way.push_back(Vec3(s, 0.0, 0.0) - depth * first);
    const double turn = 180.0 * kDegree - opening;
    for (double a = 0.0; a < turn; a += step / depth) way.push_back(-depth * Vec3(std::sin(a), 0.0, std::cos(a)));
    for (double s = 0.0; s < 0.01; s += step) way.push_back(s * along_second - depth * second);
    for (Vec3& at : way) at.y = 0.004;
    return way;
  }

 private:
  static void add_wall(PolygonMesh& mesh, const Vec3& along, int cells, bool turned) {
    const auto start = static_cast<std::uint32_t>(mesh.positions.size());
    const auto at = [&](int i, int j) { return start + static_cast<std::uint32_t>(i * (cells + 1) + j); };
    for (int i = 0; i <= cells; ++i)
      for (int j = 0; j <= cells; ++j)
        mesh.positions.push_back(0.05 * i / cells * along + Vec3(0.0, -0.03 + 0.06 * j / cells, 0.0));
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        mesh.add_face({a, turned ? d : b, c});
        mesh.add_face({a, c, turned ? b : d});
      }
  }
};

}  // namespace tangent::test
