// Both experiments, moment by moment.
#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "workbench/experiment/participant.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

namespace tangent::experiment {

using test::approx;
namespace {

Protocol protocol_named(const char* name) {
  return *read_protocol(std::filesystem::path(testing::source_folder()) / "presets" / "experiments" / name);
}
Protocol comparison() { return protocol_named("discrimination.toml"); }
Protocol naming() { return protocol_named("identification.toml"); }

KnownComparer known_comparer() {
  return {
      {{"C1", {70.0, 0.35, 0.02}}, {"C2", {11.0, 0.35, 0.02}}, {"C3", {170.0, 0.35, 0.02}}, {"C4", {11.0, 0.35, 0.02}}},
      0.0};
}
/// Moments by hand.
template <class Run>
struct Hand {
  explicit Hand(Run& r) : run(r) {}
  Run& run;
  double t = 0.0;
  std::optional<typename Run::Row> at(double passed, bool touching, Key key = Key::none, int digit = 0,
                                      double away = 0.1) {
    return run.advance({t += passed, touching, away, key, digit});
  }
  std::optional<typename Run::Row> enter() { return at(0.1, false, Key::enter); }
  std::optional<typename Run::Row> digit(int d) { return at(0.1, false, Key::digit, d); }
  void touch(double seconds) {
    at(0.1, true);
    at(seconds, true);
    at(0.0, false);
  }
};

TEST_CASE("a comparison: feel, raise, Enter, feel, raise, answer, Enter") {
  auto run = ComparisonRun::start(comparison(), 1, 5);
  REQUIRE(run);
  Hand hand(*run);
  CHECK(run->shown().phase == Phase::training);
  CHECK(run->shown().in_view);
  CHECK(run->shown().stimulus.segments == 0);
  hand.enter();
  REQUIRE(run->shown().phase == Phase::first);
  CHECK_FALSE(run->shown().in_view);
  const std::uint64_t cues = run->shown().cues;
  hand.enter();  // not touched
  CHECK(run->shown().phase == Phase::first);
  CHECK(run->shown().hint == "Touch the shape first.");
  hand.at(0.1, true);
  hand.at(0.1, true, Key::enter);  // still on it
  CHECK(run->shown().phase == Phase::first);
  CHECK(run->shown().hint == "Raise your finger first.");
  hand.at(2.0, false);
  const int first_segments = run->shown().stimulus.segments;
  hand.enter();
  REQUIRE(run->shown().phase == Phase::second);
  CHECK(run->shown().cues == cues + 1);
  CHECK((first_segments == 0) != (run->shown().stimulus.segments == 0));
  hand.touch(1.5);
  CHECK_FALSE(hand.enter());
  CHECK(run->shown().hint == "Press 1 or 2 first.");
  hand.digit(3);
  CHECK(run->shown().choice == 0);
  hand.digit(1);
  hand.digit(2);  // changed before Enter
  const auto row = hand.enter();
  REQUIRE(row);
  CHECK(row->answer == 2);
  CHECK(row->reference == (first_segments == 0 ? 1 : 2));
  CHECK(row->right == (row->reference == 2));
  CHECK(row->trial == 0);
  CHECK(row->second_touching_s == approx(1.5));
  CHECK(row->second_s >= 1.5);
  CHECK(run->shown().phase == Phase::first);
}

TEST_CASE("an object: guided, a second at the start, a ding, one key, no way back") {
  auto run = NamingRun::start(naming(), 2, 5);
  REQUIRE(run);
  Hand hand(*run);
  CHECK(run->shown().phase == Phase::training);
  CHECK(run->shown().stimulus.object == "hexagon");
  CHECK(run->shown().in_view);
  hand.enter();
  REQUIRE(run->shown().phase == Phase::guide);
  CHECK(run->shown().guided);
  CHECK(run->shown().stimulus.kind == Stimulus::Kind::none);
  hand.at(5.0, false);  // elsewhere
  hand.at(0.1, false, Key::none, 0, 0.001);
  hand.at(0.6, false, Key::none, 0, 0.001);
  hand.at(0.1, false, Key::none, 0, 0.02);  // left too early
  hand.at(0.1, false, Key::none, 0, 0.001);
  hand.at(0.9, false, Key::none, 0, 0.001);
  CHECK(run->shown().phase == Phase::guide);
  hand.at(0.11, false, Key::none, 0, 0.001);
  REQUIRE(run->shown().phase == Phase::explore);
  CHECK(run->shown().cues == 1);
  CHECK_FALSE(hand.digit(4));
  CHECK(run->shown().hint == "Touch the object first.");
  hand.at(0.5, true);
  hand.at(2.0, true);
  hand.at(1.0, false);
  hand.at(1.0, true);
  CHECK_FALSE(hand.digit(8));
  CHECK_FALSE(hand.digit(0));
  const std::string object = run->shown().stimulus.object;
  const auto row = hand.digit(4);
  REQUIRE(row);
  CHECK(row->object == object);
  CHECK(row->answer == "sphere");
  CHECK(row->right == (object == "sphere"));
  CHECK(row->since_touch_s == approx(4.3));
  CHECK(row->touching_s == approx(3.1));  // the moment of leaving counts to the touch
  CHECK(run->shown().phase == Phase::guide);
}

TEST_CASE("a clock that jumps back or stands still makes no negative times") {
  auto run = NamingRun::start(naming(), 2, 5);
  REQUIRE(run);
  run->advance({100.0, false, 0.1, Key::enter, 0});
  run->advance({101.0, false, 0.0, Key::none, 0});
  run->advance({50.0, false, 0.0, Key::none, 0});
  run->advance({51.5, false, 0.0, Key::none, 0});
  REQUIRE(run->shown().phase == Phase::explore);
  run->advance({52.0, true, 0.1, Key::none, 0});
  run->advance({20.0, true, 0.1, Key::none, 0});
  run->advance({53.0, true, 0.1, Key::none, 0});
  const auto row = run->advance({53.0, false, 0.1, Key::digit, 1});
  REQUIRE(row);
  CHECK(row->since_touch_s == approx(1.0));
  CHECK(row->touching_s == approx(1.0));
}

TEST_CASE("sessions end by themselves, blocks have a rest between, each kind of feedback its practice") {
  std::vector<NamingRow> rows;
  for (int session = 1; session <= 2; ++session) {
    auto run = NamingRun::start(naming(), 3, 5, rows);
    REQUIRE(run);
    Hand hand(*run);
    std::vector<Phase> met;
    while (!run->finished()) {
      const Phase phase = run->shown().phase;
      if (phase == Phase::guide) {
        hand.at(0.1, false, Key::none, 0, 0.0);
        hand.at(1.0, false, Key::none, 0, 0.0);
      } else if (phase == Phase::explore) {
        hand.at(0.1, true);
        const auto row = hand.digit(1);
        REQUIRE(row);
        CHECK(row->session == session);
        rows.push_back(*row);
      } else {
        met.push_back(phase);
        hand.enter();
      }
    }
    CHECK(met == std::vector<Phase>{Phase::training, Phase::rest, Phase::training});
    CHECK(rows.size() == static_cast<std::size_t>(56 * session));
    CHECK(run->all_done() == (session == 2));
  }
  const auto over = NamingRun::start(naming(), 3, 5, rows);
  REQUIRE(over);
  CHECK(over->finished());
}

TEST_CASE("the same seed and answers give the same rows, from any trial on") {
  const Protocol protocol = comparison();
  std::vector<ComparisonRow> whole;
  auto run = ComparisonRun::start(protocol, 6, 77);
  take_part(*run, known_comparer(), 1, [&](const ComparisonRow& row) { whole.push_back(row); });
  REQUIRE(whole.size() > 80);
  CHECK(run->finished());
  for (std::size_t cut = 0; cut <= whole.size(); cut += 7) {
    std::vector<ComparisonRow> rows(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut));
    auto resumed = ComparisonRun::start(protocol, 6, 77, rows);
    REQUIRE(resumed);
    take_part(*resumed, known_comparer(), 1, [&](const ComparisonRow& row) { rows.push_back(row); });
    REQUIRE(rows.size() == whole.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ComparisonRow expected = whole[i];
      expected.began_s = rows[i].began_s;  // counts from each start
      REQUIRE(rows[i] == expected);
    }
  }
}

TEST_CASE("rows of another protocol, participant, seed, or edited are refused by trial") {
  const Protocol protocol = comparison();
  std::vector<ComparisonRow> rows;
  auto run = ComparisonRun::start(protocol, 6, 77);
  take_part(*run, known_comparer(), 1, [&](const ComparisonRow& row) { rows.push_back(row); });
  CHECK(ComparisonRun::start(protocol, 6, 77, rows));
  CHECK_FALSE(ComparisonRun::start(protocol, 6, 78, rows));
  CHECK_FALSE(ComparisonRun::start(protocol, 7, 77, rows));
  auto flipped = rows;
  flipped[3].right = !flipped[3].right;
  const auto refused = ComparisonRun::start(protocol, 6, 77, flipped);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().where == "trial 3");
  auto more = rows;
  more.push_back(rows.back());
  CHECK_FALSE(ComparisonRun::start(protocol, 6, 77, more));
}

TEST_CASE("each condition is one staircase, in the participant's order") {
  const Protocol protocol = comparison();
  std::vector<std::string> order;
  int reversals = 0;
  auto run = ComparisonRun::start(protocol, 1, 3);
  take_part(*run, known_comparer(), 1, [&](const ComparisonRow& row) {
    if (order.empty() || order.back() != row.condition) order.push_back(row.condition);
    reversals += row.reversal;
    CHECK(row.angle_deg == approx(51.68 / (row.segments - 1)).epsilon(1e-3));
  });
  CHECK(order.size() == 4);
  CHECK(reversals == 44);
  std::vector<std::string> expected;
  for (const std::size_t at : latin_row(4, 1)) expected.push_back("C" + std::to_string(at + 1));
  CHECK(order == expected);
}

TEST_CASE(
    "two hundred participants through the first protocol: about as many trials as the paper's, thresholds near the "
    "truth") {
  const Protocol protocol = comparison();
  KnownComparer known = known_comparer();
  known.drift = 0.0;
  double trials = 0.0, log_off = 0.0;
  constexpr int kParticipants = 200;
  for (std::uint64_t p = 0; p < kParticipants; ++p) {
    auto run = ComparisonRun::start(protocol, p, p);
    std::optional<Staircase> staircase(std::in_place, protocol.discrimination()->conditions[0].staircase);
    take_part(*run, known, p, [&](const ComparisonRow& row) {
      trials += 1.0 / (4.0 * kParticipants);
      if (row.condition == "C1") staircase->answer(row.right);
    });
    REQUIRE(staircase->settled());
    log_off += std::log(staircase->threshold() / known.functions.at("C1").segments_at(std::sqrt(0.5))) / kParticipants;
  }
  MESSAGE("trials a condition: ", trials, "; threshold over the truth: ", std::exp(log_off));
  CHECK(trials > 30.0);
  CHECK(trials < 55.0);
  CHECK(std::abs(log_off) < 0.15);
}

}  // namespace
}  // namespace tangent::experiment
