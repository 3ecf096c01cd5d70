// Text from 80 to 200 % in windows from 900 x 600 up: nothing lies over something else, and nothing sticks out.
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <imgui_internal.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

struct Placed {
  std::string path;
  ItemRect rect;
};

/// Areas that hold other widgets, or are drawn over one another on purpose.
bool is_area(const std::string& path) {
  return path == "view" || path.starts_with("view/map_bar") || path == "transport/strip" ||
         path.starts_with("splitter/") || path.starts_with("iterations/") || path.starts_with("toast/") ||
         path.starts_with("bookmarks/") || path.starts_with("planar/") || path == "plots/other" ||
         path == "plots/values_table";
}

std::vector<Placed> pressable(HeadlessApp& ui) {
  std::vector<Placed> out;
  for (const auto& [path, rect] : ui.app().items().all())
    if (rect.id != 0 && rect.visible && !is_area(path)) out.push_back({path, rect});
  return out;
}

bool overlap(const ItemRect& a, const ItemRect& b) {
  constexpr float kTouch = 1.0f;
  return std::min(a.max.x, b.max.x) - std::max(a.min.x, b.min.x) > kTouch &&
         std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y) > kTouch;
}

void check_fit(HeadlessApp& ui, const char* state) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const std::vector<Placed> all = pressable(ui);
  CHECK(all.size() > 20);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ImGuiWindow* window = ImGui::FindWindowByID(all[i].rect.window);
    INFO(state, ": ", all[i].path, " sticks out");
    CHECK(all[i].rect.min.x >= window->Pos.x - 1.0f);
    CHECK(all[i].rect.max.x <= std::min(window->Pos.x + window->Size.x, screen.x) + 1.0f);
    for (std::size_t j = 0; j < i; ++j) {
      if (all[i].rect.window != all[j].rect.window || !overlap(all[i].rect, all[j].rect)) continue;
      FAIL_CHECK(state << ": " << all[i].path << " lies over " << all[j].path);
    }
  }
}

}  // namespace

TEST_CASE("at any size of text from 80 to 200 % and any window from 900 x 600 up no widget lies over another") {
  for (const auto& [w, h] : {std::pair{900.0f, 600.0f}, {1280.0f, 720.0f}, {1920.0f, 1080.0f}}) {
    RunningApp ui(HeadlessApp::deterministic_options(), w, h);
    ui.run(600);
    for (const float text : {0.8f, 1.0f, 1.25f, 1.5f, 2.0f}) {
      ui.model().window().set_ui_scale(text);
      for (std::size_t t = 0; t < kTaskNames.size(); ++t) {
        ui.model().window().set_task(static_cast<Task>(t));
        ui.model().window().sizes().prefer_right = t % 2 == 1;
        ui.frames(3);
        const std::string state = std::to_string(static_cast<int>(w)) + " wide, text " +
                                  std::to_string(static_cast<int>(100.0f * text)) + " %, tab " +
                                  std::string(kTaskNames[t]);
        check_fit(ui, state.c_str());
      }
    }
  }
}

TEST_CASE("a column or the plots are left out before their text has no room, and a command brings the column back") {
  RunningApp ui(HeadlessApp::deterministic_options(), 900.0f, 600.0f);
  ui.run(100);
  ui.model().window().set_ui_scale(2.0f);
  ui.frames(3);
  CHECK(ui.app().items().find("solver/method") != nullptr);
  CHECK(ui.app().items().find("tab/look") == nullptr);
  CHECK(ui.app().items().find("plots/csv") == nullptr);
  ui.model().window().show_section("Mesh", false);
  ui.frames(3);
  CHECK(ui.app().items().find("section/Mesh") != nullptr);
  CHECK(ui.app().items().find("solver/method") == nullptr);
  ui.model().window().set_ui_scale(1.0f);
  ui.frames(3);
  CHECK(ui.app().items().find("solver/method") != nullptr);
  CHECK(ui.app().items().find("section/Mesh") != nullptr);
  CHECK(ui.app().items().find("plots/csv") != nullptr);
}

TEST_CASE("columns and plots that were dragged are shares of the window in the next run") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  {
    HeadlessApp ui(options, 1280.0f, 720.0f);
    ui.model().window().sizes().left = 384.0f;
    ui.model().window().sizes().right = 320.0f;
    ui.model().window().sizes().plots = 180.0f;
    ui.frame();
  }
  {
    HeadlessApp ui(options, 1920.0f, 1080.0f);
    CHECK(ui.model().window().sizes().left == approx(576.0f));
    CHECK(ui.model().window().sizes().right == approx(480.0f));
    CHECK(ui.model().window().sizes().plots == approx(270.0f));
  }
  HeadlessApp back(options, 1280.0f, 720.0f);
  CHECK(back.model().window().sizes().left == approx(384.0f));
}

TEST_CASE("the table of iterations keeps its columns and its height - default layout forgets them") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  {
    RunningApp ui(options, 1280.0f, 2000.0f);
    ui.run(100);
    ui.drag("iterations/height", {0.0f, 40.0f});
    ui.click("iterations/columns");
    ui.click("iterations/column/ratio");
  }
  const WindowSettings kept = *read_window_settings(options.settings);
  CHECK(kept.left_out == std::vector<std::string>{"ratio"});
  CHECK(kept.table_rows > 6.0);
  RunningApp ui(options, 1280.0f, 2000.0f);
  ui.run(100);
  CHECK(ui.model().window().columns_left_out() == kept.left_out);
  CHECK(ui.model().window().table_rows() == kept.table_rows);
  ui.model().window().reset_layout();
  ui.frame();
  CHECK(ui.model().window().columns_left_out().empty());
  CHECK(ui.model().window().table_rows() == 0.0);
}

TEST_CASE("the right column has a tab for every task, in no more than two screens at 1920 x 1080, and keeps it") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  {
    RunningApp ui(options, 1920.0f, 1080.0f);
    ui.run(600);
    ui.key('K');
    for (std::size_t t = 0; t < kTaskNames.size(); ++t) {
      ui.click("tab/" + std::string(kTaskNames[t]));
      ui.frames(3);
      for (const TaskSection& section : kTaskSections) {
        const bool there = ui.app().items().find("section/" + std::string(section.title)) != nullptr;
        CHECK(there == shows(static_cast<Task>(t), section.title));
      }
      const ImGuiWindow* column = ImGui::FindWindowByName("##right");
      CAPTURE(std::string(kTaskNames[t]));
      if (static_cast<Task>(t) != Task::all) CHECK(column->ScrollMax.y <= column->Size.y);
    }
    ui.click("tab/devices");
  }
  WindowSettings kept = *read_window_settings(options.settings);
  CHECK(kept.task == "devices");
}

TEST_CASE("a picked triangle's numbers are beside the pointer that rests on it") {
  RunningApp ui;
  ui.run(50);
  ui.click("view");
  REQUIRE(ui.model().view().picked_triangle != kNone);
  ui.frame();
  CHECK(ui.app().items().find("view/triangle_card") != nullptr);
  ui.model().view().picked_triangle = kNone;
  ui.frame();
  CHECK(ui.app().items().find("view/triangle_card") == nullptr);
}
