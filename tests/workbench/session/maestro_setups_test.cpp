#include "workbench/session/maestro_setups.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::testing;

namespace {

const MaestroSetup kLeft{{-9.1e-3, 1012.25, 8.75e-3, 1987.5}, 3}, kRight{{-8e-3, 2100.0, 8e-3, 900.0}, 0};

}  // namespace

TEST_CASE("calibrations are kept by serial number, each reads back, and the others stay") {
  const TempFolder folder;
  const auto path = folder.path() / "new" / "folder" / "maestro.toml";
  CHECK(read_maestro_setup(path, "00012345").value() == std::nullopt);
  REQUIRE(keep_maestro_setup(path, "00012345", kLeft));
  REQUIRE(keep_maestro_setup(path, "odd \"serial\" \u00fc", kRight));
  CHECK(read_maestro_setup(path, "00012345").value() == kLeft);
  CHECK(read_maestro_setup(path, "odd \"serial\" \u00fc").value() == kRight);
  CHECK(read_maestro_setup(path, "00012346").value() == std::nullopt);
  REQUIRE(keep_maestro_setup(path, "00012345", kRight));
  CHECK(read_maestro_setup(path, "00012345").value() == kRight);
}

TEST_CASE("a file of calibrations that is not what it should be is refused with its line, and left as it is") {
  const TempFolder folder;
  const std::string good = "channel = 0\nlow_m = -0.01\nlow_us = 1000\nhigh_m = 0.01\n";
  for (const auto& [text, place, what] : {std::tuple{std::string("[1]\nlow_m = = 3\n"), ":2", ""},
                                          {"x = 3\n", ":1", "not a table"},
                                          {"[1]\n" + good, ":1", "missing"},
                                          {"[1]\n" + good + "high_us = \"many\"\n", ":6", "not a number"},
                                          {"[1]\n" + good + "higher_us = 3\n", ":6", "unknown"},
                                          {"[1]\n" + good + "high_us = 1000\n", ":1", "same pulse"},
                                          {"[1]\n" + good + "high_us = 9000\n", ":1", "outside"},
                                          {"[1]\n" + good + "high_us = nan\n", ":1", "finite"}}) {
    CAPTURE(text);
    const std::string file = folder.write("maestro.toml", text);
    const auto read = read_maestro_setup(file, "2");  // another's: the file is wrong all the same
    REQUIRE_FALSE(read.has_value());
    CHECK(contains(read.error().where, place));
    CHECK(contains(read.error().what, what));
    CHECK_FALSE(keep_maestro_setup(file, "2", kLeft));
    CHECK(read_text(file) == text);
  }
  CHECK_FALSE(keep_maestro_setup("/proc/nowhere/maestro.toml", "1", kLeft));
}

TEST_CASE("calibrations without a format are read as before, and a newer format is refused and left as it is") {
  const TempFolder folder;
  const auto path = folder.path() / "maestro.toml";
  REQUIRE(keep_maestro_setup(path, "1", kLeft));
  std::string text = read_text(path);
  const std::size_t line = text.find("format = 1\n");
  REQUIRE(line != std::string::npos);
  CHECK(text.find('[') > line);
  text.erase(line, std::string("format = 1\n").size());
  CHECK(read_maestro_setup(folder.write("maestro.toml", text), "1").value() == kLeft);
  const std::string newer = folder.write("maestro.toml", "format = 2\n" + text);
  const auto read = read_maestro_setup(newer, "1");
  REQUIRE_FALSE(read.has_value());
  CHECK(contains(read.error().message(), "maestro.toml:1 format: this file has format 2, this program reads up to 1"));
  CHECK_FALSE(keep_maestro_setup(newer, "1", kRight));
  CHECK(read_text(newer) == "format = 2\n" + text);
  CHECK_FALSE(keep_maestro_setup(folder.path() / "none.toml", "format", kLeft));  // the one name that is taken
}

TEST_CASE("what is asked for counts instead of what is kept, each value by itself, the program's own included") {
  const TempFolder folder;
  CHECK(chosen_maestro_setup(wish_for(kLeft), folder.path() / "maestro.toml").value() == kLeft);
  CHECK(wish_for(kLeft).over({}) == kLeft);
  CHECK(MaestroWish{}.over(kLeft) == kLeft);
  MaestroWish wish;
  wish.low_us = MaestroCalibration{}.low_us;
  MaestroSetup expected = kLeft;
  expected.calibration.low_us = MaestroCalibration{}.low_us;
  REQUIRE_FALSE(expected == kLeft);
  CHECK(wish.over(kLeft) == expected);
  CHECK(chosen_maestro_setup({}, {}).value() == MaestroSetup{});
}
