// The window with its servo and worker threads, as in real use. Nothing here depends on their speed.
#include "tests/support/paths.h"
#include "tests/workbench/gui/headless_app.h"

#include "tests/support/meshes.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

/// Builds frames until `done` or half a minute is over.
template <class Done>
bool frames_until(HeadlessApp& ui, Done done) {
  for (int i = 0; i < 3000; ++i) {
    ui.frame();
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_CASE("a live session: records come while frames are built, gains reach the servo, meshes change under it") {
  AppOptions options;
  options.mesh = "icosphere";
  HeadlessApp ui(options);
  REQUIRE(frames_until(ui, [&] { return ui.model().time().end_tick() > 500; }));
  CHECK(ui.model().scene().audit() != nullptr);
  ui.model().presets().set_value(*find_preset_key("solver", "gain_curvature_m"), 0.013);
  const std::uint32_t sent = ui.model().devices().session()->preset_id();
  REQUIRE(frames_until(ui, [&] { return ui.model().devices().status().servo.preset_id == sent; }));
  ui.click("transport/pause");
  const std::uint64_t frozen = ui.model().time().tick().record()->tick.tick;
  REQUIRE(frames_until(ui, [&] { return ui.model().time().end_tick() > frozen + 300; }));
  CHECK(ui.model().time().tick().record()->tick.tick == frozen);
  ui.model().scene().open("torus");
  REQUIRE(frames_until(ui, [&] { return !ui.model().scene().loading() && ui.model().scene().path() == "torus"; }));
  ui.click("transport/live");
  const std::uint64_t then = ui.model().time().end_tick();
  REQUIRE(frames_until(ui, [&] { return ui.model().time().end_tick() > then + 500; }));
  CHECK(ui.model().time().tick().problem().empty());
  CHECK(ui.model().messages().all().empty());
}

TEST_CASE("the last mesh asked for is the one that is opened") {
  AppOptions options;
  options.mesh = "icosphere";
  HeadlessApp ui(options);
  for (const char* name : {"torus", "cube", "saddle", "cone"}) ui.model().scene().open(name);
  REQUIRE(frames_until(ui, [&] { return !ui.model().scene().loading(); }));
  CHECK(ui.model().scene().path() == "cone");
}

// What a frame costs. Not a test: run with --no-skip to measure.
TEST_CASE("measure: processor time of building a frame with the bunny and all plots" * doctest::skip()) {
  if (!testing::shared_files_there({"meshes/stanford-bunny.obj"})) return;
  const std::filesystem::path bunny = testing::shared_file("meshes/stanford-bunny.obj");
  for (const auto& [w, h] : {std::pair{1280.0f, 720.0f}, {3840.0f, 2160.0f}}) {
    AppOptions options = HeadlessApp::deterministic_options();
    options.mesh = bunny.string();
    options.metres_per_unit = 1.0;
    HeadlessApp ui(options, w, h);
    for (int i = 0; i < 120; ++i) ui.app().advance(1000);
    for (const double span : {5000.0, 120'000.0}) {
      ui.model().time().axis().set_span(span);
      std::vector<double> ms;
      for (int i = 0; i < 300; ++i) {
        ui.app().advance(16);
        ui.frame();
        ms.push_back(ui.app().last_build_ms());
      }
      std::sort(ms.begin(), ms.end());
      MESSAGE(w, " x ", h, ", ", span * 1e-3, " s in view: median ", ms[150], " ms, p99 ", ms[297], " ms, worst ",
              ms[299], " ms");
    }
  }
}

TEST_CASE("a preset that is opened is checked beside the running servo, and cancelling takes no time") {
  const std::filesystem::path shipped = testing::source_folder() + "/presets";
  AppOptions options;
  options.mesh = "icosphere";
  options.preset = shipped / "sphere.toml";
  HeadlessApp ui(options);
  EvidenceModel& evidence = ui.model().evidence();
  REQUIRE(frames_until(ui, [&] { return evidence.result() != nullptr; }));
  CHECK(evidence.label() == "holds");
  ui.model().presets().load(shipped / "cube.toml");
  ui.frame();
  CHECK(evidence.running());
  CHECK(evidence.label() == "checking");
  evidence.cancel();
  CHECK_FALSE(evidence.running());
  ui.frame();
  CHECK(evidence.label().empty());
  ui.model().presets().load_built_in();
  ui.frame();
  CHECK_FALSE(evidence.running());
}
