// workbench experiment: a participant through a protocol.
#include "workbench/cli/experiment_command.h"
#include "core/io/input_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/refuse.h"
#include "workbench/experiment/order.h"
#include "workbench/experiment/run_simulated.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace tangent {
namespace {

struct ExperimentCommandOptions {
  std::filesystem::path protocol, out;
  std::string participant, simulated;
  std::optional<double> seed;
  bool pilot = false;
  TrialChoice trials;
};

/// As run_simulated has it, before anything is read: a name, with a number that is one.
Status check_name(const std::string& participant) {
  if (Status ok = experiment::check_participant(participant); !ok) return ok;
  if (experiment::participant_number(participant)) return {};
  const bool too_large = participant.back() >= '0' && participant.back() <= '9';
  return fail(too_large ? "has a number above 18446744073709551615" : "has no number at its end", {},
              "write one, as P07: it decides which order is the participant's");
}

/// A simulated participant has no device; and a device and a window keep real time.
Status check_trials(const ExperimentCommandOptions& options) {
  const TrialChoice& t = options.trials;
  const bool of_people = t.record || t.same_day || t.without_timeout || t.without_waiting || t.window || t.sound ||
                         t.sound_device != TrialChoice{}.sound_device ||
                         !(t.devices.names == TrialChoice{}.devices.names);
  if (!options.simulated.empty() && of_people)
    return fail("is a participant without device, window and sound", {}, "leave those options out, or --simulated");
  if (t.without_waiting && t.window) return fail("keeps real time", {}, "leave --window or --without-waiting out");
  if (t.without_waiting && !are_simulated(t.devices.names))
    return fail("can't be: real devices keep real time", {},
                "leave --without-waiting out, or choose simulated devices");
  return {};
}

Result<int> run_with_person(const ExperimentCommandOptions& options, const experiment::Protocol& protocol,
                            const std::string& text, const experiment::Enrolment& enrolment,
                            const RunTrials& in_windows) {
  auto trials = trial_options(options.trials);
  if (!trials) return tl::unexpected(trials.error());
  trials->protocol = protocol;
  trials->protocol_text = text;
  trials->out = options.out;
  trials->enrolment = enrolment;
  TrialsToRun wanted{std::move(*trials), std::nullopt, options.trials.sound_device};
  if (options.trials.sound.value_or(options.trials.window)) {
    wanted.sound = protocol.sound;
    wanted.sound->seed = enrolment.seed;
  }
  if (!options.trials.window) return run_trials(std::move(wanted));
  if (!in_windows) return fail("this program has no windows", "--window", "leave it out: keys then come from here");
  return in_windows(std::move(wanted));
}

Result<int> run_experiment(const ExperimentCommandOptions& options, const RunTrials& in_windows) {
  const Result<std::string> text = read_input_file(options.protocol, std::size_t{1} << 20);
  if (!text) return tl::unexpected(text.error());
  const Result<experiment::Protocol> protocol = experiment::parse_protocol(*text, options.protocol);
  if (!protocol) return tl::unexpected(protocol.error());
  experiment::Enrolment enrolment;
  enrolment.mark = {options.participant, options.simulated.empty() ? "no" : options.simulated, options.pilot};
  enrolment.protocol_digest = experiment::protocol_digest(*protocol);
  enrolment.seed = options.seed ? static_cast<std::uint64_t>(*options.seed)
                                : experiment::default_seed(options.participant, enrolment.protocol_digest);
  if (options.simulated.empty()) return run_with_person(options, *protocol, *text, enrolment, in_windows);
  const InterruptGuard guard;
  const auto outcome = experiment::run_simulated(options.out, *protocol, *text, enrolment, InterruptGuard::requested);
  if (!outcome) return tl::unexpected(outcome.error());
  const std::size_t trials = outcome->before + outcome->made;
  std::printf("%s: %zu trial%s%s, simulated\n", outcome->rows.c_str(), trials, trials == 1 ? "" : "s",
              outcome->before > 0 ? (" (" + std::to_string(outcome->before) + " were there)").c_str() : "");
  if (!outcome->stopped) return kDone;
  print_message("experiment", "interrupted; the same command goes on from there");
  return kFailed;
}

}  // namespace

void add_experiment_command(CLI::App& app, CommandResult& result) { add_experiment_command_with(app, result, {}); }

void add_experiment_command_with(CLI::App& app, CommandResult& result, const RunTrials& in_windows) {
  CLI::App* command =
      add_command(app, "experiment", "Take a participant through an experiment's protocol, at a device or simulated");
  auto options = std::make_shared<ExperimentCommandOptions>();
  ExperimentCommandOptions* o = options.get();
  add_text_option(*command, "PROTOCOL", o->protocol,
                  "What is shown, in which order: presets/experiments has the paper's two", "P.toml", Needed::yes);
  add_text_option(*command, "--participant", o->participant, "A name that ends with a number, which the orders go by",
                  "ID", Needed::yes);
  add_text_option(*command, "--out", o->out, "Folder for the answers of all participants", "DIR", Needed::yes);
  add_choice_option(*command, "--simulated", experiment::kSimulatedKinds,
                    "Nobody feels anything: a simulated participant answers",
                    [o](std::size_t i) { o->simulated = experiment::kSimulatedKinds[i]; });
  add_number_option(*command, "--seed", {.min = 0, .max = 9e15, .whole = true},
                    "Of orders and simulated answers (default: by participant and protocol)",
                    [o](double seed) { o->seed = seed; });
  add_flag(*command, "--pilot", o->pilot, "A trial run: marked in every row, not analysed with the others");
  add_trial_options(*command, o->trials);
  on_run(*command, [options, in_windows, &result] {
    if (options->simulated.empty() && options->trials.devices.names.force == "none")
      refuse_option("--force", "none: every trial needs a force device; choose one, for example simulated");
    refuse_failed("--participant", check_name(options->participant));
    refuse_failed(
        options->simulated.empty() ? options->trials.window ? "--window" : "--without-waiting" : "--simulated",
        check_trials(*options));
    const Result<int> code = run_experiment(*options, in_windows);
    if (!code) print_message("experiment", code.error().message());
    result.exit_code = code ? *code : kFailed;
  });
}

}  // namespace tangent
