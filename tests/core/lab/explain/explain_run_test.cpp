// Ticks that follow others without a contact.
#include "core/lab/explain/explain_run.h"

#include "tests/core/lab/explain/made_failures.h"

#include <doctest/doctest.h>

#include <vector>

namespace tangent::test {
namespace {

struct Slide {
  std::vector<TickInput> inputs;
  std::vector<TickState> before;
  std::vector<TickOutput> outputs;

  /// The first tick of the run without a contact that `last` is in.
  std::size_t first_lost(std::size_t last) const {
    while (last > 0 && !is_converged(outputs[last - 1].status)) --last;
    return last;
  }
  LostRun run(std::size_t last) const {
    const std::size_t first = first_lost(last);
    return {before[first], std::span(inputs).subspan(first, last - first + 1)};
  }
};

/// A finger of 20 mm around a ball of 10 mm, 0.5 mm deep, under gains that overshoot from the start.
Slide slide_around_the_ball(const Preset& preset, int ticks) {
  constexpr double kBall = 0.010, kDepth = 0.0005;
  Slide out;
  Stepper stepper(ball(3));
  TickState state = state_after(ball(3), sphere_preset(0.020, Method::robust),
                                touching(kBall * Vec3(0, 0, 1), Vec3(0, 0, 1), 0.020, kDepth));
  for (int i = 1; i <= ticks; ++i) {
    const double angle = 0.02 * i;
    const Vec3 n(std::sin(angle), 0.0, std::cos(angle));
    out.inputs.push_back(at_position(1e-3 * i, touching(kBall * n, n, 0.020, kDepth)));
    out.before.push_back(state);
    out.outputs.push_back(stepper.step(preset, out.inputs.back(), state));
  }
  return out;
}

Preset overshooting() {
  Preset preset = sphere_preset(0.020, Method::paper);
  preset.solver.gain_overall = 1.0;
  preset.solver.gain_curvature_m = 0.0;
  preset.solver.gain_distance_per_m = 0.0;
  return preset;
}

TEST_CASE("a tick after the loss of the contact has the cause of that loss, and a cure that keeps the contact") {
  const Preset preset = overshooting();
  const Slide slide = slide_around_the_ball(preset, 60);
  std::size_t asked = 0;
  for (std::size_t last = 0; last < slide.inputs.size(); ++last) {
    if (is_converged(slide.outputs[last].status)) continue;
    const std::size_t first = slide.first_lost(last);
    CHECK(was_lost(slide.before[last]) == (last > first));
    if (last == first || asked++ % 8 != 0) continue;
    const TickExplanation why = explain_run(ball(3), preset, slide.run(last)),
                          of_first = explain_tick(ball(3), preset, slide.inputs[first], slide.before[first]);
    CAPTURE(last);
    CAPTURE(explanation_text(why));
    CHECK(why.cause == of_first.cause);
    CHECK(why.lost_before == last - first);
    CHECK(why.tick.error_m == slide.outputs[last].error_m);
    REQUIRE(why.cure.outcome == CureOutcome::found);
    // It does what it says, from the first on.
    Preset cured = preset;
    why.cure.key->set(cured, why.cure.to);
    Stepper stepper(ball(3));
    TickState state = slide.before[first];
    TickOutput output;
    for (std::size_t i = first; i <= last; ++i) {
      output = stepper.step(cured, slide.inputs[i], state);
      CHECK(is_converged(output.status));
    }
    CHECK(!wants_explaining(output));
    CHECK(output.iterations == why.cure.proof.iterations);
    CHECK(explanation_text(why).find("The contact was lost " + std::to_string(why.lost_before)) == 0);
    CHECK(explanation_text(why).find("solved again from that tick on") != std::string::npos);
  }
  CHECK(asked > 8);
}

TEST_CASE("a run of one tick is explained as that tick is") {
  const Preset preset = overshooting();
  const Slide slide = slide_around_the_ball(preset, 20);
  std::size_t lost = 0;
  while (is_converged(slide.outputs[lost].status)) REQUIRE(++lost < slide.outputs.size());
  const TickExplanation run = explain_run(ball(3), preset, slide.run(lost)),
                        tick = explain_tick(ball(3), preset, slide.inputs[lost], slide.before[lost]);
  CHECK(explanation_text(run) == explanation_text(tick));
  CHECK(run.solves == tick.solves);
  CHECK(run.lost_before == 0);
}

}  // namespace
}  // namespace tangent::test
