// Scenes that several tests share.
#pragma once

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "core/tick/step.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace tangent::test {

using ScenePtr = std::shared_ptr<const ContactScene>;

inline ScenePtr scene_of(const PolygonMesh& mesh, const ContactMeshOptions& options = {}) {
  auto built = ContactMesh::build(mesh, options);
  REQUIRE_MESSAGE(built.has_value(), (built ? "" : built.error().message()));
  auto scene = ContactScene::build(std::move(*built));
  REQUIRE_MESSAGE(scene.has_value(), (scene ? "" : scene.error().message()));
  return *scene;
}

inline PlanarCurve curve_of(std::vector<Vec2> vertices, bool closed = false) {
  auto curve = PlanarCurve::build({"test", std::move(vertices), closed});
  REQUIRE_MESSAGE(curve.has_value(), (curve ? "" : curve.error().message()));
  return std::move(*curve);
}

/// One triangle with file normals.
inline PolygonMesh one_triangle(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& n) {
  PolygonMesh mesh;
  mesh.name = "one triangle";
  mesh.positions.assign(p.begin(), p.end());
  mesh.normals.assign(n.begin(), n.end());
  mesh.add_face({0, 1, 2});
  mesh.corner_normal = {0, 1, 2};
  return mesh;
}

/// z = height(x, y) over [-half, half]^2 with cells x cells squares, corner normals computed by the builder.
template <class Height>
PolygonMesh height_field(double half, int cells, Height height) {
  PolygonMesh mesh;
  mesh.name = "height field";
  const auto at = [&](int i) { return -half + 2.0 * half * i / cells; };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) mesh.positions.emplace_back(at(i), at(j), height(at(i), at(j)));
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      mesh.add_face({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.add_face({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

inline Preset sphere_preset(double radius_m, Method method) {
  Preset preset;
  preset.finger.shape = radius_m > 0.0 ? FingerShape::sphere : FingerShape::point;
  preset.finger.radius_m = radius_m;
  preset.solver.method = method;
  preset.solver.gain_curvature_m = radius_m;
  return preset;
}

inline TickInput at_position(double t_s, const Vec3& position) { return {t_s, {position, Quat(1.0, 0.0, 0.0, 0.0)}}; }

/// A mesh of a file, fitted to 80 mm.
inline ScenePtr file_scene(const std::filesystem::path& path, double crease_deg) {
  const auto mesh = read_mesh(path, 1e-3);
  REQUIRE_MESSAGE(mesh.has_value(), (mesh ? "" : mesh.error().message()));
  ContactMeshOptions options;
  options.fit_m = 0.080;
  options.crease_rad = crease_deg * kDegree;
  return scene_of(*mesh, options);
}

inline ScenePtr spot_scene(double crease_deg) { return file_scene(testing::spot_file(), crease_deg); }

/// One tick without kept state.
inline TickOutput solve_once(const ScenePtr& scene, const Preset& preset, const FingerPose& pose,
                             IterationTrace* trace = nullptr) {
  Stepper stepper(scene);
  TickState state;
  TickInput input{0.0, pose};
  input.all_at_once = true;
  return stepper.step(preset, input, state, trace);
}
inline TickOutput solve_once(const ScenePtr& scene, const Preset& preset, const Vec3& position) {
  return solve_once(scene, preset, {position, Quat(1.0, 0.0, 0.0, 0.0)});
}

inline constexpr std::array<Method, 3> kSmoothMethods{Method::paper, Method::newton, Method::robust};

/// The methods that solve for the smooth contact, by name for messages.
inline std::string name_of(Method method) { return to_string(method); }

/// How many of `full` rounds a test does: all in an optimised build, a part under sanitizers and in debug builds.
inline int rounds(int full) {
#if defined(__OPTIMIZE__)
  constexpr bool kOptimised = true;
#else
  constexpr bool kOptimised = false;
#endif
  return testing::kSanitized || !kOptimised ? std::max(1, full / 20) : full;
}

/// Random numbers that are the same on every platform (the distributions of <random> are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  Vec3 in_cube(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube(1.0);
      const double length2 = glm::dot(v, v);
      if (length2 < 1.0 && length2 > 1e-4) return v / std::sqrt(length2);
    }
  }
  Quat orientation() {
    const Vec3 axis = direction();
    const double half = in(0.0, 3.14159265358979);
    return Quat(std::cos(half), std::sin(half) * axis);
  }
  /// Uniform over the triangle.
  Vec2 barycentric() {
    double u = in(0.0, 1.0), v = in(0.0, 1.0);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    return {u, v};
  }

 private:
  std::mt19937_64 engine_;
};

inline bool all_finite(const TickOutput& o) {
  return is_finite(o.contact) && is_finite(o.normal) && is_finite(o.force_n) && std::isfinite(o.penetration_m) &&
         std::isfinite(o.cld_m) && std::isfinite(o.error_m) && std::isfinite(o.u) && std::isfinite(o.v);
}

inline double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree;
}

/// FNV-1a over the bytes of doubles and integers: the same bits give the same value.
class BitHash {
 public:
  void add(const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      value_ = (value_ ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  }
  void add(double x) { add(&x, sizeof x); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const TickOutput& o) {
    add(o.contact), add(o.normal), add(o.force_n);
    add(o.penetration_m), add(o.cld_m), add(o.error_m), add(o.u), add(o.v);
    const std::int32_t whole[6] = {static_cast<std::int32_t>(o.status),
                                   static_cast<std::int32_t>(o.event),
                                   static_cast<std::int32_t>(o.triangle),
                                   o.iterations,
                                   o.triangle_changes,
                                   0};
    add(whole, sizeof whole);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace tangent::test
