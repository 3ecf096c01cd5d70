#include "devices/maestro/maestro_display.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tangent {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr std::uint32_t kFailuresToLoss = 3;

DisplayCapabilities describe(const MaestroOptions& o) {
  const MaestroCalibration& c = o.calibration;
  // The travel is symmetric about 0: of the two calibrated positions the one nearer to 0 bounds it.
  return {.name = "Pololu Maestro",
          .travel_m = 2.0 * std::min(-c.low_m, c.high_m),
          .resolution_m = 0.25 * (c.high_m - c.low_m) / std::abs(c.high_us - c.low_us),
          .rate_hz = 50.0,
          .measures_position = false};
}

}  // namespace

UsbLinkOptions maestro_link_options() {
  UsbLinkOptions o;
  o.match.vendor = kMaestroVendor;
  o.match.products.assign(std::begin(kMaestroProducts), std::end(kMaestroProducts));
  o.interface_number = -1;  // requests address the device, not an interface
  return o;
}

MaestroDisplay::MaestroDisplay(const MaestroOptions& options)
    : options_(options), capabilities_(describe(options)), link_(options.link, *this, options.tap) {}

Status MaestroDisplay::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  if (const Status ok = check_calibration(options_.calibration); !ok) return ok;
  if (capabilities_.travel_m <= 0.0) {
    return fail("0 is not between the two places", "Maestro calibration",
                "measure places on either side of the middle");
  }
  if (const Status started = link_.start(); !started) return started;
  opened_ = true;
  return {};
}

void MaestroDisplay::close() {
  if (!opened_) return;
  targets_.put(0);  // off
  link_.stop();
  machine_.enter(DeviceState::absent);
  opened_ = false;
}

// --- Link's thread -------------------------------------------------------------------------------------

void MaestroDisplay::on_open(UsbLink& link) noexcept {
  in_flight_ = 0;
  unsent_ = false;
  failures_.store(0, kRelaxed);
  std::uint16_t old = 0;
  targets_.take(old);  // a target for the previous connection
  sent_ns_ = usb_now_ns();
  in_flight_ += link.send_control(maestro_speed(options_.channel, options_.speed));
  in_flight_ += link.send_control(maestro_acceleration(options_.channel, options_.acceleration));
  connection_.fetch_add(1, std::memory_order_release);
}

void MaestroDisplay::on_closed() noexcept { connection_.fetch_add(1, std::memory_order_release); }

void MaestroDisplay::on_control_done(UsbLink&, bool good, std::int64_t now_ns) noexcept {
  --in_flight_;
  if (good) {
    answered_.store(connection_.load(kRelaxed), std::memory_order_release);
    failures_.store(0, kRelaxed);
    round_trip_us_.add(static_cast<std::uint64_t>(std::max<std::int64_t>(0, now_ns - sent_ns_) / 1000));
  } else {
    failures_.store(failures_.load(kRelaxed) + 1, kRelaxed);
  }
}

// Sends the newest target as soon as a transfer is free; older ones are skipped.
void MaestroDisplay::on_turn(UsbLink& link, std::int64_t now_ns) noexcept {
  if (targets_.take(wanted_)) unsent_ = true;
  if (stop_now_.exchange(false, kRelaxed)) {
    wanted_ = 0;
    unsent_ = true;
  }
  if (!unsent_ || in_flight_ >= kMostInFlight) return;
  if (!link.send_control(maestro_target(options_.channel, wanted_))) return;
  sent_ns_ = now_ns;
  ++in_flight_;
  unsent_ = false;
  sent_ = wanted_;
}

// --- Servo thread --------------------------------------------------------------------------------------

void MaestroDisplay::update_state(const DisplayCommand& command, double dt_s) noexcept {
  const std::uint32_t connection = connection_.load(std::memory_order_acquire);
  if (connection != seen_connection_) {
    machine_.enter(DeviceState::absent);
    if (connection % 2 == 1) machine_.enter(DeviceState::open);
    seen_connection_ = connection;
  }
  if (connection % 2 == 0) return;
  if (machine_.state() == DeviceState::open && answered_.load(std::memory_order_acquire) == connection)
    machine_.enter(DeviceState::firmware);
  if (was_stopped_.exchange(false, kRelaxed)) machine_.fail(DeviceFault::watchdog);
  if (failures_.load(kRelaxed) >= kFailuresToLoss) machine_.fail(DeviceFault::disconnected);
  if (machine_.state() == DeviceState::homing) {
    homing_for_s_ += dt_s;
    if (homing_for_s_ >= options_.settle_s) machine_.enter(DeviceState::ready);
  }
  if (machine_.apply(command.request)) {
    homing_for_s_ = 0.0;
    if (command.request == DeviceRequest::clear_fault) failures_.store(0, kRelaxed);
    if (command.request == DeviceRequest::stop) targets_.put(0);
  }
  if (machine_.ready() && !std::isfinite(command.target_m)) machine_.fail(DeviceFault::bad_command);
}

DisplaySample MaestroDisplay::exchange(const DisplayCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  update_state(command, dt_s);
  if (machine_.ready() || machine_.state() == DeviceState::homing) {
    const double end = 0.5 * capabilities_.travel_m;
    const double target = machine_.ready() ? std::clamp(command.target_m, -end, end) : 0.0;
    const std::uint16_t pulse = quarter_us_at(options_.calibration, target);
    targets_.put(pulse);
    position_m_ = position_at(options_.calibration, pulse);
    link_.wake();
  } else if (command.request == DeviceRequest::stop) {
    link_.wake();
  }
  return {.position_m = position_m_, .state = machine_.state(), .fault = machine_.fault()};
}

bool MaestroDisplay::emergency_stop() noexcept {
  was_stopped_.store(true, kRelaxed);
  stop_now_.store(true, kRelaxed);
  link_.wake();
  return true;
}

bool MaestroDisplay::report(LinkReport& out) const {
  const UsbCounters& usb = link_.counters();
  out.connected = link_.connected();
  if (!out.connected) out.problem = usb_error(link_.problem(), capabilities_.name).message();
  out.controls = usb.controls;
  out.short_packets = usb.short_packets;
  out.stalls = usb.stalls;
  out.time_outs = usb.time_outs;
  out.errors = usb.errors;
  out.refused_sends = usb.refused_sends;
  out.connects = usb.connects;
  out.round_trip_us = &round_trip_us_;
  return true;
}

}  // namespace tangent
