// The trace of a tick matches what the tick computed.
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace tangent;
using namespace tangent::test;

namespace {

ScenePtr traced_torus() {
  static const ScenePtr scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  return scene;
}
ScenePtr box() {
  static const ScenePtr scene = scene_of(*generate_mesh("octagon"));
  return scene;
}

Preset traced_preset(Method method) {
  Preset preset = sphere_preset(0.020, method);
  preset.solver.gain_overall = 0.9;
  preset.solver.gain_curvature_m = 0.015;
  preset.solver.gain_distance_per_m = 3.0;
  return preset;
}

/// A finger that circles round the mesh, with a leap every 100 ticks.
Vec3 finger_at(int tick) {
  const double a = 0.002 * tick + (tick / 100) * 1.0, b = 0.3 * std::sin(0.01 * tick);
  return 0.074 * Vec3(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
}

bool same_place(const IterationRecord& r, const TickOutput& o) {
  return r.triangle == o.triangle && r.u == o.u && r.v == o.v && r.error_m == o.error_m &&
         glm::length(r.point - o.contact) == 0.0;
}

/// Calls check(trace, output, kept state) for every tick.
template <class Check>
void every_tick(const ScenePtr& scene, const Preset& preset, int ticks, Check check) {
  auto trace = std::make_unique<IterationTrace>();
  Stepper stepper(scene);
  TickState state;
  for (int i = 0; i < ticks; ++i) {
    const TickState kept = state;
    trace->clear();
    const TickOutput out = stepper.step(preset, at_position(1e-3 * i, finger_at(i)), state, trace.get());
    REQUIRE(trace->size > 0);
    check(*trace, out, kept);
  }
}

}  // namespace

TEST_CASE("a converged tick's contact is a converged record of its trace - alone in the tick, the last one") {
  for (const ScenePtr& scene : {traced_torus(), box()})
    for (const Method method : kSmoothMethods) {
      CAPTURE(name_of(method));
      int converged = 0, missing = 0, last = 0, alone = 0;
      every_tick(scene, traced_preset(method), 1000,
                 [&](const IterationTrace& trace, const TickOutput& out, const TickState&) {
                   if (out.status == TickStatus::unconverged) return;
                   ++converged;
                   bool found = false, only_tracking = true;
                   for (const IterationRecord& r : trace.view()) {
                     found |= r.stop == StopReason::converged && same_place(r, out);
                     only_tracking &= r.seed == 0;
                   }
                   missing += !found;
                   if (!only_tracking) return;
                   ++alone;
                   const IterationRecord& end = trace.records[trace.size - 1];
                   last += end.stop == StopReason::converged && same_place(end, out) && end.error_m < 1e-6 &&
                           glm::length(end.normal - out.normal) == 0.0;
                 });
      CHECK(converged > 900);
      CHECK(alone > 300);
      CHECK(missing == 0);
      CHECK(last == alone);
    }
}

TEST_CASE("iterations count the new planes: every record but the kept plane's") {
  for (const ScenePtr& scene : {traced_torus(), box()})
    for (const Method method : kSmoothMethods) {
      CAPTURE(name_of(method));
      int wrong = 0, kept_wrong = 0;
      every_tick(scene, traced_preset(method), 1000,
                 [&](const IterationTrace& trace, const TickOutput& out, const TickState& kept) {
                   REQUIRE(trace.lost == 0);
                   const int from_kept = kept.plane.feature == Feature::none ? 0 : 1;
                   wrong += static_cast<int>(trace.size) - from_kept != out.iterations;
                   const IterationRecord& first = trace.records[0];
                   if (from_kept)
                     kept_wrong += first.seed != 0 || first.triangle != kept.plane.triangle ||
                                   first.u != kept.plane.u || first.v != kept.plane.v;
                   else
                     kept_wrong += first.seed == 0;
                 });
      CHECK(wrong == 0);
      CHECK(kept_wrong == 0);
    }
}

TEST_CASE("every record's plane, contact, travel and error fit together") {
  for (const Method method : kSmoothMethods) {
    double worst = 0.0;
    int at = 0;
    every_tick(
        box(), traced_preset(method), 1000, [&](const IterationTrace& trace, const TickOutput&, const TickState&) {
          const Vec3 centre = finger_at(at++);
          for (const IterationRecord& r : trace.view()) {
            const double h = glm::dot(centre - r.point, r.normal);
            worst = std::max({worst, glm::length(r.contact - r.point - r.travel),
                              std::abs(glm::length(r.travel) - r.error_m), std::abs(glm::dot(r.travel, r.normal)),
                              glm::length(centre - h * r.normal - r.contact), std::abs(glm::length(r.normal) - 1.0)});
          }
        });
    CAPTURE(name_of(method));
    CHECK(worst <= 1e-14);
  }
}

TEST_CASE("the paper's gain column is Eq. 1 of its curvature and distance columns, with both readings of d") {
  for (const DistanceReading reading : {DistanceReading::proxy, DistanceReading::centre}) {
    Preset preset = traced_preset(Method::paper);
    preset.solver.distance_reading = reading;
    int steps = 0;
    double worst = 0.0, worst_step = 0.0, worst_distance = 0.0;
    int at = 0;
    every_tick(traced_torus(), preset, 500, [&](const IterationTrace& trace, const TickOutput&, const TickState&) {
      const Vec3 centre = finger_at(at++);
      for (const IterationRecord& r : trace.view()) {
        const double h = glm::dot(centre - r.point, r.normal);
        worst_distance =
            std::max(worst_distance, std::abs(r.distance_m - (reading == DistanceReading::proxy ? 0.020 - h : h)));
        if (r.stop != StopReason::going_on || r.seed > 1) continue;  // rivals are looked for by another rule
        ++steps;
        const double eq1 = 0.9 / ((1.0 + 0.015 * r.curvature_per_m) * (1.0 + 3.0 * std::abs(r.distance_m)));
        worst = std::max(worst, std::abs(r.gain - eq1));
        const ContactMesh& mesh = traced_torus()->mesh();
        const Vec3 flat = unit(glm::cross(mesh.position(r.triangle, 1) - mesh.position(r.triangle, 0),
                                          mesh.position(r.triangle, 2) - mesh.position(r.triangle, 0)));
        const Vec3 projected = r.travel - glm::dot(r.travel, flat) * flat;
        worst_step = std::max(worst_step, std::abs(r.step_m - r.gain * glm::length(projected)));
      }
    });
    CHECK(steps > 500);
    CHECK(worst <= 1e-13);
    CHECK(worst_step <= 1e-13);
    CHECK(worst_distance <= 1e-15);
  }
}

TEST_CASE("a larger curvature gain shortens the first step, a larger distance gain too") {
  const auto first_gain = [](double curvature, double distance) {
    Preset preset = traced_preset(Method::paper);
    preset.solver.gain_curvature_m = curvature;
    preset.solver.gain_distance_per_m = distance;
    auto trace = std::make_unique<IterationTrace>();
    // Off to the side, so that the first plane is not the answer.
    solve_once(traced_torus(), preset, {Vec3(0.070, 0.004, 0.013), Quat(1.0, 0.0, 0.0, 0.0)}, trace.get());
    return trace->records[0].gain;
  };
  CHECK(first_gain(0.0, 0.0) == approx(0.9).epsilon(1e-15));
  CHECK(first_gain(0.02, 0.0) < first_gain(0.01, 0.0));
  CHECK(first_gain(0.01, 50.0) < first_gain(0.01, 10.0));
}

TEST_CASE("where every new plane counts, the limit on iterations holds for the paper's method and newton") {
  for (const Method method : {Method::paper, Method::newton})
    for (const int limit : {1, 2, 5}) {
      Preset preset = traced_preset(method);
      preset.solver.max_iterations = limit;
      preset.solver.tolerance_m = 0.0;  // no error is below it
      auto trace = std::make_unique<IterationTrace>();
      const TickOutput out =
          solve_once(traced_torus(), preset, {Vec3(0.070, 0.004, 0.013), Quat(1.0, 0.0, 0.0, 0.0)}, trace.get());
      CAPTURE(name_of(method));
      CHECK(out.status == TickStatus::unconverged);
      CHECK(out.iterations == limit);
      CHECK(trace->records[trace->size - 1].stop == StopReason::iteration_limit);
    }
}

TEST_CASE("an unconverged tick's trace ends with a reason") {
  // Without the curvature gain the paper's iteration runs away from contacts on the torus.
  Preset preset = traced_preset(Method::paper);
  preset.solver.gain_overall = 1.0;
  preset.solver.gain_curvature_m = 0.0;
  preset.solver.gain_distance_per_m = 0.0;
  int unconverged = 0, without_reason = 0;
  std::set<StopReason> reasons;
  every_tick(traced_torus(), preset, 300, [&](const IterationTrace& trace, const TickOutput& out, const TickState&) {
    if (out.status != TickStatus::unconverged) return;
    ++unconverged;
    const StopReason stop = trace.records[trace.size - 1].stop;
    reasons.insert(stop);
    without_reason += stop == StopReason::going_on || stop == StopReason::converged;
  });
  CHECK(unconverged > 0);
  CHECK(without_reason == 0);
}

TEST_CASE("a trace that is full counts what it loses and keeps the first records") {
  auto trace = std::make_unique<IterationTrace>();
  for (std::size_t i = 0; i < IterationTrace::kCapacity + 7; ++i) {
    IterationRecord r;
    r.triangle = static_cast<std::uint32_t>(i);
    trace->push(r);
  }
  CHECK(trace->size == IterationTrace::kCapacity);
  CHECK(trace->lost == 7);
  CHECK(trace->records[IterationTrace::kCapacity - 1].triangle == IterationTrace::kCapacity - 1);
  CHECK(trace->view().size() == IterationTrace::kCapacity);
  trace->clear();
  CHECK(trace->view().empty());
  CHECK(trace->lost == 0);
}
