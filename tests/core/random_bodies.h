// Bodies made at random for the tests of the contact.
#pragma once

#include "core/lab/objects/generate.h"
#include "tests/core/scenes.h"

namespace tangent::test {

/// A ball of about 36 mm with waves of random direction, length and height, sometimes with noise on every vertex.
inline PolygonMesh random_blob(Random& random) {
  struct Wave {
    Vec3 along;
    double height, phase;
  };
  std::vector<Wave> waves(1 + random.below(5));
  for (Wave& w : waves) w = {random.in(1.0, 6.0) * random.direction(), random.in(0.0, 0.06), random.in(0.0, 6.28)};
  const double noise = random.below(2) ? random.in(0.0, 0.01) : 0.0;
  PolygonMesh mesh = make_icosphere(1.0, 2 + static_cast<int>(random.below(3)));
  for (Vec3& p : mesh.positions) {
    double r = 1.0 + noise * random.in(-1.0, 1.0);
    for (const Wave& w : waves) r += w.height * std::sin(glm::dot(w.along, p) + w.phase);
    p *= 0.036 * r;
  }
  return mesh;
}

/// A rough stone of about 36 mm, with creases from an angle of 20 to 60 degrees on; the same with a face less.
inline ScenePtr rough_stone(int subdivisions, Random& random, bool with_hole = false) {
  PolygonMesh stone = make_icosphere(0.036, subdivisions);
  for (Vec3& p : stone.positions) p *= random.in(0.85, 1.15);
  stone.normals.clear();
  stone.corner_normal.clear();
  if (with_hole) {
    stone.face_offsets.pop_back();
    stone.corner_position.resize(stone.face_offsets.back());
  }
  ContactMeshOptions options;
  options.crease_rad = random.in(20.0, 60.0) * kDegree;
  return scene_of(stone, options);
}

}  // namespace tangent::test
