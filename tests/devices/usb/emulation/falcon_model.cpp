#include "tests/devices/usb/emulation/falcon_model.h"

#include <algorithm>

namespace tangent::emulation {

namespace {

constexpr std::uint8_t kSerialString = 3;
constexpr std::uint16_t kBootBaud = 0x4138, kLoadBaud = 0x15, kRunBaud = 2;

}  // namespace

Bytes FalconModel::descriptors() const {
  Bytes d = device_descriptor(0x0403, 0xcb48);
  if (!serial.empty()) d[16] = kSerialString;
  constexpr std::array<std::uint8_t, 2> kEndpoints{0x81, 0x02};
  Bytes c = configuration_descriptor(0xFF, 0xFF, 0xFF, kEndpoints);
  for (std::size_t i = 0; i < kEndpoints.size(); ++i) c[18 + 7 * i + 3] = 2;  // bulk
  d.insert(d.end(), c.begin(), c.end());
  return d;
}

void FalconModel::reset() {
  in_packets.clear();
  parser_.restart();
  loaded_.clear();
  dtr_ = greeted_ = lettered_ = false;
  pieces_ = unanswered_ = homing_for_ = 0;
  homed_ = 0;
  last = {};
}

bool FalconModel::on_control(const ControlSetup& s, Bytes& answer) {
  answer.clear();
  if (s.request_type == 0x80 && s.request == 6 && s.value >> 8 == 3 && !serial.empty()) {
    if ((s.value & 0xffu) == 0) answer = {4, 3, 0x09, 0x04};  // in English
    if ((s.value & 0xffu) == kSerialString) {
      if (when_asked_for_serial) when_asked_for_serial();
      answer = {static_cast<std::uint8_t>(2 + 2 * serial.size()), 3};
      for (const char letter : serial) answer.insert(answer.end(), {static_cast<std::uint8_t>(letter), 0});
    }
    return !answer.empty();
  }
  if (s.request_type != 0x40) return false;
  switch (s.request) {
    case 0:  // reset, clear
    case 2:  // flow control
      return true;
    case 1:  // modem lines: DTR from low to high starts the boot loader
      if (s.value == 0x0101 && !dtr_ && baud == kBootBaud) {
        running = greeted_ = lettered_ = false;
        loaded_.clear();
        pieces_ = 0;
      }
      if ((s.value & 0x0100u) != 0) dtr_ = (s.value & 1u) != 0;
      return true;
    case 3:
      baud = s.value;
      if (baud == kRunBaud && lettered_ && loaded_ == firmware && !firmware.empty()) running = true;
      return true;
    case 4:
      return s.value == 8;
    case 9:
      latency_ms = s.value;
      return true;
    default:
      return false;
  }
}

void FalconModel::on_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) {
  if (endpoint != 0x02) return;
  if (running && baud == kRunBaud)
    parser_.feed(bytes, [this](const FalconPacket& packet) { take(packet); });
  else if (echoes)
    bytes_in(bytes);
  else if (!running)
    boot(bytes);
}

// --- Boot loader ---------------------------------------------------------------------------------------

bool FalconModel::goes_wrong(UploadFault::Step step) {
  const bool here = upload.kind != UploadFault::none && upload.step == step && upload.times > 0 &&
                    (step != UploadFault::piece || upload.at_piece == pieces_);
  if (here) --upload.times;
  return here;
}

void FalconModel::say(Bytes bytes, UploadFault::Step step) {
  if (goes_wrong(step)) {
    if (upload.kind == UploadFault::silence) return;
    if (upload.kind == UploadFault::wrong_echo) bytes.back() ^= 0x20u;
    if (upload.kind == UploadFault::missing_byte) bytes.pop_back();
  }
  bytes_in(bytes);
}

void FalconModel::boot(std::span<const std::uint8_t> bytes) {
  const Bytes said(bytes.begin(), bytes.end());
  if (baud == kBootBaud && dtr_ && said == Bytes{0x0a, 0x43, 0x0d}) {
    greeted_ = true;
    say(leading_zero ? Bytes{0x00, 0x0a, 0x44, 0x2c, 0x0d} : Bytes{0x0a, 0x44, 0x2c, 0x0d}, UploadFault::greeting);
  } else if (baud == kLoadBaud && greeted_ && !dtr_ && !lettered_ && said == Bytes{0x41}) {
    lettered_ = true;
    ++uploads;
    say(said, UploadFault::letter);
  } else if (baud == kLoadBaud && lettered_) {
    loaded_.insert(loaded_.end(), said.begin(), said.end());
    say(said, UploadFault::piece);
    ++pieces_;
  }
}

// --- Firmware ------------------------------------------------------------------------------------------

void FalconModel::bytes_in(std::span<const std::uint8_t> bytes) {
  Bytes packet{0x01, 0x60};
  packet.insert(packet.end(), bytes.begin(), bytes.end());
  if (in_packets.size() < 64) in_packets.push_back(std::move(packet));
}

void FalconModel::take(const FalconPacket& packet) {
  const auto command = to_command(packet);
  if (!command) {
    ++bad_commands;
    return;
  }
  last = *command;
  ++commands;
  if (pushes() && !homed()) ++pushed_unhomed;
  if (!answers_at_once)
    ++unanswered_;
  else if (fault != FalconFault::silent)
    answer();
}

void FalconModel::answer() {
  const FalconEncoders ticks = falcon_encoders(falcon_inverse(place_).value_or(Vec3(0.0)));
  FalconAnswer now{ticks, 0, homed_};
  if (!homed())
    now.encoder = {static_cast<std::int16_t>(ticks[0] + 900), static_cast<std::int16_t>(ticks[1] - 700),
                   static_cast<std::int16_t>(ticks[2] + 400)};
  if (fault == FalconFault::far_away)
    now.encoder = falcon_encoders(falcon_inverse({0.085, 0.0, 0.11}).value_or(Vec3(0.0)));
  if (fault == FalconFault::legs_apart) now.encoder = {32767, -32768, 0};
  if (fault == FalconFault::unhomed) now.homed = 3;
  if (fault == FalconFault::frozen) now.encoder = said_;
  said_ = now.encoder;
  FalconPacket packet = to_packet(now);
  if (fault == FalconFault::garbage) packet.fill(0xee);
  bytes_in(std::span<const std::uint8_t>(packet).first(fault == FalconFault::cut ? 9 : packet.size()));
}

void FalconModel::move() {
  constexpr int kSteps = 4;
  constexpr double kStep_s = 1e-3 / kSteps;
  const Vec3 torques = -1.0 / counts_per_nm * Vec3(last.torque[0], last.torque[1], last.torque[2]);
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 push = falcon_force(place_, torques).value_or(Vec3(0.0));
    const Vec3 hand = hand_n_per_m * (hand_m - place_) - hand_n_s_per_m * velocity_;
    velocity_ += kStep_s / mass_kg * (push + hand);
    const Vec3 next = place_ + kStep_s * velocity_;
    if (falcon_inverse(next) && falcon_plausible(next))
      place_ = next;
    else
      velocity_ = Vec3(0.0);  // a stop
  }
}

void FalconModel::tick() {
  if (running) {
    homing_for_ = last.homing ? homing_for_ + 1 : 0;
    if (!last.homing) homed_ = 0;
    for (int leg = 0; leg < 3; ++leg)
      if (homing_for_ > homing_ticks + 5 * leg) homed_ = static_cast<std::uint8_t>(homed_ | 1u << leg);
    move();
    for (; unanswered_ > 0; --unanswered_)
      if (fault != FalconFault::silent) answer();
  }
  if (++since_status_ < latency_ms || in_packets.size() >= 64) return;
  since_status_ = 0;
  if (in_packets.empty()) in_packets.push_back({0x01, 0x60});
}

}  // namespace tangent::emulation
