// Ticks of 2D scenes, and of meshes that were not built yet, whose trouble is known by how they were made.
#include "tests/core/lab/explain/made_planar_failures.h"
#include "tests/support/approx.h"

#include <map>
#include <string>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("causes on polygons that are known by construction are told right and none is invented") {
  constexpr int kEach = 60;
  for (const MadeKind& kind : kMadePlanarKinds) {
    Random random(1908);
    std::map<std::string, int> told;
    int right = 0, made_ticks = 0;
    for (int tries = 0; tries < 4000 && made_ticks < kEach; ++tries) {
      const MadeMaybe made = kind.make(random);
      if (!made) continue;
      ++made_ticks;
      const TickExplanation e = explain_tick(made->scene, made->preset, made->input, made->before);
      ++told[to_string(e.cause)];
      if (e.cause != kind.cause) continue;
      ++right;
      CHECK(e.mesh.planar);
      CHECK(e.mesh.triangle < made->scene->planar()->patch_count());
      if (e.cure.outcome == CureOutcome::found) CHECK(is_converged(e.cure.proof.status));
    }
    std::string text;
    for (const auto& [name, count] : told) text += name + " " + std::to_string(count) + "  ";
    MESSAGE(std::string(kind.name) << ": " << text);
    CHECK_MESSAGE(made_ticks == kEach, std::string(kind.name));
    CHECK_MESSAGE(right >= kEach - 1, std::string(kind.name));
  }
}

TEST_CASE("a point that crosses a sharp notch, over its corner or past it, wants no explaining") {
  Random random(1911);
  int wanted = 0;
  for (int i = 0; i < 1000; ++i) {
    MadeFailure made = notch_crossed(random);
    wanted += wants_explaining(Stepper(made.scene).step(made.preset, made.input, made.before));
  }
  CHECK(wanted == 0);
}

TEST_CASE("on a polygon the numbers that decided are those of the ground") {
  Random random(1909);
  for (int i = 0; i < 10; ++i) {
    MadeMaybe made;
    while (!made) made = circle_larger_than_hollow(random);
    const TickExplanation e = explain_tick(made->scene, made->preset, made->input, made->before);
    CHECK(e.decided.value == approx(made->preset.finger.radius_m).epsilon(0.05));
    CHECK(e.decided.threshold == approx(1.0 / kBend).epsilon(0.1));
    made.reset();
    while (!made) made = short_steps_in_a_hollow(random);
    const TickExplanation small = explain_tick(made->scene, made->preset, made->input, made->before);
    CHECK(small.decided.threshold == approx(1.0 / (1.0 - kBend * made->preset.finger.radius_m)).epsilon(0.1));
    REQUIRE(small.cure.outcome == CureOutcome::found);
    CHECK(small.cure.key->full_name() == "solver.method");
  }
}

TEST_CASE("a tick that could not search says so, and what it would have found") {
  Random random(1910);
  for (int i = 0; i < 10; ++i) {
    MadeFailure made = *plain_tick(random);
    const TickExplanation plain = explain_tick(made.scene, made.preset, made.input, made.before);
    made.input.unready = true;
    const TickExplanation e = explain_tick(made.scene, made.preset, made.input, made.before);
    CHECK(e.cause == TickCause::unready);
    CHECK(e.tick.status == TickStatus::unconverged);
    CHECK(e.mesh.mended);
    CHECK(e.mesh.triangle == plain.tick.triangle);
    CHECK(e.mesh.proof.iterations == plain.tick.iterations);
    CHECK(explanation_text(e).find("with it built the tick is plain") != std::string::npos);
    made.before = {};  // nothing was found before: there is no number
    CHECK(explain_tick(made.scene, made.preset, made.input, made.before).decided.what == nullptr);
  }
}
