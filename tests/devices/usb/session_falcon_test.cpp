// A whole session with a Falcon on USB: servo thread, link thread, gate, a surface under the finger.
#include "core/lab/objects/generate.h"
#include "devices/falcon/falcon_device.h"
#include "tests/devices/usb/emulation/falcon_model.h"
#include "tests/devices/usb/emulation/testbed.h"
#include "tests/devices/usb/usb_checks.h"
#include "workbench/session/session.h"

#include <vector>

using namespace tangent;
using namespace tangent::emulation;

namespace {

struct FalconSession {
  Testbed testbed;
  FalconModel model;
  PluggedDevice device{testbed, model, 4};
  std::unique_ptr<Session> session;
  DeviceTelemetry last;

  FalconSession() {
    model.answers_at_once = true;
    device.plug_in();
    device.run();
    FalconOptions falcon;
    falcon.torque_counts_per_nm = 10'000.0;
    falcon.silence_s = falcon.line.answer_s = falcon.line.servo_gone_s = 100.0;
    falcon.line.question_s = 5.0;
    auto mesh = ContactMesh::build(make_icosphere(0.040, 3));
    REQUIRE(mesh);
    auto scene = ContactScene::build(std::move(*mesh));
    REQUIRE(scene);
    SessionOptions options;
    options.place.offset_m = Vec3(0.0, 0.0, 0.08);  // 4 cm above the sphere
    DeviceSet set;
    set.force = std::make_unique<FalconDevice>(falcon);
    auto made = Session::create(*scene, Preset{}, options, std::move(set));
    REQUIRE(made);
    session = std::move(*made);
    session->attach_recorder();
    REQUIRE(session->start());
  }
  ~FalconSession() { static_cast<void>(session->shut_down()); }

  bool take() {
    session->poll();
    ServoRecord record;
    bool any = false;
    while (session->pop_recorded(record)) {
      last = record.device;
      any = true;
    }
    return any;
  }
  void hold_at(const Vec3& off_m) {
    device.board.with_model([&] { model.hand_m = kFalconCentre_m + off_m; });
  }
  /// The test machine is not real-time, so late ticks occur: the test lifts the finger and arms again, as a person
  /// would.
  bool feels_the_surface() {
    return eventually(
        [&] {
          take();
          const GateState gate = session->status().servo.gate_state;
          if (gate == GateState::armed || gate == GateState::ramping)
            hold_at({0.0, -0.038, 0.0});
          else
            hold_at(Vec3(0.0)), session->arm();
          const bool live = last.gate_state == GateState::armed || last.gate_state == GateState::ramping;
          return live && last.force_rendered_n != Vec3(0.0) && device.board.with_model([&] { return model.pushes(); });
        },
        kLongest_s);
  }
  /// Homed, without arming. Where the servo stood still in an exchange for longer than the session allows, the device
  /// was stopped, and only arming clears that: then `cleared`.
  bool becomes_ready(bool& cleared) {
    cleared = false;
    return eventually(
        [&] {
          if (!take()) return false;
          if (last.force_state == DeviceState::faulted) session->arm(), cleared = true;
          return last.force_state == DeviceState::ready;
        },
        kLongest_s);
  }
  bool is(DeviceState state) {
    return eventually([&] { return take() && last.force_state == state; }, kLongest_s);
  }
  static constexpr double kLongest_s = 120.0;  ///< only ends a test that hangs
};

}  // namespace

TEST_CASE(
    "a session with a Falcon waits for its homing and for a yes, feels the surface below it, and stops when it goes") {
  FalconSession s;
  CHECK(s.session->needs_yes());  // its firmware has no time-out that is known
  bool cleared = false;
  REQUIRE(s.becomes_ready(cleared));
  s.session->arm();
  for (int i = 0; i < 20; ++i) REQUIRE(eventually([&] { return s.take(); }));
  CHECK(s.last.gate_state == GateState::disarmed);
  s.session->accept_no_timeout();
  for (int round = 0; round < 2; ++round) {
    REQUIRE(s.feels_the_surface());
    s.device.unplug();
    REQUIRE(s.is(DeviceState::absent));
    REQUIRE(eventually([&] { return s.take() && s.last.gate_state == GateState::faulted; }));
    CHECK(s.last.force_rendered_n == Vec3(0.0));
    s.hold_at(Vec3(0.0));
    s.device.plug_in();
    REQUIRE(s.becomes_ready(cleared));
    if (!cleared) CHECK(s.last.gate_state == GateState::faulted);  // until a person arms
  }
  CHECK(s.device.board.with_model([&] { return s.model.pushed_unhomed; }) == 0);
}
