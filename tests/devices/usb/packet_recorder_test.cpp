#include "devices/usb/packet_recorder.h"

#include "devices/cld/cld_controller.h"
#include "tests/devices/usb/emulation/cld_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "tests/support/temp_folder.h"

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
}
