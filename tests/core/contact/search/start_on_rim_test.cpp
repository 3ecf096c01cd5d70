// The rim of an open sheet has any normal, so nothing leads a search to the one that a finger touches it with.
#include "core/contact/contact_rank.h"
#include "core/contact/patch_cache.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <cmath>
#include <utility>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A place of an edge, and a normal there that leans out of the sheet, up to behind it.
std::pair<Vec3, Vec3> rim_contact(PatchCache& cache, std::uint32_t t, std::uint32_t k, Random& random) {
  const ContactMesh& mesh = cache.mesh();
  const double f = random.in(0.0, 1.0), turn = random.in(0.0, 2.4);
  const Vec2 uv = k == 0 ? Vec2(f, 0.0) : k == 1 ? Vec2(1.0 - f, f) : Vec2(0.0, 1.0 - f);
  SurfaceSample s;
  cache.sample(t, NormalForm::bernstein, uv.x, uv.y, s);
  const Vec3 along = unit(mesh.position(t, (k + 1) % 3) - mesh.position(t, k));
  const Vec3 out = unit(glm::cross(along, s.normal));
  return {s.point, std::cos(turn) * s.normal + std::sin(turn) * out};
}

}  // namespace

TEST_CASE("a first tick finds what an ellipsoid or a capsule touches the rim of a sheet with") {
  Random random(11);
  const ScenePtr sheet = scene_of(height_field(0.020, 40, [](double, double) { return 0.0; }));
  const ContactMesh& mesh = sheet->mesh();
  PatchCache cache(mesh);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    Preset preset = sphere_preset(0.020, Method::robust);
    preset.finger = finger_of(shape);
    int shallower = 0, poses = 0;
    long planes = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (mesh.edge_kind(t, k) != EdgeKind::boundary) continue;
        const auto [point, normal] = rim_contact(cache, t, k, random);
        // Less deep than the finger's sharpest radius: deeper it folds over by itself, and another place counts.
        FingerPose pose = resting_on(preset.finger, point, normal, random.in(5e-4, 2e-3), random);
        const PlaneContact made = contact_on_plane(preset.finger, pose, point, normal);
        if (made.height_m < 0.0) continue;
        pose.position += mesh.origin();
        const TickOutput out = solve_once(sheet, preset, pose);
        const double height = glm::dot(pose.position - out.contact, out.normal);
        const double rank = preset.finger.reach_m() - (height < 0.0 ? height : out.penetration_m);
        ++poses;
        planes += out.iterations;
        shallower += rank > contact_rank(preset.finger, made) + 1e-6;
      }
    MESSAGE(poses << " poses, " << shallower << " found shallower, " << planes / poses << " planes");
    CHECK(poses > 100);
    CHECK(shallower == 0);
    CHECK(planes < 600L * poses);  // 650 and 740 where the solves began on the faces
  }
}
