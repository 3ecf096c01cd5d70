// The plots driven by a user: modes, cursors, values, export.
#include "tests/workbench/gui/headless_app.h"

#include "tests/support/temp_folder.h"
#include "workbench/gui/platform/save_picture.h"

#include <algorithm>
#include <fstream>
#include <sstream>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct PlotsApp : HeadlessApp {
  PlotsApp() : HeadlessApp(deterministic_options(), 1600.0f, 1000.0f) {}
  void run(std::uint64_t ticks) {
    app().advance(ticks);
    frames(2);
  }
};

bool said(const AppModel& model, const char* part) {
  for (const Message& m : model.messages().all()) {
    if (m.text.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("follow, hold and inspect are one button each, and say which it is") {
  PlotsApp ui;
  ui.run(2000);
  CHECK(ui.model().time().axis().following());
  ui.click("plots/hold");
  CHECK_FALSE(ui.model().time().axis().following());
  CHECK_FALSE(ui.model().time().paused());
  const double to = ui.model().time().axis().to();
  ui.run(300);
  CHECK(ui.model().time().axis().to() == to);
  CHECK(ui.model().time().tick().record()->tick.tick == 2299);  // the rest of the window goes on
  ui.click("plots/inspect");
  CHECK(ui.model().time().paused());
  ui.click("plots/follow");
  CHECK_FALSE(ui.model().time().paused());
  CHECK(ui.model().time().axis().to() == 2300.0);
}

TEST_CASE("every mode draws, with an empty store, a short one and a long one") {
  PlotsApp ui;
  for (const std::uint64_t ticks : {0u, 40u, 3000u, 6000u}) {
    ui.run(ticks);
    ui.model().time().axis().show_all();
    for (const char* mode : {"X-Y", "Spectrum", "Histogram", "Time"}) {
      ui.click(std::string("plots/mode/") + mode);
      ui.frames(3);
      CHECK((ui.app().items().find("plots/other") != nullptr) == (std::string(mode) != "Time"));
      CHECK((ui.app().items().find("plots/force") != nullptr) == (std::string(mode) == "Time"));
    }
    ui.click("plots/values");
    ui.frames(2);
    CHECK(ui.app().items().find("plots/values_table") != nullptr);
    ui.click("plots/values");
  }
  ui.click("plots/mode/X-Y");
  ui.click("plots/curve_y");
  ui.click("plots/curve_y/Error");
  ui.frames(2);
}

TEST_CASE("Ctrl-click sets A and Shift-click B, without leaving the tick in view - CSV then writes what lies between") {
  const tangent::testing::TempFolder folder;
  PlotsApp ui;
  ui.model().exports().set_folder(folder.path());
  ui.run(3000);
  ui.click("transport/pause");
  const std::uint64_t seen = ui.model().time().tick().record()->tick.tick;
  ui.model().time().axis().show(1000.0, 2000.0);
  ui.frame();
  const ItemRect rect = *ui.app().items().find("plots/force");
  const auto click_at = [&](float share, bool ctrl) {
    ui.move({std::floor(rect.min.x + share * (rect.max.x - rect.min.x)), std::floor(rect.centre().y)});
    (ctrl ? ImGui::GetIO().KeyCtrl : ImGui::GetIO().KeyShift) = true;
    ui.press();
    ui.release();
    ui.frame();
    ImGui::GetIO().KeyCtrl = ImGui::GetIO().KeyShift = false;
    ui.frame();
  };
  click_at(0.25f, true);
  click_at(0.5f, false);
  CHECK(ui.model().time().tick().record()->tick.tick == seen);
  ui.click("plots/csv");
  REQUIRE(said(ui.model(), "ticks written to"));
  std::filesystem::path written;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() == ".csv") written = entry.path();
  std::ifstream file(written);
  std::string line;
  std::getline(file, line);
  CHECK(line.substr(0, 14) == "tick,t_s,statu");
  std::uint64_t first = 0, last = 0, lines = 0;
  while (std::getline(file, line)) {
    last = std::stoull(line);
    if (lines++ == 0) first = last;
  }
  CHECK(first >= 1245);
  CHECK(first <= 1255);
  CHECK(last >= 1495);
  CHECK(last <= 1505);
  CHECK(lines == last - first + 1);
}

TEST_CASE("exported samples read back as the recorded doubles - a file is never written over") {
  const tangent::testing::TempFolder folder;
  PlotsApp ui;
  ui.model().exports().set_folder(folder.path());
  ui.run(200);
  ui.model().exports().write_ticks(ui.model().time().past().shown().records, 50, 60);
  ui.model().exports().write_ticks(ui.model().time().past().shown().records, 50, 60);
  CHECK(folder.entry_count() == 4);  // each with what its columns are
  std::ifstream file(folder.path() / "ticks-50-59.csv");
  std::string line;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, line, ',');) names.push_back(line);
  std::getline(file, line);
  std::vector<std::string> cells;
  for (std::istringstream row(line); std::getline(row, line, ',');) cells.push_back(line);
  REQUIRE(cells.size() == names.size());
  const ServoRecord& record = *ui.model().devices().session()->history().find(50);
  const auto value = [&](const char* name) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == name) return std::stod(cells[i]);
    }
    FAIL("no column ", name);
    return 0.0;
  };
  CHECK(value("tick") == 50.0);
  CHECK(value("force_z_n") == record.tick.output.force_n.z);
  CHECK(value("error_m") == record.tick.output.error_m);
  CHECK(value("cld_measured_m") == record.device.cld_measured_m);
  CHECK(value("finger_x_m") == record.tick.input.finger.position.x);
  ui.model().exports().set_folder("/nowhere/at/all");
  ui.model().exports().write_ticks(ui.model().time().past().shown().records, 50, 60);
  CHECK(ui.model().messages().all().back().severity == Severity::error);
}

TEST_CASE("PNG asks the platform for the plots' part of the window, which is cut out of it") {
  const tangent::testing::TempFolder folder;
  PlotsApp ui;
  ui.model().exports().set_folder(folder.path());
  ui.run(100);
  ui.click("plots/png");
  const auto request = ui.model().exports().take_picture_request();
  REQUIRE(request);
  CHECK_FALSE(ui.model().exports().take_picture_request());
  const ItemRect plot = *ui.app().items().find("plots/force");
  CHECK(request->of.y <= plot.min.y);
  CHECK(request->of.bottom() >= plot.max.y);
  Image whole{3200, 2000, std::vector<std::uint8_t>(4 * 3200 * 2000)};
  for (int y = 0; y < 2000; ++y)
    whole.rgba[4 * (static_cast<std::size_t>(y) * 3200)] = static_cast<std::uint8_t>(y % 251);
  const Image part = cut_out(whole, {0.0f, 100.0f, 50.0f, 20.0f}, 2.0);
  CHECK(part.width == 100);
  CHECK(part.height == 40);
  CHECK(part.at(0, 3)[0] == 203 % 251);
  CHECK(cut_out(whole, {5000.0f, 0.0f, 10.0f, 10.0f}, 1.0).rgba.empty());
  save_picture(ui.model(), *request, whole, 2.0);
  CHECK(std::filesystem::exists(folder.path() / "plots.png"));
}

TEST_CASE("a legend entry hides its curve from the axis and brings it back") {
  PlotsApp ui;
  ui.run(3000);
  ui.click("plots/values");
  const auto vertices = [&] {
    ui.frames(2);
    return ImGui::GetDrawData()->TotalVtxCount;
  };
  ui.move({5.0f, 5.0f});
  const int all = vertices();
  ui.click("plots/force/x");
  ui.move({5.0f, 5.0f});
  const int without = vertices();
  CHECK(without < all);
  ui.click("plots/force/x");
  ui.move({5.0f, 5.0f});
  CHECK(vertices() == all);
}

TEST_CASE("channels are dragged from the list onto a plot, several at once, from a legend too, and removed again") {
  PlotsApp ui;
  ui.run(3000);
  ui.click("plots/channels");
  ui.frames(2);
  const PlotLists& lists = ui.model().window().plots();
  const auto onto = [&](const std::string& from, const std::string& plot) {
    ui.move(ui.centre(from));
    ui.press();
    const ImVec2 a = ui.centre(from), b = ui.centre(plot);
    ui.move({a.x + 10.0f, a.y + 3.0f});
    ui.move(b);
    ui.release();
    ui.frames(2);
  };
  onto("plots/channel/energy", "plots/force");
  CHECK(lists.of(0).back() == "energy");
  CHECK(ui.app().items().find("plots/force/Energy") != nullptr);
  ui.click("plots/channel/iterations");
  ui.click("plots/channel/error");
  onto("plots/channel/error", "plots/energy");
  CHECK(lists.of(5) == PlotLists::Texts{"energy", "error", "iterations"});
  ui.click("plots/channels");
  onto("plots/cld/commanded", "plots/iterations");
  CHECK(lists.of(3) == PlotLists::Texts{"iterations", "cld_commanded"});
  ui.click("plots/iterations/Display commanded", 1);
  CHECK(lists.of(3) == PlotLists::Texts{"iterations"});
  ui.click("plots/values");
  onto("plots/value/force_z", "plots/cld");
  CHECK(lists.of(1).back() == "force_z");
}

TEST_CASE("a derived channel is made from the list, drawn in a plot, and known to X-Y, spectrum and histogram") {
  PlotsApp ui;
  ui.run(3000);
  ui.click("plots/channels");
  ui.click("plots/make/how");
  ui.click("plots/make/how/Low-pass filter of a");
  ui.click("plots/make");
  const std::string key = ui.model().window().plots().made().at(0);
  CHECK(key == "low_pass(force_felt, 5 Hz)");
  REQUIRE(ui.model().window().plots().add("error", key));
  REQUIRE(ui.model().window().plots().remove("error", "error"));
  ui.frames(2);
  CHECK(ui.app().items().find("plots/error/Force felt up to 5 Hz") != nullptr);
  const tangent::testing::TempFolder folder;
  const auto script = folder.path() / "steps.txt";
  for (const char* mode : {"X-Y", "Spectrum", "Histogram"}) {
    std::ofstream(script) << "plots " << mode << "\ncurve across Error\nwait 0.1\ncurve across Force felt up to 5 Hz\n";
    ui.app().run_script(script);
    ui.frames(60);
    CHECK(ui.app().script_failure().empty());
    CHECK_FALSE(ui.app().script_running());
  }
  ui.click("plots/mode/Time");
  ui.click("plots/channel/" + key, 1);
  CHECK(ui.model().window().plots().made().empty());
  CHECK(ui.app().items().find("plots/error/Force felt up to 5 Hz") == nullptr);
  CHECK(ui.app().items().find("plots/error") != nullptr);  // empty: it says what to do
}

TEST_CASE("the plots' channels are kept between runs") {
  const tangent::testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  std::ofstream(options.settings) << "format = 1\n";
  {
    HeadlessApp ui(options);
    REQUIRE(ui.model().window().plots().add("tick_time", "difference(force_x, force_z)"));
    ui.frames(2);
  }
  HeadlessApp ui(options);
  CHECK(ui.model().window().plots().of(4) == PlotLists::Texts{"tick_time", "difference(force_x, force_z)"});
  CHECK(ui.app().items().find("plots/tick_time/Force x \u2212 Force z") != nullptr);
}
