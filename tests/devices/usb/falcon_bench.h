// The Falcon's driver and an emulated Falcon behind the real libusb.
#pragma once

#include "devices/falcon/falcon_device.h"
#include "tests/devices/usb/emulation/falcon_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/falcon_rig.h"
#include "tests/devices/usb/usb_checks.h"

namespace tangent::emulation {

/// The driver and its device. Time-outs are as good as none, so that nothing depends on the machine's load.
struct FalconBench {
  Testbed testbed;
  FalconModel model;
  PluggedDevice device;
  FalconDevice falcon;
  ForceSample sample;

  static FalconOptions patient(FalconOptions o = {}) {
    o.torque_counts_per_nm = 10'000.0;
    o.silence_s = o.line.answer_s = o.line.servo_gone_s = 100.0;
    o.line.question_s = 5.0;
    return o;
  }
  explicit FalconBench(const FalconOptions& options = patient(), NodeBy by = NodeBy::shim)
      : device(testbed, model, 4, by), falcon(options) {
    model.answers_at_once = true;
  }
  ~FalconBench() { falcon.close(); }
  void begin() {
    device.plug_in();
    device.run();
    REQUIRE(falcon.open());
  }
  const ForceSample& exchange(const Vec3& force = Vec3(0.0), DeviceRequest request = DeviceRequest::none) {
    return sample = falcon.exchange({.force_n = force, .request = request}, 1e-3);
  }
  bool reach(DeviceState state) {
    return eventually([&] { return exchange().state == state; });
  }
  void make_ready() { REQUIRE(reach(DeviceState::ready)); }
  bool is_pushed() {
    return device.board.with_model([&] { return model.pushes(); });
  }
  LinkReport report() {
    LinkReport r;
    REQUIRE(falcon.report(r));
    return r;
  }
};

}  // namespace tangent::emulation
