// From an unstable contact both stable ones beside it are found.
#include "core/contact/search/beyond_fold.h"

#include "core/base/tolerances.h"
#include "core/contact/nearest_triangles.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// A groove along y, too narrow for any of the fingers: they rest on both its shoulders.
ScenePtr groove() {
  return scene_of(height_field(0.020, 61, [](double x, double) { return -0.004 * std::exp(-x * x / 1.8e-5); }));
}

SurfacePlace nearest_place(const ContactMesh& mesh, const Vec3& point) {
  NearestHit nearest;
  nearest.distance_m = 1e300;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const NearestHit hit = closest_on_triangle(mesh, t, point);
    if (hit.distance_m < nearest.distance_m) nearest = hit;
  }
  return place_on_face(nearest.triangle, nearest.u, nearest.v);
}

}  // namespace

TEST_CASE("from the bottom of a groove where a contact is unstable both those on its shoulders are found") {
  const ScenePtr scene = groove();
  const Vec3 bottom = Vec3(0.0, 0.0, -0.004) - scene->mesh().origin();
  SolverSettings settings;
  settings.method = Method::robust;
  Random random(81);
  for (const FingerShape shape : kFingerShapes) {
    if (shape == FingerShape::point) continue;
    CAPTURE(static_cast<int>(shape));
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 10; ++i) {
      const Quat yaw = glm::angleAxis(random.in(-1.0, 1.0), Vec3(0.0, 0.0, 1.0));  // lies across it
      const FingerPose pose{Vec3(0.0, 0.0, 0.007) - scene->mesh().origin(), yaw};
      PatchCache cache(scene->mesh());
      ContactContext context{cache, settings, finger, pose, scene->mesh().origin()};
      IterationResult unstable;
      iterate(context, nearest_place(scene->mesh(), bottom), kSeedBudget, unstable);
      REQUIRE(unstable.stop == StopReason::unstable);
      std::array<IterationResult, 2> beside;
      CHECK(iterate_beyond_fold(context, unstable, -1.0, 4 * kSeedBudget, beside[0]));
      CHECK(iterate_beyond_fold(context, unstable, 1.0, 4 * kSeedBudget, beside[1]));
      for (const IterationResult& r : beside) {
        CHECK(r.stability.stable());
        CHECK(r.contact.penetration_m > unstable.contact.penetration_m + 1e-3);
      }
      // The groove and the fingers are their own images when turned by half about z.
      const Vec3 first = scene->mesh().origin() + beside[0].plane.point;
      const Vec3 second = scene->mesh().origin() + beside[1].plane.point;
      CHECK(std::abs(first.x) > 2e-3);
      CHECK(std::abs(first.x + second.x) < 1e-4);
      CHECK(std::abs(first.y + second.y) < 1e-3);
    }
  }
}

TEST_CASE("beyond a fold nothing is looked for from an edge or a vertex") {
  const ScenePtr scene = groove();
  SolverSettings settings;
  const Finger finger = finger_of(FingerShape::capsule);
  const FingerPose pose{Vec3(0.0), Quat(1.0, 0.0, 0.0, 0.0)};
  PatchCache cache(scene->mesh());
  ContactContext context{cache, settings, finger, pose, Vec3(0.0)};
  IterationResult at, found;
  at.plane.move_to(place_on_edge(0, 0, 0.5));
  CHECK(!iterate_beyond_fold(context, at, 1.0, kSeedBudget, found));
  CHECK(found.evaluations == 0);
}
