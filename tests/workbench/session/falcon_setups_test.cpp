#include "workbench/session/falcon_setups.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE("what is kept of a Falcon comes back by its serial number, and others stay") {
  const testing::TempFolder folder;
  const auto path = folder.path() / "new" / "falcon.toml";
  CHECK_FALSE(*read_falcon_setup(path, "F1"));
  const FalconSetup one{12'345.5, "/home/me/nvent.bin", "ab01"}, two{0.0, "", ""};
  REQUIRE(keep_falcon_setup(path, "F1", one));
  REQUIRE(keep_falcon_setup(path, "odd \"serial\"", two));
  CHECK(**read_falcon_setup(path, "F1") == one);
  CHECK(**read_falcon_setup(path, "odd \"serial\"") == two);
  CHECK_FALSE(*read_falcon_setup(path, "F2"));
}

TEST_CASE("a Falcon's file with an error in it is named by its line, and not overwritten") {
  const testing::TempFolder folder;
  for (const char* text :
       {"[F1]\ntorque_counts_per_nm = \"many\"\n", "[F1]\ntorque_counts_per_nm = 1.0\n",
        "[F1]\ntorque_counts_per_nm = nan\n", "[F1]\nfirmware = 5\n", "[F1]\nother = 1\n", "F1 = 3\n"}) {
    const std::string file = folder.write("falcon.toml", text);
    const auto read = read_falcon_setup(file, "F1");
    REQUIRE_FALSE(read);
    CHECK(read.error().where.find("falcon.toml:") != std::string::npos);
    CHECK_FALSE(keep_falcon_setup(file, "F2", {}));
    FalconOptions given;
    given.serial = "F1";
    CHECK_FALSE(chosen_falcon_options(given, file));
  }
  CHECK_FALSE(keep_falcon_setup(folder.path() / "falcon2.toml", "", {}));
}

TEST_CASE("what is given for a Falcon goes before what is kept, and is kept where asked") {
  const testing::TempFolder folder;
  const auto path = folder.path() / "falcon.toml";
  REQUIRE(keep_falcon_setup(path, "F1", {9000.0, "/a.bin", "aa"}));
  FalconOptions given;
  given.serial = "F1";
  const auto kept = chosen_falcon_options(given, path);
  REQUIRE(kept);
  CHECK(kept->torque_counts_per_nm == 9000.0);
  CHECK(kept->firmware == "/a.bin");
  CHECK(kept->firmware_sha256 == "aa");
  given.torque_counts_per_nm = 8000.0;
  given.keep = true;
  CHECK(chosen_falcon_options(given, path)->torque_counts_per_nm == 8000.0);
  CHECK(**read_falcon_setup(path, "F1") == FalconSetup{8000.0, "/a.bin", "aa"});
  // Another file needs a confirmation of its own.
  FalconOptions other;
  other.serial = "F1";
  other.firmware = "/b.bin";
  CHECK(chosen_falcon_options(other, path)->firmware_sha256.empty());
  CHECK(**read_falcon_setup(path, "F1") == FalconSetup{8000.0, "/a.bin", "aa"});
  // Another Falcon has none of it.
  FalconOptions stranger;
  stranger.serial = "F2";
  CHECK(chosen_falcon_options(stranger, path)->torque_counts_per_nm == 0.0);
  CHECK(chosen_falcon_options(stranger, path)->kept.empty());
  // Where none is there yet, all of it goes along.
  const auto later = chosen_falcon_options({}, path);
  REQUIRE(later);
  CHECK(later->serial.empty());
  CHECK(later->torque_counts_per_nm == 0.0);
  CHECK(later->kept == FalconSetups{{"F1", {8000.0, "/a.bin", "aa"}}});
  CHECK_FALSE(chosen_falcon_options({}, folder.write("bad.toml", "F1 = 3\n")));
  stranger.serial.clear();
  stranger.keep = true;
  CHECK_FALSE(chosen_falcon_options(stranger, ""));
}

TEST_CASE("a Falcon's measured torque scale is kept beside its firmware") {
  const testing::TempFolder folder;
  const auto path = folder.path() / "falcon.toml";
  REQUIRE(keep_falcon_setup(path, "F1", {9000.0, "/a.bin", "aa"}));
  REQUIRE(keep_falcon_scale(path, "F1", 12'500.0));
  CHECK(**read_falcon_setup(path, "F1") == FalconSetup{12'500.0, "/a.bin", "aa"});
  REQUIRE(keep_falcon_scale(path, "F2", 7000.0));
  CHECK(**read_falcon_setup(path, "F2") == FalconSetup{7000.0, "", ""});
  CHECK_FALSE(keep_falcon_scale(path, "", 7000.0));
}
