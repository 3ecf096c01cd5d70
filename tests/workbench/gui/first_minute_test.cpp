// The first minute: five steps on the first start, and an example for every job.
#include "tests/support/approx.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/examples.h"

#include <imgui_internal.h>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

bool steps_shown(HeadlessApp& ui) { return ui.app().items().find("first/show") != nullptr; }

void wait_for_script(HeadlessApp& ui) {
  ui.frame();
  for (int i = 0; i < 3000 && ui.app().script_running(); ++i) ui.frame();
  CHECK_FALSE(ui.app().script_running());
}

bool any_error(HeadlessApp& ui) {
  for (const Message& m : ui.model().messages().all())
    if (m.severity == Severity::error) return true;
  return false;
}

}  // namespace

TEST_CASE("five steps are shown on the first start, can be skipped, and come again by F1") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  {
    RunningApp ui(options);
    CHECK(steps_shown(ui));
    ui.click("first/next");
    ui.click("first/next");
    CHECK(steps_shown(ui));
    ui.click("first/skip");
    ui.frame();
    CHECK_FALSE(steps_shown(ui));
  }
  RunningApp ui(options);
  CHECK_FALSE(steps_shown(ui));
  ui.key(290);
  ui.click("shortcuts/first");
  ui.frame();
  CHECK(steps_shown(ui));
  CHECK(ui.app().items().find("shortcuts") == nullptr);
  for (int i = 0; i < 5; ++i) ui.click("first/next");
  ui.frame();
  CHECK_FALSE(steps_shown(ui));
  CHECK_FALSE(any_error(ui));
}

TEST_CASE("without settings that are kept, as for pictures, no steps are shown") {
  RunningApp ui;
  CHECK_FALSE(steps_shown(ui));
}

TEST_CASE("every step shows what it says: the paper's method with a gain that fails, a pause, the past under another") {
  RunningApp ui;
  ui.run(1500);
  ui.key(290);
  ui.click("shortcuts/first");
  for (int step = 0; step < 5; ++step) {
    ui.frame();
    ui.click("first/show");
    wait_for_script(ui);
    const Preset& preset = ui.model().presets().current();
    if (step == 0) CHECK(ui.model().view().toggles.smooth_surface);
    if (step == 1) CHECK(preset.solver.method == Method::paper);
    if (step == 1) CHECK(preset.solver.gain_curvature_m == approx(3e-3));
    if (step == 2) CHECK(ui.model().time().paused());
    if (step == 3) CHECK(preset.solver.gain_curvature_m == approx(20e-3));
    if (step == 4) CHECK(ui.app().items().find("palette/text") != nullptr);
    if (step < 4) ui.click("first/next");
  }
  CHECK_FALSE(any_error(ui));
}

TEST_CASE("the examples show their jobs: defects and tight places, gains that fail, a fault that stopped the force" *
          doctest::skip(testing::kSanitized)) {
  REQUIRE(examples().size() == 3);
  for (std::size_t i = 0; i < examples().size(); ++i) {
    CAPTURE(std::string(examples()[i].name));
    RunningApp ui;
    ui.run(1500);
    ui.click("menu/file");
    ui.click("menu/file/examples");
    ui.frames(2);
    ui.click(std::string("menu/file/examples/") + examples()[i].name);
    wait_for_script(ui);
    if (i != 2) CHECK_FALSE(any_error(ui));
    CHECK_FALSE(test::said(ui.model(), Severity::error, examples()[i].name));  // nor the script of the fault
    if (i == 0) CHECK(ui.model().scene().findings()->count(FindingKind::non_manifold_edge) > 0);
    if (i == 0) CHECK(ui.model().view().picked_triangle != kNone);
    if (i == 1) CHECK(ui.model().map().statistics().max > 0.0);
    if (i == 1) CHECK(ui.model().time().paused());
    if (i == 2) CHECK(ui.model().devices().stopped());
    if (i == 2) CHECK(ui.model().view().device_monitor);
  }
}
