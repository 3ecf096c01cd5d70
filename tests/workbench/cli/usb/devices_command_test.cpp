// workbench devices and workbench monitor with emulated USB devices.
#include "workbench/cli/command.h"

#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/maestro_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/temp_folder.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::emulation;

namespace {

/// Standard output of the program's command.
std::string output_of(std::vector<const char*> arguments, int exit_code = 0) {
  const testing::TempFolder folder;
  const std::string file = folder.file("out");
  std::fflush(stdout);
  const int before = ::dup(STDOUT_FILENO), out = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(out, STDOUT_FILENO);
  arguments.insert(arguments.begin(), "workbench");
  const int code =
      run_program(static_cast<int>(arguments.size()), arguments.data(), headless_commands(), run_without_command);
  std::fflush(stdout);
  ::dup2(before, STDOUT_FILENO);
  ::close(before);
  ::close(out);
  CHECK(code == exit_code);
  return testing::read_text(file);
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("workbench devices lists what is attached and what it can do") {
  Testbed testbed;
  CldModel cld;
  MaestroModel maestro;
  PluggedDevice one(testbed, cld, 4), two(testbed, maestro, 5);
  const std::string none = output_of({"devices"});
  CHECK(has(none, "simulated force device"));
  CHECK(has(none, "CLD controller: none attached"));
  CHECK(has(none, "Pololu Maestro: none attached"));
  one.plug_in();
  one.run();
  two.plug_in();
  const std::string both = output_of({"devices"});
  CHECK(has(both, "CLD controller 1209:0001 on bus 1, address 4, firmware 1.2, serial 77"));
  CHECK(has(both, "travel     20.0 mm, 0.80 um steps"));
  CHECK(has(both, "stops by itself 50 ms after the last command"));
  CHECK(has(both, "Pololu Maestro 1ffb:0089 on bus 1, address 5"));
  CHECK(has(both, "no time-out of its own"));
}

TEST_CASE("workbench devices says why a device can't be opened") {
  Testbed testbed;
  CldModel cld;
  PluggedDevice device(testbed, cld, 4);
  device.plug_in(EACCES);
  const std::string forbidden = output_of({"devices"});
  CHECK(has(forbidden, "may not be opened by this user"));
  CHECK(has(forbidden, "60-tangent-workbench.rules"));
  device.unplug();
  device.board.claim_error = EBUSY;
  device.plug_in();
  CHECK(has(output_of({"devices"}), "in use by another program"));
  device.unplug();
  device.board.claim_error = 0;
  cld.has_firmware = false;
  device.plug_in();
  device.run();
  CHECK(has(output_of({"devices"}), "load its firmware"));
}

TEST_CASE("workbench monitor for some seconds leaves with 1 when a device was not there at any time") {
  Testbed testbed;
  CldModel cld;
  PluggedDevice device(testbed, cld, 4);
  CHECK(has(output_of({"monitor", "--device", "cld", "--seconds", "0.2"}, 1), "not connected"));
  CHECK(has(output_of({"monitor", "--seconds", "0.2"}), "Tick to tick:"));
}

TEST_CASE("workbench monitor drives the display on the cable and reports") {
  Testbed testbed;
  CldModel cld;
  cld.watchdog_on = false;  // it would stop on a busy machine, and at the end in place of the program
  PluggedDevice device(testbed, cld, 4);
  device.plug_in();
  device.run();
  const testing::TempFolder folder;
  const std::string packets = folder.file("packets.txt");
  const std::string text = output_of({"monitor", "--device", "cld", "--seconds", "2", "--packets", packets.c_str()});
  CHECK(has(text, "display ready"));
  CHECK(has(text, "Link: connected, firmware 1.2, serial 77"));
  CHECK(has(text, "Round trip:"));
  CHECK(has(text, "contact display: ready"));
  CHECK(testing::read_text(packets).size() > 10'000);
  CHECK_FALSE(device.board.with_model([&] { return cld.targets.empty(); }));
  CHECK(device.board.with_model([&] { return cld.state(); }) == CldDeviceState::idle);  // let go at the end
}
