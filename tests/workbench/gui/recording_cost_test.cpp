// What the window costs with a recording open. Measurements, no tests: run them with --no-skip.
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

std::string p50_p99_worst(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
  };
  char text[80];
  std::snprintf(text, sizeof text, "%.2f / %.2f / %.2f ms", at(0.5), at(0.99), values.back());
  return text;
}

/// Scrolls through `seconds` of the time about `middle`, a hundredth of them a frame, there and back.
std::string scroll(HeadlessApp& ui, double seconds, double middle) {
  TimeModel& time = ui.model().time();
  const double ticks = seconds / time.tick_period_s();
  std::vector<double> ms;
  for (int i = 0; i < 330; ++i) {
    const double shift = 0.01 * ticks * static_cast<double>(i < 165 ? i : 330 - i);
    time.axis().show(middle - 0.5 * ticks + shift, middle + 0.5 * ticks + shift);
    ui.frame();
    if (i >= 30) ms.push_back(ui.app().last_build_ms());
  }
  return p50_p99_worst(std::move(ms));
}

AppOptions options_of(bool deterministic) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  options.deterministic = deterministic;
  return options;
}

void wait_for_pages(HeadlessApp& ui) {
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ui.frames(2);
  } while (ui.model().recordings().busy());
}

/// 20 s of a mesh, 80 mm, under the paper's iteration, so that there is something to explain.
void record_mesh(const std::string& mesh, const std::string& path) {
  AppOptions options = options_of(true);
  options.mesh = mesh;
  options.mesh_options.fit_m = 0.08;
  RunningApp ui(options);
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.run(20'000);
  ui.model().record().write_history(path);
}

}  // namespace

TEST_CASE("measure: processor time of a frame that scrolls the live history, and an open recording" * doctest::skip()) {
  constexpr std::uint64_t kHistory = 600'000;
  {
    RunningApp live(options_of(true), 1280.0f, 720.0f);
    live.run(kHistory);
    live.model().time().select_tick(kHistory / 2);
    for (const double seconds : {1.0, 10.0, 100.0})
      MESSAGE("live history, " << seconds << " s in view: p50 / p99 / worst "
                               << scroll(live, seconds, 0.5 * static_cast<double>(kHistory)));
  }
  const char* path = std::getenv("TANGENT_LONG_RECORDING");
  if (path == nullptr) {
    MESSAGE("TANGENT_LONG_RECORDING names no recording");
    return;
  }
  HeadlessApp ui(options_of(false), 1280.0f, 720.0f);
  ui.model().open(path);
  wait_for_pages(ui);
  REQUIRE(ui.model().time().recording() != nullptr);
  const std::uint64_t middle = ui.model().time().recording()->info().last_tick / 2;
  ui.model().time().select_tick(middle);
  wait_for_pages(ui);
  for (const double seconds : {1.0, 10.0, 100.0, 3600.0, 18'000.0})
    MESSAGE("recording, " << seconds << " s in view: p50 / p99 / worst "
                          << scroll(ui, seconds, static_cast<double>(middle)));
}

TEST_CASE("measure: from a tick that is chosen to why it did what it did" * doctest::skip()) {
  const testing::TempFolder folder;
  for (const char* name : {"spot", "fandisk", "stanford-bunny"}) {
    const auto mesh = testing::shared_file(std::string("meshes/") + name + ".obj");
    const std::string path = folder.file(std::string(name) + ".sqlite");
    record_mesh(mesh.string(), path);
    HeadlessApp ui(options_of(false), 1280.0f, 720.0f);
    ui.model().open(path);
    wait_for_pages(ui);
    std::vector<double> found, shown;
    std::size_t told = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const auto began = std::chrono::steady_clock::now();
      ui.model().time().select_tick(19 * i + 500);
      const Why* why = nullptr;
      while ((why = ui.model().why().of_tick_in_view()) == nullptr)
        std::this_thread::sleep_for(std::chrono::microseconds(50));
      shown.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
      found.push_back(why->ms);
      told += why->told.cause != TickCause::nothing ? 1 : 0;
    }
    MESSAGE(std::string(name) << ": " << told << " of 1000 ticks have something to tell; found in "
                              << p50_p99_worst(found) << ", from the choice of the tick " << p50_p99_worst(shown));
  }
}
