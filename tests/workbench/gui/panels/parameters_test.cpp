// Value fields, undo, favourites, A and B: effects of typing and dragging on the preset.
#include "tests/support/approx.h"
#include "tests/workbench/gui/running_app.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

TEST_CASE("a gain that is typed is sent once, on Enter, as a whole preset") {
  RunningApp ui;
  ui.run();
  const std::uint64_t sent = ui.model().presets().sent();
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("1");
  ui.type("3");
  ui.type("4");
  CHECK(ui.model().presets().sent() == sent);  // never 1, 13, 134 on the way
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  for (int i = 0; i < 3; ++i) ui.key(259);
  ui.type("0.75");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.75);
  CHECK(ui.model().presets().sent() == sent + 1);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 0.75);
  ui.run(5);
  CHECK(ui.model().devices().status().servo.preset_id == ui.model().devices().session()->preset_id());
}

TEST_CASE("a typed value counts when the focus goes elsewhere, and not after Escape") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.5");
  ui.click("transport/pause");
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.9");
  ui.key(HeadlessApp::kEscape);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
}

TEST_CASE("Tab commits and goes on to the next value") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("0.5");
  ui.key(HeadlessApp::kTab);
  ui.frames(2);
  ui.type("12");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(0.012));
}

TEST_CASE("a typed value out of range is cut to it with a warning - rubbish is refused with an error") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("99");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 10.0);
  CHECK(said(ui.model(), Severity::warning, "solver.gain_overall"));
  ui.click("solver/gain_overall");
  ui.frame();
  ui.type("fast");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 10.0);
  CHECK(said(ui.model(), Severity::error, "fast"));
}

TEST_CASE("typing may begin in the frame after the click") {
  RunningApp ui;
  ui.run(50);
  ui.move(ui.centre("solver/gain_overall"));
  ui.press();
  ui.release();
  ui.type("0.375");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.375);
}

TEST_CASE("dragging a value slides it, live - reset brings the program's own value back") {
  RunningApp ui;
  ui.run(50);
  ui.drag("solver/gain_overall", {30.0f, 0.0f});
  const double slid = ui.model().presets().current().solver.gain_overall;
  CHECK(slid > 1.0);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == slid);
  CHECK(ui.model().presets().editor().changed());
  ui.click("solver/gain_overall/reset");
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  CHECK_FALSE(ui.model().presets().editor().changed());
}

TEST_CASE("the display's controller is tuned in a section of its own, and bounds what the display is sent") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  CHECK(ui.app().items().find("controller/p_per_s2") == nullptr);
  ui.click("section/Display controller");
  ui.frames(2);
  for (const char* key :
       {"i_per_s3", "d_per_s", "target_weight", "lowest_m", "highest_m", "fastest_m_per_s", "largest_current_a"}) {
    CAPTURE(std::string(key));
    CHECK(ui.app().items().find(std::string("controller/") + key) != nullptr);
  }
  ui.click("controller/p_per_s2");
  ui.type("2500");
  ui.key(HeadlessApp::kEnter);
  ui.click("controller/highest_m");
  ui.type("3");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().devices().session()->preset().controller.p_per_s2 == 2500.0);
  CHECK(ui.model().devices().session()->preset().controller.highest_m == approx(3e-3));
  ui.run(3000);
  double furthest = 0.0;
  for (std::uint64_t tick = 1000; tick < 3000; ++tick) {
    ui.model().time().select_tick(tick);
    furthest = std::max(furthest, ui.model().time().tick().record()->device.cld_command_m);
  }
  CHECK(furthest == approx(3e-3));
}

TEST_CASE("every key of the schema has its row in the panel of its table, wherever it means anything") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  for (const PresetTable& table : preset_tables()) {
    ui.model().window().show_section(std::string(table.title), true);
    ui.frames(2);
    CHECK(ui.app().items().find("section/" + std::string(table.title)) != nullptr);
  }
  const PresetKey& shape = *find_preset_key("finger", "shape");
  std::set<std::string> seen;
  for (std::size_t s = 0; s < shape.choices.size(); ++s) {
    ui.model().presets().set_value(shape, static_cast<double>(s));
    ui.frames(2);
    for (const PresetKey& key : preset_keys()) {
      CAPTURE(key.full_name());
      CAPTURE(s);
      const KeyCondition& c = key.condition;
      const bool meant = c.holds == nullptr || !c.otherwise.empty() || c.holds(ui.model().presets().current());
      const std::string path = std::string(key.table) + "/" + std::string(key.key) + "/label";
      CHECK((ui.app().items().find(path) != nullptr) == meant);
      if (meant) seen.insert(key.full_name());
    }
  }
  CHECK(seen.size() == preset_keys().size());
}

TEST_CASE("typing 1345 sends 1345 once, never 1, 13 or 134, and undo takes it back whole") {
  RunningApp ui;
  ui.run(50);
  const std::uint64_t sent = ui.model().presets().sent();
  const double before = ui.model().presets().current().force.stiffness_n_per_m;
  ui.click("force/stiffness_n_per_m");
  ui.frame();
  for (const char* digit : {"1", "3", "4", "5"}) {
    ui.type(digit);
    ui.frames(2);
    CHECK(ui.model().presets().sent() == sent);
    CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == before);
  }
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().sent() == sent + 1);
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == 1345.0);
  CHECK(ui.model().presets().note(ui.model().devices().session()->preset_id()).find("1345") != std::string::npos);
  ui.chord('Z');
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == before);
  ui.chord('Y');
  CHECK(ui.model().devices().session()->preset().force.stiffness_n_per_m == 1345.0);
}

TEST_CASE("a drag is undone in one step") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run(50);
  ui.drag("solver/gain_overall", {30.0f, 0.0f});
  ui.drag("solver/gain_overall", {-10.0f, 0.0f});
  ui.chord('Z');
  CHECK(ui.model().presets().current().solver.gain_overall > 1.0);
  ui.chord('Z');
  CHECK(ui.model().presets().current().solver.gain_overall == 1.0);
  ui.click("compare/redo");
  CHECK(ui.model().presets().current().solver.gain_overall > 1.0);
}

TEST_CASE("one key switches between A and B, whole and at once, and the difference is listed and can be taken over") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run(50);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_overall"), 0.4);
  ui.model().presets().set_value(*find_preset_key("finger", "radius_m"), 0.009);
  ui.frame();
  ui.key('B');
  CHECK(ui.model().presets().slots().active_slot() == 1);
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 1.0);
  CHECK(ui.app().items().find("compare/key/finger.radius_m") != nullptr);
  ui.key('B');
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 0.4);
  ui.click("compare/key/solver.gain_overall");  // A on the left, B on the right
  CHECK(ui.model().devices().session()->preset().solver.gain_overall == 1.0);
  CHECK(ui.app().items().find("compare/key/solver.gain_overall") == nullptr);
  ui.click("compare/copy");
  ui.key('B');
  CHECK(ui.model().devices().session()->preset().finger.radius_m == 0.009);
}

TEST_CASE("a click on a name makes it a favourite, which is drawn once more on top and works there") {
  RunningApp ui;
  ui.run(50);
  ui.click("solver/gain_overall/label");
  CHECK(ui.model().window().favourites() == std::vector<std::string>{"solver.gain_overall"});
  ui.click("favourites/solver/gain_overall");
  ui.frame();
  ui.type("0.625");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.625);
  ui.click("favourites/solver/gain_overall/label");
  CHECK(ui.model().window().favourites().empty());
  ui.frame();
  CHECK(ui.app().items().find("favourites/solver/gain_overall") == nullptr);
}

TEST_CASE("the gain advice stands under the gains of the paper's method and can be taken") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2000.0f);
  ui.run();
  CHECK(ui.app().items().find("solver/advice") == nullptr);  // robust has no gains
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 0.001);
  ui.run(50);
  ui.click("solver/advice/set");
  CHECK(ui.model().presets().current().solver.gain_curvature_m == ui.model().presets().current().finger.radius_m);
}
