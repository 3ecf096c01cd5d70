// workbench devices --calibrate: by lines of a pipe, in simulated time; and what devices says of one that isn't open.
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"
#include "workbench/bringup/force_calibration.h"
#include "workbench/cli/command.h"
#include "workbench/cli/device_list.h"

#include <nlohmann/json.hpp>

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tangent {
namespace {

using testing::contains;
using testing::ProcessResult;
using testing::TempFolder;

/// `lines`: a format of printf.
ProcessResult calibrate_by_lines(const std::string& lines) {
  return testing::Process({"-c", "printf \"$1\" | \"$0\" devices --calibrate simulated --without-waiting",
                           testing::program(), lines},
                          "/bin/sh")
      .wait();
}

}  // namespace

TEST_CASE("devices --calibrate: half the force by the scale gives twice the counts") {
  const ProcessResult run =
      calibrate_by_lines("yes\\nyes\\nyes\\nyes\\n0.125\\nyes\\n0.25\\nyes\\n0,375\\nyes\\n0.5\\nyes\\n");
  CHECK(run.exit_code == 0);
  CHECK(run.err.empty());
  CHECK(contains(run.out, "asked for 0.25 N, read 0.12 N"));
  CHECK(contains(run.out, "Torque scale: 10000 counts for 1 N m"));
  CHECK(contains(run.out, "nothing is kept"));
}

TEST_CASE("devices --calibrate: a stop at any step, a refusal and readings on no line leave with 1 and no scale") {
  const std::string all[] = {"yes", "yes", "yes", "yes", "0.2", "yes", "0.4", "yes", "0.6", "yes", "0.8"};
  std::string lines;
  for (const std::string& line : all) {
    for (const char* last : {"stop\\n", ""}) {  // or the end of the input
      const ProcessResult run = calibrate_by_lines(lines + last);
      CAPTURE(lines);
      CHECK(run.exit_code == 1);
      CHECK(contains(run.err, "stopped by the person"));
      CHECK_FALSE(contains(run.out, "Torque scale:"));
    }
    lines += line + "\\n";
  }
  const ProcessResult refused = calibrate_by_lines("yes\\nyes\\nyes\\nno\\n");
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "it was refused"));
  const ProcessResult crooked =
      calibrate_by_lines("yes\\nyes\\nyes\\nyes\\n0.2\\nyes\\n0.9\\nyes\\n0.3\\nyes\\n0.8\\nyes\\n");
  CHECK(crooked.exit_code == 1);
  CHECK(contains(crooked.err, "on no line"));
  CHECK_FALSE(contains(crooked.out, "Torque scale:"));
}

TEST_CASE("devices --calibrate: a line that is no reading stops it, and says what to write") {
  const ProcessResult run = calibrate_by_lines("yes\\nyes\\nyes\\nyes\\nabout half\\n");
  CHECK(run.exit_code == 1);
  CHECK(contains(run.err, "about half"));
  CHECK(contains(run.err, "write newtons, as 0.27"));
}

TEST_CASE("devices --calibrate: wrong usage leaves with 2") {
  const auto wrong = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"devices"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return testing::run_workbench(std::move(arguments)).exit_code;
  };
  CHECK(wrong({"--calibrate", "haply"}) == 2);
  CHECK(wrong({"--calibrate", "falcon", "--without-waiting"}) == 2);
  CHECK(wrong({"--calibrate", "simulated", "--check", "simulated"}) == 2);
  CHECK(wrong({"--calibrate", "simulated", "--out", "p.json"}) == 2);
}

TEST_CASE("devices --calibrate: readings of a scale") {
  CHECK(newtons_of_line("0.27") == 0.27);
  CHECK(newtons_of_line("0,27") == 0.27);
  CHECK(newtons_of_line("1") == 1.0);
  for (const char* none : {"", "0", "-1", "nan", "inf", "101", "0.27 N", "yes", "1e999", "0,2,7"})
    CHECK_FALSE(newtons_of_line(none));
}

TEST_CASE("devices says of a real device that isn't open that its force is not known") {
  const TempFolder folder;
  DeviceOptions options;
  options.serial.dev = folder.file("dev");
  std::filesystem::create_directories(options.serial.dev);
  std::ofstream(folder.file("dev/ttyACM0")) << "";
  nlohmann::json report = nlohmann::json::array();
  const std::string text = list_devices(options, report);
  CHECK(contains(text, "force      not known until it is opened"));
  CHECK_FALSE(contains(text, "peak 0.0 N"));
}

}  // namespace tangent
