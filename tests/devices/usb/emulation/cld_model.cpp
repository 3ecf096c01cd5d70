#include "tests/devices/usb/emulation/cld_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tangent::emulation {

Bytes CldModel::descriptors() const {
  Bytes d = device_descriptor(0x1209, 0x0001);
  constexpr std::array<std::uint8_t, 2> kEndpoints{0x81, 0x01};
  const Bytes c = configuration_descriptor(0xFF, 0x43, 0x01, kEndpoints);
  d.insert(d.end(), c.begin(), c.end());
  return d;
}

void CldModel::reset() {
  state_ = CldDeviceState::idle;
  fault_ = CldDeviceFault::none;
  parser_.restart();
  sequence_.restart();
  out_sequence_ = heard_sequence_ = 0;
  target_nm_ = 0;
  in_packets.clear();
  kept_.clear();
  mechanism_.hold();
}

bool CldModel::on_control(const ControlSetup&, Bytes& answer) {
  answer.clear();
  return false;
}

void CldModel::on_out(std::uint8_t, std::span<const std::uint8_t> bytes) {
  parser_.feed(bytes, [this](const CldFrame& frame) { take(frame); });
}

void CldModel::refuse(const CldFrame& frame, std::uint8_t reason) {
  send(to_frame(CldRefused{frame.type, frame.sequence, reason}, out_sequence_++));
}

void CldModel::take(const CldFrame& frame) {
  if (!has_firmware) return;
  if (sequence_.add(frame.sequence) == CldSequence::Arrival::doubled) return;
  ++heard[frame.sequence];
  heard_sequence_ = frame.sequence;
  switch (static_cast<CldType>(frame.type)) {
    case CldType::hello:
      send(to_frame(CldInfo{0x0102, 77, 20'000'000, 800'000, 1200, telemetry_hz, watchdog_ms}, out_sequence_++));
      return;
    case CldType::target: {
      const auto target = to_target(frame);
      if (!target) return refuse(frame, 3);
      if (state_ != CldDeviceState::ready) return refuse(frame, 5);
      target_nm_ = std::clamp(target->target_nm, lowest_nm_, highest_nm_);
      targets.push_back(target->target_nm);
      since_target_ = 0;
      return;
    }
    case CldType::gains:
      if (const auto g = to_gains(frame)) {
        mechanism_.set_gains({static_cast<double>(g->p_per_s2), static_cast<double>(g->i_per_s3),
                              g->d_milli_per_s * 1e-3, g->target_weight_per_65535 / 65535.0});
      } else {
        refuse(frame, 3);
      }
      return;
    case CldType::limits:
      if (const auto l = to_limits(frame)) {
        lowest_nm_ = l->lowest_nm;
        highest_nm_ = l->highest_nm;
        mechanism_.set_limits(
            {l->lowest_nm * 1e-9, l->highest_nm * 1e-9, l->fastest_um_per_s * 1e-6, l->largest_current_ma * 1e-3});
      } else {
        refuse(frame, 4);
      }
      return;
    case CldType::home:
      if (state_ == CldDeviceState::faulted) return refuse(frame, 5);
      if (state_ == CldDeviceState::homing) return;
      state_ = CldDeviceState::homing;
      homing_left_ = homing_ticks;
      return;
    case CldType::stop:
      if (state_ != CldDeviceState::faulted) state_ = CldDeviceState::idle;
      return;
    case CldType::clear_fault:
      if (state_ == CldDeviceState::faulted) {
        state_ = CldDeviceState::idle;
        fault_ = CldDeviceFault::none;
      }
      return;
    default:
      return refuse(frame, 2);
  }
}

void CldModel::run_drive() {
  const auto fail = [this](CldDeviceFault fault) {
    state_ = CldDeviceState::faulted;
    fault_ = fault;
  };
  const double before = encoder_stuck ? stuck_at_ : mechanism_.encoder_m();
  if (!encoder_stuck) stuck_at_ = before;
  if (state_ == CldDeviceState::homing) {
    target_nm_ = 0;
    if (--homing_left_ <= 0) {
      state_ = CldDeviceState::ready;
      since_target_ = 0;
    }
  }
  if (state_ == CldDeviceState::ready && ++since_target_ > watchdog_ms && watchdog_on) {
    ++watchdog_fired;
    fail(CldDeviceFault::watchdog);
  }
  if (state_ != CldDeviceState::homing && state_ != CldDeviceState::ready) return mechanism_.hold();
  mechanism_.control(target_nm_ * 1e-9, before);
  const double after = encoder_stuck ? stuck_at_ : mechanism_.encoder_m();
  stuck_for_ = std::abs(mechanism_.current()) > 0.05 && after == before ? stuck_for_ + 1 : 0;
  if (stuck_for_ >= 100) fail(CldDeviceFault::encoder);
}

void CldModel::tick() {
  time_us_ += 1000;
  if (!has_firmware) return;
  run_drive();
  if (!telemetry_on) return;
  const double reading = encoder_stuck ? stuck_at_ : mechanism_.encoder_m();
  send(to_frame(CldTelemetry{.time_us = time_us_,
                             .position_nm = static_cast<std::int32_t>(std::lround(reading * 1e9)),
                             .target_nm = target_nm_,
                             .current_ma = static_cast<std::int16_t>(std::lround(mechanism_.current() * 500)),
                             .state = state_,
                             .fault = fault_,
                             .heard_sequence = heard_sequence_,
                             .missed_frames = static_cast<std::uint16_t>(sequence_.lost())},
                out_sequence_++));
  ++telemetry_sent;
}

void CldModel::put(Bytes bytes) {
  while (bytes.size() > 64) {
    in_packets.emplace_back(bytes.begin(), bytes.begin() + 64);
    bytes.erase(bytes.begin(), bytes.begin() + 64);
  }
  in_packets.push_back(std::move(bytes));
}

void CldModel::send(const CldFrame& frame) {
  Bytes bytes(kCldLargestFrame);
  bytes.resize(encode_frame(frame, bytes));
  const Bytes kept = std::exchange(kept_, {});
  const WireFault fault = std::exchange(next_wire, WireFault::none);
  switch (fault) {
    case WireFault::none:
      break;
    case WireFault::split:
      put({bytes.begin(), bytes.begin() + 5});
      put({bytes.begin() + 5, bytes.end()});
      return;
    case WireFault::merged:
    case WireFault::out_of_order:
      kept_ = bytes;
      kept_.push_back(fault == WireFault::merged ? 1 : 0);  // a mark, taken off below
      return;
    case WireFault::garbage:
      put({0xC5, 0x01, 0x82, 0x14, 9, 9, 9});
      break;
    case WireFault::doubled:
      put(bytes);
      break;
    case WireFault::crc_error:
      bytes[8] ^= 0x10u;
      break;
    case WireFault::empty:
      in_packets.emplace_back();
      break;
  }
  if (!kept.empty()) {
    const bool merged = kept.back() == 1;
    const Bytes older(kept.begin(), kept.end() - 1);
    Bytes both = merged ? older : bytes;
    const Bytes& second = merged ? bytes : older;
    if (merged) {
      both.insert(both.end(), second.begin(), second.end());
      put(both);
    } else {
      put(both);
      put(second);
    }
    return;
  }
  put(std::move(bytes));
}

}  // namespace tangent::emulation
