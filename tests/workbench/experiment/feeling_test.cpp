// The simulated participant who feels.
#include "workbench/experiment/feeling.h"

#include "core/base/units.h"
#include "tests/support/paths.h"
#include "workbench/experiment/participant.h"
#include "workbench/experiment/run_simulated.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tangent::experiment {
namespace {

Protocol arcs_protocol() {
  return *read_protocol(std::filesystem::path(testing::source_folder()) / "presets" / "experiments" /
                        "six-conditions.toml");
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

/// Three objects whose unshaded facets are coarse, in one session.
const char* const kThreeObjects = R"([protocol]
kind = "identification"
name = "Three"
[preset]
"finger.shape" = "sphere"
"finger.radius_m" = 0.020
[objects]
names = ["cube", "cylinder", "triangle"]
facet_deg = 3.0
[runs]
sessions = 1
runs = 1
)";

TEST_CASE("one who feels names objects better than by chance, and the same again") {
  const Protocol protocol = *parse_protocol(kThreeObjects, "three.toml");
  const auto folder = OwnFolder::make();
  const Enrolment who{{"P1", "feeling", false}, 3, protocol_digest(protocol)};
  std::vector<NamingRow> rows[2];
  for (int i = 0; i < 2; ++i) {
    const std::filesystem::path data = folder->path() / std::to_string(i);
    const auto outcome = run_simulated(data, protocol, kThreeObjects, who, {});
    REQUIRE_MESSAGE(outcome, (outcome ? "" : outcome.error().message()));
    const auto file = enrol(data, protocol, kThreeObjects, who);
    REQUIRE(file);
    rows[i] = *naming_rows(*file);
  }
  REQUIRE(rows[0].size() == 12);
  CHECK(rows[0] == rows[1]);
  int right = 0;
  for (const NamingRow& row : rows[0]) {
    right += row.right;
    CHECK(row.touching_s > 0.5);
    CHECK(row.touching_s <= row.since_touch_s);
  }
  MESSAGE("right: ", right, " of 12");
  CHECK(right >= 9);  // 4 by chance; 9 or more by chance once in 260
}

TEST_CASE("what is felt of objects: like itself, unlike others, more so where the display moves") {
  const Protocol protocol = *parse_protocol(kThreeObjects, "three.toml");
  const auto stimuli = Stimuli::make(protocol);
  REQUIRE(stimuli);
  const FeelingHand hand;
  const auto felt = [&](const char* object, bool tactile, std::uint64_t seed) {
    const auto stimulus = stimuli->object(object, true, tactile, Facing::right);
    const auto path = StrokePath::build(*stimulus->scene, pad_distance_m(stimulus->preset.finger));
    REQUIRE(path);
    auto out = touch_object(*stimulus, *path, hand, seed);
    REQUIRE(out);
    return *out;
  };
  for (const bool tactile : {false, true}) {
    const FeltObject cube = felt("cube", tactile, 1);
    CHECK(distance2(cube, cube, hand) == 0.0);
    const double itself = distance2(cube, felt("cube", tactile, 2), hand);
    CHECK(itself < 0.1 * distance2(cube, felt("triangle", tactile, 2), hand));
    CHECK(cube.seconds > 1.0);
    if (!tactile)
      for (const double display_m : cube.display_m) CHECK(display_m == 0.0);
  }
  CHECK(distance2(felt("cube", true, 1), felt("cylinder", true, 1), hand) >
        distance2(felt("cube", false, 1), felt("cylinder", false, 1), hand));
}

}  // namespace
}  // namespace tangent::experiment
