// Hard because of their shape: too narrow for the finger, with edges, rims or slivers, or without an inside.
#include "core/base/units.h"
#include "core/base/vec.h"
#include "core/lab/objects/circle_points.h"
#include "core/lab/objects/generators_hard.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

constexpr double kHalfSize = 0.040;      // m
constexpr double kFingerRadius = 0.020;  // m, that the shapes are made for

/// Grid of (columns + 1) x (rows + 1) points, number j (columns + 1) + i, into triangles.
void add_grid(PolygonMesh& mesh, std::uint32_t first, int columns, int rows, bool turned = false) {
  const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (turned) {
        mesh.add_face({a, c, b});
        mesh.add_face({a, d, c});
      } else {
        mesh.add_face({a, b, c});
        mesh.add_face({a, c, d});
      }
    }
  }
}

/// Points from `from` to `to` radians on a circle in the x-z plane; angles count from -z towards +x.
void add_arc(std::vector<SheetLine>& profile, double cx, double cz, double r, double from, double to, int steps) {
  for (int i = profile.empty() ? 0 : 1; i <= steps; ++i) {
    const double a = from + (to - from) * i / steps;
    profile.push_back({cx + r * std::sin(a), cz - r * std::cos(a)});
  }
}

/// Rows of latitude from `from` (0: pole at -z) to `to` degrees, around z, outward; poles are single points.
PolygonMesh latitude_rows(double radius, int slices, int rows, double from_deg, double to_deg, bool outward) {
  PolygonMesh mesh;
  std::vector<std::uint32_t> before, row;
  for (int j = 0; j <= rows; ++j) {
    const double polar = (from_deg + (to_deg - from_deg) * j / rows) * kDegree;
    const bool pole = (j == 0 && from_deg == 0.0) || (j == rows && to_deg == 180.0);
    row.clear();
    for (int i = 0; i < (pole ? 1 : slices); ++i) {
      const Vec2 circle = circle_point(i, slices);
      const double across = pole ? 0.0 : std::sin(polar);
      mesh.positions.push_back(radius * Vec3(across * circle.x, across * circle.y, -std::cos(polar)));
      row.push_back(static_cast<std::uint32_t>(mesh.positions.size() - 1));
    }
    for (std::size_t i = 0; j > 0 && i < static_cast<std::size_t>(slices); ++i) {
      const auto of = [&](const std::vector<std::uint32_t>& r, std::size_t k) { return r[k % r.size()]; };
      const std::array<std::uint32_t, 4> q{of(before, i), of(before, i + 1), of(row, i + 1), of(row, i)};
      const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a != b && b != c && c != a) outward ? mesh.add_face({a, b, c}) : mesh.add_face({a, c, b});
      };
      add(q[0], q[1], q[2]);
      add(q[0], q[2], q[3]);
    }
    before = row;
  }
  return mesh;
}

}  // namespace

PolygonMesh swept_sheet(const std::vector<SheetLine>& profile, int rows) {
  PolygonMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    const double y = kHalfSize * static_cast<double>(2 * j - rows) / rows;
    for (const SheetLine& p : profile) mesh.positions.emplace_back(p.x_m, y, p.z_m);
  }
  add_grid(mesh, 0, static_cast<int>(profile.size()) - 1, rows);
  return mesh;
}

// A trough of radius 22 mm between shoulders of 10 mm. At h = 19 mm the Newton matrix keeps 1 - 19/22 = 14 % of
// its size across the trough.
PolygonMesh make_trough() {
  constexpr double kRadius = 0.022, kShoulder = 0.010, kOpening = 50.0 * kDegree;
  std::vector<SheetLine> profile;
  const double x = (kRadius + kShoulder) * std::sin(kOpening), z = -(kRadius + kShoulder) * std::cos(kOpening);
  add_arc(profile, -x, z, kShoulder, 180.0 * kDegree, 180.0 * kDegree - kOpening, 6);
  add_arc(profile, 0.0, 0.0, kRadius, -kOpening, kOpening, 32);
  add_arc(profile, x, z, kShoulder, 180.0 * kDegree + kOpening, 180.0 * kDegree, 6);
  return swept_sheet(profile, 20);
}

PolygonMesh make_exact_pipe() {
  std::vector<SheetLine> profile;
  add_arc(profile, 0.0, 0.0, kFingerRadius, -80.0 * kDegree, 80.0 * kDegree, 48);
  return swept_sheet(profile, 20);
}

PolygonMesh make_dimple() {
  constexpr double kDepth = 0.005, kWidth = 0.006;
  return height_sheet(
      kHalfSize, 64, [](double x, double y) { return -kDepth * std::exp(-(x * x + y * y) / (2.0 * kWidth * kWidth)); });
}

PolygonMesh make_two_plates() {
  constexpr double kHalfGap = 0.0195;  // 1 mm less between them than a 20 mm finger is thick
  constexpr int kCells = 12;
  PolygonMesh mesh = height_sheet(0.030, kCells, [](double, double) { return -kHalfGap; });
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < first; ++i)
    mesh.positions.push_back({mesh.positions[i].x, mesh.positions[i].y, kHalfGap});
  add_grid(mesh, first, kCells, kCells, true);
  return mesh;
}

PolygonMesh make_thin_fin() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? 0.030 : -0.030, i & 2 ? 0.030 : -0.030, i & 4 ? 0.05e-3 : -0.05e-3);
  }
  for (const auto& q : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    mesh.add_face({q[0], q[1], q[2], q[3]});
  }
  return mesh;
}

// An arch of radius 40 mm, 80 mm long, in strips as long as it; every second strip is 0.8 um wide.
PolygonMesh make_needle_arch() {
  constexpr double kRadius = 0.040, kNeedle = 0.8e-6 / kRadius;
  constexpr int kStrips = 24;
  std::vector<SheetLine> profile;
  for (int i = 0; i <= kStrips; ++i) {
    const double a = (-70.0 + 140.0 * i / kStrips) * kDegree;
    for (const double angle : {a, a + kNeedle})
      profile.push_back({kRadius * std::sin(angle), kRadius * std::cos(angle)});
  }
  return swept_sheet(profile, 1);
}

PolygonMesh make_sliver_pole_sphere() { return latitude_rows(0.040, 512, 16, 0.0, 180.0, true); }
PolygonMesh make_open_bowl() { return latitude_rows(0.040, 48, 12, 90.0, 180.0, true); }
PolygonMesh make_narrow_cup() { return latitude_rows(0.015, 32, 8, 0.0, 90.0, false); }

PolygonMesh make_moebius() {
  constexpr int kSteps = 96, kAcross = 6;
  constexpr double kRadius = 0.035, kHalfWidth = 0.010;
  PolygonMesh mesh;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSteps;
    for (int j = 0; j <= kAcross; ++j) {
      const double w = kHalfWidth * (2.0 * j / kAcross - 1.0);
      const double r = kRadius + w * std::cos(0.5 * a);
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), w * std::sin(0.5 * a));
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    const auto at = [&](int row, int j) {
      // After one turn the band has turned over.
      return static_cast<std::uint32_t>(row < kSteps ? row * (kAcross + 1) + j : kAcross - j);
    };
    for (int j = 0; j < kAcross; ++j) {
      mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.add_face({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Flat for x < 0; from there a ridge along x rises whose slopes steepen smoothly from 0 to 45 degrees.
PolygonMesh make_crease_dart() {
  return height_sheet(kHalfSize, 32, [](double x, double y) {
    return x <= 0.0 ? 0.0 : -std::abs(y) * (x / kHalfSize) * (x / kHalfSize);
  });
}

PolygonMesh make_notched_cube() {
  // The cells of a 2 x 2 x 2 cube but one; faces between a cell and nothing.
  constexpr double kCell = 0.028;
  PolygonMesh mesh;
  for (int i = 0; i < 27; ++i) mesh.positions.push_back(kCell * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
  const auto filled = [](int x, int y, int z) {
    return x >= 0 && x < 2 && y >= 0 && y < 2 && z >= 0 && z < 2 && !(x == 1 && y == 1 && z == 1);
  };
  const auto point = [](int x, int y, int z) { return static_cast<std::uint32_t>(x + 3 * y + 9 * z); };
  for (int cell = 0; cell < 8; ++cell) {
    const int x = cell & 1, y = cell >> 1 & 1, z = cell >> 2;
    if (!filled(x, y, z)) continue;
    if (!filled(x - 1, y, z))
      mesh.add_face({point(x, y, z), point(x, y, z + 1), point(x, y + 1, z + 1), point(x, y + 1, z)});
    if (!filled(x + 1, y, z))
      mesh.add_face({point(x + 1, y, z), point(x + 1, y + 1, z), point(x + 1, y + 1, z + 1), point(x + 1, y, z + 1)});
    if (!filled(x, y - 1, z))
      mesh.add_face({point(x, y, z), point(x + 1, y, z), point(x + 1, y, z + 1), point(x, y, z + 1)});
    if (!filled(x, y + 1, z))
      mesh.add_face({point(x, y + 1, z), point(x, y + 1, z + 1), point(x + 1, y + 1, z + 1), point(x + 1, y + 1, z)});
    if (!filled(x, y, z - 1))
      mesh.add_face({point(x, y, z), point(x, y + 1, z), point(x + 1, y + 1, z), point(x + 1, y, z)});
    if (!filled(x, y, z + 1))
      mesh.add_face({point(x, y, z + 1), point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1), point(x, y + 1, z + 1)});
  }
  return mesh;
}

PolygonMesh make_staircase() {
  constexpr double kStep = 0.004;
  std::vector<SheetLine> profile;
  for (int i = 0; i <= 10; ++i) {
    profile.push_back({kStep * (i - 5), kStep * (i - 5)});
    if (i < 10) profile.push_back({kStep * (i - 4), kStep * (i - 5)});
  }
  return swept_sheet(profile, 8);
}

}  // namespace tangent
