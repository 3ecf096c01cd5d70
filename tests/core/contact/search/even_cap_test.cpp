// A flat cap of many corners is a fan of slivers that all meet at one vertex: on all of them the contact is the one
// place straight under the finger.
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A cylinder of 40 mm with caps of n corners at +-20 mm along z.
PolygonMesh capped(int n) {
  PolygonMesh mesh;
  for (const double z : {-0.020, 0.020})
    for (int i = 0; i < n; ++i) {
      const double turn = 6.283185307179586 * i / n;
      mesh.positions.push_back({0.040 * std::cos(turn), 0.040 * std::sin(turn), z});
    }
  const auto corner = [&](int i) { mesh.corner_position.push_back(static_cast<std::uint32_t>(i)); };
  const auto close = [&] { mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size())); };
  for (int i = 0; i < n; ++i) corner(n + i);
  close();
  for (int i = n; i-- > 0;) corner(i);
  close();
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    corner(i), corner(j), corner(n + j), corner(n + i);
    close();
  }
  return mesh;
}

}  // namespace

TEST_CASE("a finger that slides over a flat cap of many slivers asks no oftener for more of them, and is right") {
  for (const int corners : {64, 400, 2000}) {
    CAPTURE(corners);
    const ScenePtr scene = scene_of(capped(corners));
    const Preset preset = sphere_preset(0.020, Method::robust);
    Stepper tracking(scene), searching(scene);
    TickState state;
    Vec3 centre(0.0);
    int asked = 0, on_face = 0, differ = 0;
    for (int i = 0; i < 1200; ++i) {
      const TickInput input = at_position(1e-3 * i, {-0.030 + 5e-5 * i, 0.0007, 0.039});
      const TickOutput tracked = tracking.step(preset, input, state);
      asked += state.clearance.centre != centre;
      centre = state.clearance.centre;
      on_face += tracked.status == TickStatus::face;
      if (i % 20 > 0) continue;
      TickState fresh;
      const TickOutput cold = searching.step(preset, input, fresh);
      differ += glm::distance(tracked.contact, cold.contact) > 2.0 * preset.solver.tolerance_m ||
                std::abs(tracked.penetration_m - cold.penetration_m) > 1e-9;
    }
    CHECK(on_face == 1200);
    CHECK(differ == 0);
    CHECK(asked < 1200 / 12);
  }
}

TEST_CASE("over the rim of a cap of many corners the contact is the one that a search from nothing finds") {
  const ScenePtr scene = scene_of(capped(400));
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.contacts = ForceContacts::deepest;
  Stepper tracking(scene), searching(scene);
  TickState state;
  int behind = 0, on_edge = 0;
  for (int i = 0; i < 600; ++i) {
    // From over the cap past its rim and down the side, about a millimetre deep.
    const double turn = 1.6 * i / 600.0;
    const Vec3 rim(0.040, 0.0, 0.020), out(std::sin(turn), 0.0, std::cos(turn));
    const TickInput input = at_position(1e-3 * i, rim + Vec3(0.0, 0.0007 + 1e-6 * i, 0.0) + 0.019 * out);
    const TickOutput tracked = tracking.step(preset, input, state);
    on_edge += tracked.status == TickStatus::edge || tracked.status == TickStatus::vertex;
    TickState fresh;
    const TickOutput cold = searching.step(preset, input, fresh);
    behind += cold.penetration_m - tracked.penetration_m > preset.solver.switch_hysteresis_m + 2e-6;
  }
  CHECK(on_edge > 100);
  CHECK(behind == 0);
}
