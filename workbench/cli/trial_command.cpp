#include "workbench/cli/trial_command.h"

#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/trial_keys.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

namespace tangent {
namespace {

using experiment::TrialSession;

constexpr std::uint64_t kTicksAtOnce = 16;  // in simulated time: as a display at 60 Hz would

/// Says what is new, to the participant on standard output, to the operator on standard error.
class Teller {
 public:
  void look(const TrialSession& trials) {
    const experiment::ParticipantView now = trials.participant();
    const std::string prompt = now.prompt + (now.hint.empty() ? "" : " " + now.hint);
    if (prompt != prompt_) {
      std::printf("%d of about %d. %s\n", now.trial, now.of, prompt.c_str());
      std::fflush(stdout);
    }
    prompt_ = prompt;
    const std::string fault = trials.operator_view().fault;
    if (fault != fault_ && !fault.empty()) print_message("experiment", "paused: " + fault);
    fault_ = fault;
  }

 private:
  std::string prompt_, fault_;
};

double clock_of(TrialSession& trials) {
  const History& history = trials.session().history();
  return history.empty() ? 0.0 : history.newest().tick.input.t_s;
}

/// All that can be taken now. `wait_until_s`: nothing is before that.
Status take_keys(TrialKeys& keys, TrialSession& trials, double& wait_until_s) {
  while (clock_of(trials) >= wait_until_s) {
    const auto input = keys.next();
    if (!input) return tl::unexpected(input.error());
    if (!*input) {
      if (keys.ended()) trials.press(experiment::TrialKey::quit);
      return {};
    }
    if ((*input)->key) trials.press(*(*input)->key);
    if (!(*input)->note.empty()) trials.note((*input)->note);
    if ((*input)->wait_s > 0.0) wait_until_s = clock_of(trials) + (*input)->wait_s;
    if (trials.finished()) return {};
  }
  return {};
}

Status attend(TrialSession& trials) {
  TrialKeys keys;
  Teller teller;
  if (keys.terminal())
    std::puts("Enter, 1 to 9: answers   Escape stop   r resume   n note   space raise a simulated finger   q quit");
  double wait_until_s = 0.0;
  while (!trials.finished() && !InterruptGuard::requested()) {
    if (trials.session().options().threaded)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    else
      trials.session().advance(kTicksAtOnce);
    trials.poll();
    teller.look(trials);
    if (Status ok = take_keys(keys, trials, wait_until_s); !ok) return ok;
  }
  teller.look(trials);
  return {};
}

}  // namespace

void add_trial_options(CLI::App& command, TrialChoice& choice) {
  add_device_options(command, choice.devices);
  add_flag(command, "--record", choice.record, "Keep every tick of each trial, a file a trial beside the answers");
  add_flag(command, "--without-timeout", choice.without_timeout,
           "Arm even a device that goes on with its last command when this program dies");
  add_flag(command, "--without-waiting", choice.without_waiting,
           "One tick right after the other, in simulated time (simulated devices, keys from a pipe)");
}

Result<experiment::TrialOptions> trial_options(const TrialChoice& choice) {
  experiment::TrialOptions out;
  out.record = choice.record;
  out.without_timeout = choice.without_timeout;
  SessionOptions& session = out.session;
  session.threaded = !choice.without_waiting;
  session.servo.cpu = choice.devices.servo_cpu;
  session.devices = choice.devices.names;
  if (session.devices.display == "maestro") {
    const auto setup = chosen_maestro_setup(choice.devices.maestro, maestro_setups_path());
    if (!setup) return tl::unexpected(setup.error());
    session.maestro = setup->calibration;
    session.maestro_channel = setup->channel;
  }
  session.packets = choice.devices.packets;
  session.place = choice.devices.place;
  session.history_s = 20.0;
  return out;
}

Result<int> run_trials(experiment::TrialOptions options) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
  const InterruptGuard guard;
  const bool waits = options.session.threaded;
  auto trials = TrialSession::start(std::move(options));
  if (!trials) return tl::unexpected(trials.error());
  if (!waits && (*trials)->session().status().real_devices)
    return fail("real devices keep real time", "--without-waiting", "leave it out, or choose simulated devices");
  const Status attended = attend(**trials);
  const int answers = (*trials)->answers();
  const bool complete = (*trials)->complete();
  const Status ended = (*trials)->end();
  std::printf("%s: %d trials\n", (*trials)->rows().c_str(), answers);
  if (!attended) return tl::unexpected(attended.error());
  if (!ended) return tl::unexpected(ended.error());
  if (complete) return kDone;
  print_message("experiment", "ended before its end; the same command goes on from there");
  return kFailed;
}

}  // namespace tangent
