#include "workbench/recording/replay.h"

#include "tests/support/approx.h"
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/compare.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// 5 s with changes of preset, scene and hand in between.
void record_changes(const std::filesystem::path& path) {
  RecordedSession recorded(path);
  recorded.run(1300);
  Preset preset = recorded.session->preset();
  preset.solver.method = Method::paper;
  preset.force.stiffness_n_per_m = 400.0;
  REQUIRE(recorded.session->set_preset(preset));
  recorded.run(900);
  SceneSource other{std::make_shared<const PolygonMesh>(make_icosphere(0.040, 3)), {}, nullptr};
  const auto scene = built(other);
  const std::uint32_t id = recorded.session->set_scene(scene);
  recorded.recorder->scene_changed(id, scene, "sphere", other);
  recorded.run(1100);
  preset.force.damping_n_s_per_m = 1.0;
  REQUIRE(recorded.session->set_preset(preset));
  recorded.session->stop();
  recorded.run(700);
  recorded.session->arm();
  recorded.run(1000);
  recorded.finish();
}

}  // namespace

TEST_CASE("a recording with changes of preset and scene is computed again bit for bit, by any number of threads") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  record_changes(path);
  for (const unsigned threads : {1u, 2u, 5u}) {
    CAPTURE(threads);
    ReplayOptions options;
    options.threads = threads;
    const auto report = replay(path, options);
    REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
    CHECK(report->same());
    CHECK(report->checked == 5000);
    if (threads == 1) CHECK(report->states >= 2);
  }
  ReplayOptions quick;
  quick.every_second = true;
  const auto report = replay(path, quick);
  REQUIRE(report);
  CHECK(report->same());
  CHECK(report->checked >= 5);
  CHECK(report->checked < 50);
}

TEST_CASE("the first tick that differs is named, with its field and both values") {
  const testing::TempFolder folder;
  const std::string good = folder.file("good.sqlite");
  RecordedSession recorded(good);
  recorded.run(2500);
  recorded.finish();
  const std::vector<RecordedTick> ticks = all_ticks(good);
  const auto damaged = [&](const std::string& sql) {
    const std::string path = folder.file("damaged.sqlite");
    std::filesystem::copy_file(good, path, std::filesystem::copy_options::overwrite_existing);
    change(path, sql);
    const auto report = replay(path);
    REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
    CHECK_FALSE(report->same());
    REQUIRE(report->first);
    return *report;
  };
  const ReplayReport force = damaged("UPDATE tick_rows SET force_z_n = force_z_n + 1e-9 WHERE tick IN (1700, 2300)");
  CHECK(force.first->tick == 1700);
  CHECK(force.first->field == "force_z_n");
  CHECK(force.different == 2);
  CHECK(force.largest.at("force_z_n") == approx(1e-9).epsilon(1e-3));
  const ReplayReport digest = damaged("UPDATE tick_rows SET digest = digest + 1 WHERE tick = 99");
  CHECK(digest.first->tick == 99);
  CHECK(digest.first->field == "digest");
  const ReplayReport status = damaged("UPDATE tick_rows SET status = 5 WHERE tick = 1234");
  CHECK(status.first->field == "status");
  CHECK(status.first->recorded == "facing");
  // Another position: this tick, and those that follow from it until the next kept state.
  const ReplayReport moved = damaged("UPDATE tick_rows SET finger_x_m = finger_x_m + 1e-5 WHERE tick = 1500");
  CHECK(moved.first->tick == 1500);
  CHECK(moved.different >= 1);
  // A preset that is not the one that was used.
  const ReplayReport preset =
      damaged("UPDATE presets SET toml = replace(toml, 'stiffness_n_per_m = 800', 'stiffness_n_per_m = 801')");
  CHECK(preset.different > 100);
  const ReplayReport kept =
      damaged("UPDATE states SET bytes = (SELECT bytes FROM states WHERE tick = 0) WHERE tick > 0");
  CHECK(kept.first->tick >= 900);
}

TEST_CASE("without its mesh a recording is replayed on the one that is given, and on no other") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path, torus_source(), false);
  recorded.run(800);
  recorded.finish();
  const auto alone = replay(path);
  REQUIRE_FALSE(alone);
  CHECK(says(message_of(alone.error()), "--no-mesh"));
  ReplayOptions options;
  options.scene = built(torus_source());
  const auto given = replay(path, options);
  REQUIRE(given);
  CHECK(given->same());
  CHECK(given->checked == 800);
  options.scene = built({std::make_shared<const PolygonMesh>(make_icosphere(0.040, 2)), {}, nullptr});
  const auto wrong = replay(path, options);
  REQUIRE_FALSE(wrong);
  CHECK(says(message_of(wrong.error()), "hash"));
}

TEST_CASE("the same motion under the same preset differs in nothing, under another in what that changes") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(3000);
  recorded.finish();
  CompareOptions options;
  const auto same = compare(path, options);
  REQUIRE_MESSAGE(same, (same ? "" : message_of(same.error())));
  CHECK(same->difference.worst_force_n == 0.0);
  CHECK(same->difference.worst_display_m == 0.0);
  CHECK(same->difference.changed_contacts == 0);
  CHECK(same->recorded.ticks == 3000);
  CHECK(same->other.mean_iterations == same->recorded.mean_iterations);
  CHECK(same->other.events == same->recorded.events);
  CHECK(same->other.force_above_20hz_n == same->recorded.force_above_20hz_n);
  double most = 0.0;
  for (const RecordedTick& tick : all_ticks(path))
    most = std::max(most, std::sqrt(glm::dot(tick.record.tick.output.force_n, tick.record.tick.output.force_n)));
  CHECK(same->recorded.most_force_n == most);

  options.preset = [](const Preset& was) {
    Preset preset = was;
    preset.force.stiffness_n_per_m *= 0.5;
    preset.force.blend = ForceBlend::off;
    return preset;
  };
  const auto softer = compare(path, options);
  REQUIRE(softer);
  CHECK(softer->other.mean_force_n < 0.6 * softer->recorded.mean_force_n);
  CHECK(softer->difference.worst_force_n > 0.1);
  CHECK(softer->difference.changed_contacts == 0);

  options.preset = [](const Preset& was) {
    Preset preset = was;
    preset.solver.method = Method::facet;
    return preset;
  };
  const auto facets = compare(path, options);
  REQUIRE(facets);
  CHECK(facets->difference.changed_contacts > 1000);
  CHECK(facets->other.rms_display_jump_m > 1.5 * facets->recorded.rms_display_jump_m);
}
