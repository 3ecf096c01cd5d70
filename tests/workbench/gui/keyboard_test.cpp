// The window without a mouse: Tab, F6, Enter and the arrows reach and set everything.
#include "tests/support/approx.h"
#include "tests/workbench/gui/running_app.h"

#include <cmath>
#include <set>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

constexpr int kF6 = 295, kUp = 265, kDown = 264;

const std::string& focus(HeadlessApp& ui) { return ui.app().items().focus(); }

/// Presses Tab until the widget has the keyboard.
void tab_to(HeadlessApp& ui, const std::string& path) {
  for (int i = 0; i < 400 && focus(ui) != path; ++i) ui.key(HeadlessApp::kTab);
  REQUIRE(focus(ui) == path);
  ui.frames(3);  // it is scrolled to
}

}  // namespace

TEST_CASE("Tab goes through every widget of the window, once, and Shift-Tab back - what has the keyboard is in view") {
  RunningApp ui;
  ui.run(300);
  std::vector<std::string> order;
  for (int i = 0; i < 400; ++i) {
    ui.key(HeadlessApp::kTab);
    if (!order.empty() && focus(ui) == order.front()) break;
    order.push_back(focus(ui));
  }
  const std::set<std::string> seen(order.begin(), order.end());
  CHECK(seen.size() == order.size());
  CHECK(order.size() > 100);
  for (const auto& [path, rect] : ui.app().items().all()) {
    if (rect.id == 0 || path.starts_with("splitter/")) continue;
    CAPTURE(path);
    CHECK(seen.contains(path));
  }
  ImGui::GetIO().KeyShift = true;
  ui.key(HeadlessApp::kTab);
  ImGui::GetIO().KeyShift = false;
  CHECK(focus(ui) == order.back());
  tab_to(ui, "display/travel_m");
  CHECK(ui.app().items().find(focus(ui))->visible);
}

TEST_CASE("F6 goes from part to part of the window") {
  RunningApp ui;
  ui.run(300);
  std::set<ImGuiID> parts;
  for (int i = 0; i < 12; ++i) {
    ui.key(kF6);
    REQUIRE_FALSE(focus(ui).empty());
    parts.insert(ui.app().items().find(focus(ui))->window);
  }
  for (const char* of : {"menu/file", "solver/method", "view", "section/Iterations", "plots/csv", "transport/pause"}) {
    CAPTURE(std::string(of));
    CHECK(parts.contains(ui.app().items().find(of)->window));
  }
}

TEST_CASE("every value of the preset is set with the keyboard: the arrows slide, Enter types, lists choose") {
  RunningApp ui;
  ui.run(50);
  for (const PresetTable& table : preset_tables()) ui.model().window().open_sections()[std::string(table.title)] = true;
  ui.frames(2);
  int values = 0;
  for (const PresetKey& key : preset_keys()) {
    const std::string path = std::string(key.table) + "/" + std::string(key.key);
    if (ui.app().items().find(path) == nullptr) continue;  // it has no meaning under the present choices
    CAPTURE(path);
    tab_to(ui, path);
    const double before = key.get(ui.model().presets().current());
    ui.key(HeadlessApp::kRight);
    if (key.get(ui.model().presets().current()) == before) ui.key(HeadlessApp::kLeft);
    CHECK(key.get(ui.model().presets().current()) != before);
    ui.model().presets().undo();
    ui.frames(2);
    ++values;
  }
  CHECK(values > 25);
  tab_to(ui, "solver/gain_curvature_m");
  ui.key(HeadlessApp::kEnter);
  ui.frame();
  ui.type("13.5");
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(13.5e-3));
}

TEST_CASE("Enter presses what has the keyboard: buttons, sections, menus with their items, lists") {
  RunningApp ui;
  ui.run(50);
  tab_to(ui, "transport/pause");
  ui.key(HeadlessApp::kEnter);
  ui.frame();
  CHECK(ui.model().time().paused());
  tab_to(ui, "section/Solver");
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  CHECK(ui.app().items().find("solver/method") == nullptr);
  tab_to(ui, "menu/scene");
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  REQUIRE(ui.app().items().find("menu/scene/cube") != nullptr);
  for (int i = 0; i < 30 && focus(ui) != "menu/scene/cube"; ++i) ui.key(kDown);
  ui.key(kUp);
  ui.key(kDown);
  REQUIRE(focus(ui) == "menu/scene/cube");
  ui.key(HeadlessApp::kEnter);
  ui.frames(3);
  CHECK(ui.model().scene().path() == "cube");
  CHECK(ui.app().items().find("menu/scene/cube") == nullptr);
}

TEST_CASE("the arrows are the field's while it has the keyboard, else the time's - a click and Escape take it away") {
  RunningApp ui;
  ui.run(500);
  ui.key(HeadlessApp::kSpace);
  const std::uint64_t tick = ui.model().time().tick().record()->tick.tick;
  tab_to(ui, "solver/gain_overall");
  ui.key(HeadlessApp::kLeft);
  CHECK(ui.model().time().tick().record()->tick.tick == tick);
  ui.key(HeadlessApp::kEscape);
  CHECK(focus(ui).empty());
  ui.key(HeadlessApp::kLeft);
  CHECK(ui.model().time().tick().record()->tick.tick == tick - 1);
  ui.key(HeadlessApp::kTab);
  CHECK_FALSE(focus(ui).empty());
  ui.click("view");
  CHECK(focus(ui).empty());
}
