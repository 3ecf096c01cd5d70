// The participant's screen: everything is on it, apart, readable, and the scene only where it may be seen.
#include "workbench/gui/experiment/participant_screen.h"

#include "tests/workbench/gui/experiment/headless_screen.h"
#include "workbench/gui/experiment/experiment_keys.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

ParticipantScreen longest_screen() {
  ParticipantScreen screen;
  screen.prompt = "Feel the second shape. Then raise your finger, press 1 or 2 for the smooth one, and Enter.";
  screen.hint = "Press Enter when you have felt it.";
  screen.keys = {{"1", "the first", false}, {"2", "the second", true}, {"Enter", "", false}};
  screen.trial = 123;
  return screen;
}

ParticipantScreen seven_objects() {
  ParticipantScreen screen;
  screen.prompt = "Which object is it?";
  screen.hint = "Touch the object first.";
  for (const char* object : {"cone", "cylinder", "cube", "sphere", "tetrahedron", "octagon", "triangle"})
    screen.keys.push_back({std::to_string(screen.keys.size() + 1), object, false});
  screen.trial = 14;
  screen.of = 112;
  return screen;
}

ParticipantScreen on_the_way() {
  ParticipantScreen screen;
  screen.prompt = "Bring your finger to the mark, and wait there.";
  screen.trial = 3;
  screen.of = 112;
  screen.show_mark = true;
  screen.right_mm = 500.0;
  screen.up_mm = -300.0;
  screen.away_mm = 12.0;
  return screen;
}

bool draws(ImTextureID texture) {
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i)
    for (const ImDrawCmd& command : data.CmdLists[i]->CmdBuffer)
      if (command.TextureId == texture) return true;
  return false;
}

const std::array<ImVec2, 5> kScreens{
    {{1920.0f, 1080.0f}, {1280.0f, 1024.0f}, {960.0f, 600.0f}, {640.0f, 480.0f}, {3840.0f, 2160.0f}}};

}  // namespace

TEST_CASE("on every screen the participant's words are whole, apart, and in strong contrast") {
  for (const ImVec2 size : kScreens)
    for (const bool dark : {true, false})
      for (const ParticipantScreen& screen : {longest_screen(), seven_objects(), on_the_way()}) {
        HeadlessScreen headless(size.x, size.y);
        TextRecorder recorder;
        headless.draw(screen, dark);
        const std::vector<DrawnText> texts = recorder.texts();
        REQUIRE(texts.size() >= 3);
        CAPTURE(size.x);
        for (std::size_t i = 0; i < texts.size(); ++i) {
          CAPTURE(texts[i].text);
          CHECK(texts[i].min.x >= 0.0f);
          CHECK(texts[i].max.x <= size.x);
          CHECK(texts[i].min.y >= 0.0f);
          CHECK(texts[i].max.y <= size.y);
        }
        check_apart(texts);
        for (const double contrast : contrasts(texts, {0, 0, 0, 1})) CHECK(contrast >= 7.0);
      }
}

TEST_CASE("the participant's prompt is read from two metres") {
  HeadlessScreen headless(1920.0f, 1080.0f);
  headless.draw(longest_screen());
  // Inter's capitals are 0.727 of its size; on a screen 300 mm high, in minutes of arc at 2 m.
  const double capital_mm = 0.727 * 300.0 * static_cast<double>(headless.large().prompt->FontSize) / 1080.0;
  CHECK(capital_mm / 2000.0 * 180.0 / 3.14159265 * 60.0 > 22.0);
}

TEST_CASE("the scene is drawn in practice and training alone, whatever is handed over") {
  HeadlessScreen headless;
  const auto texture = reinterpret_cast<ImTextureID>(std::intptr_t{77});
  ParticipantScreen screen = seven_objects();
  headless.draw(screen, true, {texture, {}, {0, 0}, 0.0f});
  CHECK_FALSE(draws(texture));
  screen.show_scene = true;
  headless.draw(screen, true, {texture, {}, {0, 0}, 0.0f});
  CHECK(draws(texture));
}

TEST_CASE("in trials the drawing is the same with a scene at hand as without") {
  const auto vertices = [](const PracticePicture& scene) {
    HeadlessScreen headless;
    headless.draw(longest_screen(), true, scene);
    int count = 0;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) count += data.CmdLists[i]->VtxBuffer.Size;
    return count;
  };
  const PracticePicture scene{nullptr, {{{0, 0}, {100, 100}}}, {50, 50}, 20.0f};
  CHECK(vertices(scene) == vertices({}));
}

TEST_CASE("keys of the participant's window are answers, those of the number pad, too, and nothing else is") {
  using Kind = PressedKey::Kind;
  CHECK(experiment_key('1') == PressedKey{Kind::digit, 1});
  CHECK(experiment_key('9') == PressedKey{Kind::digit, 9});
  CHECK(experiment_key(321) == PressedKey{Kind::digit, 1});
  CHECK(experiment_key(329) == PressedKey{Kind::digit, 9});
  CHECK(experiment_key(257) == PressedKey{Kind::enter, 0});
  CHECK(experiment_key(335) == PressedKey{Kind::enter, 0});
  CHECK(experiment_key(256) == PressedKey{Kind::stop, 0});
  CHECK(experiment_key(' ') == PressedKey{Kind::lift, 0});
  for (const int other : {48, 320, 65, 259, 340, -1}) CHECK_FALSE(experiment_key(other));
}
