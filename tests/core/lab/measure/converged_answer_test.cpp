#include "core/lab/measure/converged_answer.h"

#include "core/lab/objects/generate.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("solving on from a loose answer gives the answer of a tight tolerance") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 2));
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Preset loose = sphere_preset(0.020, method), tight = loose;
    loose.solver.tolerance_m = 1e-4;
    tight.solver.tolerance_m = 1e-13;
    tight.solver.max_iterations = 500;
    const TickInput input = at_position(0.0, 0.059 * unit(Vec3(0.3, 0.5, 0.7)));
    Stepper stepper(scene), exact(scene);
    TickState state, tight_state;
    const TickOutput rough = stepper.step(loose, input, state);
    REQUIRE(rough.status == TickStatus::face);
    const TickOutput wanted = exact.step(tight, input, tight_state);
    const auto answer = converged_answer(exact, loose, input, state, converged_tolerance_m(*scene, loose.finger));
    REQUIRE(answer);
    CHECK(glm::length(answer->contact - wanted.contact) < 1e-12);
    CHECK(answer->error_m < 1e-13);
    CHECK(answer->error_m <= rough.error_m);
  }
}

TEST_CASE("the tolerance of converged answers follows the scene's size") {
  const Finger finger{.shape = FingerShape::point};
  const double metre = converged_tolerance_m(*scene_of(make_icosphere(0.5, 1)), finger);
  const double millimetre = converged_tolerance_m(*scene_of(make_icosphere(0.5e-3, 1)), finger);
  CHECK(metre == approx(1000.0 * millimetre));
  CHECK(metre < 1.1e-12);
}
