// Rendering a recorded contact again gives the same as a step.
#include "core/tick/render_again.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <functional>

using namespace tangent;
using namespace tangent::test;

namespace {

ScenePtr outline() {
  PlanarPolygon polygon{
      "outline",
      {{-0.060, -0.030}, {0.055, -0.034}, {0.055, -0.034}, {0.048, 0.018}, {0.022, 0.004}, {-0.050, 0.034}},
      true};
  auto curve = PlanarCurve::build(polygon);
  REQUIRE(curve);
  return *ContactScene::build(std::move(*curve));
}

/// A valley whose walls are both touched by what goes round in it.
ScenePtr inner_corner() {
  return scene_of(height_field(0.080, 16, [](double x, double) { return 0.8 * std::abs(x) - 0.045; }));
}

bool same(const TickOutput& a, const TickOutput& b) {
  return a.status == b.status && a.event == b.event && a.triangle == b.triangle && a.u == b.u && a.v == b.v &&
         a.contact == b.contact && a.normal == b.normal && a.penetration_m == b.penetration_m &&
         a.force_n == b.force_n && a.cld_m == b.cld_m && a.error_m == b.error_m && a.iterations == b.iterations &&
         a.triangle_changes == b.triangle_changes;
}

/// Around a torus or an outline, in and out of contact.
TickInput pose(int i) {
  const double s = 1.5e-3 * i;
  TickInput input = at_position(1e-3 * i, Vec3(0.055 * std::cos(s), 0.035 * std::sin(s), 0.028 * std::sin(0.37 * s)));
  input.finger.orientation = glm::angleAxis(0.3 * std::sin(s), unit(Vec3(1.0, 0.4, 0.2)));
  return input;
}

}  // namespace

TEST_CASE("force and display rendered again from a known contact are a step's, bit for bit") {
  for (const ScenePtr& scene : {scene_of(make_torus(0.040, 0.015, 48, 24)), inner_corner(), outline()}) {
    for (const Method method : {Method::robust, Method::newton, Method::paper}) {
      CAPTURE(to_string(method));
      Preset own = sphere_preset(0.010, method);
      own.force.contacts = ForceContacts::all;
      Preset other = own;
      other.force.stiffness_n_per_m = 431.0;
      other.force.damping_n_s_per_m = 2.0;
      other.force.limit_n = 1.1;
      other.display.finger_arc_m = 11e-3;
      other.safety.unconverged_hold_s = 0.0;
      if (method != Method::paper) other.solver.gain_curvature_m = other.solver.gain_overall = 0.5;
      REQUIRE(same_contacts(own, other));
      Preset held = other;
      held.display.source = TactileSource::held;
      Stepper first(scene), second(scene), third(scene);
      TickState a, b, c;
      RenderedState of_other, of_held;
      int compared = 0, forces = 0;
      for (int i = 0; i < 6000; ++i) {
        const TickState kept = a;
        const TickOutput solved = first.step(own, pose(i), a);
        const TickOutput stepped = second.step(other, pose(i), b), parked = third.step(held, pose(i), c);
        if (!is_converged(solved.status)) {
          of_other = b.rendered;
          of_held = c.rendered;
          continue;
        }
        ++compared;
        forces += glm::length(stepped.force_n) > 0.0 && stepped.force_n != solved.force_n;
        REQUIRE(same(render_again(*scene, other, pose(i), kept, of_other, solved), stepped));
        REQUIRE(same(render_again(*scene, held, pose(i), kept, of_held, solved), parked));
      }
      CHECK(compared > 4000);
      CHECK(forces > 500);
    }
  }
}

TEST_CASE("presets have the same contacts unless they differ in something that their method reads") {
  using Change = std::function<void(Preset&)>;
  const std::vector<Change> gains{[](Preset& p) { p.solver.gain_overall = 0.7; },
                                  [](Preset& p) { p.solver.gain_curvature_m = 0.0137; },
                                  [](Preset& p) { p.solver.gain_distance_per_m = 3.0; },
                                  [](Preset& p) { p.solver.distance_reading = DistanceReading::centre; }};
  const std::vector<Change> read{[](Preset& p) { p.solver.tolerance_m = 2e-6; },
                                 [](Preset& p) { p.solver.max_iterations = 7; },
                                 [](Preset& p) { p.solver.normal_form = NormalForm::vlachos; },
                                 [](Preset& p) { p.solver.switch_hysteresis_m = 1e-4; },
                                 [](Preset& p) { p.solver.local_centre = LocalCentre::midpoint; },
                                 [](Preset& p) { p.finger.radius_m = 0.011; },
                                 [](Preset& p) { p.solver.method = Method::facet; },
                                 [](Preset& p) { p.force.source = ForceSource::facet; },
                                 [](Preset& p) { p.display.source = TactileSource::facet; }};
  const std::vector<Change> rendered{
      [](Preset& p) { p.force.stiffness_n_per_m = 1.0; }, [](Preset& p) { p.force.limit_n = 1.0; },
      [](Preset& p) { p.display.travel_m = 1e-3; }, [](Preset& p) { p.safety.unconverged_ramp_s = 1.0; },
      [](Preset& p) { p.display.source = TactileSource::held; }};
  for (const Method method : {Method::robust, Method::newton, Method::paper}) {
    const Preset own = sphere_preset(0.010, method);
    const auto same_after = [&](const Change& change) {
      Preset other = own;
      change(other);
      CHECK_FALSE(other == own);
      return same_contacts(own, other);
    };
    for (const Change& change : gains) CHECK(same_after(change) == (method != Method::paper));
    for (const Change& change : read) CHECK_FALSE(same_after(change));
    for (const Change& change : rendered) CHECK(same_after(change));
  }
}
