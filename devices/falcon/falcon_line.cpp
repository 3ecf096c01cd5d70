#include "devices/falcon/falcon_line.h"

#include <utility>

namespace tangent {

namespace {

constexpr std::int64_t kAnswering_ns = 100'000'000;
constexpr int kQuestions = 3;

std::int64_t in_ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

void count_one(std::atomic<std::uint64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

constexpr FalconCommand kQuestion{.lamps = kFalconRed};

}  // namespace

FalconLine::FalconLine(const FalconLineOptions& options, std::vector<std::uint8_t> firmware)
    : options_(options), firmware_(std::move(firmware)) {}

// --- Connection ----------------------------------------------------------------------------------------

void FalconLine::opened(std::int64_t now_ns, const std::vector<std::uint8_t>* firmware) noexcept {
  loads_ = firmware != nullptr ? firmware : &firmware_;
  pieces_.store((loads_->size() + FalconScript::kPiece - 1) / FalconScript::kPiece, kRelaxed);
  failed_at_.store(0, kRelaxed);
  attempts_ = refusals_ = 0;
  ended_ = false;
  ask(now_ns);
  connection_.fetch_add(1, std::memory_order_release);
}

void FalconLine::closed() noexcept {
  script_.stop();
  connection_.fetch_add(1, std::memory_order_release);
}

void FalconLine::ask(std::int64_t now_ns) noexcept {
  FalconOrder old;
  orders_.take(old);
  wanted_ = {};
  fresh_ = in_flight_ = pushing_ = false;
  set_doubt(false);
  blocked_ns_ = 0;
  garbage_.store(0, kRelaxed);
  unanswered_.store(0, kRelaxed);
  parser_.restart();
  questions_ = 0;
  script_.start_run_mode(now_ns);
  enter(FalconPhase::asking);
}

void FalconLine::upload(std::int64_t now_ns) noexcept {
  ++attempts_;
  count_one(uploads_);
  script_.start_upload(*loads_, now_ns);
  enter(FalconPhase::uploading);
}

// --- In ------------------------------------------------------------------------------------------------

void FalconLine::packet(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  const auto payload = ftdi_payload(bytes);
  if (payload.empty()) return;
  if (script_.state() == FalconScript::State::busy) return script_.heard(payload, now_ns);
  const std::uint64_t skipped = parser_.skipped();
  parser_.feed(payload, [&](const FalconPacket& found) { take_answer(found, now_ns); });
  skipped_.store(parser_.skipped(), kRelaxed);
  if (parser_.skipped() == skipped) return;
  set_doubt(true);
  in_flight_ = false;
  garbage_.store(garbage_.load(kRelaxed) + 1, kRelaxed);
}

void FalconLine::take_answer(const FalconPacket& packet, std::int64_t now_ns) noexcept {
  const auto answer = to_answer(packet);
  // A boot loader that sends back what it gets is no firmware.
  const bool echo = phase() == FalconPhase::asking && packet == asked_;
  in_flight_ = false;
  if (!answer || echo) {
    set_doubt(true);
    garbage_.store(garbage_.load(kRelaxed) + 1, kRelaxed);
    return;
  }
  set_doubt(false);
  garbage_.store(0, kRelaxed);
  unanswered_.store(0, kRelaxed);
  answered_ns_ = now_ns;
  count_one(answers_);
  heard_.put({*answer, now_ns, connection_.load(kRelaxed)});
  if (phase() == FalconPhase::asking && questions_ > 0) {
    failed_at_.store(0, kRelaxed);
    enter(FalconPhase::running);
  }
}

void FalconLine::note_failed_step() noexcept {
  const auto step = static_cast<std::uint32_t>(script_.step() + 1), piece = static_cast<std::uint32_t>(script_.piece());
  failed_at_.store(step << 24 | (piece & 0xffffu) << 8 | static_cast<std::uint32_t>(script_.why()), kRelaxed);
}

bool FalconLine::is_answering(std::int64_t now_ns) const noexcept {
  return phase() == FalconPhase::running && now_ns - answered_ns_ < kAnswering_ns;
}

// --- Out -----------------------------------------------------------------------------------------------

void FalconLine::set_doubt(bool doubt) noexcept {
  doubt_ = doubt;
  withholds_.store(doubt, kRelaxed);
}

void FalconLine::not_answered() noexcept {
  in_flight_ = false;
  blocked_ns_ = 0;
  set_doubt(true);
  count_one(lost_);
  unanswered_.store(unanswered_.load(kRelaxed) + 1, kRelaxed);
}

bool FalconLine::send(FalconWire& wire, FalconCommand command, std::int64_t now_ns) noexcept {
  if (doubt_ || held_.load(kRelaxed)) command.torque = {};
  if (!wire.can_send() || !wire.send(to_packet(command))) return false;
  pushing_ = command.torque != FalconCommand{}.torque;
  in_flight_ = true;
  sent_ns_ = now_ns;
  return true;
}

void FalconLine::turn_asking(FalconWire& wire, std::int64_t now_ns) noexcept {
  if (script_.state() == FalconScript::State::failed) {
    note_failed_step();
    return ++refusals_ < options_.attempts ? ask(now_ns) : enter(FalconPhase::not_loaded);
  }
  if (script_.state() != FalconScript::State::done) return;
  if (questions_ > 0 && now_ns - sent_ns_ < in_ns(options_.question_s)) return;
  if (questions_ < kQuestions) {
    asked_ = to_packet(kQuestion);
    if (send(wire, kQuestion, now_ns)) ++questions_;
    return;
  }
  if (loads_->empty()) return enter(FalconPhase::no_firmware);
  if (attempts_ >= options_.attempts) return enter(FalconPhase::not_loaded);
  upload(now_ns);
}

void FalconLine::turn_uploading(FalconWire&, std::int64_t now_ns) noexcept {
  if (script_.state() == FalconScript::State::done) return ask(now_ns);  // does it run now?
  if (script_.state() != FalconScript::State::failed) return;
  note_failed_step();
  if (attempts_ >= options_.attempts) return enter(FalconPhase::not_loaded);
  upload(now_ns);
}

// The servo may stand still anywhere: what it worked out before the device was unplugged, or posted long ago and could
// not be sent, is no torque any more.
void FalconLine::take_order(std::int64_t now_ns) noexcept {
  FalconOrder order;
  if (orders_.take(order) && order.connection == connection_.load(kRelaxed)) {
    wanted_ = order.command;
    fresh_ = true;
    wanted_ns_ = now_ns;
  } else if ((pushing_ || fresh_) && now_ns - wanted_ns_ > in_ns(options_.servo_gone_s)) {
    wanted_.torque = {};
    fresh_ = true;
  }
}

void FalconLine::turn_running(FalconWire& wire, std::int64_t now_ns) noexcept {
  if (stop_now_.exchange(false, kRelaxed)) {
    if (!send(wire, {.homing = wanted_.homing, .lamps = kFalconRed}, now_ns)) stop_now_.store(true, kRelaxed);
    return;
  }
  take_order(now_ns);
  const auto too_long = [&](std::int64_t since_ns) { return now_ns - since_ns >= in_ns(options_.answer_s); };
  if ((in_flight_ && too_long(sent_ns_)) || (blocked_ns_ != 0 && too_long(blocked_ns_))) not_answered();
  const bool withdraw = doubt_ && pushing_;
  if (in_flight_ || !(fresh_ || withdraw)) return;
  if (send(wire, wanted_, now_ns))
    fresh_ = false, blocked_ns_ = 0;
  else if (blocked_ns_ == 0)
    blocked_ns_ = now_ns;
}

void FalconLine::turn(FalconWire& wire, std::int64_t now_ns) noexcept {
  if (ending_.load(kRelaxed)) {
    if (!ended_ && phase() == FalconPhase::running) ended_ = send(wire, {}, now_ns);
    return;
  }
  const bool busy = phase() == FalconPhase::asking || phase() == FalconPhase::uploading;
  if (again_.exchange(false, kRelaxed) && !busy && !is_answering(now_ns)) {
    attempts_ = refusals_ = 0;
    ask(now_ns);
  }
  script_.turn(wire, now_ns);
  switch (phase()) {
    case FalconPhase::asking:
      return turn_asking(wire, now_ns);
    case FalconPhase::uploading:
      return turn_uploading(wire, now_ns);
    case FalconPhase::running:
      return turn_running(wire, now_ns);
    case FalconPhase::no_firmware:
    case FalconPhase::not_loaded:
      return;
  }
}

// --- Any thread ----------------------------------------------------------------------------------------

void FalconLine::hold() noexcept {
  held_.store(true, kRelaxed);
  stop_now_.store(true, kRelaxed);
}

std::string FalconLine::failed_step() const {
  const std::uint32_t packed = failed_at_.load(kRelaxed);
  if (packed == 0) return {};
  const std::size_t step = (packed >> 24) - 1, piece = (packed >> 8) & 0xffffu;
  std::string text = FalconScript::name(step);
  if (text == "the firmware")
    text += ", piece " + std::to_string(piece + 1) + " of " + std::to_string(pieces_.load(kRelaxed));
  switch (static_cast<FalconWhy>(packed & 0xffu)) {
    case FalconWhy::none:
      break;
    case FalconWhy::refused:
      return text + ": the USB transfer failed";
    case FalconWhy::silent:
      return text + ": no answer";
    case FalconWhy::wrong_answer:
      return text + ": wrong answer";
  }
  return text;
}

}  // namespace tangent
