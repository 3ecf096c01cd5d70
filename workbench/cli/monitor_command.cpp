// workbench monitor: live view of the devices in a terminal, with the built-in scene under the finger.
#include "workbench/cli/builtin_scene.h"
#include "workbench/cli/command.h"
#include "workbench/cli/device_options.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/monitor_text.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"
#include "workbench/recording/session_recorder.h"
#include "workbench/session/maestro_setups.h"
#include "workbench/session/raw_terminal.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

#include <poll.h>
#include <unistd.h>

namespace tangent {
namespace {

struct MonitorOptions {
  DeviceChoice devices;
  double seconds = 0.0;  ///< 0: until q or Ctrl-C
  double servo_hz = 1000.0;
  InjectedFault inject = InjectedFault::none;
  std::filesystem::path record;  ///< empty: nothing is recorded
  bool inject_display = false, stay_stopped = false, arm = false, without_timeout = false;
};

/// Reads single keys while it exists, if standard input is a terminal.
class Keys {
 public:
  bool active() const { return terminal_.active(); }
  /// 0: none.
  char next() const {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char key = 0;
    return active() && ::poll(&input, 1, 0) > 0 && ::read(STDIN_FILENO, &key, 1) == 1 ? key : '\0';
  }

 private:
  RawTerminal terminal_;
};

void say_if_refused(const Status& status) {
  if (!status) std::printf("\n%s\n", status.error().message().c_str());
}

/// False: quit.
bool handle(char key, Session& session) {
  switch (key) {
    case 'q':
      return false;
    case 'a':
      session.arm();
      break;
    case 's':
      session.stop();
      break;
    case 'h':
      session.home();
      break;
    case 'f':
      say_if_refused(session.fit_to_workspace());
      break;
    case 'c':
      say_if_refused(session.hold_clutch(!session.status().clutched));
      break;
    case 'r':
      std::printf("\n%s", monitor_report(session).c_str());
      break;
    default:
      break;
  }
  return true;
}

/// Says what stands in the way of writing, once each time.
void look_after(SessionRecorder& recorder, std::string& told) {
  recorder.poll();
  const std::string now = recorder.status().trouble;
  if (now == told) return;
  told = now;
  print_message("monitor", now.empty() ? "the recording goes on"
                                       : "not recorded at present, and tried again every second: " + now);
}

/// Devices that may be plugged in later: which of them came.
class LinkWatch {
 public:
  void look(const Session& session) {
    LinkReport force, display;
    if (session.force_report(force)) force_.see(force);
    if (session.display_report(display)) display_.see(display);
  }
  /// Fails when one of them was never there.
  Status all_came(const DeviceNames& names) const {
    if (force_.missed()) return missing("--force " + names.force, force_);
    if (display_.missed()) return missing("--display " + names.display, display_);
    return {};
  }

 private:
  struct Link {
    bool sought = false, came = false;
    std::string problem = {};
    void see(const LinkReport& report) {
      sought = true;
      came = came || report.connected;
      if (!report.connected) problem = report.problem;
    }
    bool missed() const { return sought && !came; }
  };
  static Status missing(const std::string& option, const Link& link) {
    if (link.problem.empty()) return fail("was not there at any time", option, "plug it in, and see workbench devices");
    return fail("was not there at any time: " + link.problem, option, "see workbench devices");  // it says what to do
  }

  Link force_, display_;
};

/// `recorder`: null: none.
void watch(Session& session, const MonitorOptions& options, const FaultInjection& fault, SessionRecorder* recorder,
           LinkWatch& links) {
  using Clock = std::chrono::steady_clock;
  const Keys keys;
  const bool live = ::isatty(STDOUT_FILENO) != 0;
  if (keys.active())
    std::puts("a arm   s stop   h home   f fit the scene to the device   c clutch, on and off   r report   q quit");
  const auto began = Clock::now();
  auto next_line = began;
  std::string told;
  bool injected = fault.kind == InjectedFault::none;
  for (bool going = true; going && !InterruptGuard::requested();) {
    session.poll();
    links.look(session);
    if (recorder != nullptr) look_after(*recorder, told);
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - began).count();
    if (!injected && session.status().servo.gate_state == GateState::armed) {
      session.inject(fault, options.inject_display);
      injected = true;
    }
    if (now >= next_line) {
      std::printf(live ? "\r\033[K%s" : "%s\n", monitor_line(session).c_str());
      std::fflush(stdout);
      next_line = now + std::chrono::milliseconds(live ? 100 : 500);
    }
    if (options.seconds > 0.0 && elapsed >= options.seconds) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    while (const char key = keys.next()) going = going && handle(key, session);
  }
  if (live) std::puts("");
}

/// The device renders less than the preset asks for.
void say_what_is_capped(const Session& session) {
  const double asked = Preset{}.force.stiffness_n_per_m, used = session.preset().force.stiffness_n_per_m;
  if (!(used < asked) || session.force_capabilities() == nullptr) return;
  print_message("monitor", format("the stiffness of %.4g N/m is more than %s renders stably: it uses %.4g N/m", asked,
                                  session.force_capabilities()->name.c_str(), used));
}

Status run_monitor(const MonitorOptions& options) {
  const FaultInjection fault{.kind = options.inject};
  auto scene = builtin_scene();
  if (!scene) return tl::unexpected(scene.error());
  SessionOptions wanted;
  wanted.servo.rate_hz = options.servo_hz;
  wanted.servo.cpu = options.devices.servo_cpu;
  wanted.devices = options.devices.names;
  wanted.drivers = options.devices.drivers;
  if (wanted.devices.display == "maestro") {
    const auto setup = chosen_maestro_setup(options.devices.maestro, maestro_setups_path());
    if (!setup) return tl::unexpected(setup.error());
    wanted.maestro = setup->calibration;
    wanted.maestro_channel = setup->channel;
  }
  wanted.packets = options.devices.packets;
  wanted.place = options.devices.place;
  wanted.history_s = 1.0;
  wanted.arm_on_start = options.stay_stopped ? ArmOnStart::never
                        : options.arm        ? ArmOnStart::always
                                             : ArmOnStart::simulated;
  const InterruptGuard guard;  // before there are devices: a signal while they start ends them in order, too
  auto session = Session::create(*scene, Preset{}, wanted);
  if (!session) return tl::unexpected(session.error());
  if (options.without_timeout) (*session)->accept_no_timeout();
  if ((*session)->needs_yes()) {
    for (const std::string& name : (*session)->without_timeout())
      print_message("monitor", name +
                                   " goes on with its last command when this program dies (its firmware has no "
                                   "time-out), so nothing is armed; --without-timeout arms nevertheless");
  }
  say_what_is_capped(**session);
  Result<std::unique_ptr<SessionRecorder>> recorder;
  if (!options.record.empty()) {
    std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
    SessionRecording recording;
    recording.source.mesh = std::make_shared<const PolygonMesh>(builtin_mesh());
    recording.scene_name = "built-in sphere";
    recorder = SessionRecorder::start(**session, options.record, std::move(recording));
    if (!recorder) return tl::unexpected(recorder.error());
  }
  if (const Status ok = (*session)->start(); !ok) return ok;
  LinkWatch links;
  watch(**session, options, fault, recorder->get(), links);
  const Status ended = (*session)->shut_down();
  const Status written = *recorder ? (*recorder)->finish() : Status{};
  std::fputs(monitor_report(**session).c_str(), stdout);
  if (*recorder)
    std::printf("Recorded: %llu ticks, %llu missing, in %s\n",
                static_cast<unsigned long long>((*recorder)->status().written),
                static_cast<unsigned long long>((*recorder)->status().missing), options.record.c_str());
  if (!written) return written;
  if (!ended) return ended;
  const Status log = (*session)->packet_log();
  return log && options.seconds > 0.0 ? links.all_came(options.devices.names) : log;
}

}  // namespace

void add_monitor_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "monitor", "Devices, rates and the safety gate, live in the terminal");
  auto options = std::make_shared<MonitorOptions>();
  add_device_options(*command, options->devices);
  add_number_option(*command, "--seconds", {.min = 0, .max = 86400, .unit = "s"},
                    "How long (default: until q or Ctrl-C)", [options](double v) { options->seconds = v; });
  add_text_option(*command, "--record", options->record,
                  "Record every tick into this file; one that is there is not written over", "F.sqlite");
  add_number_option(*command, "--servo-hz", {.min = kSlowestServoHz, .max = kFastestServoHz, .unit = "Hz"},
                    "Rate of the servo (default 1000)", [options](double v) { options->servo_hz = v; });
  add_choice_option(
      *command, "--inject", injected_fault_names(), "Fault to give the simulated device once armed",
      [options](int i) { options->inject = *injected_fault(injected_fault_names()[static_cast<std::size_t>(i)]); });
  add_flag(*command, "--inject-display", options->inject_display,
           "Give it to the contact display instead of the force device");
  add_flag(*command, "--arm", options->arm, kArmText);
  add_flag(*command, "--without-timeout", options->without_timeout,
           "Arm even a device that goes on with its last command when this program dies");
  add_flag(*command, "--stay-stopped", options->stay_stopped, "No force until a is pressed");
  exclude_each_other(*command, "--arm", "--stay-stopped");
  on_run(*command, [options, &result] {
    const Status status = run_monitor(*options);
    if (!status) print_message("monitor", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
