// workbench record: the session without a window, into a file.
#include "core/io/scene_file.h"
#include "workbench/cli/builtin_scene.h"
#include "workbench/cli/command.h"
#include "workbench/cli/device_options.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/preset_options.h"
#include "workbench/cli/text_format.h"
#include "workbench/recording/session_recorder.h"
#include "workbench/session/two_threads.h"

#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

namespace tangent {
namespace {

struct RecordOptions {
  MeshOptions mesh;
  PresetOptions preset;
  DeviceChoice devices;
  std::filesystem::path out;
  double seconds = 0.0;  ///< 0: until Ctrl-C
  double servo_hz = 1000.0;
  bool no_mesh = false, arm = false, stay_stopped = false, without_waiting = false, without_timeout = false;
};

struct Scene {
  std::shared_ptr<const ContactScene> scene;
  SceneSource source;
};

Result<Scene> load(const MeshOptions& options) {
  if (options.file.empty()) {
    auto scene = builtin_scene();
    if (!scene) return tl::unexpected(scene.error());
    return Scene{*scene, {std::make_shared<const PolygonMesh>(builtin_mesh()), {}, nullptr}};
  }
  Result<SceneFile> file = read_scene(options.file, {options.metres_per_unit, options.build, {}}, run_on_two_threads);
  if (!file) return tl::unexpected(file.error());
  if (file->source) return Scene{file->scene, {file->source, options.build, nullptr}};
  return Scene{file->scene, source_of_planar(*file->scene)};
}

SessionOptions session_options(const RecordOptions& options) {
  SessionOptions wanted;
  wanted.threaded = !options.without_waiting;
  wanted.servo.rate_hz = options.servo_hz;
  wanted.servo.cpu = options.devices.servo_cpu;
  wanted.devices = options.devices.names;
  wanted.drivers = options.devices.drivers;
  wanted.packets = options.devices.packets;
  wanted.place = options.devices.place;
  wanted.history_s = 1.0;
  wanted.arm_on_start = options.stay_stopped ? ArmOnStart::never
                        : options.arm        ? ArmOnStart::always
                                             : ArmOnStart::simulated;
  return wanted;
}

/// Says what stands in the way of writing, once each time.
class TroubleTeller {
 public:
  void look(const RecorderStatus& status) {
    if (status.trouble == told_) return;
    told_ = status.trouble;
    print_message("record", told_.empty() ? "the recording goes on"
                                          : "not recorded at present, and tried again every second: " + told_);
  }

 private:
  std::string told_;
};

/// Until the time is over or a signal comes. True: a signal came.
bool run(Session& session, SessionRecorder& recorder, const RecordOptions& options) {
  const auto most = static_cast<std::uint64_t>(options.seconds * session.status().servo.nominal_hz + 0.5);
  TroubleTeller trouble;
  for (std::uint64_t done = 0; options.seconds == 0.0 || done < most;) {
    if (InterruptGuard::requested()) return true;
    if (options.without_waiting) {
      constexpr std::uint64_t kBatch = 1000;
      session.advance(std::min(kBatch, most - done));
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    session.poll();
    recorder.poll();
    trouble.look(recorder.status());
    done = session.status().servo.ticks;
  }
  return false;
}

void report(const SessionRecorder& recorder, const RecordOptions& options) {
  const RecorderStatus status = recorder.status();
  std::error_code error;
  const auto bytes = std::filesystem::file_size(options.out, error);
  std::printf("%s: %llu ticks, %llu missing, %.1f MB\n", options.out.c_str(),
              static_cast<unsigned long long>(status.written), static_cast<unsigned long long>(status.missing),
              error ? 0.0 : static_cast<double>(bytes) / 1e6);
}

Status record(const RecordOptions& options, bool& interrupted) {
  Result<PresetFile> preset = load_preset(options.preset);
  if (!preset) return tl::unexpected(preset.error());
  Result<Scene> scene = load(options.mesh);
  if (!scene) return tl::unexpected(scene.error());
  auto session = Session::create(scene->scene, preset->preset, session_options(options));
  if (!session) return tl::unexpected(session.error());
  if (options.without_timeout) (*session)->accept_no_timeout();
  if (options.without_waiting && (*session)->status().real_devices)
    return fail("real devices keep real time", "--without-waiting", "leave it out, or choose simulated devices");
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
  const InterruptGuard guard;
  const std::string name = options.mesh.file.empty() ? "built-in sphere" : options.mesh.file.filename().string();
  auto recorder = SessionRecorder::start(
      **session, options.out,
      {options.no_mesh ? SceneSource{} : std::move(scene->source), name, !options.without_waiting});
  if (!recorder) return tl::unexpected(recorder.error());
  if (Status ok = (*session)->start(); !ok) return ok;
  interrupted = run(**session, **recorder, options);
  const Status ended = (*session)->shut_down();
  const Status written = (*recorder)->finish();
  report(**recorder, options);
  if (!written) return written;
  return ended ? (*session)->packet_log() : ended;
}

}  // namespace

void add_record_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "record", "Run the devices without a window, and record every tick");
  auto options = std::make_shared<RecordOptions>();
  add_mesh_options(*command, options->mesh, false);
  add_text_option(*command, "--out", options->out, "The recording; a file that is there is not written over",
                  "F.sqlite", Needed::yes);
  add_number_option(*command, "--seconds", {.min = 1e-3, .max = 864000, .unit = "s"},
                    "How long (default: until Ctrl-C)", [options](double v) { options->seconds = v; });
  add_flag(*command, "--no-mesh", options->no_mesh, "Keep the mesh's name and hash, not its bytes");
  add_number_option(*command, "--servo-hz", {.min = kSlowestServoHz, .max = kFastestServoHz, .unit = "Hz"},
                    "Rate of the servo (default 1000)", [options](double v) { options->servo_hz = v; });
  add_flag(*command, "--without-waiting", options->without_waiting,
           "One tick right after the other, in simulated time (simulated devices; needs --seconds)");
  add_device_options(*command, options->devices);
  add_flag(*command, "--arm", options->arm, kArmText);
  add_flag(*command, "--without-timeout", options->without_timeout,
           "Arm even a device that goes on with its last command when this program dies");
  add_flag(*command, "--stay-stopped", options->stay_stopped, "No force");
  exclude_each_other(*command, "--arm", "--stay-stopped");
  add_preset_options(*command, options->preset);
  on_run(*command, [options, &result] {
    if (options->without_waiting && options->seconds == 0.0)
      refuse_option("--without-waiting", "needs --seconds: simulated time has no Ctrl-C");
    bool interrupted = false;
    const Status status = record(*options, interrupted);
    if (!status) print_message("record", status.error().message());
    const bool early = interrupted && options->seconds > 0.0;
    if (early) print_message("record", "interrupted; " + options->out.string() + " holds the ticks until then");
    result.exit_code = status && !early ? kDone : kFailed;
  });
}

}  // namespace tangent
