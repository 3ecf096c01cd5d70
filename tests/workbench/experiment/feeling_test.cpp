// The simulated participant who feels.
#include "workbench/experiment/feeling.h"

#include "core/base/units.h"
#include "workbench/experiment/participant.h"
#include "workbench/experiment/run_simulated.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tangent::experiment {
namespace {

Protocol arcs_protocol() {
  return *read_protocol(std::filesystem::path(TANGENT_SOURCE_DIR) / "presets" / "experiments" / "six-conditions.toml");
}

FeltJump felt_jump(const Protocol& protocol, const std::string& condition, int segments, std::uint64_t seed = 1) {
  const auto arcs = arcs_to_feel(protocol);
  REQUIRE(arcs);
  const auto arc = (*arcs)(condition, segments);
  REQUIRE(arc);
  const auto jump = touch_arc(*arc, *protocol.discrimination(), {}, seed);
  REQUIRE(jump);
  return *jump;
}

TEST_CASE("the display jumps by the finger's radius times the angle between facets") {
  const Protocol protocol = arcs_protocol();
  const double radius = protocol.preset.finger.radius_m;
  for (const int segments : {48, 80}) {
    const double turn = comparison_angle_deg(*protocol.discrimination(), segments) * kDegree;
    const double jump = felt_jump(protocol, "C3", segments).display_m;
    CAPTURE(segments);
    CHECK(jump > 0.9 * radius * turn);
    CHECK(jump < 1.3 * radius * turn);  // encoder steps and the hand's own turn add to it
  }
  CHECK(felt_jump(protocol, "C1", 48).display_m == 0.0);  // held
}

TEST_CASE("coarse arcs jump more than the exact one, but for the one that is shaded in both") {
  const Protocol protocol = arcs_protocol();
  for (const char* condition : {"C1", "C2", "C3", "C4", "P2"}) {
    CAPTURE(condition);
    CHECK(felt_size(felt_jump(protocol, condition, 8), {}) > felt_size(felt_jump(protocol, condition, 0), {}) + 1.0);
  }
  CHECK(std::abs(felt_size(felt_jump(protocol, "P1", 8), {}) - felt_size(felt_jump(protocol, "P1", 0), {})) < 0.5);
}

TEST_CASE("a touch has the same bits each time, and other tremor with another seed") {
  const Protocol protocol = arcs_protocol();
  const FeltJump one = felt_jump(protocol, "C3", 30), again = felt_jump(protocol, "C3", 30);
  CHECK(one.force_n == again.force_n);
  CHECK(one.display_m == again.display_m);
  CHECK(one.seconds > 1.0);
  CHECK(felt_jump(protocol, "C3", 30, 2).force_n != one.force_n);
}

TEST_CASE("one who feels and is interrupted goes on to the rows of one who is not") {
  Protocol protocol = arcs_protocol();
  auto& conditions = std::get<Discrimination>(protocol.kind).conditions;
  conditions.erase(conditions.begin(), conditions.begin() + 2);
  conditions.resize(1);  // C3
  conditions[0].staircase.reversals = 3;
  conditions[0].staircase.large_reversals = 1;
  conditions[0].staircase.averaged = 2;
  conditions[0].staircase.start = 150.0;
  const auto participant = [&] {
    return FeelingComparer(*arcs_to_feel(protocol), *protocol.discrimination(), feeling_hand(3, 9), 9);
  };
  std::vector<ComparisonRow> whole;
  auto run = ComparisonRun::start(protocol, 3, 9);
  FeelingComparer first = participant();
  REQUIRE(take_part(*run, first, 9, [&](const ComparisonRow& row) { whole.push_back(row); }));
  REQUIRE(whole.size() >= 5);
  std::vector<ComparisonRow> rows(whole.begin(), whole.begin() + 3);
  auto rest = ComparisonRun::start(protocol, 3, 9, rows);
  REQUIRE(rest);
  FeelingComparer second = participant();
  REQUIRE(take_part(*rest, second, 9, [&](const ComparisonRow& row) { rows.push_back(row); }));
  REQUIRE(rows.size() == whole.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i].segments == whole[i].segments);
    CHECK(rows[i].answer == whole[i].answer);
    CHECK(rows[i].first_s == whole[i].first_s);
  }
}

TEST_CASE("one who feels names no objects, and says so before a file is made") {
  const auto file = std::filesystem::path(TANGENT_SOURCE_DIR) / "presets" / "experiments" / "identification.toml";
  const Protocol protocol = *read_protocol(file);
  const auto folder = OwnFolder::make();
  Enrolment who{{"P1", "feeling", false}, 1, protocol_digest(protocol)};
  const auto outcome = run_simulated(folder->path() / "data", protocol, "", who, {});
  REQUIRE_FALSE(outcome);
  CHECK(outcome.error().message().find("names no objects") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder->path() / "data"));
}

}  // namespace
}  // namespace tangent::experiment
