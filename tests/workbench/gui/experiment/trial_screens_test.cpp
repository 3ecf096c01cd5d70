// Both screens from what a running experiment says of itself.
#include "workbench/gui/experiment/trial_screens.h"

#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "workbench/gui/model/experiment_start.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

experiment::Protocol shipped(const std::string& name) {
  return *experiment::read_protocol(std::filesystem::path(testing::source_folder()) / "presets/experiments" /
                                    (name + ".toml"));
}

}  // namespace

TEST_CASE("objects are asked for without their list, which is drawn as keys") {
  experiment::ParticipantView view;
  view.prompt = "Which object is it? 1 cone, 2 cylinder, 3 cube.";
  view.phase = experiment::Phase::explore;
  view.trial = 3;
  view.of = 112;
  const ParticipantScreen screen = participant_screen(view, shipped("identification"), 0);
  CHECK(screen.prompt == "Which object is it?");
  REQUIRE(screen.keys.size() == 7);
  CHECK(screen.keys[0].means == "cone");
  CHECK(screen.of == 112);
  CHECK_FALSE(screen.show_scene);
}

TEST_CASE("of a pair the key that is chosen is marked, and how many pairs will come is not guessed") {
  experiment::ParticipantView view;
  view.phase = experiment::Phase::second;
  view.trial = 3;
  view.of = 168;
  const ParticipantScreen screen = participant_screen(view, shipped("discrimination"), 2);
  REQUIRE(screen.keys.size() == 3);
  CHECK_FALSE(screen.keys[0].pressed);
  CHECK(screen.keys[1].pressed);
  CHECK(screen.of == 0);
}

TEST_CASE("practice and the end have no number of a trial") {
  experiment::ParticipantView view;
  view.trial = 3;
  view.of = 112;
  for (const experiment::Phase phase : {experiment::Phase::training, experiment::Phase::finished}) {
    view.phase = phase;
    CHECK(participant_screen(view, shipped("identification"), 0).trial == 0);
  }
  view.phase = experiment::Phase::guide;
  CHECK(participant_screen(view, shipped("identification"), 0).trial == 3);
}

TEST_CASE("the way to the start is drawn as the person has it: forward is away, the left is left") {
  experiment::ParticipantView view;
  view.phase = experiment::Phase::guide;
  view.show_finger = true;
  view.finger_from_start_m = {0.010, 0.020, -0.030};  // world: forward, left, down
  const ParticipantScreen screen = participant_screen(view, shipped("identification"), 0);
  CHECK(screen.show_mark);
  CHECK(screen.away_mm == approx(10.0));
  CHECK(screen.right_mm == approx(-20.0));
  CHECK(screen.up_mm == approx(-30.0));
  CHECK(screen.mark_mm == approx(5.0));
}

TEST_CASE("stages follow the participant's order, and runs fill one after the other") {
  const auto conditions = experiment_stages(shipped("discrimination"), "P7", "C1", 5, 40);
  REQUIRE(conditions.size() == 4);
  int now = 0;
  for (const ExperimentStage& stage : conditions) {
    CHECK(stage.over == (now == 0 && !stage.now));
    now += stage.now;
    if (stage.now) CHECK(stage.done == 5);
  }
  CHECK(now == 1);
  const auto runs = experiment_stages(shipped("identification"), "P7", "", 0, 30);
  REQUIRE(runs.size() == 8);
  CHECK(runs[1].over);
  CHECK(runs[2].now);
  CHECK(runs[2].done == 2);
  CHECK(runs[2].name == "Session 1, block 2, run 1");
  CHECK_FALSE(runs[3].now);
}

TEST_CASE("reversals on the operator's screen are those of the protocol's rule") {
  const experiment::Protocol protocol = shipped("discrimination");
  experiment::Staircase staircase(protocol.discrimination()->conditions[0].staircase);
  std::vector<std::pair<int, bool>> answers;
  for (int i = 0; i < 20; ++i) {
    answers.emplace_back(staircase.segments(), i % 3 != 2);
    staircase.answer(i % 3 != 2);
  }
  std::size_t reversals = 0;
  for (const StaircasePoint& point : staircase_points(protocol, "C1", answers)) reversals += point.reversal;
  CHECK(reversals == staircase.reversals().size());
  CHECK(reversals > 3);
  CHECK(staircase_points(protocol, "no such condition", answers).empty());
}

TEST_CASE("an experiment is started from the window by protocol, participant and folder") {
  const auto arguments = experiment_arguments("discrimination P3 my data");
  REQUIRE(arguments);
  CHECK(arguments->at(0) == "experiment");
  CHECK(std::filesystem::path(arguments->at(1)).filename() == "discrimination.toml");
  CHECK(arguments->at(3) == "P3");
  CHECK(arguments->at(5) == "my data");
  CHECK(arguments->back() == "--window");
  CHECK_FALSE(experiment_arguments("discrimination P3"));
  CHECK_FALSE(experiment_arguments(""));
  CHECK_FALSE(experiment_arguments("nonsense P3 data"));
}
