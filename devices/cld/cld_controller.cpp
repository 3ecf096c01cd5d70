#include "devices/cld/cld_controller.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr std::int64_t kHelloEvery_ns = 100'000'000;

std::int64_t to_ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

void raise(std::atomic<std::uint64_t>& counter, std::uint64_t by = 1) noexcept {
  counter.store(counter.load(kRelaxed) + by, kRelaxed);
}

bool fit(const CldInfo& info) {
  return info.travel_nm > 0 && info.telemetry_hz > 0 && info.watchdog_ms >= 10 && info.watchdog_ms <= 200;
}

}  // namespace

UsbLinkOptions cld_link_options() {
  UsbLinkOptions o;
  o.match.interface_class = {0xFF, 0x43, 0x01};
  o.in_endpoint = 0x81;
  o.out_endpoint = 0x01;
  return o;
}

CldController::CldController(const CldControllerOptions& options)
    : options_(options),
      capabilities_{.name = "CLD controller",
                    .travel_m = 20e-3,
                    .resolution_m = 0.8e-6,
                    .bandwidth_hz = 12.0,
                    .rate_hz = 1000.0,
                    .firmware_timeout_s = 50e-3,
                    .has_controller = true},
      link_(options.link, *this, options.tap) {}

Status CldController::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  if (const Status started = link_.start(); !started) return started;
  opened_ = true;
  return {};
}

void CldController::close() {
  if (!opened_) return;
  commands_.push({CldType::stop, 0});
  link_.stop();
  opened_ = false;
}

// --- Link's thread: out --------------------------------------------------------------------------------

void CldController::put_frame(const CldFrame& frame, std::int64_t now_ns) noexcept {
  std::array<std::uint8_t, kCldLargestFrame> bytes{};
  const std::size_t size = encode_frame(frame, bytes);
  if (packet_held_ + size > packet_.size()) flush();
  if (packet_held_ + size > packet_.size()) return raise(unsent_);
  std::copy_n(bytes.begin(), size, packet_.begin() + static_cast<std::ptrdiff_t>(packet_held_));
  packet_held_ += size;
  sent_ns_[frame.sequence & 255u] = now_ns;
}

void CldController::put_settings(std::int64_t now_ns) noexcept {
  const auto whole = [](double value, double unit, double most) {
    return std::round(std::clamp(value / unit, -most, most));
  };
  const ControllerSettings& s = settings_;
  put_frame(to_frame(CldWireGains{.p_per_s2 = static_cast<std::uint32_t>(whole(s.p_per_s2, 1.0, 4e9)),
                                  .i_per_s3 = static_cast<std::uint32_t>(whole(s.i_per_s3, 1.0, 4e9)),
                                  .d_milli_per_s = static_cast<std::int32_t>(whole(s.d_per_s, 1e-3, 2e9)),
                                  .target_weight_per_65535 =
                                      static_cast<std::uint16_t>(whole(s.target_weight, 1.0 / 65535.0, 65535.0))},
                     next_sequence_++),
            now_ns);
  put_frame(to_frame(CldWireLimits{.lowest_nm = static_cast<std::int32_t>(whole(s.lowest_m, 1e-9, 2e9)),
                                   .highest_nm = static_cast<std::int32_t>(whole(s.highest_m, 1e-9, 2e9)),
                                   .fastest_um_per_s = static_cast<std::uint32_t>(whole(s.fastest_m_per_s, 1e-6, 4e9)),
                                   .largest_current_ma =
                                       static_cast<std::uint16_t>(whole(s.largest_current_a, 1e-3, 65535.0))},
                     next_sequence_++),
            now_ns);
  settings_unsent_ = false;
}

void CldController::flush() noexcept {
  if (packet_held_ == 0 || !link_.can_send()) return;  // sent in the next turn
  link_.send({packet_.data(), packet_held_});
  packet_held_ = 0;
}

void CldController::on_open(UsbLink&) noexcept {
  parser_.restart();
  sequence_.restart();
  heard_any_ = false;
  packet_held_ = 0;
  opened_ns_ = next_hello_ns_ = usb_now_ns();
  Outgoing old;
  while (commands_.pop(old)) {}  // commands for the previous connection
  connection_.fetch_add(1, std::memory_order_release);
}

void CldController::on_closed() noexcept { connection_.fetch_add(1, std::memory_order_release); }

void CldController::on_turn(UsbLink&, std::int64_t now_ns) noexcept {
  const std::uint32_t connection = connection_.load(kRelaxed);
  if (info_connection_.load(kRelaxed) != connection) {
    if (now_ns >= next_hello_ns_) {
      put_frame(bare_frame(CldType::hello, next_sequence_++), now_ns);
      next_hello_ns_ = now_ns + kHelloEvery_ns;
    }
    if (now_ns - opened_ns_ > to_ns(options_.info_timeout_s)) unfit_connection_.store(connection, kRelaxed);
  }
  if (link_.can_send() && stop_now_.exchange(false, kRelaxed)) {
    Outgoing old;
    while (commands_.pop(old)) {}
    put_frame(bare_frame(CldType::stop, next_sequence_++), now_ns);
    return flush();
  }
  if (new_settings_.take(settings_)) settings_unsent_ = true;
  if (settings_unsent_ && info_connection_.load(kRelaxed) == connection && link_.can_send()) put_settings(now_ns);
  Outgoing out;
  // When all transfers are in flight, the rest stays queued, in order.
  while (link_.can_send() && commands_.pop(out)) {
    const std::uint16_t sequence = next_sequence_++;
    put_frame(
        out.type == CldType::target ? to_frame(CldTarget{out.target_nm}, sequence) : bare_frame(out.type, sequence),
        now_ns);
  }
  flush();
}

// --- Link's thread: in ---------------------------------------------------------------------------------

void CldController::on_packet(UsbLink&, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  std::array<std::uint8_t, kUsbPacketBytes> copy{};
  std::copy(bytes.begin(), bytes.end(), copy.begin());
  for (std::size_t i = 0; i < last_packet_.size(); ++i) {
    std::uint64_t word = 0;
    for (std::size_t j = 0; j < 8; ++j) word |= std::uint64_t{copy[8 * i + j]} << (8 * j);
    last_packet_[i].store(word, kRelaxed);
  }
  last_packet_bytes_.store(static_cast<std::uint32_t>(bytes.size()), kRelaxed);
  parser_.feed(bytes, [&](const CldFrame& frame) { take_frame(frame, now_ns); });
  if (parser_.in_frame()) raise(cut_packets_);
  frames_.store(parser_.counts().frames, kRelaxed);
  crc_errors_.store(parser_.counts().crc_errors, kRelaxed);
  skipped_bytes_.store(parser_.counts().skipped_bytes, kRelaxed);
}

void CldController::take_frame(const CldFrame& frame, std::int64_t now_ns) noexcept {
  const CldSequence::Arrival arrival = sequence_.add(frame.sequence);
  lost_.store(sequence_.lost(), kRelaxed);
  doubled_.store(sequence_.doubled(), kRelaxed);
  late_.store(sequence_.late(), kRelaxed);
  if (arrival == CldSequence::Arrival::doubled) return;
  if (frame.type == static_cast<std::uint8_t>(CldType::info)) return take_info(frame);
  if (to_refused(frame)) return raise(refused_);
  // A position that arrives after a newer one is ignored.
  if (arrival != CldSequence::Arrival::late) take_telemetry(frame, now_ns);
}

void CldController::take_info(const CldFrame& frame) noexcept {
  const auto info = to_info(frame);
  const std::uint32_t connection = connection_.load(kRelaxed);
  if (!info || !fit(*info)) return unfit_connection_.store(connection, kRelaxed);
  info_travel_nm_.store(info->travel_nm, kRelaxed);
  info_step_pm_.store(info->step_pm, kRelaxed);
  info_rates_.store(
      std::uint64_t{info->bandwidth_centihz} << 32 | std::uint64_t{info->telemetry_hz} << 16 | info->watchdog_ms,
      kRelaxed);
  info_serial_.store(info->serial, kRelaxed);
  info_firmware_.store(info->firmware_version, kRelaxed);
  unfit_connection_.store(0, kRelaxed);
  if (info_connection_.load(kRelaxed) != connection && !(settings_ == ControllerSettings{})) settings_unsent_ = true;
  info_connection_.store(connection, std::memory_order_release);
}

void CldController::take_telemetry(const CldFrame& frame, std::int64_t now_ns) noexcept {
  const auto telemetry = to_telemetry(frame);
  if (!telemetry) return;
  if (heard_any_ && now_ns > last_telemetry_ns_)
    arrival_us_.add(static_cast<std::uint64_t>((now_ns - last_telemetry_ns_) / 1000));
  if (!heard_any_ || telemetry->heard_sequence != last_heard_sequence_) {
    const std::int64_t sent = sent_ns_[telemetry->heard_sequence & 255u];
    const auto outstanding = static_cast<std::uint16_t>(next_sequence_ - telemetry->heard_sequence);
    if (heard_any_ && outstanding < 256 && sent > 0)
      round_trip_us_.add(static_cast<std::uint64_t>((now_ns - sent) / 1000));
    last_heard_sequence_ = telemetry->heard_sequence;
  }
  heard_any_ = true;
  last_telemetry_ns_ = now_ns;
  lost_by_device_.store(telemetry->missed_frames, kRelaxed);
  telemetry_.push({*telemetry, now_ns, connection_.load(kRelaxed)});
}

// --- Servo thread --------------------------------------------------------------------------------------

void CldController::hear() noexcept {
  while (telemetry_.pop(newest_)) ever_heard_ = true;
}

DeviceState CldController::state_now(std::int64_t now_ns, DeviceFault& fault) noexcept {
  const std::uint32_t connection = connection_.load(std::memory_order_acquire);
  if (connection % 2 == 0) return DeviceState::absent;
  if (lost_connection_ == connection) {
    fault = DeviceFault::disconnected;
    return DeviceState::faulted;
  }
  if (unfit_connection_.load(kRelaxed) == connection) {
    fault = DeviceFault::firmware;
    return DeviceState::faulted;
  }
  const bool current = ever_heard_ && newest_.connection == connection;
  if (info_connection_.load(kRelaxed) != connection || !current) return DeviceState::open;
  if (now_ns - newest_.at_ns > to_ns(options_.silence_s)) {
    lost_connection_ = connection;  // latched until a person clears the fault
    fault = DeviceFault::disconnected;
    return DeviceState::faulted;
  }
  const bool homed = homed_connection_ == connection;
  switch (newest_.telemetry.state) {
    case CldDeviceState::idle:
      return DeviceState::firmware;
    case CldDeviceState::homing:
      return homed ? DeviceState::homing : DeviceState::firmware;
    case CldDeviceState::ready:
      return homed ? DeviceState::ready : DeviceState::firmware;
    case CldDeviceState::faulted:
      break;
  }
  fault = fault_of(newest_.telemetry.fault);
  return DeviceState::faulted;
}

void CldController::request(DeviceRequest request, DeviceState state) noexcept {
  const auto send = [this](CldType type) { commands_.push({type, 0}); };
  if (request == DeviceRequest::home && (state == DeviceState::firmware || state == DeviceState::ready)) {
    homed_connection_ = connection_.load(kRelaxed);
    send(CldType::home);
  }
  if (request == DeviceRequest::stop) {
    homed_connection_ = 0;
    send(CldType::stop);
  }
  if (request == DeviceRequest::clear_fault) {
    lost_connection_ = 0;
    homed_connection_ = 0;
    send(CldType::clear_fault);
  }
}

void CldController::set_controller(const ControllerSettings& settings) noexcept {
  if (settings == last_settings_) return;
  last_settings_ = settings;
  new_settings_.put(settings);
  link_.wake();
}

DisplaySample CldController::exchange(const DisplayCommand& command, double) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  hear();
  const std::int64_t now = usb_now_ns();
  DisplaySample sample;
  sample.state = state_now(now, sample.fault);
  sample.travel_m = static_cast<double>(info_travel_nm_.load(kRelaxed)) * 1e-9;
  request(command.request, sample.state);
  if (sample.state == DeviceState::ready && std::isfinite(command.target_m)) {
    const double end = 0.5 * sample.travel_m;
    const double target_nm = std::round(std::clamp(command.target_m, -end, end) * 1e9);
    commands_.push({CldType::target, static_cast<std::int32_t>(target_nm)});
  }
  if (ever_heard_) {
    sample.position_m = static_cast<double>(newest_.telemetry.position_nm) * 1e-9;
    sample.age_s = static_cast<double>(now - newest_.at_ns) * 1e-9;
  }
  link_.wake();
  return sample;
}

// --- Any thread ----------------------------------------------------------------------------------------

bool CldController::emergency_stop() noexcept {
  stop_now_.store(true, kRelaxed);
  link_.wake();
  return true;
}

bool CldController::report(LinkReport& out) const {
  const UsbCounters& usb = link_.counters();
  out.connected = link_.connected();
  const std::uint32_t connection = connection_.load(kRelaxed);
  if (info_connection_.load(kRelaxed) == connection && out.connected) {
    const unsigned version = info_firmware_.load(kRelaxed);
    out.identity = "firmware " + std::to_string(version >> 8) + "." + std::to_string(version & 255u) + ", serial " +
                   std::to_string(info_serial_.load(kRelaxed));
    const std::uint64_t rates = info_rates_.load(kRelaxed);
    out.travel_m = static_cast<double>(info_travel_nm_.load(kRelaxed)) * 1e-9;
    out.resolution_m = static_cast<double>(info_step_pm_.load(kRelaxed)) * 1e-12;
    out.bandwidth_hz = static_cast<double>(rates >> 32) * 0.01;
    out.rate_hz = static_cast<double>((rates >> 16) & 0xffffu);
    out.firmware_timeout_s = static_cast<double>(rates & 0xffffu) * 1e-3;
  }
  if (!out.connected)
    out.problem = usb_error(link_.problem(), capabilities_.name).message();
  else if (unfit_connection_.load(kRelaxed) == connection)
    out.problem = usb_error(UsbProblem::wrong_interface, capabilities_.name).message();
  out.packets_in = usb.packets_in;
  out.packets_out = usb.packets_out;
  out.controls = usb.controls;
  out.empty_packets = usb.empty_packets;
  out.short_packets = usb.short_packets + cut_packets_;
  out.stalls = usb.stalls;
  out.time_outs = usb.time_outs;
  out.errors = usb.errors;
  out.refused_sends = usb.refused_sends;
  out.connects = usb.connects;
  out.frames = frames_;
  out.crc_errors = crc_errors_;
  out.skipped_bytes = skipped_bytes_;
  out.lost = lost_;
  out.doubled = doubled_;
  out.late = late_;
  out.lost_by_device = lost_by_device_;
  out.refused = refused_;
  out.dropped_commands = commands_.drops() + unsent_;
  for (std::size_t i = 0; i < out.last_packet.size(); ++i) {
    out.last_packet[i] = static_cast<std::uint8_t>((last_packet_[i / 8].load(kRelaxed) >> (8 * (i % 8))) & 0xffu);
  }
  out.last_packet_bytes = last_packet_bytes_;
  out.round_trip_us = &round_trip_us_;
  out.arrival_us = &arrival_us_;
  return true;
}

}  // namespace tangent
