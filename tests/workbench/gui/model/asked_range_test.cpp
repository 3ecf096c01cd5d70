// What-if, sweep and Why on ticks of a recording that are not loaded: read when they are asked for, as far as they fit.
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"

#include <chrono>
#include <thread>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

constexpr std::uint64_t kTicks = 9000;

void record_long_torus(const std::string& path, std::uint64_t ticks = kTicks) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  RunningApp ui(options);
  ui.run(ticks);
  ui.model().record().write_history(path);
}

/// A recording of which `page_s` seconds are loaded at a time.
struct LongApp : RunningApp {
  LongApp(const std::string& path, double page_s, std::size_t solved_bytes = 0, bool deterministic = true)
      : RunningApp(options(page_s, solved_bytes, deterministic), 1600.0f, 4200.0f) {
    model().window().open_sections()["Sweep"] = true;
    model().open(path);
    for (int i = 0; i < 4000 && model().recordings().busy(); ++i, frame())
      std::this_thread::sleep_for(std::chrono::milliseconds(deterministic ? 0 : 2));
    frames(2);
    REQUIRE(time().recording() != nullptr);
  }
  static AppOptions options(double page_s, std::size_t solved_bytes, bool deterministic) {
    AppOptions options = deterministic_options();
    options.history_s = page_s;
    options.solved_bytes = solved_bytes;
    options.deterministic = deterministic;
    return options;
  }
  TimeModel& time() { return model().time(); }
  void set_cursors(std::uint64_t a, std::uint64_t b) {
    if (time().selection()) {  // a click takes a cursor away that is set
      click("plots/cursor_a");
      click("plots/cursor_b");
    }
    time().select_tick(a);
    click("plots/cursor_a");
    time().select_tick(b);
    click("plots/cursor_b");
    REQUIRE(time().selection() == TickRange{a, b});
  }
  void set_tolerance(double factor) {
    const PresetKey& tolerance = *find_preset_key("solver", "tolerance_m");
    model().presets().set_value(tolerance, factor * tolerance.get(Preset{}));
    frames(2);
  }
};

}  // namespace

TEST_CASE("what-if on ticks of a recording that are not loaded is what it is where all of it is") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"));
  const auto solved = [&folder](double page_s) {
    LongApp ui(folder.file("run.sqlite"), page_s);
    ui.set_cursors(1000, 8000);
    ui.set_tolerance(30.0);
    if (page_s < 5.0) {
      CHECK(ui.time().selection_to_load());
      CHECK(ui.time().ghost()->channels->end_tick() - ui.time().ghost()->channels->first_tick() == 2000);
      ui.click("time_machine/read");
      CHECK(ui.app().items().find("time_machine/read") == nullptr);
      CHECK(ui.time().past().main().records.size() == 2000);  // the page is what it was
    }
    ui.frames(2);
    REQUIRE(ui.time().ghost() != nullptr);
    CHECK(ui.time().ghost()->channels->first_tick() <= 1000);
    CHECK(ui.time().ghost()->channels->end_tick() > 8000);
    REQUIRE(ui.time().time_machine().compared() != nullptr);
    return *ui.time().time_machine().compared();
  };
  const PresetsCompared part = solved(2.0), whole = solved(600.0);
  CHECK(part.from_tick == 1000);
  CHECK(part.end_tick == 8001);
  CHECK(part.from_tick == whole.from_tick);
  CHECK(part.end_tick == whole.end_tick);
  for (const auto numbers : {&PresetsCompared::before_numbers, &PresetsCompared::after_numbers}) {
    CHECK((part.*numbers).ticks == 7001);
    CHECK((part.*numbers).mean_iterations == (whole.*numbers).mean_iterations);
    CHECK((part.*numbers).worst_error_m == (whole.*numbers).worst_error_m);
  }
  CHECK(part.before_numbers.mean_iterations != part.after_numbers.mean_iterations);
}

TEST_CASE("what was read from A to B stays solved while one looks elsewhere, and goes with the cursors") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"));
  LongApp ui(folder.file("run.sqlite"), 2.0);
  ui.set_cursors(1000, 8000);
  ui.time().solve_past_again();  // reads them
  ui.frames(2);
  const auto ghost = ui.time().ghost();
  REQUIRE(ghost != nullptr);
  CHECK(ghost->channels->end_tick() > 8000);
  for (const std::uint64_t tick : {8999u, 4000u, 10u, 1500u}) {
    ui.time().select_tick(tick);
    ui.frame();
    CHECK(ui.time().ghost() == ghost);
    CHECK(ui.time().beside().shown());
    CHECK(ui.time().beside().carried() == (tick >= 900 && tick <= 8000));
  }
  ui.set_cursors(1000, 1600);
  CHECK(ui.time().past().kept_selection() == nullptr);
  CHECK(ui.time().selection_kept());  // the page has it
  ui.key(HeadlessApp::kEnd);
  CHECK(ui.time().past().kept_selection() == nullptr);
}

TEST_CASE("a sweep over ticks of a recording that are not loaded reads them first") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"));
  LongApp ui(folder.file("run.sqlite"), 2.0);
  ui.set_cursors(500, 8500);
  ui.model().tuning().set_key(0, find_preset_key("solver", "tolerance_m"));
  ui.model().tuning().set_count(0, 2);
  ui.frame();
  ui.click("sweep/start");
  ui.frames(2);
  REQUIRE(ui.model().tuning().points().size() == 2);
  CHECK(ui.model().tuning().points_range() == TickRange{500, 8500});
  CHECK(ui.model().tuning().points()[0].numbers.ticks == 8001);
}

TEST_CASE("any tick of a recording is explained, loaded or not, as from its file alone") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"));
  LongApp ui(folder.file("run.sqlite"), 1.0);
  for (const std::uint64_t tick : {8999u, 20u, 4321u}) {
    REQUIRE_FALSE(ui.time().past().main().covers(tick));
    ui.time().select_tick(tick);
    ui.frame();
    const Why* why = ui.model().why().of_tick_in_view();
    REQUIRE(why != nullptr);
    CHECK(why->asked.tick == tick);
    CHECK(why->asked.scene == ui.model().scene().current());
    const ServoRecord& record = *ui.time().tick().record();
    CHECK(explanation_text(why->told) ==
          explanation_text(explain_tick(ui.time().scene_of_tick(), *ui.time().preset_of_tick(), record.tick.input,
                                        record.tick.kept)));
  }
}

TEST_CASE("from A to B may be longer than memory allows: said, with how much fits, and nothing is read") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"));
  LongApp ui(folder.file("run.sqlite"), 1.0, 3000 * bytes_of_solved_tick());
  ui.set_cursors(1000, 8000);
  ui.click("sweep/start");
  CHECK(said(ui.model(), Severity::error, "too long to be solved at once: 7101 ticks"));
  CHECK(said(ui.model(), Severity::error, "there is room for 3000 ticks"));
  CHECK(ui.model().tuning().points().empty());
  CHECK_FALSE(ui.model().tuning().waits());
  CHECK(ui.time().past().kept_selection() == nullptr);
  ui.set_cursors(1000, 3800);
  ui.click("sweep/start");
  ui.frames(2);
  CHECK_FALSE(ui.model().tuning().points().empty());
  CHECK(usable_memory_bytes() > 10'000 * bytes_of_solved_tick());
}

TEST_CASE(
    "reading from A to B shows how far it is and can be cancelled, and what waits for it goes on when it is there") {
  const testing::TempFolder folder;
  record_long_torus(folder.file("run.sqlite"), 12'000);
  LongApp ui(folder.file("run.sqlite"), 1.0, 0, false);
  ui.set_cursors(100, 11'900);
  ui.model().tuning().set_key(0, find_preset_key("solver", "tolerance_m"));
  ui.model().tuning().set_count(0, 2);
  ui.model().tuning().start_sweep();
  CHECK(ui.model().tuning().waits());
  CHECK(ui.time().selection_loading());
  CHECK(ui.model().recordings().busy());
  ui.model().tuning().cancel_sweep();
  CHECK_FALSE(ui.time().selection_loading());
  CHECK(ui.time().past().kept_selection() == nullptr);
  ui.frames(3);
  CHECK(ui.model().tuning().points().empty());
  ui.model().tuning().start_sweep();
  double last = 0.0;
  for (int i = 0; i < 4000 && (ui.model().tuning().waits() || ui.model().tuning().sweep().running()); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(ui.time().selection_progress() >= last);
    last = ui.time().selection_progress();
    if (i % 8 == 0) ui.frame();
  }
  ui.frame();
  CHECK(last > 0.99);
  CHECK(ui.model().tuning().points().size() == 2);
  // Closed while it is read.
  ui.set_cursors(200, 11'800);
  ui.time().load_selection();
  ui.key(HeadlessApp::kEnd);
  CHECK(ui.time().recording() == nullptr);
}
