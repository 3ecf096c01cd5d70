#include "workbench/experiment/protocol.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

namespace tangent::experiment {
namespace {

std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(testing::source_folder()) / "presets" / "experiments" / (name + ".toml");
}
std::string text_of(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}
std::string changed(const std::string& name, const std::string& from, const std::string& to) {
  std::string text = text_of(shipped(name));
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("the first shipped protocol has the paper's numbers") {
  const auto protocol = read_protocol(shipped("discrimination"));
  REQUIRE_MESSAGE(protocol, (protocol ? "" : protocol.error().message()));
  const Discrimination* d = protocol->discrimination();
  REQUIRE(d);
  CHECK(d->radius_m == 0.1);
  CHECK(d->angle_rad == 0.902);
  REQUIRE(d->conditions.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const StaircaseRule& rule = d->conditions[i].staircase;
    CHECK(d->conditions[i].name == "C" + std::to_string(i + 1));
    CHECK(rule.reversals == 11);
    CHECK(rule.large_reversals == 3);
    CHECK(rule.averaged == 6);
    CHECK(rule.down == 2);
    CHECK(rule.large_step > rule.small_step);
  }
  CHECK(protocol->preset.finger.radius_m == 0.020);
  CHECK(protocol->preset.display.travel_m == 0.016);
  CHECK(protocol->preset.display.finger_arc_m == 0.016);
  CHECK(protocol->preset.finger.shape == FingerShape::sphere);
  CHECK(d->placement == ArcPlacement::tangent);
}

TEST_CASE("every number of the paper's protocols has its section beside it, or says that it is ours") {
  for (const std::string name : {"discrimination", "identification"}) {
    std::istringstream lines(text_of(shipped(name)));
    int numbers = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find('='), comment = line.find('#');
      if (equals == std::string::npos || comment < equals || line.starts_with("version")) continue;
      const std::size_t number = line.find_first_of("0123456789", equals);
      if (number == std::string::npos || number > comment) continue;
      ++numbers;
      CAPTURE(name);
      CAPTURE(line);
      REQUIRE(comment != std::string::npos);
      const std::string why = line.substr(comment);
      const bool experiment_2 = name == "identification";
      CHECK((why.find("(5.") != std::string::npos || why.find("ours") != std::string::npos));
      // What is of the other experiment says so.
      if (why.find(experiment_2 ? "(5.2" : "(5.3") != std::string::npos) CHECK(why.find("as ") != std::string::npos);
    }
    CHECK(numbers > 12);
  }
}

TEST_CASE("the fewest segments are those that can be made: three tangent ones, two inscribed") {
  const std::string bare = "[protocol]\nkind = \"discrimination\"\nname = \"x\"\n[[conditions]]\nname = \"C1\"\n";
  CHECK(parse_protocol(bare, "p.toml")->discrimination()->conditions[0].staircase.fewest == 3.0);
  const auto inscribed = parse_protocol(bare + "[arc]\nplacement = \"inscribed\"\n", "p.toml");
  REQUIRE(inscribed);
  CHECK(inscribed->discrimination()->conditions[0].staircase.fewest == 2.0);
}

TEST_CASE("the second shipped protocol has the paper's numbers") {
  const auto protocol = read_protocol(shipped("identification"));
  REQUIRE_MESSAGE(protocol, (protocol ? "" : protocol.error().message()));
  const Identification* d = protocol->identification();
  REQUIRE(d);
  CHECK(d->objects ==
        std::vector<std::string>{"cone", "cylinder", "cube", "sphere", "tetrahedron", "octagon", "triangle"});
  CHECK(d->practice == "hexagon");
  CHECK(d->rounding_m == 1.5e-3);
  CHECK(d->sessions * d->blocks * d->runs == 8);
  CHECK(d->sessions == 2);
  CHECK(d->blocks == 2);
  CHECK(d->hours_between_sessions == 24.0);
  CHECK(d->both_ways == std::vector<std::string>{"cone", "tetrahedron"});
  CHECK(d->hold_s == 1.0);
  CHECK(d->tactile_first_even);
  CHECK(protocol->preset.finger.radius_m == 0.020);
  CHECK(protocol->preset.display.travel_m == 0.016);
  CHECK(protocol->preset.display.finger_arc_m == 0.016);
}

TEST_CASE("a digest is of what a participant meets, not of how the file is written") {
  const auto protocol = read_protocol(shipped("discrimination"));
  const auto again = parse_protocol(changed("discrimination", "# Experiment 1", "# Something else"), "p.toml");
  const auto other = parse_protocol(changed("discrimination", "reversals = 11 ", "reversals = 12 "), "p.toml");
  const auto limit =
      parse_protocol(changed("discrimination", "\"force.limit_n\" = 6.0", "\"force.limit_n\" = 5.0"), "p.toml");
  REQUIRE(again);
  REQUIRE(other);
  REQUIRE(limit);
  CHECK(protocol_digest(*again) == protocol_digest(*protocol));
  CHECK(protocol_digest(*other) != protocol_digest(*protocol));
  CHECK(protocol_digest(*limit) != protocol_digest(*protocol));
  CHECK(protocol_digest(*protocol).size() == 16);
}

TEST_CASE("a protocol that can't be says where and what to do") {
  struct Bad {
    const char *file, *from, *to, *named;
  };
  const Bad kBad[] = {
      {"discrimination", "reversals = 11", "reversals = 0", "reversals"},
      {"discrimination", "averaged = 6", "averaged = 20", "averaged"},
      {"discrimination", "name = \"C1\"", "name = \"C9\"", "C1, C2"},
      {"discrimination", "name = \"C2\"", "name = \"C1\"", "twice"},
      {"discrimination", "fewest = 3", "fewest = 5000", "fewest"},
      {"discrimination", "fewest = 3", "fewest = 2.4", "2 segments"},  // a staircase would come to it half way
      {"discrimination", "start = 26", "start = 1", "start"},
      {"discrimination", "[arc]", "[arch]", "arch"},
      {"discrimination", "radius_m = 0.100", "radius = 0.1", "radius"},
      {"discrimination", "\"finger.radius_m\" = 0.020", "\"finger.size_m\" = 0.020", "finger.size_m"},
      {"discrimination", "kind = \"discrimination\"", "kind = \"taste\"", "kind"},
      {"identification", "\"cube\", ", "\"blob\", ", "blob"},
      {"identification", "\"cube\", ", "\"cone\", ", "twice"},
      {"identification", "both_ways = [\"cone\"", "both_ways = [\"cube\"", "both ways"},
      {"identification", "runs = 2 ", "runs = 3 ", "even"},
      {"identification", "blocks = 2 ", "blocks = 1 ", "even"},
      {"identification", "hold_s = 1.0", "hold_s = nan", "hold_s"},
      {"identification", "place_m = [0.0, 0.0, 0.08]", "place_m = [0.0, 0.0]", "three numbers"},
      {"identification", "tactile_first = \"even\"", "tactile_first = 2", "even"},
  };
  for (const Bad& bad : kBad) {
    CAPTURE(bad.to);
    const auto protocol = parse_protocol(changed(bad.file, bad.from, bad.to), "p.toml");
    REQUIRE_FALSE(protocol);
    CAPTURE(protocol.error().message());
    CHECK(protocol.error().message().find(bad.named) != std::string::npos);
    CHECK(protocol.error().message().find("p.toml") != std::string::npos);
  }
  CHECK_FALSE(parse_protocol("", "p.toml"));
  CHECK_FALSE(parse_protocol("[protocol]\nkind = \"identification\"\nname = \"x\"\n", "p.toml"));
  CHECK_FALSE(read_protocol("/nonexistent/p.toml"));
}

TEST_CASE("a wrong value is said as it was written, and its key once") {
  const auto message = [](const char* from, const char* to) {
    return parse_protocol(changed("discrimination", from, to), "p.toml").error().message();
  };
  CHECK(message("start = 26", "start = 1").find("is 1, which is not allowed") != std::string::npos);
  CHECK(message("reversals = 11", "reversals = \"many\"").find("is \"many\", which is not allowed") !=
        std::string::npos);
  const std::string limit = message("\"force.limit_n\" = 6.0", "\"force.limit_n\" = 500.0");
  CAPTURE(limit);
  const std::size_t first = limit.find("force.limit_n");
  REQUIRE(first != std::string::npos);
  CHECK(limit.find("force.limit_n", first + 1) == std::string::npos);
}

TEST_CASE("hours between sessions keep a protocol's digest at a day, and change it otherwise") {
  const auto day = parse_protocol(changed("identification", "hours_between = 24 ", ""), "p.toml");
  const auto shorter =
      parse_protocol(changed("identification", "hours_between = 24 ", "hours_between = 12 "), "p.toml");
  const auto shipped_one = read_protocol(shipped("identification"));
  REQUIRE(day);
  REQUIRE(shorter);
  CHECK(protocol_digest(*day) == protocol_digest(*shipped_one));
  CHECK(protocol_digest(*shorter) != protocol_digest(*shipped_one));
}

TEST_CASE("what should be a table and is none is refused by line and key, not passed over") {
  const std::string comparing = "[protocol]\nkind = \"discrimination\"\nname = \"x\"\n[[conditions]]\nname = \"C1\"\n";
  const std::string naming = "[protocol]\nkind = \"identification\"\nname = \"x\"\n[objects]\nnames = [\"cube\"]\n";
  REQUIRE(parse_protocol(comparing, "p.toml"));
  REQUIRE(parse_protocol(naming, "p.toml"));
  struct Bad {
    std::string text, where, what;
  };
  const Bad kBad[] = {
      {"protocol = 1\n", "p.toml:1 protocol", "a whole number"},
      {"preset = 5\n" + comparing, "p.toml:1 preset", "a whole number"},
      {"sound = 3\n" + comparing, "p.toml:1 sound", "a whole number"},
      {"\narc = 7.5\n" + comparing, "p.toml:2 arc", "a number with a fraction"},
      {"staircase = \"x\"\n" + comparing, "p.toml:1 staircase", "text"},
      {comparing + "[[arc]]\nradius_m = 0.1\n", "p.toml:6 arc", "an array"},
      {comparing + "[[preset]]\n", "p.toml:6 preset", "an array"},
      {"runs = 2\n" + naming, "p.toml:1 runs", "a whole number"},
      {"start = true\n" + naming, "p.toml:1 start", "true or false"},
      {"sound = [1]\n" + naming, "p.toml:1 sound", "an array"},
      {"objects = 1\n" + naming.substr(0, naming.find("[objects]")), "p.toml:1 objects", "a whole number"},
      {"conditions = 5\n" + comparing.substr(0, comparing.find("[[")), "p.toml:1 conditions", "a whole number"},
      {"conditions = [5]\n" + comparing.substr(0, comparing.find("[[")), "p.toml:1 conditions", "no table"},
  };
  for (const Bad& bad : kBad) {
    CAPTURE(bad.text);
    const auto protocol = parse_protocol(bad.text, "p.toml");
    REQUIRE_FALSE(protocol);
    CHECK(protocol.error().where == bad.where);
    CHECK(protocol.error().what.find(bad.what) != std::string::npos);
    CHECK_FALSE(protocol.error().remedy.empty());
  }
}

}  // namespace
}  // namespace tangent::experiment
