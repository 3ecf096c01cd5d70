// A flat cap of many corners is a fan of slivers that all meet at one vertex: on all of them the contact is the one
// place straight under the finger.
#include "tests/core/capped_cylinder.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a finger that slides over a flat cap of many slivers asks no oftener for more of them, and is right") {
  for (const int corners : {64, 400, 2000}) {
    CAPTURE(corners);
    const ScenePtr scene = scene_of(capped_cylinder(corners));
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
  const ScenePtr scene = scene_of(capped_cylinder(400));
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

TEST_CASE("over a cap of slivers and past its hub nothing is lost, and a search asks for few of many slivers") {
  for (const int corners : {400, 6400}) {
    CAPTURE(corners);
    const ScenePtr scene = scene_of(capped_cylinder(corners));
    const Preset preset = sphere_preset(0.020, Method::robust);
    Stepper tracking(scene);
    TickState state;
    int events = 0;
    for (int i = 0; i < 400; ++i) {  // the hub is at (40, 0) mm
      const TickOutput tracked = tracking.step(preset, at_position(1e-3 * i, {0.030 + 5e-5 * i, 1e-5, 0.039}), state);
      events += i > 0 && tracked.event != TickEvent::none;
    }
    CHECK(events == 0);
    int most = 0;
    for (const double x : {-0.02, 0.0, 0.02, 0.035, 0.039}) {
      int asked = 0;
      ContactQuery query;
      query.centre = {x, 0.002, 0.039};
      query.margin_m = 4e-4;
      limit_query(query, preset.finger, 0.0195);
      scene->hierarchy().visit(query, [&](std::uint32_t, ContactQuery&) { return ++asked, true; });
      most = std::max(most, asked);
    }
    CAPTURE(most);
    CHECK(most <= 200);
  }
}
