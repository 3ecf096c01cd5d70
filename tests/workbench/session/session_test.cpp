#include "workbench/session/session.h"

#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/exploration_path.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

std::unique_ptr<Session> started(SessionOptions options, std::shared_ptr<const ContactScene> scene = torus_scene()) {
  options.servo.realtime = false;
  auto session = Session::create(std::move(scene), Preset{}, std::move(options));
  REQUIRE(session);
  (*session)->start();
  return std::move(*session);
}

SessionOptions by_hand() {
  SessionOptions o;
  o.threaded = false;
  return o;
}

bool same_output(const TickOutput& a, const TickOutput& b) {
  const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return a.status == b.status && a.event == b.event && a.triangle == b.triangle && same(a.u, b.u) && same(a.v, b.v) &&
         same(a.contact, b.contact) && same(a.normal, b.normal) && same(a.penetration_m, b.penetration_m) &&
         same(a.force_n, b.force_n) && same(a.cld_m, b.cld_m) && same(a.error_m, b.error_m) &&
         a.iterations == b.iterations && a.triangle_changes == b.triangle_changes;
}

}  // namespace

TEST_CASE("a session refuses what it can't run") {
  SessionOptions slow = by_hand(), fast = by_hand(), odd = by_hand(), no_number = by_hand();
  slow.servo.rate_hz = 99.0;
  fast.servo.rate_hz = 10'001.0;
  no_number.servo.rate_hz = std::numeric_limits<double>::quiet_NaN();
  odd.devices.display = "teapot";
  for (const SessionOptions& options : {slow, fast, odd, no_number})
    CHECK_FALSE(Session::create(sphere_scene(), Preset{}, options));
  Preset bad;
  bad.force.stiffness_n_per_m = -1.0;
  CHECK_FALSE(Session::create(sphere_scene(), bad, by_hand()));
}

TEST_CASE("a session takes the way that its scene was prepared with, of another scene it makes its own") {
  Finger wide = Preset{}.finger;
  wide.radius_m *= 2.0;
  const auto scene = torus_scene();
  const double own = ExplorationPath::build(*scene, pad_distance_m(Preset{}.finger)).length_m();
  const double prepared = ExplorationPath::build(*scene, pad_distance_m(wide)).length_m();
  REQUIRE(own != prepared);
  const auto length_over = [&](const std::shared_ptr<const ContactScene>& of) {
    auto session = Session::create(scene, Preset{}, by_hand(), Session::prepare(of, wide));
    REQUIRE(session);
    return (*session)->path().length_m();
  };
  CHECK(length_over(scene) == prepared);
  CHECK(length_over(sphere_scene()) == own);
  auto session = Session::create(scene, Preset{}, by_hand());
  REQUIRE(session);
  CHECK((*session)->path().length_m() == own);
}

TEST_CASE("a stiffness above the device's largest is not rendered, nor recorded as if it were") {
  Preset stiff;
  stiff.force.stiffness_n_per_m = 9000.0;
  auto made = Session::create(sphere_scene(), stiff, by_hand());
  REQUIRE(made);
  Session& session = **made;
  const double largest = session.force_capabilities()->largest_stiffness_n_per_m;
  CHECK(largest == 3500.0);
  CHECK(session.preset().force.stiffness_n_per_m == largest);
  stiff.force.stiffness_n_per_m = 2000.0;
  REQUIRE(session.set_preset(stiff));
  CHECK(session.preset().force.stiffness_n_per_m == 2000.0);
  stiff.force.stiffness_n_per_m = 4000.0;
  const auto id = session.set_preset(stiff);
  REQUIRE(id);
  CHECK(session.preset(*id)->force.stiffness_n_per_m == largest);
  stiff.force.stiffness_n_per_m = 5000.0;
  CHECK(session.set_preset(stiff) == *id);  // nothing changed
  CHECK_FALSE(session.needs_yes());         // simulated
}

TEST_CASE("driven by hand, the same calls give the same history") {
  const auto run = [] {
    auto session = started(by_hand());
    session->advance(1500);
    Preset preset;
    preset.solver.method = Method::paper;
    REQUIRE(session->set_preset(preset));
    session->advance(700);
    session->set_hand_target(Vec3(0.08, 0.0, 0.0));
    session->advance(800);
    return session;
  };
  const auto a = run(), b = run();
  REQUIRE(a->history().size() == 3000);
  REQUIRE(b->history().size() == 3000);
  for (std::size_t i = 0; i < 3000; ++i) {
    const ServoRecord &x = a->history()[i], &y = b->history()[i];
    REQUIRE(same_output(x.tick.output, y.tick.output));
    CHECK(x.tick.input.finger.position == y.tick.input.finger.position);
    CHECK(x.tick.solve_ns == y.tick.solve_ns);
    CHECK(x.tick_ns == 0.0);
    CHECK(x.tick.input.t_s == approx(static_cast<double>(i) * 1e-3).epsilon(1e-12).scale(1e-3));
  }
}

TEST_CASE("every recorded tick, stepped again with its preset and scene, gives the same bits and its iterations") {
  auto session = started(by_hand());
  session->advance(1200);
  Preset paper;
  paper.solver.method = Method::paper;
  REQUIRE(session->set_preset(paper));
  session->advance(500);
  session->set_scene(sphere_scene());
  session->advance(800);
  auto trace = std::make_unique<IterationTrace>();
  std::size_t with_iterations = 0;
  for (std::size_t i = session->history().size(); i-- > 0;) {  // backwards: no memory of earlier ticks is needed
    const ServoRecord& record = session->history()[i];
    const auto output = session->re_step(record, *trace);
    REQUIRE(output);
    REQUIRE(same_output(*output, record.tick.output));
    with_iterations += trace->size > 1;
    if (output->iterations > 0) CHECK(trace->size > 0);
  }
  CHECK(with_iterations > 100);
}

TEST_CASE("a tick can be stepped under another preset") {
  auto session = started(by_hand());
  session->advance(1500);
  Preset stiff = session->preset();
  stiff.force.stiffness_n_per_m *= 2.0;
  auto trace = std::make_unique<IterationTrace>();
  const ServoRecord& record = session->history().newest();
  REQUIRE(record.tick.output.force_n != Vec3(0.0));
  const auto output = session->re_step(record, stiff, *trace);
  REQUIRE(output);
  CHECK(glm::length(output->decided_force_n) == approx(2.0 * glm::length(record.tick.output.decided_force_n)));
}

TEST_CASE("a tick whose scene is gone from the history says so") {
  SessionOptions options = by_hand();
  options.history_s = 1.0;  // 1,024 records at least
  auto session = started(options);
  session->advance(10);
  const ServoRecord old = session->history().newest();
  session->set_scene(sphere_scene());
  session->advance(500);
  auto trace = std::make_unique<IterationTrace>();
  CHECK(session->re_step(old, *trace));
  session->advance(1000);
  CHECK(session->scene(0) == nullptr);
  CHECK(session->scene(1) != nullptr);
  const auto gone = session->re_step(old, *trace);
  REQUIRE_FALSE(gone);
  CHECK(gone.error().where.find('9') != std::string::npos);
}

TEST_CASE("presets get ids, the same preset keeps its own, and a bad one changes nothing") {
  auto session = started(by_hand());
  CHECK(session->preset_id() == 0);
  CHECK(*session->set_preset(Preset{}) == 0);
  Preset other;
  other.solver.gain_overall = 0.5;
  CHECK(*session->set_preset(other) == 1);
  CHECK(*session->set_preset(other) == 1);
  Preset bad = other;
  bad.solver.tolerance_m = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(session->set_preset(bad));
  CHECK(session->preset() == other);
  CHECK(*session->preset(0) == Preset{});
  CHECK(session->preset(2) == nullptr);
  CHECK(session->status().preset_sent == 1);
  CHECK(session->status().servo.preset_id == 0);  // not yet applied
  session->advance(1);
  CHECK(session->status().servo.preset_id == 1);
}

TEST_CASE("stop takes the force away, arm brings it back") {
  auto session = started(by_hand());
  session->advance(1500);
  CHECK(session->status().servo.gate_state == GateState::armed);
  CHECK(session->status().force_state == DeviceState::ready);
  session->stop();
  session->advance(2);
  CHECK(session->history().newest().device.force_rendered_n == Vec3(0.0));
  CHECK(session->status().servo.gate_state == GateState::disarmed);
  session->arm();
  session->advance(1000);
  CHECK(session->status().servo.gate_state == GateState::armed);
  CHECK(session->history().newest().device.force_rendered_n != Vec3(0.0));
}

TEST_CASE("a session without devices still tracks the hand") {
  SessionOptions options = by_hand();
  options.devices = {"none", "none"};
  auto session = started(options);
  session->advance(1500);
  CHECK(session->force_capabilities() == nullptr);
  CHECK(session->display_capabilities() == nullptr);
  CHECK(session->history().newest().tick.output.penetration_m > 0.0);
  CHECK(session->history().newest().device.force_command_n == Vec3(0.0));
}

TEST_CASE("hand settings that are not finite are ignored") {
  auto session = started(by_hand());
  const HandSettings before = session->hand();
  session->set_hand({.speed_m_per_s = std::numeric_limits<double>::quiet_NaN()});
  session->set_hand_target(Vec3(0.0, std::numeric_limits<double>::infinity(), 0.0));
  CHECK(session->hand() == before);
}

TEST_CASE("a running session takes presets, scenes and targets from its owner while the servo ticks") {
  SessionOptions options;
  auto session = started(options, sphere_scene());
  Preset preset;
  std::uint64_t records = 0;
  std::uint32_t scene = 0;
  for (int frame = 0; frame < 60; ++frame) {
    preset.solver.gain_curvature_m = 0.001 * frame;
    REQUIRE(session->set_preset(preset));
    if (frame % 20 == 10) scene = session->set_scene(frame % 40 == 10 ? torus_scene() : sphere_scene());
    if (frame == 25) session->set_hand_target(Vec3(0.06, 0.0, 0.0));
    if (frame == 40) session->set_hand({});
    if (frame == 45) session->stop();
    if (frame == 50) session->arm();
    records += session->poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  session->shut_down();
  const SessionStatus status = session->status();
  CHECK(status.servo.preset_id == session->preset_id());
  CHECK(status.servo.scene_id == scene);
  CHECK(status.servo.ticks == session->history().size() + status.servo.gui_drops);
  CHECK(records <= session->history().size());
  // Each record ran on a preset and scene that the session knows, and neither ever went back.
  auto trace = std::make_unique<IterationTrace>();
  for (std::size_t i = 0; i < session->history().size(); ++i) {
    const ServoRecord& r = session->history()[i];
    if (i > 0) {
      CHECK(r.tick.preset_id >= session->history()[i - 1].tick.preset_id);
      CHECK(r.scene_id >= session->history()[i - 1].scene_id);
    }
    const auto again = session->re_step(r, *trace);
    REQUIRE(again);
    REQUIRE(same_output(*again, r.tick.output));
  }
  MESSAGE("ticks " << status.servo.ticks << ", late " << status.servo.late_ticks << ", tick mean "
                   << status.servo.tick_mean_ns * 1e-3 << " us, p50 " << status.servo.tick_p50_ns * 1e-3 << ", p99 "
                   << status.servo.tick_p99_ns * 1e-3 << ", p99.9 " << status.servo.tick_p999_ns * 1e-3 << ", worst "
                   << status.servo.tick_worst_ns * 1e-3);
}

TEST_CASE("a session can be shut down twice, started again, and dropped while running") {
  auto session = started(SessionOptions{}, sphere_scene());
  session->shut_down();
  session->shut_down();
  CHECK_FALSE(session->running());
  session->start();
  CHECK(session->running());
  session.reset();
}

TEST_CASE("a session whose force device keeps the time runs by its calls") {
  SessionOptions options = by_hand();
  options.threaded = true;
  options.devices.force = "scheduled";
  options.servo.rate_hz = 250.0;  // not the device's
  auto session = started(options);
  CHECK(session->status().servo.nominal_hz == 1000.0);
  while (session->status().servo.ticks < 600) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    session->poll();
  }
  session->shut_down();
  const std::uint64_t ticks = session->status().servo.ticks;
  CHECK(session->history().newest().tick.tick + 1 == ticks);
  CHECK(session->history().newest().device.force_state == DeviceState::ready);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(session->status().servo.ticks == ticks);
}
