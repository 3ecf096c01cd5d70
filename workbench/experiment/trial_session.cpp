#include "workbench/experiment/trial_session.h"

#include "core/io/rendering_condition.h"
#include "workbench/recording/core_digest.h"
#include "workbench/session/prepared_scene.h"

#include <limits>

namespace tangent::experiment {
namespace {

constexpr double kLongestGap_s = 0.1;  // between two ticks; longer: time has jumped, or the program was held up
constexpr double kRaised_m = -3e-3;    // press of a simulated finger that is off the surface
constexpr std::size_t kDigestDigits = 16;
constexpr const char* kSimulatedDevice = "device";  // of RunMark::simulated: nobody felt anything

bool is_live(const ServoRecord& record) {
  return record.device.gate_state == GateState::ramping || record.device.gate_state == GateState::armed;
}

/// As participants do: a force is felt, and it is the surface's.
bool touches(const ServoRecord& record) {
  const TickOutput& output = record.tick.output;
  return is_live(record) && output.status != TickStatus::free && output.force_n != Vec3(0.0);
}

/// One of each that the protocol's presets come from.
std::vector<Stimulus> kinds_of(const Protocol& protocol) {
  std::vector<Stimulus> out;
  Stimulus shown;
  if (const Discrimination* arcs = protocol.discrimination()) {
    shown.kind = Stimulus::Kind::arc;
    for (const ComparisonCondition& condition : arcs->conditions) {
      shown.condition = condition.name;
      out.push_back(shown);
    }
    return out;
  }
  const Identification& design = *protocol.identification();
  shown.kind = Stimulus::Kind::object;
  shown.object = design.practice.empty() ? design.objects.front() : design.practice;
  for (const bool shaded : {true, false})
    for (const bool tactile : {false, true}) {
      shown.shaded = shaded;
      shown.tactile = tactile;
      out.push_back(shown);
    }
  return out;
}

Status check_conditions(const Protocol& protocol, const Stimuli& stimuli, const Session& session) {
  if (session.force_capabilities() == nullptr)
    return fail("there is no force device, which every trial needs", "--force", "choose one, for example simulated");
  for (const Stimulus& shown : kinds_of(protocol)) {
    const auto stimulus = stimuli.rendered(shown);
    if (!stimulus) return tl::unexpected(stimulus.error());
    if (Status ok = check_devices(stimulus->preset, true, session.display_capabilities() != nullptr); !ok) return ok;
  }
  return {};
}

std::string device_text(const Session& session) {
  std::string out = session.force_capabilities()->name;
  if (!session.force_capabilities()->serial.empty()) out += " " + session.force_capabilities()->serial;
  const DisplayCapabilities* display = session.display_capabilities();
  return out + ", " + (display != nullptr ? display->name : "no display");
}

std::string feedback_text(const Stimulus& shown) {
  if (shown.kind == Stimulus::Kind::arc) return shown.condition;
  if (shown.kind == Stimulus::Kind::none) return {};
  return std::string(shown.tactile ? "force and tactile" : "force") + (shown.shaded ? ", shaded" : ", unshaded");
}

}  // namespace

TrialKey digit_key(int digit) {
  if (digit < 1 || digit > 9) return TrialKey::enter;
  return static_cast<TrialKey>(static_cast<int>(TrialKey::digit_1) + digit - 1);
}

// --- Start and end -------------------------------------------------------------------------------------

TrialSession::TrialSession(TrialOptions options, Stimuli stimuli, TrialRun run, TrialEvents events,
                           std::unique_ptr<Session> session)
    : options_(std::move(options)),
      stimuli_(std::move(stimuli)),
      run_(std::move(run)),
      events_(std::move(events)),
      session_(std::move(session)) {}

Result<std::unique_ptr<TrialSession>> TrialSession::start(TrialOptions options) {
  return make(std::move(options), nullptr);
}
Result<std::unique_ptr<TrialSession>> TrialSession::start(TrialOptions options, DeviceSet devices) {
  return make(std::move(options), &devices);
}

// Devices first: without them nobody is enrolled.
Result<std::unique_ptr<TrialSession>> TrialSession::make(TrialOptions options, DeviceSet* devices) {
  options.session.arm_on_start = ArmOnStart::never;
  if (Status ok = check_participant(options.enrolment.mark.participant); !ok) return tl::unexpected(ok.error());
  Result<Stimuli> stimuli = Stimuli::make(options.protocol);
  if (!stimuli) return tl::unexpected(stimuli.error());
  const auto first = stimuli->rendered(kinds_of(options.protocol).front());
  if (!first) return tl::unexpected(first.error());
  // All stimuli of a protocol are placed alike. The device stays where it is in the scene while they change.
  PlaceOptions& place = options.session.place;
  if (!place.fit && !place.offset_m && place.scale == 1.0 && place.rotation == PlaceOptions{}.rotation)
    place = {false, first->placement.scale, first->placement.rotation, first->placement.offset_m};
  auto session = devices != nullptr
                     ? Session::create(first->scene, options.protocol.preset, options.session, std::move(*devices))
                     : Session::create(first->scene, options.protocol.preset, options.session);
  if (!session) return tl::unexpected(session.error());
  if (Status ok = check_conditions(options.protocol, *stimuli, **session); !ok) return tl::unexpected(ok.error());
  std::string& simulated = options.enrolment.mark.simulated;
  if (simulated == "no" && (*session)->force_capabilities()->simulated) simulated = kSimulatedDevice;
  auto run = TrialRun::start(options.out, options.protocol, options.protocol_text, options.enrolment);
  if (!run) return tl::unexpected(run.error());
  auto events = TrialEvents::open(run->rows(), options.enrolment);
  if (!events) return tl::unexpected(events.error());
  auto made = std::unique_ptr<TrialSession>(new TrialSession(std::move(options), std::move(*stimuli), std::move(*run),
                                                             std::move(*events), std::move(*session)));
  if (Status ok = made->begin(); !ok) return tl::unexpected(ok.error());
  return made;
}

Status TrialSession::begin() {
  wish_.felt = false;
  session_->set_surface(wish_);
  if (options_.without_timeout) session_->accept_no_timeout();
  if (Status ok = log(TrialEvent::started, device_text(*session_) + "; sound " + options_.sound + "; program " +
                                               std::string(core_digest()).substr(0, kDigestDigits));
      !ok)
    return ok;
  if (Status ok = session_->start(); !ok) return ok;
  fault_ = "not armed yet; put the finger into the device, and press resume";
  if (!session_->status().real_devices) resume();
  return {};
}

TrialSession::~TrialSession() { static_cast<void>(end()); }

Status TrialSession::end() {
  if (std::exchange(closed_, true)) return {};
  const bool complete = run_.finished();
  ended_ = true;
  Status out = session_->shut_down();
  const auto also = [&out](const Status& status) {
    if (out && !status) out = status;
  };
  also(recorder_.end());
  also(run_.settle());
  also(log(TrialEvent::ended, complete ? "complete" : "ended before its end"));
  if (!hashes_.empty()) also(note_stimuli(run_.rows(), hashes_));
  also(session_->packet_log());
  return out;
}

Status TrialSession::log(TrialEvent event, const std::string& text) {
  const double t_s = any_ ? last_.tick.input.t_s : 0.0;
  char when[32];
  std::snprintf(when, sizeof when, "%.1f s  ", t_s);
  if (event != TrialEvent::trial) notes_.push_back(when + text);
  return events_.add(t_s, run_.trial(), event, text);
}

void TrialSession::note(const std::string& text) {
  if (const Status ok = log(TrialEvent::note, text); !ok) pause(ok.error().message());
}

// --- Keys ----------------------------------------------------------------------------------------------

void TrialSession::press(TrialKey key) {
  if (ended_) return;
  switch (key) {
    case TrialKey::stop:
      session_->stop();
      return pause("stopped by the operator");
    case TrialKey::resume:
      return resume();
    case TrialKey::quit:
      session_->stop();
      ended_ = true;
      return;
    case TrialKey::lift:
      raised_ = !raised_;
      return lead_simulated_hand();
    default:
      break;
  }
  if (stage_ != Stage::running || !any_) return;
  if (key == TrialKey::enter)
    advance(Key::enter, 0);
  else
    advance(Key::digit, 1 + static_cast<int>(key) - static_cast<int>(TrialKey::digit_1));
  show();
}

void TrialSession::pause(const std::string& why) {
  if (stage_ == Stage::paused && !fault_.empty()) return;
  stage_ = Stage::paused;
  fault_ = why + "; press resume when it is mended: the trial begins again";
  wish({.felt = false});
  put_ = {};
  begun_ = -1;
  static_cast<void>(recorder_.end());  // what it lacks is said by the file itself
  static_cast<void>(log(TrialEvent::paused, why));
}

void TrialSession::resume() {
  if (stage_ != Stage::paused || ended_) return;
  Status ok = run_.settle();
  if (ok && session_->needs_yes())
    ok = fail(session_->without_timeout().front() + " goes on with its last command when this program dies", "devices",
              "start with --without-timeout if that is known and accepted");
  if (ok) ok = check_devices_are_there();
  if (ok) ok = log(TrialEvent::resumed, "goes on");
  if (!ok) {
    fault_ = ok.error().message();
    return;
  }
  if (any_) run_.repeat(last_.tick.input.t_s);
  fault_.clear();
  stage_ = Stage::arming;
  armed_from_ = session_->status().servo.ticks + 1;
  session_->arm();
}

// The gate takes a device that is absent for none, and would go on without it.
Status TrialSession::check_devices_are_there() const {
  const DisplayCapabilities* display = session_->display_capabilities();
  const char* remedy = "plug it in, then press resume";
  if (any_ && last_.device.force_state == DeviceState::absent)
    return fail("the force device is not there", session_->force_capabilities()->name, remedy);
  if (any_ && display != nullptr && last_.device.display_state == DeviceState::absent)
    return fail("the contact display is not there", display->name, remedy);
  return {};
}

// --- Views ---------------------------------------------------------------------------------------------

ParticipantView TrialSession::participant() const {
  const Shown& shown = run_.shown();
  ParticipantView out;
  out.phase = shown.phase;
  out.cues = shown.cues;
  out.trial = std::min(run_.progress().done + 1, run_.progress().expected);
  out.of = run_.progress().expected;
  out.prompt = shown.prompt;
  if (ended_ || run_.finished()) return out;
  if (stage_ != Stage::running) {
    out.prompt = "A short break. Please wait.";
    return out;
  }
  out.hint = last_.device.surface_waits != 0 ? "Raise your finger." : shown.hint;
  out.show_scene = shown.in_view && is_in();
  out.show_finger = shown.guided;
  if (shown.guided) out.finger_from_start_m = finger_from_start_m();
  return out;
}

OperatorView TrialSession::operator_view() const {
  const Shown& shown = run_.shown();
  OperatorView out;
  out.stimulus = shown.stimulus.kind == Stimulus::Kind::none ? "none" : put_stimulus_.name;
  out.condition = feedback_text(shown.stimulus);
  out.what_is_next = run_.what_is_next();
  out.progress = run_.progress();
  out.touching = moment_.touching;
  out.paused = stage_ == Stage::paused;
  out.fault = fault_;
  out.notes = notes_;
  out.staircase = run_.staircase();
  return out;
}

RowOrigin TrialSession::origin() const {
  RowOrigin out;
  out.interruptions = std::max(0, events_.begun(run_.trial()) - 1);
  out.device = device_text(*session_);
  out.sound = options_.sound;
  out.mesh = comparison_hash_;
  out.preset = preset_digest(session_->preset());
  out.protocol = options_.enrolment.protocol_digest;
  out.program = std::string(core_digest()).substr(0, kDigestDigits);
  out.recording = recorder_.file();
  return out;
}

// --- Ticks ---------------------------------------------------------------------------------------------

void TrialSession::poll() {
  if (closed_) return;
  take_records();
  if (stage_ == Stage::running && session_->status().servo.hung != ExchangeWith::none)
    pause("a device does not return from an exchange: switch it off, and start the program again");
  if (const std::string trouble = recorder_.poll(); !trouble.empty()) pause("the trial is not recorded: " + trouble);
  show();
}

void TrialSession::take_records() {
  session_->poll();
  placement_ = session_->status().placement;
  const History& history = session_->history();
  std::size_t i = any_ ? history.lower_bound(last_.tick.tick + 1) : 0;
  for (; i < history.size(); ++i) take(history[i]);
}

void TrialSession::take(const ServoRecord& record) {
  const double passed_s = record.tick.input.t_s - last_.tick.input.t_s;
  const bool gap = any_ && (record.tick.tick != last_.tick.tick + 1 || !(passed_s >= 0.0 && passed_s <= kLongestGap_s));
  last_ = record;
  any_ = true;
  if (stage_ == Stage::arming) watch_arming(record);
  if (stage_ != Stage::running || ended_) return;
  if (gap) return pause("the clock jumped, or the program was held up: ticks of this trial are missing");
  if (!watch_faults(record)) advance(Key::none, 0);
}

void TrialSession::watch_arming(const ServoRecord& record) {
  if (record.tick.tick < armed_from_) return;
  if (is_live(record)) stage_ = Stage::running;
  if (record.device.arming == ArmingStage::given_up)
    pause("not armed: " + std::string(to_string(record.device.in_the_way)) + ". " + remedy(record.device.in_the_way));
}

bool TrialSession::watch_faults(const ServoRecord& record) {
  if (is_live(record)) return false;
  const DeviceTelemetry& device = record.device;
  std::string why = device.gate_fault == GateFault::none
                        ? std::string("the force was stopped")
                        : std::string("the safety gate stopped the force: ") + to_string(device.gate_fault);
  if (device.force_fault != DeviceFault::none) why += std::string("; force device: ") + to_string(device.force_fault);
  if (device.display_fault != DeviceFault::none) why += std::string("; display: ") + to_string(device.display_fault);
  pause(why);
  return true;
}

void TrialSession::advance(Key key, int digit) {
  const Identification* naming = options_.protocol.identification();
  const bool away = last_.device.surface_share == 0.0F && !wish_.felt;
  moment_ = {last_.tick.input.t_s, is_in() && touches(last_), std::numeric_limits<double>::infinity(), key, digit};
  if (naming != nullptr && away) moment_.from_start_m = glm::length(finger_from_start_m());
  const std::uint64_t cues = run_.shown().cues;
  if (const Status ok = run_.advance(moment_, key == Key::none ? RowOrigin{} : origin()); !ok)
    pause(ok.error().message());
  if (run_.shown().cues != cues) raised_ = false;
}

// --- Stimuli -------------------------------------------------------------------------------------------

bool TrialSession::is_in() const {
  return put_ == run_.shown().stimulus && put_.kind != Stimulus::Kind::none && last_.scene_id == put_scene_ &&
         last_.tick.preset_id == put_preset_ && last_.device.surface_share == 1.0F;
}

// The start is a place in the room.
SurfaceWish TrialSession::pull_to_start() const {
  const Identification& design = *options_.protocol.identification();

  return {false, true, placement_.to_scene(design.start_m), design.guide_n_per_m / placement_.scale,
          design.guide_limit_n};
}

Vec3 TrialSession::finger_from_start_m() const {
  return placement_.to_device(last_.tick.input.finger.position) - options_.protocol.identification()->start_m;
}

void TrialSession::wish(const SurfaceWish& wish) {
  if (wish == wish_) return;
  wish_ = wish;
  session_->set_surface(wish);
}

void TrialSession::show() {
  lead_simulated_hand();
  if (stage_ != Stage::running || !any_) return;
  const Shown& shown = run_.shown();
  if (ended_ || shown.stimulus.kind == Stimulus::Kind::none) {
    put_ = {};
    if (const Status ok = recorder_.end(); !ok) return pause(ok.error().message());
    return wish(shown.guided ? pull_to_start() : SurfaceWish{.felt = false});
  }
  if (put_ != shown.stimulus) {
    wish({.felt = false});
    if (last_.device.surface_share == 0.0F) put(shown.stimulus);
    return;
  }
  const bool there = last_.scene_id == put_scene_ && last_.tick.preset_id == put_preset_;
  if (there && begin_trial()) wish({});
}

void TrialSession::put(const Stimulus& shown) {
  auto stimulus = stimuli_.rendered(shown);
  if (!stimulus) return pause(stimulus.error().message());
  const auto preset = session_->set_preset(stimulus->preset);
  if (!preset) return pause(preset.error().message());
  put_preset_ = *preset;
  auto path = paths_.find(stimulus->mesh_hash);
  if (path == paths_.end()) {
    put_scene_ = session_->set_scene(stimulus->scene);
    paths_.emplace(stimulus->mesh_hash, session_->path());
  } else {
    put_scene_ = session_->set_scene(PreparedScenePtr(new PreparedScene(stimulus->scene, path->second)));
  }
  put_ = shown;
  recorder_.scene_changed(put_scene_, *stimulus);
  hashes_[stimulus->name] = stimulus->mesh_hash;
  if (shown.kind == Stimulus::Kind::object || shown.segments != 0) comparison_hash_ = stimulus->mesh_hash;
  put_stimulus_ = std::move(*stimulus);
}

// Each trial, and each time it begins again, is in the events before it is felt.
bool TrialSession::begin_trial() {
  const Phase phase = run_.shown().phase;
  if ((phase != Phase::first && phase != Phase::explore) || begun_ == run_.trial()) return true;
  Status ok = log(TrialEvent::trial, put_stimulus_.name);
  if (ok && options_.record) ok = recorder_.begin(*session_, recordings_path(run_.rows()), run_.trial(), put_stimulus_);
  if (!ok) return pause(ok.error().message()), false;
  begun_ = run_.trial();
  return true;
}

// A simulated finger goes over what is there; it is off the surface while that is replaced, or when it is told so.
void TrialSession::lead_simulated_hand() {
  if (!session_->force_capabilities()->simulated) return;
  if (const Shown& shown = run_.shown(); shown.guided) {
    if (session_->hand().mode != HandMode::point) session_->set_hand_target(pull_to_start().pull_to_m);
    return;
  }
  HandSettings hand = options_.session.hand;
  if (raised_ || !is_in()) hand.press_m = kRaised_m;
  if (!(session_->hand() == hand)) session_->set_hand(hand);
}

}  // namespace tangent::experiment
