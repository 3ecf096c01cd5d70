#include "workbench/gui/model/device_model.h"

#include "workbench/session/maestro_setups.h"

#include <cstdio>
#include <utility>

namespace tangent {

namespace {

SessionOptions session_options(const AppOptions& from) {
  SessionOptions options;
  options.servo.rate_hz = from.servo_hz;
  options.servo.cpu = from.servo_cpu;
  options.devices = from.devices;
  options.drivers = from.drivers;
  options.packets = from.packets;
  options.seed = from.seed;
  options.history_s = from.history_s;
  options.arm_on_start = from.arm_on_start;
  options.threaded = !from.deterministic;
  options.place = from.place;
  return options;
}

}  // namespace

DeviceModel::DeviceModel(const AppOptions& options, const SceneModel& scene, const PresetModel& presets,
                         MessageLog& messages, std::function<void()> session_ended)
    : scene_(scene),
      presets_(presets),
      messages_(messages),
      session_ended_(std::move(session_ended)),
      options_(session_options(options)),
      maestro_wish_(options.maestro) {
  if (!options.settings.empty()) maestro_file_ = options.settings.parent_path() / kMaestroFile;
}

void DeviceModel::take_scene(PreparedScenePtr prepared) {
  if (session_ != nullptr)
    session_->set_scene(std::move(prepared));
  else
    make_session(std::move(prepared));
}

void DeviceModel::make_session(PreparedScenePtr prepared) {
  if (lent_) return;
  // The wish to arm is for the first attempt, whatever comes of it: a later choice of devices arms nothing.
  const ArmOnStart arm_on_start = std::exchange(options_.arm_on_start, ArmOnStart::never);
  if (options_.devices.display == "maestro") {
    const auto setup = chosen_maestro_setup(maestro_wish_, maestro_file_);
    if (!setup) return messages_.say(Severity::error, setup.error().message());
    options_.maestro = setup->calibration;
    options_.maestro_channel = setup->channel;
  }
  SessionOptions wanted = options_;
  wanted.arm_on_start = arm_on_start;
  auto session = Session::create(scene_.of_servo(), presets_.current(), wanted, std::move(prepared));
  if (!session) {
    messages_.say(Severity::error, session.error().message());
    return;
  }
  session_ = std::move(*session);
  capped_ = {};
  clutch_ = {};
  clutch_held_ = placement_refused_ = false;
  last_hung_ = ExchangeWith::none;
  say_what_differs();
  for (const std::string& name : session_->without_timeout())
    messages_.say(Severity::warning, name +
                                         " goes on with its last command when this program dies: its firmware has no "
                                         "time-out. Nothing is armed until you confirm it in the device monitor");
  if (const Status ok = session_->start(); !ok) messages_.say(Severity::error, ok.error().message());
  status_ = session_->status();
}

void DeviceModel::end_session() {
  if (session_ == nullptr) return;
  if (const Status ended = session_->shut_down(); !ended) {
    messages_.say(Severity::error, ended.error().message());
    std::fprintf(stderr, "workbench gui: %s\n", ended.error().message().c_str());  // the window may be closing
  }
  if (before_release_) before_release_();
  session_.reset();
}

void DeviceModel::restart_session() {
  if (scene_.of_servo() == nullptr) return;
  end_session();  // releases its devices before the new one opens them
  status_ = {};
  session_ended_();
  make_session();
}

void DeviceModel::choose(const DeviceNames& names) {
  if (names == options_.devices && session_ != nullptr) return;
  options_.devices = names;
  restart_session();
}

std::optional<std::uint32_t> DeviceModel::send_preset() {
  if (session_ == nullptr) return std::nullopt;
  auto sent = session_->set_preset(presets_.current());
  if (sent) {
    say_what_differs();
    return *sent;
  }
  messages_.say(Severity::error, sent.error().message());
  return std::nullopt;
}

// Once for every value that is asked for.
void DeviceModel::say_what_differs() {
  // Without one the session may also have refused what was asked for, and goes on with what it had.
  if (session_->force_capabilities() == nullptr) return;
  const auto say = [this](const char* what, const char* unit, double asked, double used, double& said) {
    if (used < asked && asked != said) {
      char text[200];
      std::snprintf(text, sizeof text, "the %s of %.4g %s is more than %s renders stably: it uses %.4g %s", what, asked,
                    unit, session_->force_capabilities()->name.c_str(), used, unit);
      messages_.say(Severity::warning, text);
    }
    said = used < asked ? asked : 0.0;
  };
  const ForceSettings &asked = session_->asked_preset().force, &used = session_->preset().force;
  say("stiffness", "N/m", asked.stiffness_n_per_m, used.stiffness_n_per_m, capped_.stiffness_n_per_m);
  say("damping", "N s/m", asked.damping_n_s_per_m, used.damping_n_s_per_m, capped_.damping_n_s_per_m);
}

void DeviceModel::say_if_refused(const Status& status) {
  if (!status) messages_.say(Severity::warning, status.error().message());
}

std::string DeviceModel::placement_locked() const {
  if (session_ == nullptr) return "no session";
  const Status may = session_->may_place();
  return may ? std::string() : may.error().message();
}

void DeviceModel::place(const Placement& placement) {
  if (session_ != nullptr) say_if_refused(session_->place(placement));
}

void DeviceModel::fit_to_workspace() {
  if (session_ != nullptr) say_if_refused(session_->fit_to_workspace());
}

void DeviceModel::take_clutch() {
  const bool held = clutch_.key || clutch_.button || clutch_.latched;
  clutch_.key = clutch_.button = false;
  if (held == clutch_held_) return;
  const Status told = session_->hold_clutch(held);
  say_if_refused(told);
  clutch_held_ = held;  // refused: once for every press
  if (!told) clutch_.latched = false;
}

void DeviceModel::take_status() {
  if (session_ == nullptr) return;
  take_clutch();
  status_ = session_->status();
  say_what_differs();  // another placement caps anew
  if (status_.placement_refused && !placement_refused_)
    messages_.say(Severity::warning, "the scene was not placed: force is being sent. Stop first (Escape)");
  placement_refused_ = status_.placement_refused;
  const GateFault gate_fault = status_.servo.gate_fault;
  if (gate_fault != last_gate_fault_ && gate_fault != GateFault::none)
    messages_.say(Severity::error, std::string("force stopped: ") + to_string(gate_fault) + "; Arm lets it in again");
  last_gate_fault_ = gate_fault;
  const ExchangeWith hung = status_.servo.hung;
  if (hung != last_hung_ && hung != ExchangeWith::none)
    messages_.say(Severity::error, std::string(to_string(hung)) + " does not return from an exchange; " +
                                       (status_.servo.hung_was_stopped ? "it was told to stop"
                                                                       : "it has no way to be stopped: switch it off"));
  last_hung_ = hung;
  if (status_.force_fault != last_fault_ && status_.force_fault != DeviceFault::none)
    messages_.say(Severity::error, std::string("force device: ") + to_string(status_.force_fault));
  last_fault_ = status_.force_fault;
  const Status log = session_->packet_log();
  if (!log && packet_log_complete_) messages_.say(Severity::error, "log of USB packets: " + log.error().message());
  packet_log_complete_ = log.has_value();
}

void DeviceModel::calibrate_maestro(const MaestroCalibration& calibration, unsigned channel) {
  if (const Status ok = check_calibration(calibration); !ok)
    return messages_.say(Severity::error, ok.error().message());
  const MaestroSetup setup{calibration, channel};
  options_.maestro = calibration;
  options_.maestro_channel = channel;
  maestro_wish_ = wish_for(setup);
  keep_calibration(setup);
  if (options_.devices.display == "maestro") restart_session();
}

void DeviceModel::keep_calibration(const MaestroSetup& setup) {
  if (maestro_file_.empty()) return;
  const std::string serial = attached_maestro();
  if (serial.empty())
    return messages_.say(
        Severity::note, "no Maestro with a serial number is attached: the calibration is kept until the window closes");
  const Status kept = keep_maestro_setup(maestro_file_, serial, setup);
  if (kept)
    messages_.say(Severity::note, "calibration of the Maestro " + serial + " kept in " + maestro_file_.string());
  else
    messages_.say(Severity::error, kept.error().message());
}

void DeviceModel::set_hand_follows_mouse(bool on) {
  hand_follows_mouse_ = on;
  if (session_ == nullptr || on) return;
  HandSettings hand = session_->hand();
  hand.mode = HandMode::explore;
  session_->set_hand(hand);
}

void DeviceModel::lead_hand(const Vec3& finger_centre_world_m) {
  if (session_ != nullptr) session_->set_hand_target(finger_centre_world_m);
}

bool DeviceModel::stopped() const {
  return status_.servo.gate_state == GateState::disarmed || status_.servo.gate_state == GateState::faulted;
}

void DeviceModel::lend() {
  lent_ = true;
  end_session();
  status_ = {};
  session_ended_();
}

void DeviceModel::give_back() {
  lent_ = false;
  if (scene_.of_servo() != nullptr) make_session();
}

void DeviceModel::stop() {
  for (const auto& stop : also_stop_) stop();
  options_.arm_on_start = ArmOnStart::never;  // of a session that is still to come
  if (session_ != nullptr) session_->stop();
}

void DeviceModel::arm() {
  if (session_ == nullptr) return;
  if (session_->needs_yes())
    return messages_.say(Severity::warning,
                         "nothing is armed: say yes to the device without a time-out in the device "
                         "monitor first (View > Device monitor)");
  session_->arm();
}

bool DeviceModel::faulted() const {
  return session_ != nullptr &&
         (status_.servo.gate_state == GateState::faulted || status_.force_state == DeviceState::faulted ||
          status_.display_state == DeviceState::faulted);
}

std::string DeviceModel::arming_text() const {
  if (session_ == nullptr || !stopped()) return {};
  if (session_->force_capabilities() == nullptr && session_->display_capabilities() == nullptr) return {};
  if (session_->needs_yes()) return "No force: confirm the device without a time-out in the device monitor";
  const ServoStatus& servo = status_.servo;
  const bool asked = status_.arming == ArmingStage::arming || status_.arming == ArmingStage::given_up;
  if (servo.gate_state == GateState::faulted && !asked) return std::string("No force: ") + to_string(servo.gate_fault);
  const std::string text = tangent::arming_text(status_.arming, status_.in_the_way, status_.force_wanted_n);
  return text.empty() ? "No force" : text;
}

}  // namespace tangent
