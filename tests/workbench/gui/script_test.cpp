// Scripts: what a person does in the window, line by line; and what is said where a line can't be done.
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

/// Runs the lines to their end; why they did not, or nothing.
std::string run_script(HeadlessApp& ui, const testing::TempFolder& folder, const std::string& lines) {
  ui.app().run_script(folder.write("steps.txt", lines));
  for (int i = 0; i < 4000 && ui.app().script_running() && ui.app().script_failure().empty(); ++i) {
    ui.frame();
    ui.model().exports().take_picture_request();  // nothing is drawn here
  }
  CHECK_FALSE(ui.app().script_running());
  return ui.app().script_failure();
}

}  // namespace

TEST_CASE("a message about what was given to a field shows only what a terminal prints") {
  const testing::TempFolder folder;
  RunningApp ui;
  run_script(ui, folder, "enter devices/hand_speed \x1b[31m\xff fast\n");
  CHECK(test::said(ui.model(), Severity::error, "\"?[31m? fast\" is not a number"));
}

TEST_CASE("a tuner's session as a script: a mesh, the paper's method, a gain, its map, what differs, undo") {
  const testing::TempFolder folder;
  RunningApp ui;
  ui.model().exports().set_folder(folder.path());
  CHECK(run_script(ui, folder, R"(# find the worst place, and cure it
mesh torus
expect title torus
method paper
curvature gain 4 mm
expect solver.gain_curvature_m 4 mm
run 2000
pause on
expect title paused at
step -10
bookmark note before
curvature gain 20
wait for work
undo
expect solver.gain_curvature_m 4 mm
redo
map iterations-worst
wait for work
worst place
expect widget map/worst/0
press map/log
panel Compare
compare right built-in
press plots/mode/Spectrum
curve across Force y
export ticks
expect message ticks written to
theme light
text size 120
live
say done
expect message done
)") == "");
  CHECK(ui.model().window().theme() == Theme::light);
  CHECK(ui.model().window().ui_scale() == approx(1.2f));
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(20e-3));
  CHECK(ui.model().map().logarithmic());
  CHECK(std::any_of(ui.model().time().bookmarks().all().begin(), ui.model().time().bookmarks().all().end(),
                    [](const Bookmark& mark) { return mark.note == "before"; }));
  CHECK(ui.model().view().picked_triangle != kNone);
  CHECK_FALSE(ui.model().time().paused());
  CHECK(ui.app().items().find("plots/curve_x") != nullptr);
}

TEST_CASE("a widget is pressed and a field filled wherever it is: folded, scrolled away, in a hidden column") {
  const testing::TempFolder folder;
  RunningApp ui;
  ui.run(200);
  ui.model().window().sizes().show_right = ui.model().window().sizes().show_left = false;
  ui.model().window().open_sections()["Messages"] = false;
  CHECK(run_script(ui, folder, "say an apple\npress log/clear\n") == "");
  CHECK(ui.model().messages().all().empty());
  CHECK(run_script(ui, folder, "hand speed 35\nenter mesh/fit_mm 80\nenter presets/note worth keeping\n") == "");
  CHECK(ui.model().devices().session()->hand().speed_m_per_s == approx(0.035));
  CHECK(ui.model().scene().fit_m().value() == approx(0.08));
  CHECK(run_script(ui, folder, "enter solver/gain_overall 0.75\nenter solver/method newton\n") == "");
  CHECK(ui.model().presets().current().solver.gain_overall == 0.75);
  CHECK(ui.model().presets().current().solver.method == Method::newton);
}

TEST_CASE("a script that fails names its file and line, what is wrong and what to do, and does nothing further") {
  const testing::TempFolder folder;
  struct Wrong {
    const char *lines, *where, *what;
  };
  for (const Wrong& wrong : {Wrong{"\n# c\nfrobnicate\nundo\n", ":3", "there is no command"},
                             {"pause\ncurvature gain 1e9\n", ":2", "allowed: 0 to"},
                             {"open /nowhere/missing.obj\ntheme light\n", ":1", "missing.obj"},
                             {"press no/such\ntheme light\n", ":1", "no/such"},
                             {"enter solver/method cubic\ntheme light\n", ":1", "cubic"},
                             {"frame\nexpect title something else\n", ":2", "the title is \"icosphere"},
                             {"expect message there was none\n", ":1", "no message contains"},
                             {"expect solver.gain_overall 3\n", ":1", "solver.gain_overall is 1"},
                             {"undo\ntheme light\n", ":1", "nothing to undo"},
                             {"press transport/first\ntheme light\n", ":1", "is greyed"},
                             {"tune keep\ntheme light\n", ":1", "try a trial first"},
                             {"guard yes\ntheme light\n", ":1", "no question"},
                             {"sweep key nonsense\ntheme light\n", ":1", "nearest: solver."},
                             {"sweep key gain_curvatur_m\n", ":1", "nearest: solver.gain_curvature_m"},
                             {"sweep count many\ntheme light\n", ":1", "write 2 to 100"},
                             {"tune range gain_curvatur_m 0 80\n", ":1", "nearest: solver.gain_curvature_m"},
                             {"run 20\ntick 99999999\ntheme light\n", ":2", "there is no tick 99999999: they are 0 to"},
                             {"pause\nclose recording\ntheme light\n", ":2", "no recording is open"},
                             {"script steps.txt\n", ":1", "can't run another"}}) {
    CAPTURE(std::string(wrong.lines));
    RunningApp ui;
    const std::string why = run_script(ui, folder, wrong.lines);
    CHECK(why.find("steps.txt" + std::string(wrong.where)) != std::string::npos);
    CHECK(why.find(wrong.what) != std::string::npos);
    CHECK(ui.model().window().theme() == Theme::dark);
    CHECK(ui.app().wants_close());
  }
  for (const auto& [file, why] : {std::pair{(folder.path() / "none.txt").string(), "can't be opened"},
                                  std::pair{std::string("/dev/zero"), "zero byte"}}) {
    RunningApp ui;
    ui.app().run_script(file);
    CHECK(ui.app().script_failure().find(file) != std::string::npos);
    CHECK(ui.app().script_failure().find(why) != std::string::npos);
  }
}

TEST_CASE("the palette is a console: it runs lines with values, says why it can't, and brings back what was run") {
  RunningApp ui;
  ui.run(50);
  const auto run = [&](const char* line) {
    ui.chord('P');
    ui.type(line);
    ui.frame();
    ui.key(HeadlessApp::kEnter);
    ui.frames(2);
  };
  run("curvature gain 12");
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(12e-3));
  CHECK(ui.app().items().find("palette/text") == nullptr);
  run("method newton");
  CHECK(ui.model().presets().current().solver.method == Method::newton);
  run("curvature gain 1e9");
  CHECK(ui.app().items().find("palette/problem") != nullptr);
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(12e-3));
  ui.key(HeadlessApp::kEscape);
  ui.frames(2);
  // Up: the line before, and the one before that.
  ui.model().presets().undo();
  ui.model().presets().undo();
  constexpr int kUp = 265;
  ui.chord('P');
  ui.key(kUp);
  ui.key(kUp);
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  CHECK(ui.model().presets().current().solver.gain_curvature_m == approx(12e-3));
  CHECK(ui.model().presets().current().solver.method != Method::newton);
  // Without its value, the line is put into the box and waits for it.
  ui.chord('P');
  ui.type("overall gain");
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  REQUIRE(ui.app().items().find("palette/text") != nullptr);
  ui.type("0.5");
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  CHECK(ui.model().presets().current().solver.gain_overall == 0.5);
}

TEST_CASE("a script that a person starts in the window says its failure there, and the window stays") {
  const testing::TempFolder folder;
  RunningApp ui;
  ui.run(50);
  const std::string file = folder.write("mine.txt", "theme light\nfrobnicate\n");
  ui.chord('P');
  ui.type(("script " + file).c_str());
  ui.frame();
  ui.key(HeadlessApp::kEnter);
  ui.frames(12);
  CHECK(ui.model().window().theme() == Theme::light);
  CHECK(test::said(ui.model(), Severity::error, "mine.txt:2"));
  CHECK_FALSE(ui.app().wants_close());
}
