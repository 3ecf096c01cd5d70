// Scenes that several tests share.
#pragma once

#include "core/mesh/generate.h"
#include "core/mesh/mesh_io.h"
#include "core/step.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <memory>
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

/// A mesh of the shared collection, or null (with a message) where it isn't there.
inline ScenePtr shared_scene(const std::string& name, double crease_deg) {
  const std::filesystem::path path = std::filesystem::path(TANGENT_SHARED_ASSETS) / "meshes" / name;
  if (!std::filesystem::exists(path)) {
    MESSAGE("skipped: " << path.string() << " is not there");
    return nullptr;
  }
  const auto mesh = read_mesh(path, 1e-3);
  REQUIRE_MESSAGE(mesh.has_value(), (mesh ? "" : mesh.error().message()));
  ContactMeshOptions options;
  options.fit_m = 0.080;
  options.crease_rad = crease_deg * kDegree;
  return scene_of(*mesh, options);
}

/// FNV-1a over the bytes of doubles and integers: the same bits give the same value.
class BitHash {
 public:
  void add(const void* data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211ull;
  }
  void add(double x) { add(&x, sizeof x); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const TickOutput& o) {
    add(o.contact), add(o.normal), add(o.force_n);
    add(o.penetration_m), add(o.cld_m), add(o.error_m), add(o.u), add(o.v);
    const std::int32_t whole[6] = {static_cast<std::int32_t>(o.status), static_cast<std::int32_t>(o.event),
                                   static_cast<std::int32_t>(o.triangle), o.iterations, o.triangle_changes, 0};
    add(whole, sizeof whole);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace tangent::test
