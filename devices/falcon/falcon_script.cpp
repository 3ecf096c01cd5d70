#include "devices/falcon/falcon_script.h"

#include <algorithm>
#include <array>

namespace tangent {

namespace {

enum class StepKind : std::uint8_t { setting, greeting, letter, firmware };

struct ScriptStep {
  const char* name;
  StepKind kind;
  std::uint8_t request;
  std::uint16_t value;
};

constexpr std::uint8_t kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kLine = 4, kLatency = 9;
constexpr StepKind kSet = StepKind::setting;

constexpr std::array<ScriptStep, 18> kScript{{
    {"clearing what was received", kSet, kReset, 1},
    {"clearing what was to be sent", kSet, kReset, 2},
    {"latency of 16 ms", kSet, kLatency, 16},
    {"9600 baud", kSet, kBaud, 0x4138},
    {"8 bits, no parity, 1 stop bit", kSet, kLine, 8},
    {"no flow control", kSet, kFlow, 0},
    {"RTS low", kSet, kModem, 0x0200},
    {"DTR low", kSet, kModem, 0x0100},
    {"DTR high", kSet, kModem, 0x0101},
    {"the boot loader's greeting", StepKind::greeting, 0, 0},
    {"DTR low after the greeting", kSet, kModem, 0x0100},
    {"the boot loader's fast baud rate", kSet, kBaud, 0x15},
    {"the letter A", StepKind::letter, 0, 0},
    {"the firmware", StepKind::firmware, 0, 0},
    {"latency of 1 ms", kSet, kLatency, 1},
    {"the firmware's baud rate", kSet, kBaud, 2},
    {"clearing what was received last", kSet, kReset, 1},
    {"clearing what was to be sent last", kSet, kReset, 2},
}};
constexpr std::size_t kRunMode = 14;
constexpr std::array<std::uint8_t, 3> kGreeting{0x0a, 0x43, 0x0d};
constexpr std::array<std::uint8_t, 4> kGreeted{0x0a, 0x44, 0x2c, 0x0d};
constexpr std::array<std::uint8_t, 1> kLetter{0x41};
constexpr std::int64_t kAnswer_ns = 500'000'000, kGreeting_ns = 100'000'000, kSetting_ns = 1'000'000'000;
constexpr int kGreetings = 10;  // the boot loader may have missed the first

}  // namespace

const char* FalconScript::name(std::size_t step) { return step < kScript.size() ? kScript[step].name : "?"; }
std::size_t FalconScript::step_count() { return kScript.size(); }

void FalconScript::start(std::size_t first, std::int64_t now_ns) noexcept {
  state_ = State::busy;
  why_ = FalconWhy::none;
  step_ = first;
  sent_bytes_ = heard_bytes_ = 0;
  sent_ = spoilt_ = false;
  tries_ = 0;
  since_ns_ = now_ns;
}

void FalconScript::start_run_mode(std::int64_t now_ns) noexcept { start(kRunMode, now_ns); }

void FalconScript::start_upload(std::span<const std::uint8_t> firmware, std::int64_t now_ns) noexcept {
  firmware_ = firmware;
  start(0, now_ns);
}

void FalconScript::next(std::int64_t now_ns) noexcept {
  sent_ = spoilt_ = false;
  heard_bytes_ = 0;
  tries_ = 0;
  since_ns_ = now_ns;
  if (++step_ == kScript.size()) state_ = State::done;
}

void FalconScript::fail(FalconWhy why) noexcept {
  state_ = State::failed;
  why_ = why;
}

std::span<const std::uint8_t> FalconScript::to_say() const noexcept {
  switch (kScript[step_].kind) {
    case StepKind::setting:
      return {};
    case StepKind::greeting:
      return kGreeting;
    case StepKind::letter:
      return kLetter;
    case StepKind::firmware:
      return firmware_.subspan(sent_bytes_, std::min(kPiece, firmware_.size() - sent_bytes_));
  }
  return {};
}

std::span<const std::uint8_t> FalconScript::to_hear() const noexcept {
  return kScript[step_].kind == StepKind::greeting ? std::span<const std::uint8_t>(kGreeted) : to_say();
}

void FalconScript::turn(FalconWire& wire, std::int64_t now_ns) noexcept {
  if (state_ != State::busy) return;
  const ScriptStep& step = kScript[step_];
  const bool greeting = step.kind == StepKind::greeting;
  if (!sent_) {
    if (!wire.can_send()) return;
    sent_ = true;
    since_ns_ = now_ns;
    const bool taken = step.kind == StepKind::setting
                           ? wire.send_control({.request = step.request, .value = step.value})
                           : wire.send(to_say());
    if (!taken) fail(FalconWhy::refused);
    return;
  }
  const std::int64_t longest = greeting ? kGreeting_ns : step.kind == StepKind::setting ? kSetting_ns : kAnswer_ns;
  if (now_ns - since_ns_ < longest) return;
  if (!greeting || ++tries_ >= kGreetings) return fail(spoilt_ ? FalconWhy::wrong_answer : FalconWhy::silent);
  sent_ = spoilt_ = false;
  heard_bytes_ = 0;
}

void FalconScript::control_done(bool good, std::int64_t now_ns) noexcept {
  if (state_ != State::busy || kScript[step_].kind != StepKind::setting || !sent_) return;
  if (good)
    next(now_ns);
  else
    fail(FalconWhy::refused);
}

void FalconScript::heard(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  for (const std::uint8_t byte : bytes) {
    if (state_ != State::busy || kScript[step_].kind == StepKind::setting || !sent_) return;
    const bool greeting = kScript[step_].kind == StepKind::greeting;
    if (greeting && byte == 0 && heard_bytes_ == 0) continue;  // may come first
    if (spoilt_ || byte != to_hear()[heard_bytes_]) {
      spoilt_ = true;  // a greeting is tried again when its time is over
      if (!greeting) fail(FalconWhy::wrong_answer);
      continue;
    }
    if (++heard_bytes_ < to_hear().size()) continue;
    if (kScript[step_].kind != StepKind::firmware) {
      next(now_ns);
      continue;
    }
    sent_bytes_ += heard_bytes_;
    heard_bytes_ = 0;
    sent_ = false;
    if (sent_bytes_ == firmware_.size()) next(now_ns);
  }
}

}  // namespace tangent
