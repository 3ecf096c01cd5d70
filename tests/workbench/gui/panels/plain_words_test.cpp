// What the window says: the first thing about a mesh of which much is missing, what limits count, faults, marks.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/panels/attempts_text.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/theme/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

AppOptions options_with_mesh(const std::string& mesh) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = mesh;
  return options;
}

/// Vertices of this colour inside an item.
int vertices_in(const ItemRect& rect, ImU32 ink) {
  int count = 0;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (const ImDrawVert& v : data.CmdLists[i]->VtxBuffer) {
      if (v.col == ink && v.pos.x >= rect.min.x && v.pos.x <= rect.max.x && v.pos.y >= rect.min.y &&
          v.pos.y <= rect.max.y)
        ++count;
    }
  }
  return count;
}

bool tooltip_shown() {
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    if (std::string_view(data.CmdLists[i]->_OwnerName).substr(0, 9) == "##Tooltip") return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a mesh of which three of four triangles are left out says so first") {
  const tangent::testing::TempFolder folder;
  HeadlessApp ui(options_with_mesh(folder.write("thin.obj",
                                                "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 20 0 0\nv 30 0 0\n"
                                                "f 1 2 3\nf 1 4 2\nf 1 5 2\nf 1 4 5\n")));
  REQUIRE_FALSE(ui.model().messages().all().empty());
  const Message& first = ui.model().messages().all().front();
  CHECK(first.severity == Severity::warning);
  CHECK(first.text.find("3 of 4 triangles are left out") != std::string::npos);
}

TEST_CASE("a tick's outcome names its status, its event and that it searches on") {
  TickOutput out;
  out.status = TickStatus::face;
  CHECK(outcome_text(out) == "face");
  out.searching = true;
  CHECK(outcome_text(out) == "face, searching");
  out.event = TickEvent::switched;
  CHECK(outcome_text(out) == "face, switch, searching");
}

TEST_CASE("the planes of a tick are counted by attempt, beside the limit of one attempt") {
  std::vector<IterationRecord> records(51);
  CHECK(attempts_text(std::span(records).first(2), 0, 1, 50) == "Tracking 1; limit 50 per attempt");
  for (int i = 0; i < 47; ++i) {
    records.emplace_back();
    records.back().seed = i < 30 ? 1 : 2;
  }
  CHECK(attempts_text(records, 0, 97, 50) == "Tracking 50, seeds 30 + 17; limit 50 per attempt");
  CHECK(attempts_text(records, 0, 100, 50) == "Tracking 50, seeds 30 + 17, searched 3; limit 50 per attempt");
  CHECK(attempts_text({}, 0, 0, 50) == "Tracking 0; limit 50 per attempt");
  HeadlessApp ui;
  ui.app().advance(50);
  ui.frames(2);
  CHECK(ui.app().items().find("iterations/attempts") != nullptr);
}

TEST_CASE("after a fault the button that arms is red, before one it is not") {
  HeadlessApp ui;
  const ImU32 red = theme_colours(Theme::dark).bad;
  ui.model().devices().stop();
  ui.app().advance(50);
  ui.frames(3);
  REQUIRE(ui.app().items().find("arming/arm") != nullptr);
  CHECK(vertices_in(*ui.app().items().find("arming/arm"), red) == 0);
  Session& session = *ui.model().devices().session();
  session.arm();
  ui.app().advance(3000);
  session.inject({InjectedFault::drop_out, 200}, false);
  ui.app().advance(100);
  ui.frames(3);
  REQUIRE(ui.model().devices().faulted());
  CHECK(ui.model().devices().arming_text().size() > std::string("No force: ").size());
  REQUIRE(ui.app().items().find("arming/arm") != nullptr);
  CHECK(vertices_in(*ui.app().items().find("arming/arm"), red) > 0);
}

TEST_CASE("the legend of the plots names bands, events and lines, and goes away again") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1600.0f, 1000.0f);
  ui.app().advance(500);
  ui.click("plots/legend");
  ui.frames(2);
  CHECK(ui.app().items().find("plots/legend/Bookmarked: unconverged") != nullptr);
  CHECK(ui.app().items().find("plots/legend/Unconverged") != nullptr);
  CHECK(ui.app().items().find("plots/legend/Thin line: ghost, the past solved again") != nullptr);
  ui.click("plots/legend");
  ui.frames(2);
  CHECK(ui.app().items().find("plots/legend/Unconverged") == nullptr);
}

TEST_CASE("every kind of bookmark has a colour of its own, in all themes") {
  ItemMap items;
  Typing typing;
  Resting resting;
  const ThemeFonts fonts;
  std::map<std::string, bool> sections;
  constexpr std::array kKinds{BookmarkKind::user,  BookmarkKind::reseeded,    BookmarkKind::iterations,
                              BookmarkKind::force, BookmarkKind::unconverged, BookmarkKind::device_fault};
  for (std::size_t t = 0; t < kThemeCount; ++t) {
    const auto theme = static_cast<Theme>(t);
    const UiContext ui{items, typing, resting, theme_colours(theme), palette(theme), fonts, sections};
    for (const BookmarkKind a : kKinds)
      for (const BookmarkKind b : kKinds) {
        if (a >= b) continue;
        const ImVec4 p = ImGui::ColorConvertU32ToFloat4(bookmark_ink(ui, a)),
                     q = ImGui::ColorConvertU32ToFloat4(bookmark_ink(ui, b));
        INFO("theme ", t, ": ", to_string(a), " and ", to_string(b));
        CHECK(std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)}) > 0.1f);
      }
  }
}

TEST_CASE("no tooltip covers a value while it is typed") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1600.0f, 1000.0f);
  const char* field = "solver/tolerance_m";
  ui.move(ui.centre(field));
  ui.frames(60);
  CHECK(tooltip_shown());
  ui.click(field);
  ui.frames(60);
  CHECK_FALSE(tooltip_shown());
  ui.type("3");
  ui.frames(60);
  CHECK_FALSE(tooltip_shown());
}

TEST_CASE("the status line says the whole frame's time, once it is known") {
  HeadlessApp ui;
  CHECK(ui.app().items().find("status/frame") == nullptr);
  ui.input().last_frame_ms = 37.0;
  ui.input().width = 1900.0f;
  ui.frames(2);
  CHECK(ui.app().items().find("status/frame") != nullptr);
}

TEST_CASE("the whole finger is in view wherever it goes around a 2D outline") {
  const tangent::testing::TempFolder folder;
  HeadlessApp ui(options_with_mesh(
      folder.write("outline.csv", "x_m,y_m\n-0.06,-0.03\n0.055,-0.034\n0.048,0.018\n-0.018,0.04\n-0.05,0.034\n")));
  for (int i = 0; i < 120; ++i) {
    ui.app().advance(100);
    ui.frame();
    const ItemRect finger = *ui.app().items().find("planar/finger"), view = *ui.app().items().find("view");
    CHECK(finger.min.x >= view.min.x);
    CHECK(finger.min.y >= view.min.y);
    CHECK(finger.max.x <= view.max.x);
    CHECK(finger.max.y <= view.max.y);
  }
}
