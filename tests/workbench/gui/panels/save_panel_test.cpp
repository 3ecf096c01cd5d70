// Figures and tables for a paper, saved by a user through the dialogue.
#include "workbench/gui/panels/save_panel.h"

#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/model/export_tables.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/figure_table.h"

#include <chrono>
#include <fstream>
#include <future>
#include <sstream>
#include <stop_token>
#include <thread>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::testing::TempFolder;

namespace {

struct SavingApp : HeadlessApp {
  TempFolder folder;
  explicit SavingApp(std::uint64_t ticks = 2000) : HeadlessApp(deterministic_options(), 1600.0f, 1000.0f) {
    model().exports().set_folder(folder.path());
    app().advance(ticks);
    frames(2);
  }
  std::string read(const char* name) const {
    std::ifstream file(folder.path() / name, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string last_message() { return model().messages().all().back().text; }
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool no_gnuplot() {
  if (std::system("command -v gnuplot >/dev/null 2>&1") == 0) return false;
  MESSAGE("skipped: no gnuplot");
  return true;
}

}  // namespace

TEST_CASE("the plots are saved as SVG with axes, units and where they come from, and as PDF") {
  if (no_gnuplot()) return;
  SavingApp ui;
  ui.click("plots/figure");
  ui.click("save/accept");
  REQUIRE(ui.last_message().find("plots.svg") != std::string::npos);
  const std::string svg = ui.read("plots.svg");
  for (const char* part :
       {"<svg", "Force [N]", "Display [mm]", "Time [s]", "<metadata>", "Mesh: icosphere, 320 triangles",
        "Preset: ", "Unit: 1 unit", "Command: workbench gui", "</svg>"}) {
    CAPTURE(part);
    CHECK(svg.find(part) != std::string::npos);
  }
  CHECK(svg.find("Tick time") == std::string::npos);  // simulated time has none
  ui.click("plots/figure");
  ui.click("save/ending/pdf");
  ui.click("save/accept");
  const std::string pdf = ui.read("plots.pdf");
  CHECK(pdf.substr(0, 5) == "%PDF-");
  CHECK(pdf.find("/Mesh <FEFF") != std::string::npos);
  CHECK(pdf.substr(pdf.size() - 6) == "%%EOF\n");
}

TEST_CASE("every kind of plot is a figure") {
  if (no_gnuplot()) return;
  SavingApp ui;
  for (const char* mode : {"X-Y", "Spectrum", "Histogram"}) {
    CAPTURE(mode);
    ui.click(std::string("plots/mode/") + mode);
    ui.frames(2);
    ui.click("plots/figure");
    ui.model().exports().dialog().name = std::string(mode) + ".svg";
    ui.frame();
    ui.click("save/accept");
    const std::string svg = ui.read((std::string(mode) + ".svg").c_str());
    CHECK(svg.find("Force x [N]") != std::string::npos);
    CHECK(svg.size() > 3000);
  }
}

TEST_CASE("plots without samples are no figure, and no file") {
  SavingApp empty(0);
  empty.click("plots/figure");
  empty.click("save/accept");
  CHECK(empty.last_message().find("nothing to draw") != std::string::npos);
  CHECK(empty.read("plots.svg").empty());
}

TEST_CASE("the dialogue asks before it writes over a file, and Esc puts it away") {
  SavingApp ui;
  std::ofstream(ui.folder.path() / "planes.csv") << "mine";
  ask_to_save(ui.model(), SaveWhat::planes);
  ui.frame();
  ui.click("save/accept");
  CHECK(ui.model().exports().dialog().asks_to_replace());
  CHECK(ui.read("planes.csv") == "mine");
  ui.key(HeadlessApp::kEscape);
  CHECK_FALSE(ui.model().exports().dialog().is_open());
  CHECK(ui.read("planes.csv") == "mine");
}

TEST_CASE("the planes of the tick in view are a table that says its mesh, preset, unit and command") {
  SavingApp ui;
  ui.click("transport/pause");
  ask_to_save(ui.model(), SaveWhat::planes);
  ui.frame();
  ui.click("save/accept");
  const std::string table = ui.read("planes.csv");
  CHECK(table.find("# Mesh: icosphere, 320 triangles, ") == 0);
  CHECK(table.find("\n# Command: workbench gui") != std::string::npos);
  CHECK(count_of(table, "\n" + std::to_string(ui.model().time().tick().record()->tick.tick) + ",") ==
        ui.model().time().tick().iterations().size());
}

TEST_CASE("the scene is saved at the width asked for, with alpha, and the window's own picture is as before") {
  const auto context = OffscreenContext::open();
  if (!context) {
    MESSAGE("skipped: " << context.error().message());
    return;
  }
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  SavingApp ui(200);
  ui.app().set_renderer(&renderer);
  ui.frames(2);
  const int width_px = renderer.width_px();
  ask_to_save(ui.model(), SaveWhat::scene);
  ui.model().exports().dialog().width_px = 900;
  ui.frame();
  ui.click("save/accept");
  ui.frames(2);
  const std::string png = ui.read("scene.png");
  REQUIRE(png.size() > 5000);
  CHECK(png.substr(16, 4) == std::string("\0\0\x03\x84", 4));
  CHECK(png[25] == 6);  // colour and alpha
  CHECK(png.find("workbench gui icosphere") != std::string::npos);
  CHECK(renderer.width_px() == width_px);
  // With labels and scales it is another picture of the same size, and the window's fonts stay as they are.
  const ImFont* font = ImGui::GetIO().Fonts->Fonts[0];
  ask_to_save(ui.model(), SaveWhat::scene);
  ui.frame();
  ui.click("save/overlay");
  ui.model().exports().dialog().name = "labelled.png";
  ui.frame();
  ui.click("save/accept");
  ui.frames(2);
  const std::string labelled = ui.read("labelled.png");
  REQUIRE(labelled.size() > png.size());
  CHECK(labelled.substr(16, 8) == png.substr(16, 8));
  CHECK(ImGui::GetIO().Fonts->Fonts[0] == font);
  ui.app().set_renderer(nullptr);
}

TEST_CASE("a figure is drawn while the window goes on, and what is cancelled leaves nothing") {
  if (no_gnuplot()) return;
  TempFolder folder;
  Figure figure{.name = "slow", .title = "Slow"};
  figure.script = "pause 20\nplot x\n";
  std::stop_source stop;
  auto drawn = std::async(std::launch::async,
                          [&] { return write_drawing(figure, {}, folder.path() / "slow.svg", stop.get_token()); });
  CHECK(drawn.wait_for(std::chrono::milliseconds(100)) == std::future_status::timeout);
  stop.request_stop();
  const Status done = drawn.get();
  REQUIRE_FALSE(done);
  CHECK(done.error().what.find("cancelled") != std::string::npos);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("one file is written at a time, and the message at its end says where it is") {
  AppOptions live;  // not deterministic: with threads
  live.mesh = "icosphere";
  MessageLog messages;
  ExportModel exports(live, messages);
  std::promise<void> go;
  exports.start("one.svg", [&, ready = go.get_future().share()](const std::stop_token&) -> Result<std::string> {
    ready.wait();
    return "written to one.svg";
  });
  CHECK(exports.writing());
  CHECK(exports.what() == "one.svg");
  exports.start("two.svg", [](const std::stop_token&) -> Result<std::string> { return "never"; });
  CHECK(messages.all().back().text.find("wait for one.svg") != std::string::npos);
  exports.take_finished();
  CHECK(exports.writing());
  go.set_value();
  for (int i = 0; i < 2000 && exports.writing(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    exports.take_finished();
  }
  CHECK(messages.all().back().text == "written to one.svg");
}

TEST_CASE("the map is a table of places and values, those that the window shows" * doctest::skip(testing::kSanitized)) {
  SavingApp ui(100);
  CHECK_FALSE(write_map_table(ui.model(), ui.folder.path() / "none.csv"));
  ui.model().map().on = true;
  ui.model().map().set_quantity(MapQuantity::curvature);
  ui.frames(3);
  REQUIRE(write_map_table(ui.model(), ui.folder.path() / "map.csv"));
  std::istringstream lines(ui.read("map.csv"));
  std::string line;
  while (std::getline(lines, line) && line.front() == '#') {}
  CHECK(line == "triangle,part,u,v,x_m,y_m,z_m,curvature_per_m");
  std::size_t rows = 0;
  int wrong = 0;
  for (; std::getline(lines, line); ++rows) {
    unsigned triangle = 0, part = 0;
    double u = 0, v = 0, x = 0, y = 0, z = 0, value = 0;
    REQUIRE(std::sscanf(line.c_str(), "%u,%u,%lf,%lf,%lf,%lf,%lf,%lf", &triangle, &part, &u, &v, &x, &y, &z, &value) ==
            8);
    wrong += value != ui.model().map().value_at(triangle, u, v);
    wrong += std::abs(std::sqrt(x * x + y * y + z * z) - 0.04) > 1e-3;
  }
  CHECK(rows == ui.model().map().statistics().values);
  CHECK(rows >= 320);
  CHECK(wrong == 0);
}
