#include "devices/usb/packet_recorder.h"

#include "devices/cld/cld_controller.h"
#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/temp_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <sstream>

using namespace tangent;
using namespace tangent::emulation;

TEST_CASE("every packet of a link is written down and reads back as the frames it held") {
  const testing::TempFolder folder;
  const std::string file = folder.file("packets.txt");
  std::uint64_t in = 0;
  {
    Testbed testbed;
    CldModel model;
    PluggedDevice device(testbed, model, 4);
    device.plug_in();
    device.run();
    auto recorder = PacketRecorder::create(file);
    REQUIRE(recorder);
    CldControllerOptions options;
    options.tap = recorder->get();
    CldController cld(options);
    REQUIRE(cld.open());
    LinkReport report;
    REQUIRE(eventually([&] {
      cld.exchange({}, 1e-3);
      cld.report(report);
      return report.packets_in > 200;
    }));
    cld.close();
    cld.report(report);
    in = report.packets_in;
    CHECK((*recorder)->drops() == 0);
  }
  std::istringstream lines(testing::read_text(file));
  std::string line;
  std::uint64_t counted = 0;
  CldParser parser;
  while (std::getline(lines, line)) {
    if (line.starts_with("#")) continue;
    std::istringstream fields(line);
    std::string direction, hex;
    double t = -1.0;
    int status = -1;
    std::size_t size = 0;
    REQUIRE((fields >> t >> direction >> status >> size));
    fields >> hex;
    CHECK(hex.size() == 2 * size);
    if (direction != "in") continue;
    ++counted;
    for (std::size_t i = 0; i < size; ++i)
      parser.feed(static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, 16)));
  }
  CHECK(counted == in);
  CHECK(parser.counts().frames >= 200);
  CHECK(parser.counts().crc_errors == 0);
}

TEST_CASE("a file that can't be written is refused") {
  CHECK_FALSE(PacketRecorder::create("/no/such/folder/packets.txt"));
  CHECK_FALSE(PacketRecorder::create("/dev/full"));
}

TEST_CASE("a log that lacks packets says so") {
  const testing::TempFolder folder;
  const std::string pipe = folder.file("pipe");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  REQUIRE(reader >= 0);
  auto* const before = std::signal(SIGPIPE, SIG_IGN);
  {
    auto recorder = PacketRecorder::create(pipe);
    REQUIRE(recorder);
    CHECK((*recorder)->complete());
    ::close(reader);
    const std::array<std::uint8_t, 3> bytes{1, 2, 3};
    (*recorder)->packet(UsbTap::Direction::in, 0, bytes, 0);
    REQUIRE(eventually([&] { return !(*recorder)->complete(); }));
    CHECK((*recorder)->complete().error().where == pipe);
  }
  std::signal(SIGPIPE, before);
}
