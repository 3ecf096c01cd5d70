// The operator's screen: what it says, what its buttons ask for, and what it covers.
#include "workbench/gui/experiment/operator_screen.h"

#include "tests/workbench/gui/experiment/headless_screen.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

OperatorScreen half_way() {
  OperatorScreen screen;
  screen.protocol = "Smoothness of polygonal arcs";
  screen.participant = "P7";
  screen.data = "data/sub-P7/beh/sub-P7_task-discrimination_beh.tsv";
  screen.pilot = true;
  screen.simulated = "known";
  screen.stimulus = "29 segments";
  screen.condition = "C1";
  screen.prompt = "Feel the first shape. Then raise your finger and press Enter.";
  screen.next = "the second of the pair";
  screen.trial = 12;
  screen.expected = 168;
  screen.force_on = true;
  screen.device = {{"simulated", "ready", StatusLine::Level::good}, {"Safety gate", "armed", StatusLine::Level::good}};
  for (int i = 0; i < 12; ++i) screen.staircase.push_back({20 + 3 * (i % 4), i % 3 != 0, i % 4 == 0});
  screen.stages = {{"Condition C2", 0, 0, false, true}, {"Condition C1", 12, 0, true, false}};
  screen.notes = {"0.0 s  simulated, no display; sound none", "12.3 s  headphones put right"};
  for (int i = 0; i < 500; ++i) screen.force_n.push_back(static_cast<float>(2.0 + 2.0 * std::sin(0.05 * i)));
  screen.force_limit_n = 6.0;
  return screen;
}

OperatorScreen at_a_fault() {
  OperatorScreen screen = half_way();
  screen.paused = true;
  screen.force_on = false;
  screen.fault = "the safety gate stopped the force: energy; press resume when it is mended: the trial begins again";
  return screen;
}

std::vector<DrawnText> drawn(HeadlessScreen& headless, OperatorPanel& panel, const OperatorScreen& screen,
                             Theme theme = Theme::dark) {
  TextRecorder recorder;
  for (int i = 0; i < 4; ++i) {
    recorder.clear();
    headless.draw(panel, screen, theme);
  }
  return recorder.texts();
}

bool says(const std::vector<DrawnText>& texts, const std::string& part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const DrawnText& t) { return t.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("the operator's words are apart and readable, on small and large screens, in both themes") {
  for (const ImVec2 size :
       {ImVec2(640, 480), ImVec2(800, 600), ImVec2(900, 500), ImVec2(1280, 720), ImVec2(1920, 1080)})
    for (const Theme theme : {Theme::dark, Theme::light})
      for (const OperatorScreen& screen : {half_way(), at_a_fault()}) {
        HeadlessScreen headless(size.x, size.y);
        OperatorPanel panel;
        const std::vector<DrawnText> texts = drawn(headless, panel, screen, theme);
        CAPTURE(size.x);
        const std::vector<double> contrast = contrasts(texts, panel.ground());
        for (std::size_t i = 0; i < texts.size(); ++i) {
          CAPTURE(texts[i].text);
          const bool disabled = texts[i].text == "Resume" && !screen.paused;
          if (!disabled) CHECK(contrast[i] >= 4.5);
        }
        check_apart(texts);
        CHECK(panel.items().find("experiment/stop")->visible);
      }
}

TEST_CASE("a fault is said whole, in red, and is gone with it") {
  HeadlessScreen headless;
  OperatorPanel panel;
  const std::vector<DrawnText> texts = drawn(headless, panel, at_a_fault());
  CHECK(says(texts, "the safety gate stopped the force: energy"));
  CHECK(panel.items().find("experiment/fault") != nullptr);
  drawn(headless, panel, half_way());
  CHECK(panel.items().find("experiment/fault") == nullptr);
}

TEST_CASE("Stop asks to stop the moment it is pressed, and Escape does while a note is typed") {
  HeadlessScreen headless;
  OperatorPanel panel;
  const OperatorScreen screen = half_way();
  CHECK(headless.click(panel, screen, "experiment/stop").stop);
  CHECK_FALSE(headless.click(panel, screen, "experiment/note").stop);
  ImGui::GetIO().AddInputCharactersUTF8("tired");
  headless.draw(panel, screen);
  ImGui::GetIO().KeysDown[256] = true;
  CHECK(headless.draw(panel, screen).stop);
  CHECK_FALSE(headless.draw(panel, screen).stop);  // once
  ImGui::GetIO().KeysDown[256] = false;
}

TEST_CASE("a note is handed over once, when Enter is pressed") {
  HeadlessScreen headless;
  OperatorPanel panel;
  const OperatorScreen screen = half_way();
  headless.click(panel, screen, "experiment/note");
  ImGui::GetIO().AddInputCharactersUTF8("headphones put right");
  CHECK(headless.draw(panel, screen).note.empty());
  ImGui::GetIO().KeysDown[257] = true;
  const OperatorWishes wishes = headless.draw(panel, screen);
  ImGui::GetIO().KeysDown[257] = false;
  CHECK(wishes.note == "headphones put right");
  CHECK(wishes.give_keys);  // the participant's keys are answers again
  CHECK(headless.draw(panel, screen).note.empty());
}

TEST_CASE("Resume is for a pause, and the session ends after two clicks") {
  HeadlessScreen headless;
  OperatorPanel panel;
  CHECK_FALSE(headless.click(panel, half_way(), "experiment/resume").resume);
  CHECK(headless.click(panel, at_a_fault(), "experiment/resume").resume);
  CHECK_FALSE(headless.click(panel, half_way(), "experiment/end").end);
  CHECK(headless.click(panel, half_way(), "experiment/end").end);
}

TEST_CASE("a keyboard that is not the participant's is said, with a button that gives it back") {
  HeadlessScreen headless;
  OperatorPanel panel;
  OperatorScreen screen = half_way();
  drawn(headless, panel, screen);
  CHECK(panel.items().find("experiment/keys") == nullptr);
  screen.participant_has_keys = false;
  CHECK(headless.click(panel, screen, "experiment/keys").give_keys);
}

TEST_CASE("covered, the operator's screen names neither stimulus nor condition, and draws no answers") {
  HeadlessScreen headless;
  OperatorPanel panel;
  const OperatorScreen screen = half_way();
  std::vector<DrawnText> texts = drawn(headless, panel, screen);
  CHECK(says(texts, "29 segments"));
  CHECK(says(texts, "C1"));
  CHECK(says(texts, "reversal"));
  panel.set_covered(true);
  texts = drawn(headless, panel, screen);
  for (const char* secret : {"29", "C1", "C2", "reversal", "Segments"})
    CHECK_FALSE_MESSAGE(says(texts, secret), secret);
}
