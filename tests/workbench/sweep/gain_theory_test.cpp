#include "workbench/sweep/gain_theory.h"

#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "workbench/session/exploration_poses.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace tangent::sweep {

using test::approx;
namespace {

std::shared_ptr<const ContactScene> object(const char* name, double rounding_m) {
  GenerateOptions options;
  options.rounding_m = rounding_m;
  return *ContactScene::build(*ContactMesh::build(*generate_mesh(name, options), {}));
}

std::vector<TickInput> first_ticks(const ContactScene& scene, std::size_t count) {
  auto poses = exploration_poses(scene, Finger{}, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(poses);
  poses->poses.resize(std::min(count, poses->poses.size()));
  return std::move(poses->poses);
}

Preset with_gain(double overall, double curvature_m) {
  Preset out;
  out.solver.method = Method::paper;
  out.solver.gain_overall = overall;
  out.solver.gain_curvature_m = curvature_m;
  out.solver.gain_distance_per_m = 0.0;
  return out;
}

bool has(const GainTheory& theory, GainCause cause) {
  return std::find(theory.causes.begin(), theory.causes.end(), cause) != theory.causes.end();
}

TEST_CASE("the rule's own gains part from nothing") {
  const auto scene = object("sphere", 0.0);
  const auto theory = gain_theory(scene, with_gain(1.0, Preset{}.finger.reach_m()), first_ticks(*scene, 400));
  REQUIRE(theory);
  CHECK(theory->causes.empty());
  CHECK(theory->planes_found == theory->planes_rule);
  CHECK(gain_theory_text(*theory).find("are the rule's") != std::string::npos);
}

TEST_CASE("on a sphere the found gain is nearer to h than to the reach where it says that depth is the cause") {
  const auto scene = object("sphere", 0.0);
  const std::vector<TickInput> motion = first_ticks(*scene, 800);
  const double reach = Preset{}.finger.reach_m();
  const auto theory = gain_theory(scene, with_gain(1.0, reach - 1e-3), motion);
  REQUIRE(theory);
  CHECK(theory->height_mean_m < reach - 0.4e-3);  // pressed 0.4 to 1.6 mm deep
  CHECK(theory->height_mean_m > reach - 1.6e-3);
  CHECK(has(*theory, GainCause::depth));
  CHECK(has(*theory, GainCause::same_step));
  CHECK(theory->edge_turn == 0.0);
}

TEST_CASE("on rounded edges theory's contraction is what the rule's gains leave") {
  const auto scene = object("cube", 1.5e-3);
  const std::vector<TickInput> motion = first_ticks(*scene, 3000);
  const auto theory = gain_theory(scene, with_gain(1.0, 2.0 * Preset{}.finger.reach_m()), motion);
  REQUIRE(theory);
  CHECK(theory->edge_turn > 5.0);
  CHECK(theory->edge_theory == approx(theory->edge_turn / (2.0 + theory->edge_turn)));
  CHECK(theory->edge_rule == approx(theory->edge_theory).epsilon(0.1));
  CHECK(theory->grounds_found.share(tangent::Ground::tight) > 0.2);
  CHECK(!theory->causes.empty());
}

TEST_CASE("gains that take more planes than the rule's were found for something else, and told to stop it stops") {
  const auto scene = object("sphere", 0.0);
  const std::vector<TickInput> motion = first_ticks(*scene, 400);
  const auto theory = gain_theory(scene, with_gain(0.5, Preset{}.finger.reach_m()), motion);
  REQUIRE(theory);
  CHECK(has(*theory, GainCause::other_aims));
  CHECK(theory->planes_found > theory->planes_rule);
  const std::string text = gain_theory_text(*theory);
  CHECK(text.find("other aims") != std::string::npos);
  CHECK(!gain_theory(scene, with_gain(1.0, 0.01), motion, [] { return true; }));
}

}  // namespace
}  // namespace tangent::sweep
