#include "workbench/sweep/ignored_keys.h"

#include "core/lab/objects/generate.h"
#include "core/tick/step.h"
#include "tests/workbench/sweep/ground_fixture.h"
#include "workbench/sweep/trial_run.h"

#include <doctest/doctest.h>

namespace tangent::sweep {
namespace {

/// Another value that the key takes, as far from this one as the slider goes.
double other_value_of(const PresetKey& key, double value) {
  if (key.kind == KeyKind::choice) return value == 0.0 ? key.max : 0.0;
  return value == key.slider_max ? key.slider_min : key.slider_max;
}

/// All that a tick says.
std::vector<double> everything(Stepper& stepper, const Preset& preset, std::span<const TickInput> motion) {
  std::vector<double> out;
  TickState state;
  for (const TickInput& input : motion) {
    const TickOutput tick = stepper.step(preset, input, state);
    for (const Vec3& v : {tick.contact, tick.normal, tick.force_n}) out.insert(out.end(), {v.x, v.y, v.z});
    out.insert(out.end(), {tick.penetration_m, tick.error_m, tick.u, tick.v, tick.cld_m});
    out.insert(out.end(), {double(tick.iterations), double(tick.triangle), double(tick.triangle_changes),
                           double(tick.status), double(tick.event)});
  }
  return out;
}

/// Each method with each source of force and display, damped or not, under each finger that it takes.
std::vector<Preset> all_kinds() {
  std::vector<Preset> out;
  for (std::size_t i = 0; i < 6 * 4 * 4 * 2; ++i) {
    Preset preset;
    preset.solver.method = static_cast<Method>(i % 6);
    preset.force.source = static_cast<ForceSource>(i / 6 % 4);
    preset.display.source = static_cast<TactileSource>(i / 24 % 4);
    preset.force.damping_n_s_per_m = i / 96 % 2 == 0 ? 0.0 : 2.0;
    if (preset.solver.method != Method::two_pass)
      preset.finger.shape = std::array{FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule}[i / 6 % 3];
    out.push_back(preset);
  }
  return out;
}

Range range_of(const char* key, double from, double to, std::size_t count = 3) {
  Range range;
  range.key = find_preset_key(key);
  range.from = from;
  range.to = to;
  range.count = count;
  return range;
}

TEST_CASE("a key that is said to be ignored changes no bit of any tick") {
  const Ground ground = testing::torus_ground(12);
  Stepper stepper(ground.scene);
  std::size_t ignored = 0, read = 0;
  for (const Preset& preset : all_kinds()) {
    const std::vector<double> expected = everything(stepper, preset, *ground.motion);
    for (const PresetKey& key : preset_keys()) {
      if (why_ignored(key, preset).empty()) continue;
      Preset changed = preset;
      key.set(changed, other_value_of(key, key.get(preset)));
      CAPTURE(key.full_name());
      CAPTURE(to_string(preset.solver.method));
      CAPTURE(static_cast<int>(preset.force.source));
      CAPTURE(static_cast<int>(preset.display.source));
      CHECK(everything(stepper, changed, *ground.motion) == expected);
      ++ignored;
    }
    // And it is no table that ignores everything.
    for (const char* const name : {"solver.tolerance_m", "force.stiffness_n_per_m", "display.travel_m"})
      read += why_ignored(*find_preset_key(name), preset).empty() ? 1 : 0;
  }
  CHECK(ignored > 1000);
  CHECK(read == 3 * all_kinds().size());
  for (const char* const gain : {"solver.gain_overall", "solver.gain_curvature_m", "solver.gain_distance_per_m"})
    CHECK(why_ignored(*find_preset_key(gain), testing::paper_preset(0.02)).empty());
}

TEST_CASE("keys that are swept for nothing are named once, with the methods and why") {
  Plan plan;
  plan.meshes = {"a.obj"};
  plan.poses = {"around"};
  plan.fingers = {Finger{}};
  plan.methods = {Method::paper, Method::robust, Method::facet};
  plan.ranges = {range_of("solver.gain_curvature_m", 0.0, 0.08), range_of("solver.tolerance_m", 1e-8, 1e-6),
                 range_of("force.velocity_cutoff_hz", 10.0, 100.0)};
  CHECK(ignored_key_texts(*Cells::of(plan)) ==
        std::vector<std::string>{
            "solver.gain_curvature_m changes nothing under robust and facet: paper alone reads it",
            "force.velocity_cutoff_hz changes nothing under paper, robust and facet: force.damping_n_s_per_m is 0"});
  plan.ranges.push_back(range_of("force.damping_n_s_per_m", 0.0, 2.0));  // now it counts in some cells
  plan.methods = {Method::paper};
  CHECK(ignored_key_texts(*Cells::of(plan)).empty());

  Range local;
  local.key = find_preset_key("solver.local_centre");
  local.values = {0.0, 1.0};
  plan.ranges = {local};
  CHECK(ignored_key_texts(*Cells::of(plan)).empty());  // an .obj may be a polygon
  plan.meshes = {"a.ply"};
  CHECK(ignored_key_texts(*Cells::of(plan)).size() == 1);
  plan.ranges = {range_of("solver.gain_curvature_m", 0.0, 0.08)};

  Preset newton;
  newton.solver.method = Method::newton;
  CHECK(ignored_key_texts(plan.ranges, newton) ==
        std::vector<std::string>{"solver.gain_curvature_m changes nothing under newton: paper alone reads it"});
  CHECK(ignored_key_texts(plan.ranges, testing::paper_preset(0.02)).empty());
}

}  // namespace
}  // namespace tangent::sweep
