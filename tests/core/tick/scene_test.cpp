// A scene holds what its ticks read and no more, and what is built late or beside changes no bit.
#include "core/tick/scene.h"

#include "core/io/rendering_condition.h"
#include "core/lab/objects/arc.h"
#include "tests/core/scenes.h"

#include <cstring>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh built_torus() {
  auto mesh = ContactMesh::build(make_torus(0.040, 0.015, 32, 16));
  REQUIRE(mesh);
  return std::move(*mesh);
}

ScenePtr torus_scene(const SceneParts& parts, const RunBoth& run_both = run_in_turn) {
  auto scene = ContactScene::build(built_torus(), parts, run_both);
  REQUIRE(scene);
  return *scene;
}

/// Outputs on a way over the torus, into its hole and back, with leaps.
std::vector<TickOutput> outputs(const ScenePtr& scene, const Preset& preset) {
  Stepper stepper(scene);
  TickState state;
  std::vector<TickOutput> all;
  for (int i = 0; i < 400; ++i) {
    const double a = 0.004 * i + (i % 100 == 99 ? 2.0 : 0.0);
    all.push_back(stepper.step(preset, at_position(1e-3 * i, {0.04 * std::cos(a), 0.04 * std::sin(a), 0.0335}), state));
  }
  return all;
}

bool same_bits(const std::vector<TickOutput>& a, const std::vector<TickOutput>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].triangle != b[i].triangle || a[i].u != b[i].u || a[i].v != b[i].v || a[i].contact != b[i].contact ||
        a[i].normal != b[i].normal || a[i].force_n != b[i].force_n || a[i].cld_m != b[i].cld_m ||
        a[i].iterations != b[i].iterations || a[i].event != b[i].event || a[i].status != b[i].status)
      return false;
  }
  return a.size() == b.size();
}

}  // namespace

TEST_CASE("facet, force shading, two-pass and the conditions C1 to C3 and P2 never read the hierarchy") {
  const auto check = [](const Preset& preset, bool reads) {
    CHECK(parts_for(preset).hierarchy == reads);
    const ScenePtr scene = torus_scene(parts_for(preset)), whole = torus_scene({});
    CHECK(scene->has_hierarchy() == reads);
    CHECK(whole->has_hierarchy());
    CHECK((scene->memory_bytes() < whole->memory_bytes()) == !reads);
    CHECK(same_bits(outputs(scene, preset), outputs(whole, preset)));
    CHECK(scene->has_hierarchy() == reads);
  };
  for (const Method method :
       {Method::paper, Method::newton, Method::robust, Method::facet, Method::force_shading, Method::two_pass}) {
    CAPTURE(to_string(method));
    check(sphere_preset(0.020, method), is_smooth(method));
    for (const RenderingCondition& condition : kRenderingConditions) {
      CAPTURE(std::string(condition.name));
      Preset preset = sphere_preset(0.020, method);
      set_condition(preset, condition);
      check(preset, condition.force == ForceSource::smooth || condition.tactile == TactileSource::smooth);
    }
  }
}

TEST_CASE("a smooth tick on a scene without its hierarchy builds it, with the same bits") {
  const Preset preset = sphere_preset(0.020, Method::robust);
  const ScenePtr late = torus_scene({.hierarchy = false});
  CHECK_FALSE(late->has_hierarchy());
  CHECK(same_bits(outputs(late, preset), outputs(torus_scene({}), preset)));
  CHECK(late->has_hierarchy());
}

TEST_CASE("structures are the same bits built in turn, the other way round or at once") {
  const Preset preset = sphere_preset(0.020, Method::robust);
  const auto expected = outputs(torus_scene({}), preset);
  const auto swapped = [](const std::function<void()>& a, const std::function<void()>& b) { b(), a(); };
  const auto at_once = [](const std::function<void()>& a, const std::function<void()>& b) {
    std::thread other(b);
    a();
    other.join();
  };
  CHECK(same_bits(outputs(torus_scene({}, swapped), preset), expected));
  CHECK(same_bits(outputs(torus_scene({}, at_once), preset), expected));
}

TEST_CASE("what is built before, while or after a tick asks for it gives the same bits") {
  const Preset preset = sphere_preset(0.020, Method::robust);
  const auto late = [] { return torus_scene({.far_parts = false, .whole_up_to = 0}); };
  const auto at_once = [](const std::function<void()>& a, const std::function<void()>& b) {
    std::thread other(b);
    a();
    other.join();
  };
  const ScenePtr before = torus_scene({.whole_up_to = 0}, at_once);
  CHECK(before->unbuilt_parts() == 0);
  const auto expected = outputs(before, preset);

  const ScenePtr on_the_way = late();
  const std::size_t parts = on_the_way->unbuilt_parts();
  CHECK(parts > 100);
  CHECK(same_bits(outputs(on_the_way, preset), expected));
  CHECK(on_the_way->unbuilt_parts() > 0);  // the torus's other side
  CHECK(on_the_way->unbuilt_parts() < parts);
  CHECK(on_the_way->memory_bytes() < before->memory_bytes());

  const ScenePtr beside = late();
  std::thread builder([&] { beside->build_far_parts(run_in_turn); });
  std::vector<TickOutput> others;
  std::thread another([&] { others = outputs(beside, preset); });
  const auto meanwhile = outputs(beside, preset);
  builder.join();
  another.join();
  CHECK(beside->unbuilt_parts() == 0);
  CHECK(same_bits(meanwhile, expected));
  CHECK(same_bits(others, expected));
}

TEST_CASE("where the parts near the finger are built, ticks seldom build any") {
  const auto ticks_that_build = [](double radius, bool ahead) {
    const Preset preset = sphere_preset(radius, Method::robust);
    const ScenePtr scene = torus_scene({.far_parts = false, .whole_up_to = 0});
    scene->search();
    Stepper stepper(scene);
    TickState state;
    int built = 0;
    for (int i = 0; i < 200; ++i) {
      const double a = 0.002 * i;
      const Vec3 at(0.04 * std::cos(a), 0.04 * std::sin(a), 0.0145 + radius);
      if (ahead) scene->build_near(at, preset.finger.reach_m());
      const std::size_t before = scene->unbuilt_parts();
      stepper.step(preset, at_position(1e-3 * i, at), state);
      built += scene->unbuilt_parts() != before;
    }
    CHECK(scene->unbuilt_parts() > 0);
    return built;
  };
  for (const double radius : {0.0, 0.005, 0.020}) {
    CAPTURE(radius);
    const int alone = ticks_that_build(radius, false), ahead = ticks_that_build(radius, true);
    CHECK(ahead < alone);
    CHECK(ahead <= 3);
  }
}

TEST_CASE(
    "a tick in a thread that makes nothing builds nothing and says so, and once all is built gives the same bits") {
  for (const Method method : {Method::robust, Method::paper, Method::facet, Method::two_pass}) {
    CAPTURE(to_string(method));
    const Preset preset = sphere_preset(0.020, method);
    const ScenePtr late = torus_scene({.far_parts = false, .whole_up_to = 0});
    const std::size_t parts = late->unbuilt_parts();
    const auto expected = outputs(torus_scene({.whole_up_to = 0}), preset);
    {
      const MakesNothing here;
      outputs(late, preset);
      CHECK(here.missed());
    }
    CHECK(late->unbuilt_parts() == parts);
    late->build_far_parts(run_in_turn);
    const MakesNothing here;
    CHECK(same_bits(outputs(late, preset), expected));
    CHECK_FALSE(here.missed());
  }
}

TEST_CASE("parts are built from the finger outwards, one at a time") {
  const Preset preset = sphere_preset(0.005, Method::robust);
  const ScenePtr scene = torus_scene({.far_parts = false, .whole_up_to = 0});
  const Vec3 at(0.04, 0.0, 0.0195);
  const auto is_ready = [&] {
    Stepper stepper(scene);
    TickState state;
    const MakesNothing here;
    stepper.step(preset, at_position(0.0, at), state);
    return !here.missed();
  };
  const std::size_t parts = scene->unbuilt_parts();
  std::size_t ready_after = 0, built = 0;
  for (; scene->build_next_part(at); ++built) {
    CHECK(scene->unbuilt_parts() == parts - 2 * (built + 1));  // of both structures
    if (ready_after == 0 && is_ready()) ready_after = built + 1;
  }
  CHECK(2 * built == parts);
  MESSAGE("ready after " << ready_after << " of " << built);
  CHECK(ready_after > 0);
  CHECK(5 * ready_after < built);
  CHECK(is_ready());
  // The same at once.
  const ScenePtr near = torus_scene({.far_parts = false, .whole_up_to = 0});
  near->build_near(at, preset.finger.reach_m());
  CHECK(near->unbuilt_parts() > parts / 2);
}

TEST_CASE("a tick that may not search renders the last contact, which fades, and needs none of the scene") {
  const Preset preset = sphere_preset(0.020, Method::robust);
  const ScenePtr scene = torus_scene({});
  Stepper stepper(scene);
  TickState state;
  const Vec3 at(0.04, 0.0, 0.034);
  TickOutput last;
  for (int i = 0; i < 100; ++i) last = stepper.step(preset, at_position(1e-3 * i, at), state);
  REQUIRE(glm::length(last.force_n) > 0.5);
  const double pushed_n = glm::length(last.force_n);
  int fading = 0;
  for (int i = 100; i < 400; ++i) {
    TickInput input = at_position(1e-3 * i, at);
    input.unready = true;
    const TickState kept = state;
    const TickOutput out = stepper.step(preset, input, state);
    TickState again = kept;
    CHECK(same_bits({Stepper(scene).step(preset, input, again)}, {out}));
    CHECK(out.status == TickStatus::unconverged);
    CHECK(out.iterations == 0);
    CHECK(glm::length(out.force_n) <= glm::length(last.force_n) + 1e-12);
    fading += glm::length(out.force_n) > 0.0;
    last = out;
  }
  MESSAGE(pushed_n << " N fade in " << fading << " ticks");
  CHECK(fading > 5);
  CHECK(last.force_n == Vec3(0.0));
}

TEST_CASE("contacts of a mesh built in parts are those of one built as a whole") {
  for (const Method method : {Method::robust, Method::facet}) {
    const Preset preset = sphere_preset(0.020, method);
    const auto whole = outputs(torus_scene({}), preset), parts = outputs(torus_scene({.whole_up_to = 0}), preset);
    REQUIRE(whole.size() == parts.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      CHECK(whole[i].status == parts[i].status);
      CHECK(glm::length(whole[i].contact - parts[i].contact) < 1e-9);
      CHECK(glm::length(whole[i].force_n - parts[i].force_n) < 1e-9);
    }
  }
}

TEST_CASE("a 2D scene for ticks alone has no mesh, less than half of the memory, and the same bits") {
  const auto scene = [](const SceneParts& parts) {
    auto curve = PlanarCurve::build(make_regular_polygon(2000, 0.05));
    REQUIRE(curve);
    auto built = ContactScene::build(std::move(*curve), parts);
    REQUIRE(built);
    return *built;
  };
  const auto lean = scene(parts_for(Preset{})), whole = scene({});
  CHECK_FALSE(lean->has_mesh());
  CHECK_FALSE(lean->has_hierarchy());
  CHECK(whole->has_mesh());
  CHECK_FALSE(whole->has_hierarchy());  // no tick and no view reads it
  CHECK(2 * lean->memory_bytes() < whole->memory_bytes());
  for (const Method method : {Method::paper, Method::robust, Method::facet, Method::two_pass}) {
    CAPTURE(to_string(method));
    const auto walk = [&](const ScenePtr& on) {
      Stepper stepper(on);
      TickState state;
      std::vector<TickOutput> all;
      for (int i = 0; i < 300; ++i) {
        const double a = 0.002 * i;
        const Vec3 at(0.069 * std::sin(a), 0.069 * std::cos(a), 0.0);
        all.push_back(stepper.step(sphere_preset(0.020, method), at_position(1e-3 * i, at), state));
      }
      return all;
    };
    CHECK(same_bits(walk(lean), walk(whole)));
  }
}
