#include "core/lab/audit/finger_size.h"

#include "tests/core/scenes.h"
#include "tests/support/temp_folder.h"

using namespace tangent;
using namespace tangent::test;
using tangent::testing::contains;

TEST_CASE("a finger a thousand times larger or smaller than the mesh is remarked on, a plausible one is not") {
  const auto mesh = ContactMesh::build(height_field(0.01, 2, [](double, double) { return 0.0; }));
  REQUIRE(mesh);
  const auto note = [&](double radius_m) {
    return finger_size_note(longest_side_m(*mesh), sphere_preset(radius_m, Method::robust).finger);
  };
  CHECK(contains(note(20.0), "the finger reaches 2e+04 mm, 1000 times the mesh's longest side of 20 mm: check --unit"));
  CHECK(note(0.02).empty());
  CHECK(note(0.02 * kFingerToMesh).empty());
  CHECK_FALSE(note(0.0201 * kFingerToMesh).empty());
  CHECK(note(0.0).empty());  // a point
  CHECK(note(0.02 / kMeshToFinger).empty());
  CHECK(contains(note(20e-6), "the mesh is 20 mm long, 1000 times the finger's reach of 0.02 mm: check --unit"));
}

TEST_CASE("the note counts how far a finger of any shape reaches") {
  const auto mesh = ContactMesh::build(height_field(0.01, 2, [](double, double) { return 0.0; }));
  REQUIRE(mesh);
  Finger finger;
  finger.shape = FingerShape::ellipsoid;
  finger.semi_axes_m = Vec3(0.01, 3.0, 0.01);
  CHECK(contains(finger_size_note(longest_side_m(*mesh), finger), "reaches 3000 mm, 150 times"));
}
