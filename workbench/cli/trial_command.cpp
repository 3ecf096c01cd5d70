#include "workbench/cli/trial_command.h"

#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/trial_keys.h"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

namespace tangent {
namespace {

using experiment::TrialSession;

constexpr std::array<std::string_view, 2> kSounds{"none", "noise"};
constexpr std::uint64_t kTicksAtOnce = 16;  // in simulated time: as a display at 60 Hz would
constexpr int kKeysAtOnce = 64;             // then time goes on, whoever goes on writing

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

/// What can be taken now, at most kKeysAtOnce. `wait_until_s`: nothing is before that.
Status take_keys(TrialKeys& keys, TrialSession& trials, double& wait_until_s) {
  for (int taken = 0; taken < kKeysAtOnce && clock_of(trials) >= wait_until_s; ++taken) {
    const auto input = keys.next();
    if (!input) return tl::unexpected(input.error());
    if (!*input) {
      if (keys.ended()) trials.press(experiment::TrialKey::quit);
      return {};
    }
    if (!(*input)->wrong.empty()) print_message("experiment", (*input)->wrong);
    if ((*input)->key) trials.press(*(*input)->key);
    if (!(*input)->note.empty()) trials.note((*input)->note);
    if ((*input)->wait_s > 0.0) wait_until_s = clock_of(trials) + (*input)->wait_s;
    if (trials.finished()) return {};
  }
  return {};
}

Status attend(TrialSession& trials, experiment::SoundFollower& sound) {
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
    sound.follow(trials);
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
  add_flag(command, "--same-day", choice.same_day,
           "Begin a session sooner after the one before than the protocol says; the events tell it");
  add_flag(command, "--without-timeout", choice.without_timeout,
           "Arm even a device that goes on with its last command when this program dies");
  add_flag(command, "--without-waiting", choice.without_waiting,
           "One tick right after the other, in simulated time (simulated devices, keys from a pipe)");
  add_flag(command, "--window", choice.window,
           "Two windows: the operator's, and the participant's, which fills a second monitor where there is one");
  add_choice_option(command, "--sound", kSounds,
                    "White noise and cues, or none, which the rows say (default: noise with --window, else none)",
                    [&choice](std::size_t i) { choice.sound = i == 1; });
  add_text_option(command, "--sound-device", choice.sound_device, "ALSA's name of it (default \"default\")", "NAME");
}

Result<experiment::TrialOptions> trial_options(const TrialChoice& choice) {
  experiment::TrialOptions out;
  out.record = choice.record;
  out.same_day = choice.same_day;
  out.without_timeout = choice.without_timeout;
  SessionOptions& session = out.session;
  session.threaded = !choice.without_waiting;
  session.servo.cpu = choice.devices.servo_cpu;
  session.devices = choice.devices.names;
  session.drivers = choice.devices.drivers;
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

int say_outcome(const std::filesystem::path& rows, int answers, bool complete) {
  std::printf("%s: %d trial%s\n", rows.c_str(), answers, answers == 1 ? "" : "s");
  if (complete) return kDone;
  print_message("experiment", "ended before its end; the same command goes on from there");
  return kFailed;
}

Result<int> run_trials(TrialsToRun wanted) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
  const InterruptGuard guard;
  auto sound = experiment::SoundFollower::open(wanted.sound, wanted.sound_device);
  if (!sound) return tl::unexpected(sound.error());
  wanted.trials.sound = sound->text();
  auto trials = TrialSession::start(std::move(wanted.trials));
  if (!trials) return tl::unexpected(trials.error());
  const Status attended = attend(**trials, *sound);
  const int answers = (*trials)->answers();
  const bool complete = (*trials)->complete();
  const Status ended = (*trials)->end();
  const int code = say_outcome((*trials)->rows(), answers, complete);
  if (!attended) return tl::unexpected(attended.error());
  if (!ended) return tl::unexpected(ended.error());
  return code;
}

}  // namespace tangent
