// What a search remembers of creases and vertices under fingers that are not round.
#include "core/contact/prove/core_feature_proof.h"

#include "core/contact/prove/core_proof.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh creased_ball() {
  ContactMeshOptions options;
  options.crease_rad = 0.1;
  PolygonMesh ball = make_icosphere(0.010, 1);
  ball.normals.clear();
  ball.corner_normal.clear();
  return *ContactMesh::build(ball, options);
}

/// The finger touches a corner of the triangle, or is off by some millimetres.
FingerPose near_corner(const Finger& finger, const ContactMesh& mesh, std::uint32_t t, Random& random) {
  const Vec3& normal = mesh.normal(t, 0);
  FingerPose pose{Vec3(0.0), random.orientation()};
  pose.position = mesh.position(t, 0) - 5e-4 * normal - support_point(finger, pose, normal);
  if (random.below(2)) pose.position += 0.004 * random.direction();
  return pose;
}

}  // namespace

TEST_CASE("creases and vertices that one triangle has excluded for an ellipsoid or a capsule are asked no more") {
  Random random(77);
  const ContactMesh mesh = creased_ball();
  PatchCache cache(mesh);
  const SolverSettings settings;
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    const Finger finger = finger_of(shape);
    const RankBound bound{finger.reach_m(), 1.0};
    int excluded = 0, unproved = 0;
    for (int i = 0; i < 400; ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count());
      const FingerPose pose = near_corner(finger, mesh, t, random);
      const FingerCore core(finger, pose);
      ContactContext context{cache, settings, finger, pose, Vec3(0.0)};
      context.core = &core;
      FeatureMemory memory;
      const PatchExclusion proof = exclude_by_core(context, core, t, bound, 1e-4, &memory);
      const FeatureExclusion features = exclude_features_by_core(context, core, {t}, bound, 1e9);
      const FeatureExclusion again = exclude_features_by_core(context, core, {t}, bound, 1e9, &memory);
      CHECK((proof.feature != PatchExclusion::kNoFeature) == !(features.margin_m > 0.0));
      if (!proof.possible) {
        ++excluded;
        CHECK(features.asked_count > 0);
        CHECK(proof.margin_m <= features.margin_m);
        CHECK(again.asked_count < features.asked_count);  // the memory forgets some
      } else {  // beside a place that may hold a contact no margin is told, so they are to be asked elsewhere
        CHECK(again.asked_count == features.asked_count);
      }
      if (proof.feature == PatchExclusion::kNoFeature) continue;
      ++unproved;
      CHECK(proof.feature == features.unproved);
      memory.add(proof.feature);
      CHECK(exclude_features_by_core(context, core, {t}, bound, 1e9, &memory).unproved != proof.feature);
    }
    CHECK(excluded > 0);
    CHECK(unproved > 0);
  }
}
