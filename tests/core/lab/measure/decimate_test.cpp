#include "core/lab/measure/decimate.h"
#include "core/lab/measure/perception.h"
#include "tests/core/scenes.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;

namespace {

ScenePtr with_file_normals(const PolygonMesh& mesh) {
  ContactMeshOptions options;
  options.normals = NormalSource::file;
  return scene_of(mesh, options);
}

}  // namespace

TEST_CASE("a fine sphere decimates to the limit's angle, keeps its smooth surface both ways, and solves" *
          doctest::skip(testing::kSanitized)) {
  const ScenePtr fine = scene_of(make_icosphere(0.04, 4));
  const double limit_deg = 14.8, deviation = 80e-6;
  const DecimateResult result = decimate(*fine, {limit_deg, deviation});
  CHECK(result.before == 5120);
  CHECK(result.after < 800);
  CHECK(result.mesh.face_count() == result.after);
  const ScenePtr coarse = with_file_normals(result.mesh);
  const PerceptionAudit audit = audit_perception(coarse->mesh(), facet_angles(coarse->mesh()));
  CHECK(audit.boundary_edges == 0);
  CHECK(audit.crease_edges == 0);
  CHECK(audit.largest_curve_deg <= limit_deg + 1e-4);
  CHECK(audit.largest_curve_deg > 0.8 * limit_deg);
  for (const SurfaceDeviation& d :
       {surface_deviation(*coarse, *fine, 20000), surface_deviation(*fine, *coarse, 20000)}) {
    CHECK(d.unresolved == 0);
    CHECK(d.largest_m < deviation);
    CHECK(d.rms_m < 0.3 * deviation);
    CHECK(d.largest_m > 1e-7);
  }
  Stepper stepper(coarse);
  TickState state;
  int unconverged = 0;
  for (int i = 0; i < 2000; ++i) {
    const double a = 6.283185307179586 * i / 2000.0;
    const Vec3 out_of = unit(Vec3(std::cos(a), std::sin(a), 0.4 * std::sin(5.0 * a)));
    const TickOutput out =
        stepper.step(sphere_preset(0.020, Method::robust), at_position(1e-3 * i, 0.059 * out_of), state);
    unconverged += out.status == TickStatus::unconverged;
    CHECK(angle_deg(out.normal, out_of) < 2.0);
  }
  CHECK(unconverged == 0);
}

TEST_CASE("a finer limit leaves more triangles, and one below every angle leaves the mesh as it is") {
  const ScenePtr fine = scene_of(make_icosphere(0.04, 3));
  const std::uint64_t p1 = decimate(*fine, {14.8, 1e-3}).after, c4 = decimate(*fine, {6.0, 1e-3}).after;
  CHECK(p1 < c4);
  const DecimateResult none = decimate(*fine, {0.1, 1e-3});
  CHECK(none.after == none.before);
  CHECK(none.mesh.positions.size() == 642);
}

TEST_CASE("the distance limit alone holds too") {
  const ScenePtr fine = scene_of(make_icosphere(0.04, 3));
  CHECK(decimate(*fine, {14.8, 2e-6}).after > decimate(*fine, {14.8, 200e-6}).after);
}

TEST_CASE("creases and boundaries keep their vertices, and corner normals stay on their sides") {
  // A closed cylinder whose wall is fine: its two rims are creases.
  const ScenePtr fine = scene_of(*generate_mesh("cylinder", {.segments = 48}));
  const PerceptionAudit before = audit_perception(fine->mesh(), facet_angles(fine->mesh()));
  const DecimateResult result = decimate(*fine, {14.8, 100e-6});
  const ScenePtr coarse = with_file_normals(result.mesh);
  const PerceptionAudit after = audit_perception(coarse->mesh(), facet_angles(coarse->mesh()));
  CHECK(before.crease_edges > 0);
  CHECK(after.crease_edges == before.crease_edges);
  CHECK(after.boundary_edges == 0);
  CHECK(after.largest_curve_deg <= std::max(14.8, before.largest_curve_deg) + 1e-4);

  const ScenePtr sheet = scene_of(height_field(0.04, 24, [](double x, double y) { return 2.0 * x * y; }));
  const DecimateResult flat = decimate(*sheet, {14.8, 100e-6});
  CHECK(flat.after < flat.before / 2);
  const ScenePtr coarse_sheet = with_file_normals(flat.mesh);
  const auto count = [](const ScenePtr& s) {
    return audit_perception(s->mesh(), facet_angles(s->mesh())).boundary_edges;
  };
  CHECK(count(coarse_sheet) == count(sheet));
}

TEST_CASE("asked to stop, it leaves a good mesh and says so") {
  const ScenePtr fine = scene_of(make_icosphere(0.04, 3));
  const DecimateResult result = decimate(*fine, {14.8, 1e-3}, [] { return false; });
  CHECK(result.stopped);
  CHECK(result.after == result.before);
}
