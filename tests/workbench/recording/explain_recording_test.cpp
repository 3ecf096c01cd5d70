#include "workbench/recording/explain_recording.h"

#include "core/lab/explain/explain_run.h"
#include "tests/support/sanitized.h"
#include "tests/workbench/recording/recording_fixture.h"

#include <map>

using namespace tangent;
using namespace tangent::test;

namespace {

/// 3 s; from tick 1,200 to 1,999 with gains that are too small.
void record_small_gains(const std::filesystem::path& path) {
  RecordedSession recorded(path);
  recorded.run(1200);
  const Preset good = recorded.session->preset();
  Preset small = good;
  small.solver.method = Method::paper;
  small.solver.gain_overall = 0.05;
  REQUIRE(recorded.session->set_preset(small));
  recorded.run(800);
  REQUIRE(recorded.session->set_preset(good));
  recorded.run(1000);
  recorded.finish();
}

/// By going over the file from its first tick on.
std::map<std::uint64_t, TickExplanation> explained_one_by_one(const std::filesystem::path& path) {
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const auto states = usable_states(*recording);
  const auto scenes = scenes_of(*recording, nullptr);
  REQUIRE(states);
  REQUIRE(scenes);
  auto walk = TickWalk::start(*recording, *scenes, *states, 0, recording->info().last_tick);
  REQUIRE(walk);
  std::map<std::uint64_t, TickExplanation> found;
  std::vector<TickInput> lost;  // ticks in a row without a contact, under one preset
  TickState before_lost;
  const Preset* under = nullptr;
  for (;;) {
    const Result<bool> any = walk->next();
    REQUIRE(any);
    if (!*any) return found;
    const TickRecord& tick = walk->tick().record.tick;
    CHECK(output_digest(walk->output()) == walk->tick().digest);
    if (is_converged(tick.output.status) || under != &walk->preset()) lost.clear();
    if (!is_converged(tick.output.status)) {
      if (lost.empty()) before_lost = tick.kept;
      lost.push_back(tick.input);
      under = &walk->preset();
    }
    if (wants_explaining(tick.output))
      found[tick.tick] = lost.empty() ? explain_tick(walk->scene(), walk->preset(), tick.input, tick.kept)
                                      : explain_run(walk->scene(), walk->preset(), {before_lost, lost});
  }
}

}  // namespace

TEST_CASE("any tick of a recording is explained as the tick itself is, from the last kept state on" *
          doctest::skip(testing::kSanitized)) {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  record_small_gains(path);
  const auto all = explained_one_by_one(path);
  REQUIRE(all.size() > 50);
  std::map<TickCause, std::uint64_t> counts;
  std::size_t looked = 0;
  for (const auto& [tick, why] : all) {
    ++counts[why.cause];
    if (looked++ % 16 != 0) continue;
    const auto one = explain_recorded_tick(path, tick);
    REQUIRE(one);
    CHECK(one->same_bits);
    CHECK(one->tick == tick);
    CHECK(explanation_text(one->why) == explanation_text(why));
  }
  CHECK(counts[TickCause::gain_too_small] > 50);
  for (const unsigned threads : {1u, 3u}) {
    ExplainRecordingOptions options;
    options.threads = threads;
    const auto summary = explain_recording(path, options);
    REQUIRE(summary);
    CHECK(summary->ticks == 3000);
    CHECK(summary->wanted == all.size());
    CHECK(summary->explained == all.size());
    CHECK(summary->causes.size() == counts.size());
    for (const CauseInRecording& cause : summary->causes) {
      CHECK(cause.ticks == counts[cause.cause]);
      CHECK(cause.worst.why.cause == cause.cause);
      CHECK(explanation_text(cause.worst.why) == explanation_text(all.at(cause.worst.tick)));
    }
  }
}

TEST_CASE("over its limit a recording's ticks are explained in part, and it says how many") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  record_small_gains(path);
  ExplainRecordingOptions options;
  options.most = 5;
  const auto summary = explain_recording(path, options);
  REQUIRE(summary);
  CHECK(summary->explained <= 5);
  CHECK(summary->wanted > 50);
  options.cancelled = [] { return true; };
  const auto stopped = explain_recording(path, options);
  REQUIRE(stopped);
  CHECK(stopped->cancelled);
}

TEST_CASE("explaining a recording fails on ticks that it does not have and on files that are damaged") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  record_small_gains(path);
  const auto none = explain_recorded_tick(path, 3000);
  REQUIRE(!none);
  CHECK(says(message_of(none.error()), "has no tick 3000"));
  CHECK(says(message_of(none.error()), "0 to 2999"));
  change(path, "DELETE FROM tick_rows WHERE tick = 1500");
  CHECK(explain_recorded_tick(path, 1499));
  CHECK(!explain_recorded_tick(path, 1500));
  change(path, "UPDATE meta SET value = '999' WHERE key = 'state_layout'");
  for (const auto& failed : {explain_recorded_tick(path, 10)})
    CHECK(says(message_of(failed.error()), "whose kept states this version can't use"));
  CHECK(!explain_recording(path));
  CHECK(!explain_recorded_tick(folder.file("none.sqlite"), 1));
}
