// Trials and the two clocks: the servo's, which counts a trial's seconds, and the computer's date, which anybody may
// put forward or back.
#include "tests/workbench/experiment/trial_fixture.h"

#include <cstdlib>

namespace tangent::experiment {
namespace {

using test::Bench;

constexpr std::int64_t kNoon_utc_s = 1'764'000'000;  // 2025-11-24T16:00:00Z

std::string events_in(const Bench& bench) { return test::text_in(events_path(bench.trials->rows())); }
bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A start at that date, hours after the first.
std::function<void(TrialOptions&)> at(double hours, bool same_day = false) {
  return [hours, same_day](TrialOptions& options) {
    options.utc_s = [hours] { return kNoon_utc_s + static_cast<std::int64_t>(3600.0 * hours); };
    options.same_day = same_day;
  };
}

TEST_CASE("a leap of the clock pauses: ticks of the trial are missing") {
  Bench bench(test::short_comparison());
  bench.answer(1);
  bench.trials->session().advance(9000);  // more than the history holds, and nobody looks
  bench.trials->poll();
  CHECK(bench.trials->operator_view().fault.find("missing") != std::string::npos);
}

TEST_CASE("a date that leaps about, hours a call, changes no time of a trial, and no answer is lost") {
  std::int64_t calls = 0;
  Bench steady(test::short_comparison(), at(0.0));
  Bench leaping(test::short_comparison(), [&calls](TrialOptions& options) {
    options.utc_s = [&calls] {
      ++calls;
      return kNoon_utc_s + (calls % 2 == 0 ? 1 : -1) * 7200 * calls;
    };
  });
  steady.answer(3);
  leaping.answer(3);
  for (Bench* bench : {&steady, &leaping}) REQUIRE(bench->trials->end());
  const ReadRows a = steady.table(), b = leaping.table();
  CHECK(b.complaint.empty());
  CHECK(a.rows == b.rows);
  CHECK(events_in(steady) == events_in(leaping));
  CHECK(calls >= 2);
}

TEST_CASE("put back between two starts, the date makes no onset go back, and the answers stay in order") {
  Bench bench(test::short_comparison(), at(0.0));
  bench.answer(2);
  bench.trials.reset();
  bench.start(test::short_comparison(), at(-48.0));
  bench.answer(3);
  bench.trials.reset();
  bench.start(test::short_comparison(), at(1.0));  // put right: an hour after the first start
  bench.answer();
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  CHECK(table.complaint.empty());
  double before_s = -1.0;
  for (const Fields& fields : table.rows) {
    const double began_s = comparison_row(table.columns, fields)->second.began_s;
    CHECK(began_s > before_s);
    before_s = began_s;
  }
  CHECK(before_s > 3600.0);
  before_s = -1.0;
  std::istringstream lines(events_in(bench));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    CHECK(std::atof(line.c_str()) >= before_s);
    before_s = std::atof(line.c_str());
  }
  // Each start has the date that the computer had, so that it is seen what happened.
  const auto sidecar = read_sidecar(bench.trials->rows());
  REQUIRE(sidecar);
  const std::string sidecar_text =
      test::text_in(std::filesystem::path(bench.trials->rows()).replace_extension(".json"));
  for (const char* date : {"2025-11-24T16:00:00Z", "2025-11-22T16:00:00Z", "2025-11-24T17:00:00Z"})
    CHECK(says(sidecar_text, date));
}

/// As short_naming, in two sessions.
std::string two_sessions() {
  std::string text = test::short_naming();
  return text.replace(text.find("sessions = 1"), 12, "sessions = 2");
}

TEST_CASE("a session is not begun within a day of the one before, unless somebody says so, and then it is told") {
  Bench bench(two_sessions(), at(0.0));
  bench.answer(3);
  bench.trials.reset();
  bench.start(two_sessions(), at(0.5));  // the same session goes on at any time
  bench.answer();
  REQUIRE(bench.trials->finished());
  REQUIRE(bench.trials->end());
  CHECK(says(events_in(bench), "\tended\t8\tsession 1 of 2 complete"));
  bench.trials.reset();
  const auto early = bench.try_start(two_sessions(), at(3.0));
  REQUIRE_FALSE(early);
  CHECK(says(early.error().message(), "2.5 hours ago"));
  CHECK(says(early.error().message(), "--same-day"));
  CHECK(bench.try_start(two_sessions(), at(24.6)));
  CHECK(bench.try_start(two_sessions(), at(24.7)));             // after a start that came to no answer
  const auto back = bench.try_start(two_sessions(), at(-5.0));  // the computer's clock was put back
  REQUIRE_FALSE(back);
  CHECK(says(back.error().message(), "the session before was begun at 2025-11-24T16:30:00Z"));
  CHECK(says(back.error().message(), "clock"));
  {
    const auto allowed = bench.try_start(two_sessions(), at(3.0, true));
    REQUIRE(allowed);
    CHECK(says(test::text_in(events_path((*allowed)->rows())), "sessions need not lie apart"));
  }
}

}  // namespace
}  // namespace tangent::experiment
