// The transport bar, the iteration table and the plots, driven by a user: effects on the tick in view.
#include "tests/support/approx.h"
#include "tests/workbench/gui/running_app.h"

#include <cmath>
#include <iterator>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

TEST_CASE("clicking Pause freezes the tick in view - live again follows the newest") {
  RunningApp ui;
  ui.run();
  CHECK_FALSE(ui.model().time().paused());
  ui.click("transport/pause");
  REQUIRE(ui.model().time().paused());
  const std::uint64_t frozen = ui.model().time().tick().record()->tick.tick;
  ui.run(200);
  CHECK(ui.model().time().tick().record()->tick.tick == frozen);
  CHECK(ui.model().time().end_tick() > frozen + 100);  // the recording went on
  ui.click("transport/live");
  CHECK_FALSE(ui.model().time().paused());
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().end_tick() - 1);
}

TEST_CASE("buttons and arrow keys step by one tick, back and forth") {
  RunningApp ui;
  ui.run();
  ui.click("transport/pause");
  const std::uint64_t at = ui.model().time().tick().record()->tick.tick;
  ui.click("transport/step_back");
  CHECK(ui.model().time().tick().record()->tick.tick == at - 1);
  ui.key(HeadlessApp::kLeft);
  CHECK(ui.model().time().tick().record()->tick.tick == at - 2);
  ui.key(HeadlessApp::kRight);
  ui.click("transport/step_forward");
  CHECK(ui.model().time().tick().record()->tick.tick == at);
  ui.click("transport/step_forward");  // there is no later one
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().end_tick() - 1);
  ui.key(HeadlessApp::kHome);
  CHECK(ui.model().time().tick().record()->tick.tick == ui.model().time().first_tick());
  ui.key(HeadlessApp::kEnd);
  CHECK_FALSE(ui.model().time().paused());
}

TEST_CASE("full stop and comma walk through the iterations and on into the neighbouring ticks") {
  RunningApp ui;
  ui.run();
  ui.key(HeadlessApp::kSpace);
  REQUIRE(ui.model().time().paused());
  const std::uint64_t at = ui.model().time().tick().record()->tick.tick;
  const std::size_t count = ui.model().time().tick().iterations().size();
  REQUIRE(count >= 1);
  ui.model().time().select_tick(at - 5);
  ui.frame();
  const std::size_t here = ui.model().time().tick().iterations().size();
  for (std::size_t i = 0; i < here; ++i) {
    ui.key('.');
    CHECK(ui.model().time().tick().selected() == i);
  }
  ui.key('.');
  CHECK(ui.model().time().tick().record()->tick.tick == at - 4);
  CHECK(ui.model().time().tick().selected() == std::size_t{0});
  ui.key(',');
  CHECK(ui.model().time().tick().record()->tick.tick == at - 5);
  CHECK(ui.model().time().tick().selected() == here - 1);
}

TEST_CASE("the iterations in view are those of the recorded tick, computed again") {
  RunningApp ui;
  ui.run();
  for (std::uint64_t back : {1u, 77u, 500u}) {
    ui.model().time().select_tick(ui.model().time().end_tick() - back);
    const ServoRecord& record = *ui.model().time().tick().record();
    CHECK(ui.model().time().tick().problem().empty());
    const auto iterations = ui.model().time().tick().iterations();
    REQUIRE(!iterations.empty());
    CHECK(iterations.back().error_m == record.tick.output.error_m);
  }
}

TEST_CASE("the wheel over a plot zooms time about the pointer once it is held") {
  RunningApp ui;
  ui.run();
  ui.click("transport/pause");
  const ItemRect rect = *ui.app().items().find("plots/force");
  const ImVec2 at{std::floor(rect.min.x + 0.3f * (rect.max.x - rect.min.x)),
                  std::floor(rect.centre().y)};  // ImGui rounds the mouse down
  const auto tick_at = [&] {
    return ui.model().time().axis().tick_at(static_cast<double>(at.x), static_cast<double>(rect.min.x),
                                            static_cast<double>(rect.max.x - rect.min.x));
  };
  const double before = tick_at(), span = ui.model().time().axis().span();
  ui.wheel(at, 2.0f);
  CHECK(ui.model().time().axis().span() < span);
  CHECK(tick_at() == approx(before));
}

TEST_CASE("dragging a plot pans and stops following - clicking it selects that tick") {
  RunningApp ui;
  ui.run();
  REQUIRE(ui.model().time().axis().following());
  ui.model().time().axis().set_span(1000.0);
  ui.frame();
  ui.drag("plots/error", {40.0f, 0.0f});
  CHECK_FALSE(ui.model().time().axis().following());
  CHECK(ui.model().time().axis().to() < 1500.0);
  ui.click("plots/error");
  REQUIRE(ui.model().time().paused());
  const double middle = 0.5 * (ui.model().time().axis().from() + ui.model().time().axis().to());
  CHECK(std::abs(static_cast<double>(ui.model().time().tick().record()->tick.tick) - middle) <= 3.0);
}

TEST_CASE("legend entries hide and show their curve") {
  RunningApp ui;
  ui.run(300);
  CHECK(ui.app().items().find("plots/force/x") != nullptr);
  ui.click("plots/force/x");
  ui.click("plots/force/x");
}

TEST_CASE("a click on a row of the iteration table pauses and selects that iteration - another lets go of it") {
  RunningApp ui;
  ui.run();
  ui.click("iterations/row/0");
  CHECK(ui.model().time().paused());
  CHECK(ui.model().time().tick().selected() == std::size_t{0});
  ui.click("iterations/row/0");
  CHECK_FALSE(ui.model().time().tick().selected().has_value());
}
