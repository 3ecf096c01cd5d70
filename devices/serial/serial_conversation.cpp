#include "devices/serial/serial_conversation.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr std::int64_t kHelloEvery_ns = 100'000'000;
constexpr std::int64_t kAnswer_ns = 3'000'000'000;  // a board that resets when its port is opened takes 2 s
constexpr std::uint16_t kUnheard = 15;              // commands under way; the firmware stops after 20 ms

// A flood: four times what the telemetry makes, and what may have waited while this program stood still.
constexpr double kFlood = 4.0, kBacklog_bytes = 8192.0, kTelemetryFrame_bytes = 48.0;

bool fit(const ForceInfo& info) {
  return info.telemetry_hz >= 100 && info.watchdog_ms >= 10 && info.watchdog_ms <= 200 && info.pushes_along < 8 &&
         info.senses_rotation < 8;
}

}  // namespace

void SerialConversation::expect(const ForceInfo& info) noexcept {
  info_ = info;
  expecting_ = true;
}

void SerialConversation::connected(std::int64_t now_ns) noexcept {
  const std::uint32_t connection = news_.connection + 1;
  news_ = {};
  news_.connection = connection;
  parser_.restart();
  sequence_.restart();
  clock_.restart();
  hello_ns_ = connected_ns_ = allowed_since_ns_ = now_ns;
  allowed_bytes_ = kBacklog_bytes;
  stop_due_ = false;
}

void SerialConversation::closed() noexcept {
  if (news_.connection % 2 == 0) return;
  const std::uint32_t connection = news_.connection + 1;
  news_ = {};
  news_.connection = connection;
}

/// The first trouble stays; the firmware is told to stop at once, without waiting for the servo.
void SerialConversation::find(SerialTrouble trouble) noexcept {
  if (news_.trouble != SerialTrouble::none) return;
  news_.trouble = trouble;
  stop_due_ = news_.informed;
}

/// What another device or firmware would have to mend stays.
void SerialConversation::clear() noexcept {
  if (!news_.informed) return;
  news_.trouble = SerialTrouble::none;
  news_.heard = stop_due_ = false;
  sequence_.restart();
  clock_.restart();
}

// --- Out -----------------------------------------------------------------------------------------------

bool SerialConversation::has_to_speak(std::int64_t now_ns) const noexcept {
  return stop_due_ || (!news_.informed && now_ns >= hello_ns_);
}

/// Zero force while there is trouble, and a stop the first time.
ForceCommandMessage SerialConversation::believed(const ForceCommandMessage& command) noexcept {
  if (command.request == SerialRequest::clear_fault) {
    const bool latched = news_.state == CldDeviceState::faulted;
    clear();
    return {{}, latched ? SerialRequest::clear_fault : SerialRequest::none};
  }
  if (news_.trouble == SerialTrouble::none) return command;
  return {{}, std::exchange(stop_due_, false) ? SerialRequest::stop : SerialRequest::none};
}

std::size_t SerialConversation::compose(const ForceCommandMessage* command, std::int64_t now_ns,
                                        std::span<std::uint8_t> out) noexcept {
  std::size_t bytes = 0;
  const auto say = [&](const CldFrame& frame) { bytes += encode_frame(frame, out.subspan(bytes)); };
  if (!news_.informed && now_ns >= hello_ns_) {
    hello_ns_ = now_ns + kHelloEvery_ns;
    if (now_ns - connected_ns_ > kAnswer_ns) find(SerialTrouble::no_answer);
    say(bare_frame(CldType::hello, next_sequence_++));  // an older firmware knows this one
    say(to_frame(ForceHello{}, next_sequence_++));
    return bytes;
  }
  if (command == nullptr && !stop_due_) return 0;
  say(to_frame(believed(command != nullptr ? *command : ForceCommandMessage{}), next_sequence_++));
  return bytes;
}

// --- In ------------------------------------------------------------------------------------------------

bool SerialConversation::floods(std::size_t bytes, std::int64_t now_ns) noexcept {
  const double rate = kFlood * kTelemetryFrame_bytes * std::max<double>(info_.telemetry_hz, 1000.0);
  const double since_s = 1e-9 * static_cast<double>(now_ns - allowed_since_ns_);
  allowed_since_ns_ = now_ns;
  allowed_bytes_ = std::min(kBacklog_bytes, allowed_bytes_ + rate * since_s) - static_cast<double>(bytes);
  return allowed_bytes_ < 0.0;
}

void SerialConversation::receive(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  if (floods(bytes.size(), now_ns)) {
    allowed_bytes_ = 0.0;
    find(SerialTrouble::flood);
  }
  parser_.feed(bytes, [&](const CldFrame& frame) { take_frame(frame, now_ns); });
  const CldParserCounts& parsed = parser_.counts();
  counts_.frames = parsed.frames;
  counts_.crc_errors = parsed.crc_errors;
  counts_.skipped_bytes = parsed.skipped_bytes;
}

void SerialConversation::take_frame(const CldFrame& frame, std::int64_t now_ns) noexcept {
  const CldSequence::Arrival arrival = sequence_.add(frame.sequence);
  counts_.lost = sequence_.lost();
  counts_.doubled = sequence_.doubled();
  counts_.late = sequence_.late();
  if (arrival == CldSequence::Arrival::doubled) return;
  if (const auto info = to_force_info(frame)) return take_info(*info);
  if (const auto refused = to_refused(frame)) return take_refused(*refused);
  if (arrival == CldSequence::Arrival::late) return;
  if (const auto telemetry = to_force_telemetry(frame)) take_telemetry(*telemetry, now_ns);
}

void SerialConversation::take_info(const ForceInfo& info) noexcept {
  if (news_.informed) return;
  news_.trouble = SerialTrouble::none;
  if (info.version != kForceVersion) return find(SerialTrouble::version);
  if (!fit(info)) return find(SerialTrouble::unfit);
  if (expecting_ && !(info == info_)) return find(SerialTrouble::other_device);
  info_ = info;
  news_.informed = true;
  stop_due_ = false;
}

void SerialConversation::take_refused(const CldRefused& refused) noexcept {
  constexpr std::uint8_t kVersion = 1, kType = 2;
  ++counts_.refused;
  if (news_.informed || refused.type != static_cast<std::uint8_t>(SerialType::force_hello)) return;
  if (refused.reason == kVersion) find(SerialTrouble::version);
  if (refused.reason == kType) find(SerialTrouble::display);
}

void SerialConversation::take_telemetry(const ForceTelemetry& t, std::int64_t now_ns) noexcept {
  if (!news_.informed || news_.trouble != SerialTrouble::none) return;
  counts_.lost_by_device = t.missed_frames;
  SerialTrouble wrong = clock_.add(t.time_us, now_ns);
  SerialSample sample;
  if (wrong == SerialTrouble::none) wrong = read_sample(t, info_, sample);
  // A firmware that says itself that its sensor failed is faulted, which is more to the point.
  if (wrong == SerialTrouble::not_measured && t.state == CldDeviceState::faulted) {
    wrong = SerialTrouble::none;
    sample = news_.sample;
  }
  const auto unheard = static_cast<std::uint16_t>(next_sequence_ - 1 - t.heard_sequence);
  if (t.state == CldDeviceState::ready && unheard > kUnheard && unheard < 0x8000) wrong = SerialTrouble::deaf;
  if (wrong != SerialTrouble::none) return find(wrong);
  news_.heard = true;
  news_.state = t.state;
  news_.fault = t.fault;
  news_.sample = sample;
  news_.buttons = t.buttons;
  news_.arrived_ns = now_ns;
  news_.measured_ns = clock_.measured_ns();
}

}  // namespace tangent
