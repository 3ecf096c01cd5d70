// The two programs are one build: what one records, the other opens without a warning.
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"
#include "workbench/gui/model/opened_recording.h"
#include "workbench/recording/build_identity.h"
#include "workbench/recording/core_digest.h"

#include <doctest/doctest.h>

using namespace tangent;

namespace {

TEST_CASE("a recording made without a window is not taken for another build's") {
  CHECK(std::string(core_digest()).size() == 64);
  const testing::TempFolder folder;
  const std::string file = folder.file("run.sqlite");
  REQUIRE(testing::run_workbench({"record", "--seconds", "0.2", "--without-waiting", "--out", file}).exit_code == 0);
  const auto opened = OpenedRecording::open(file, {});
  REQUIRE(opened);
  CHECK((*opened)->info().build == build_identity());
  CHECK((*opened)->remarks().empty());
}

}  // namespace
