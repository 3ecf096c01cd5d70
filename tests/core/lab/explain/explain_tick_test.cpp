// Ticks whose trouble is known by how they were made: is it found, is nothing invented, does the cure cure?
#include "core/io/pose_file.h"
#include "tests/core/fingers.h"
#include "tests/core/lab/explain/made_failures.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <chrono>
#include <cstdlib>
#include <map>
#include <string>

using namespace tangent;
using namespace tangent::test;
using tangent::testing::contains;

namespace {

/// 10,000 with TANGENT_EXPLAINED_TICKS=10000.
int explained_ticks() {
  if (const char* wanted = std::getenv("TANGENT_EXPLAINED_TICKS")) return std::max(20, std::atoi(wanted));
  return rounds(1000);
}

std::uint64_t seed_of_ticks() {
  const char* wanted = std::getenv("TANGENT_RANDOM_SEED");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 1901;
}

MadeFailure make_one(const MadeKind& kind, Random& random) {
  for (int tries = 0; tries < 10000; ++tries)
    if (MadeMaybe made = kind.make(random)) return *made;
  FAIL("no tick could be made: " << kind.name);
  return {};
}

TickExplanation explain(const MadeFailure& made, const ExplainOptions& options = {}) {
  return explain_tick(made.scene, made.preset, made.input, made.before, options);
}

/// The tick with the cure's value.
TickOutput with_cure(const MadeFailure& made, const TickCure& cure, double value) {
  Preset preset = made.preset;
  cure.key->set(preset, value);
  Stepper stepper(made.scene);
  TickState state = made.before;
  return stepper.step(preset, made.input, state);
}

/// "cause count, cause count" of one kind.
std::string counts_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}

}  // namespace

TEST_CASE("causes that are known by construction are told right in 99 of 100 ticks and none is invented") {
  const int each = explained_ticks() / static_cast<int>(std::size(kMadeKinds));
  int all = 0, right = 0, invented = 0;
  std::string table;
  for (const MadeKind& kind : kMadeKinds) {
    Random random(seed_of_ticks());
    std::map<std::string, int> told;
    int right_here = 0;
    for (int i = 0; i < each; ++i) {
      const TickExplanation e = explain(make_one(kind, random));
      ++told[to_string(e.cause)];
      right_here += e.cause == kind.cause;
      invented += e.cause != kind.cause && e.cause != TickCause::not_told;
    }
    table += "\n  " + std::string(kind.name) + ": " + counts_text(told);
    CHECK_MESSAGE(right_here >= each - 1 - each / 33, kind.name);
    all += each;
    right += right_here;
  }
  MESSAGE(right << " of " << all << " right, " << invented << " invented" << table);
  CHECK(right >= 0.99 * all);
  CHECK(invented <= 0.01 * all);
}

TEST_CASE("a cure that is named cures, and nine tenths of it does not") {
  int found = 0, by_less = 0;
  for (const MadeKind& kind : kMadeKinds) {
    Random random(1902);
    for (int i = 0; i < 5; ++i) {
      const MadeFailure made = make_one(kind, random);
      const TickExplanation e = explain(made);
      const TickCure& cure = e.cure;
      if (cure.outcome != CureOutcome::found || cure.as_deep || e.cause == TickCause::other_facet) continue;
      ++found;
      CHECK(cure.key->allows(cure.to));
      CHECK(cure.from == cure.key->get(made.preset));
      const TickOutput out = with_cure(made, cure, cure.to);
      CHECK(is_converged(out.status));
      CHECK(out.event == TickEvent::none);
      CHECK(out.iterations == cure.proof.iterations);
      if (cure.key->kind != KeyKind::number) continue;
      by_less += !wants_explaining(with_cure(made, cure, cure.from + 0.9 * (cure.to - cure.from)));
    }
  }
  CHECK(found > 40);
  CHECK(by_less == 0);
}

TEST_CASE("the numbers that decided are those of the ground") {
  Random random(1903);
  for (int i = 0; i < 10; ++i) {
    const MadeFailure ball = *gain_too_small_on_a_ball(random);
    const double full = 1.0 + ball.preset.finger.radius_m / 0.010;
    CHECK(explain(ball).decided.threshold == approx(1.0 / full).epsilon(0.1));
    MadeMaybe hollow;
    while (!hollow) hollow = finger_larger_than_hollow(random);
    const TickExplanation e = explain(*hollow);
    CHECK(e.decided.value == approx(hollow->preset.finger.radius_m).epsilon(0.05));
    CHECK(e.decided.threshold == approx(1.0 / kBend).epsilon(0.1));
    const TickExplanation jump = explain(*facet_crossed(random));
    CHECK(jump.decided.value > 10.0);
    CHECK(jump.decided.margin() == approx(jump.decided.value - 10.0));
  }
}

TEST_CASE("defects are named with their place, and mending them is what cures") {
  Random random(1904);
  for (const auto make : {wild_normal, sliver}) {
    for (int i = 0; i < 10; ++i) {
      MadeMaybe made;
      while (!made) made = make(random);
      const TickExplanation e = explain(*made);
      if (e.cause != TickCause::wild_normal && e.cause != TickCause::sliver) continue;
      CHECK(e.mesh.mended);
      CHECK(!wants_explaining(e.mesh.proof));
      REQUIRE(e.mesh.triangle < made->scene->mesh().triangle_count());
      CHECK(e.decided.margin() > 0.0);
    }
  }
}

TEST_CASE("explaining a tick leaves it as it was, and says the same again") {
  for (const MadeKind& kind : kMadeKinds) {
    Random random(1905);
    const MadeFailure made = make_one(kind, random);
    const TickExplanation a = explain(made), b = explain(made);
    CHECK(a.cause == b.cause);
    CHECK(explanation_text(a) == explanation_text(b));
    CHECK(a.solves == b.solves);
    CHECK(a.solves < 150);
    Stepper stepper(made.scene);
    TickState state = made.before;
    BitHash alone, explained;
    alone.add(stepper.step(made.preset, made.input, state));
    explained.add(a.tick);
    CHECK(alone.value() == explained.value());
  }
}

TEST_CASE("a plain tick is nothing and costs one solve, and the threshold of many planes is the caller's") {
  Random random(1906);
  const MadeFailure plain = *plain_tick(random);
  CHECK(explain(plain).solves == 1);
  CHECK(explanation_text(explain(plain)) == "Nothing is wrong.");
  const MadeFailure slow = *gain_too_small_on_a_ball(random);
  CHECK(explain(slow).cause == TickCause::gain_too_small);
  CHECK(explain(slow, {10000}).cause == TickCause::nothing);
}

TEST_CASE("a finger in the air over a hollow is not said to touch its sides, and no smaller one is its cure" *
          doctest::skip(testing::kSanitized)) {
  const ScenePtr torus = scene_of(*generate_mesh("torus"));
  std::map<Method, int> told;
  for (const Method method : {Method::paper, Method::robust, Method::newton})
    for (const double height : {0.07, 0.1, 0.2}) {
      const Preset preset = sphere_preset(0.005, method);
      Stepper stepper(torus);
      TickState state;
      for (int i = 0; i < 100; ++i) {
        const TickInput input =
            at_position(1e-3 * i, Vec3(0.02 * std::cos(0.1 * i), 0.02 * std::sin(0.13 * i), height));
        const TickState before = state;
        stepper.step(preset, input, state);
        const TickExplanation e = explain_tick(torus, preset, input, before, {0});
        if (e.cause != TickCause::unstable_ground) continue;
        ++told[method];
        CHECK(e.untouched);
        CHECK(e.cure.outcome == CureOutcome::not_sought);
        CHECK(contains(explanation_text(e), "Unstable ground: the finger touches nothing"));
        CHECK_FALSE(contains(explanation_text(e), "Cured by"));
      }
    }
  CHECK(told[Method::paper] > 20);
  CHECK(told[Method::paper] + told[Method::robust] + told[Method::newton] > told[Method::paper]);
}

TEST_CASE("every finger, method and a 2D scene get an explanation") {
  Random random(1907);
  for (const FingerShape shape : kFingerShapes) {
    for (std::size_t m = 0; m < kMethodNames.size(); ++m) {
      MadeFailure made{ball(2), {}, {}, {}};
      made.preset.finger = finger_of(shape);
      made.preset.solver.method = static_cast<Method>(m);
      made.preset.solver.max_iterations = 3;
      if (!check_preset(made.preset)) continue;
      made.before = state_after(made.scene, made.preset, 0.015 * random.direction());
      made.input = at_position(1e-3, 0.015 * random.direction());
      CHECK(!explanation_text(explain(made)).empty());
    }
  }
  auto curve = PlanarCurve::build({"outline", {{0.03, -0.02}, {0.03, 0.02}, {-0.03, 0.02}, {-0.03, -0.02}}, true});
  REQUIRE(curve.has_value());
  auto scene = ContactScene::build(std::move(*curve));
  REQUIRE(scene.has_value());
  for (const Method method : kSmoothMethods) {
    MadeFailure made{*scene, sphere_preset(0.020, method), at_position(1e-3, {0.0495, 0.001, 0.0}), {}};
    CHECK(explain(made).cause == TickCause::first_contact);
    made.before = state_after(*scene, made.preset, {0.0495, 0.001, 0.0});
    made.input = at_position(1e-3, {0.0495, 0.0011, 0.0});
    const TickExplanation e = explain(made, {10000});
    CHECK(e.cause == TickCause::nothing);
    CHECK(!explanation_text(explain(made)).empty());  // beside the contact other patches are solved for
  }
}

TEST_CASE("causes have names of their own") {
  std::map<std::string, int> names;
  for (std::size_t i = 0; i < kTickCauses.size(); ++i) {
    CHECK(static_cast<std::size_t>(kTickCauses[i]) == i);
    ++names[to_string(kTickCauses[i])];
  }
  CHECK(names.size() == kTickCauses.size());
}

TEST_CASE("measure what explaining a tick of spot, fandisk and the bunny costs" * doctest::skip()) {
  for (const std::string name : {"spot", "fandisk", "stanford-bunny"}) {
    const ScenePtr scene = file_scene(testing::shared_file("meshes/" + name + ".obj"), 45.0);
    const auto poses = read_poses(testing::shared_file("poses/" + name + "-r020.csv"));
    REQUIRE(poses.has_value());
    for (const Method method : {Method::robust, Method::paper}) {
      const Preset preset = sphere_preset(0.020, method);
      Stepper stepper(scene);
      TickState state;
      std::map<std::string, int> told;
      std::vector<double> ms;
      std::string dearest;
      int most_solves = 0;
      for (std::size_t i = 0; i < std::min<std::size_t>(poses->size(), 10000); ++i) {
        const TickInput& input = (*poses)[i];
        const TickState before = state;
        if (!wants_explaining(stepper.step(preset, input, state))) continue;
        const auto start = std::chrono::steady_clock::now();
        const TickExplanation e = explain_tick(scene, preset, input, before);
        ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        if (ms.back() >= *std::max_element(ms.begin(), ms.end())) dearest = to_string(e.cause);
        most_solves = std::max(most_solves, e.solves);
        ++told[to_string(e.cause)];
      }
      std::sort(ms.begin(), ms.end());
      MESSAGE(name << " " << name_of(method) << ": " << ms.size() << " explained, ms p50 " << ms[ms.size() / 2]
                   << " max " << ms.back() << " (" << dearest << "), solves at most " << most_solves << "; "
                   << counts_text(told));
    }
  }
}
