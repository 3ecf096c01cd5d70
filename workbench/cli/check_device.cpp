#include "workbench/cli/check_device.h"

#include "devices/found_device.h"
#include "workbench/bringup/bring_up_protocol.h"
#include "workbench/bringup/bring_up_runner.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/bringup/proved_devices.h"
#include "workbench/cli/answer_keys.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/usb_packet_log.h"
#include "workbench/session/kept_devices.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

namespace tangent {
namespace {

constexpr std::uint64_t kTicksPerLook = 16;

BringUpAnswer answer_of(AnswerKey key) {
  return key == AnswerKey::yes ? BringUpAnswer::yes : key == AnswerKey::no ? BringUpAnswer::no : BringUpAnswer::skip;
}

std::string keys_text(const BringUpView& view, bool terminal) {
  const std::string no = no_text(view).empty() ? "" : terminal ? ", n no" : ", no";
  const std::string skip = may_skip(view) ? terminal ? ", s skip" : ", skip" : "";
  return (terminal ? " [y yes" : " [yes") + no + skip + (terminal ? ", Escape stop]" : ", stop]");
}

/// Says what is new.
class StepTeller {
 public:
  explicit StepTeller(AnswerKeys& keys) : keys_(keys), terminal_(keys.terminal()) {}
  void look(const BringUpView& view, const ForceCapabilities& can) {
    for (std::size_t i = 0; i < kBringUpSteps; ++i) {
      const auto step = static_cast<BringUpStep>(i);
      if (view.verdicts[i] == told_[i]) continue;
      told_[i] = view.verdicts[i];
      if (told_[i] != StepVerdict::waiting && told_[i] != StepVerdict::running) say_step(step, view, can);
    }
    if (view.asks() && view.questions != asked_) {
      asked_ = view.questions;
      if (!can.simulated) keys_.drop();  // what was typed before it was asked for is no answer
      std::printf("%s%s\n", question_text(view, can).c_str(), keys_text(view, terminal_).c_str());
    }
    std::fflush(stdout);
  }
  bool has_asked(const BringUpView& view) const { return view.questions == asked_; }

 private:
  static void say_step(BringUpStep step, const BringUpView& view, const ForceCapabilities& can) {
    const std::string facts = step_facts_text(step, view, can), why = step_why_text(step, view, can);
    std::printf("%s: %s%s%s%s%s\n", step_title(step), to_string(view.verdict(step)), facts.empty() ? "" : ". ",
                facts.c_str(), why.empty() ? "" : ". ", why.c_str());
  }
  AnswerKeys& keys_;
  bool terminal_;
  std::uint32_t asked_ = 0;
  std::array<StepVerdict, kBringUpSteps> told_{};
};

/// An answer where one came. A question that was not put yet isn't answered.
Status take_answer(AnswerKeys& keys, const StepTeller& teller, BringUpRunner& runner) {
  if (keys.wants_stop()) return runner.stop(), Status{};
  if (!runner.view().asks() || !runner.settled() || !teller.has_asked(runner.view())) return {};
  const auto key = keys.next();
  if (!key) return runner.stop(), tl::unexpected(key.error());
  if (*key == AnswerKey::stop || (!*key && keys.ended()))
    runner.stop();
  else if (*key)
    runner.answer(answer_of(**key));
  return {};
}

Status attend(BringUpRunner& runner, bool threaded) {
  AnswerKeys keys;
  StepTeller teller(keys);
  Status status;
  bool ended = false;
  while (!ended) {
    if (threaded)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    else
      runner.advance(kTicksPerLook);
    const BringUpView& view = runner.view();
    ended = view.ended;
    teller.look(view, runner.capabilities());
    if (InterruptGuard::requested()) runner.stop();
    if (ended) break;
    if (const Status taken = take_answer(keys, teller, runner); !taken) status = taken;
  }
  return status;
}

BringUpProtocol unopened(const DeviceCheck& check, const ForceCapabilities& can, const Error& why) {
  return unopened_protocol(check.kind, can, why, is_attached(check.kind, check.drivers));
}

Status keep(const BringUpProtocol& protocol, const DeviceCheck& check) {
  if (!check.out.empty()) {
    if (Status written = write_protocol(protocol, check.out); !written) return written;
    std::printf("%s: the protocol; beside it as a page\n", check.out.c_str());
  }
  const std::filesystem::path kept = proved_devices_path();
  // Of a device that could not even be opened nothing new is known: what was proved before stays.
  const bool unopened = !protocol.opening.what.empty();
  if (unopened || protocol.device.simulated || protocol.device.serial.empty() || kept.empty()) return {};
  if (Status ok = keep_proved(kept, proved_device(protocol)); !ok) return ok;
  std::printf("%s: kept for serial number %s\n", kept.c_str(), protocol.device.serial.c_str());
  return {};
}

}  // namespace

Result<int> check_device(const DeviceCheck& check) {
  auto packets = UsbPacketLog::create(check.packets);
  if (!packets) return tl::unexpected(packets.error());
  DeviceOptions drivers = check.drivers;
  drivers.tap = packets->tap();
  auto made = make_devices_as_kept({check.kind, "none"}, drivers);
  if (!made) return tl::unexpected(made.error());
  const InterruptGuard guard;
  const ForceCapabilities can = made->force->capabilities();
  const BringUpRunOptions options{.limits = {.most_n = check.most_n}, .threaded = !check.without_waiting};
  std::printf("%s%s\n", can.name.c_str(), can.simulated ? ": simulated, which proves nothing about a real one" : "");
  BringUpProtocol protocol;
  Status attended;
  if (auto runner = BringUpRunner::start(std::move(made->force), options); runner) {
    attended = attend(**runner, options.threaded);
    protocol.kind = check.kind;
    protocol.device = (*runner)->capabilities();
    protocol.device.serial = (*runner)->serial();
    protocol.cable = (*runner)->link_problem();
    protocol.result = (*runner)->view();
  } else {
    print_message("devices", runner.error().message());
    protocol = unopened(check, can, runner.error());
  }
  protocol.date = protocol_date();
  protocol.program = TANGENT_VERSION;
  protocol.most_n = check.most_n;
  if (protocol.result.why(protocol.result.step) == BringUpWhy::hangs) packets->leave_behind();
  if (!attended) return tl::unexpected(attended.error());
  if (const Status kept = keep(protocol, check); !kept) return tl::unexpected(kept.error());
  const bool all = protocol.result.all_proved();
  std::printf("%s. Left open:\n", all ? "All that is needed was proved" : "Not all proved");
  for (const std::string& line : not_proved_lines(protocol.result, protocol.device))
    std::printf("  %s\n", line.c_str());
  if (const Status logged = packets->complete(); !logged) return tl::unexpected(logged.error());
  return all ? kDone : kFailed;
}

}  // namespace tangent
