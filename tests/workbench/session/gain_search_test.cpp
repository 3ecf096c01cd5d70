#include "workbench/session/gain_search.h"
#include "tests/support/sanitized.h"

#include "session_fixture.h"
#include "workbench/session/session.h"

using namespace tangent;

TEST_CASE("a search is better only by the numbers that are shown") {
  RunScore now;
  now.ticks = 1000;
  now.iterations = 3000;
  RunScore other = now;
  CHECK_FALSE(shows_better(now, other));
  other.iterations = 2999;  // 3.00 either way
  CHECK_FALSE(shows_better(now, other));
  other.iterations = 2980;
  CHECK(shows_better(now, other));
  other.unconverged = 1;
  CHECK_FALSE(shows_better(now, other));
  now.unconverged = 2;
  CHECK(shows_better(now, other));
}

TEST_CASE("gains found on recorded poses are the tuner's, and score as said" * doctest::skip(testing::kSanitized)) {
  SessionOptions options;
  options.threaded = false;
  Preset preset;
  preset.solver.method = Method::paper;
  preset.solver.gain_curvature_m = 0.0;
  auto session = Session::create(test::torus_scene(), preset, options);
  REQUIRE(session);
  (*session)->start();
  (*session)->advance(1200);
  std::vector<TickInput> poses;
  for (std::size_t i = 1000; i < 1200; ++i) poses.push_back((*session)->history()[i].tick.input);
  GainSearch search;
  search.start(test::torus_scene(), preset, poses, 1199, false);
  const auto found = search.result();
  REQUIRE(found != nullptr);
  CHECK(found->first_tick == 1000);
  CHECK(found->last_tick == 1199);
  CHECK(shows_better(found->now, found->best.score));
  Stepper stepper(test::torus_scene());
  Preset with = preset;
  with.solver = with_gains(with.solver, found->best.gains);
  CHECK(score_run(stepper, with, poses).iterations == found->best.score.iterations);
  CHECK(score_run(stepper, preset, poses).iterations == found->now.iterations);
}

TEST_CASE("a search in the background is cancelled at once, with no result") {
  std::vector<TickInput> poses(3000);
  for (std::size_t i = 0; i < poses.size(); ++i)
    poses[i].finger.position = {0.040 + 1e-6 * static_cast<double>(i), 0.0, 0.0349};
  GainSearch search;
  search.start(test::torus_scene(), Preset{}, poses, 2999, true);
  search.cancel();
  CHECK_FALSE(search.running());
}
