// A program that is killed while a participant is at the device.
#include "core/base/split_mix.h"
#include "tests/core/scenes.h"
#include "tests/support/killed_process.h"
#include "tests/workbench/experiment/trial_fixture.h"

#include <cstdlib>

namespace tangent::experiment {
namespace {

using test::Bench;

/// A start of the program in a process of its own, which is killed after a while; none: it ends by itself.
void take_part_until_killed(Bench& bench, std::optional<unsigned> after_us) {
  tangent::testing::run_until_killed(after_us, [&] {
    bench.trials.reset();
    auto trials = bench.try_start(test::short_comparison());
    if (!trials) return trials.error().message().find("answered everything") != std::string::npos ? 0 : 1;
    bench.trials = std::move(*trials);
    bench.run(400);
    bench.answer();
    return bench.trials->finished() && bench.trials->end() ? 0 : 2;
  });
}

TEST_CASE("killed at any moment of trials at a device, no answer is lost and the run goes on at the same stimulus") {
  Bench whole(test::short_comparison());
  whole.answer();
  const ReadRows expected = whole.table();
  Bench bench(test::short_comparison());
  const std::filesystem::path rows = bench.trials->rows();
  bench.trials.reset();
  SplitMix random(3);
  const char* asked = std::getenv("TANGENT_TRIAL_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : test::rounds(20);
  std::size_t before = 0;
  for (int i = 0; i < kills; ++i) {
    take_part_until_killed(bench, static_cast<unsigned>(random.below(asked != nullptr ? 400'000 : 60'000)));
    const ReadRows now = bench.table_at(rows);
    CHECK(now.complaint.empty());
    CHECK(now.rows.size() >= before);
    before = now.rows.size();
    if (before < expected.rows.size()) continue;
    std::filesystem::remove_all(rows.parent_path());  // all answered: from the start again
    REQUIRE(bench.try_start(test::short_comparison()));
    before = 0;
  }
  take_part_until_killed(bench, std::nullopt);
  const ReadRows end = bench.table_at(rows);
  REQUIRE(end.rows.size() == expected.rows.size());
  for (std::size_t i = 0; i < end.rows.size(); ++i) {
    const auto a = comparison_row(end.columns, end.rows[i])->second;
    const auto b = comparison_row(expected.columns, expected.rows[i])->second;
    CHECK(a.trial == b.trial);
    CHECK(a.condition == b.condition);
    CHECK(a.segments == b.segments);
    CHECK(a.reference == b.reference);
    CHECK(a.answer == b.answer);
  }
}

}  // namespace
}  // namespace tangent::experiment
