// workbench devices --calibrate falcon against an emulated Falcon behind the real libusb, from the first question to a
// force that is one, by a person who reads a spring scale.
#include "tests/devices/usb/emulation/falcon_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "workbench/cli/command.h"
#include "workbench/session/falcon_setups.h"
#include "workbench/session/kept_devices.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::emulation;

namespace {

using AnswersQuestion = std::function<std::string(const std::string& question)>;

struct AskedRun {
  int code = 0;
  std::string text;  ///< standard output
};

/// The program's command, in this process, with pipes for standard input and output. Each line that ends in ']' is a
/// question, and is answered by another thread.
AskedRun run_asked(std::vector<const char*> arguments, const AnswersQuestion& answer) {
  std::array<int, 2> in{}, out{};
  REQUIRE(::pipe(in.data()) == 0);
  REQUIRE(::pipe(out.data()) == 0);
  std::fflush(stdout);
  const int stdin_before = ::dup(STDIN_FILENO), stdout_before = ::dup(STDOUT_FILENO);
  ::dup2(in[0], STDIN_FILENO);
  ::dup2(out[1], STDOUT_FILENO);
  ::close(out[1]);
  AskedRun run;
  std::thread person([&] {
    std::string line;
    char letter = 0;
    while (::read(out[0], &letter, 1) == 1) {
      run.text += letter;
      if (letter != '\n') {
        line += letter;
        continue;
      }
      const std::string said = line.ends_with("]") ? answer(line) + "\n" : std::string();
      if (::write(in[1], said.data(), said.size()) < 0) break;
      line.clear();
    }
  });
  arguments.insert(arguments.begin(), "workbench");
  run.code =
      run_program(static_cast<int>(arguments.size()), arguments.data(), headless_commands(), run_without_command);
  std::fflush(stdout);
  ::dup2(stdin_before, STDIN_FILENO);
  ::dup2(stdout_before, STDOUT_FILENO);  // the last end of the pipe: the person's reading ends
  person.join();
  for (const int end : {stdin_before, stdout_before, in[0], in[1], out[0]}) ::close(end);
  return run;
}

/// XDG_CONFIG_HOME in a folder of its own.
struct OwnConfiguration {
  OwnConfiguration() {
    const char* now = std::getenv("XDG_CONFIG_HOME");
    if (now != nullptr) before = now;
    ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
  }
  ~OwnConfiguration() {
    if (before.empty())
      ::unsetenv("XDG_CONFIG_HOME");
    else
      ::setenv("XDG_CONFIG_HOME", before.c_str(), 1);
  }
  testing::TempFolder folder;
  std::string before;
};

struct HeldFalcon {
  Testbed testbed;
  FalconModel model;
  PluggedDevice device{testbed, model, 4};
  HeldFalcon() {
    model.counts_per_nm = 12'500.0;
    device.plug_in();
    device.run();
  }
  double felt_n() {
    return device.board.with_model([&] { return model.hand_n_per_m * glm::length(model.place_m() - model.hand_m); });
  }
  /// As a person reads a scale: once it stands still. On a busy machine the force is late.
  double steady_n() {
    double before = felt_n();
    for (int i = 0, still = 0; i < 100 && still < 3; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      const double now = felt_n();
      still = std::abs(now - before) < 0.002 ? still + 1 : 0;
      before = now;
    }
    return before;
  }
};

constexpr int kTries = 200;  // on a busy machine, where one takes a second; beside compilers 40 were not enough

bool says(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE(
    "devices --calibrate falcon: what a spring scale reads becomes its torque scale, and 1 N is one from then on") {
  const OwnConfiguration own;
  HeldFalcon held;
  const std::string packets = own.folder.file("packets.txt");
  const auto person = [&](const std::string& question) -> std::string {
    if (!says(question, "a number and Enter")) return "yes";
    std::array<char, 32> read;  // of a scale with marks at each 0.01 N
    std::snprintf(read.data(), read.size(), "%.2f", held.steady_n());
    return read.data();
  };
  // Neither this program nor the emulated device runs in real time here: a late tick ends it, and a person begins
  // again.
  AskedRun run;
  for (int i = 0; i < kTries && (i == 0 || run.code != kDone); ++i) {
    std::filesystem::remove(packets);
    run = run_asked({"devices", "--calibrate", "falcon", "--packets", packets.c_str()}, person);
  }
  INFO(run.text);
  REQUIRE(run.code == kDone);
  CHECK(says(run.text, "torque not calibrated: begins with 5000 counts for 1 N m"));
  CHECK(says(run.text, "Keep a hand on its power switch"));
  CHECK(says(run.text, "kept for serial number F00001"));
  CHECK(testing::read_text(packets).size() > 100'000);
  CHECK(held.device.board.with_model([&] { return held.model.pushed_unhomed; }) == 0);
  CHECK_FALSE(held.device.board.with_model([&] { return held.model.pushes(); }));
  const auto kept = read_falcon_setup(falcon_setups_path(), "F00001");
  REQUIRE(kept);
  REQUIRE(*kept);
  CHECK((*kept)->torque_counts_per_nm == approx(12'500.0).epsilon(0.03));

  DeviceOptions patient;
  patient.falcon.silence_s = patient.falcon.line.answer_s = 100.0;
  auto made = make_devices_as_kept({"falcon", "none"}, patient);
  REQUIRE(made);
  REQUIRE(made->force->open());
  CHECK(made->force->capabilities().name == "Novint Falcon");
  REQUIRE(eventually([&] { return made->force->exchange({}, 1e-3).state == DeviceState::ready; }));
  CHECK(eventually([&] {
    made->force->exchange({.force_n = Vec3(0.0, 0.0, 1.0)}, 1e-3);
    return std::abs(held.felt_n() - 1.0) < 0.04;
  }));
  made->force->close();
}

TEST_CASE("devices --calibrate falcon: unplugged while it pulls, it ends without a scale, and keeps nothing") {
  const OwnConfiguration own;
  HeldFalcon held;
  bool unplugged = false;  // a late tick may end it before
  const auto person = [&](const std::string& question) -> std::string {
    if (!says(question, "a number and Enter")) return "yes";
    held.device.unplug();
    unplugged = true;
    return "0.25";
  };
  AskedRun run;
  for (int i = 0; i < kTries && !unplugged; ++i) run = run_asked({"devices", "--calibrate", "falcon"}, person);
  INFO(run.text);
  REQUIRE(unplugged);
  CHECK(run.code == kFailed);
  CHECK_FALSE(says(run.text, "Torque scale:"));
  CHECK_FALSE(*read_falcon_setup(falcon_setups_path(), "F00001"));
}
