#include "devices/haply/haply_device.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>
#include <utility>

namespace tangent {

namespace {

constexpr auto kLax = std::memory_order_relaxed;
constexpr int kMostOwed = 8;  // answers, before not even zero force is sent out of turn
// One message, one reply. So many that answer nothing are more than a misunderstanding of ours, unless for each of them
// there are so many that do answer.
constexpr int kMostUnasked = 100, kAnswersForOne = 10;
constexpr int kMostUnturned = 20;  // states in a row that don't say how the VerseGrip is turned
constexpr std::int64_t kAskListEvery_ns = 500'000'000, kKeepAliveEvery_ns = 4'000'000;

std::int64_t ns_of(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

void count_up(std::atomic<std::uint64_t>& counter) noexcept { counter.store(counter.load(kLax) + 1, kLax); }

ForceCapabilities describe_haply(const HaplyOptions& options) {
  ForceCapabilities can;
  can.name = "Haply Inverse3";
  can.serial = options.device;
  can.buttons = 3;
  can.peak_force_n = options.peak_force_n;
  can.workspace_half_size_m = Vec3(0.1);  // a careful box of ours: Haply's pages give no size
  can.rate_hz = 1000.0;
  can.homing_s = 60.0;  // done at once where it is calibrated; else a person puts it into its inkwell
  // Haply's x is to the right and its y away from the person; the world's x is away from the person, z is up in both.
  const double half = std::sqrt(0.5);
  can.frame.rotation = Quat(half, 0.0, 0.0, -half);
  return can;
}

}  // namespace

std::int64_t haply_now_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

HaplyForceDevice::HaplyForceDevice(const HaplyOptions& options)
    : options_(options), capabilities_(describe_haply(options)), link_(*this), id_(options.device) {}

// --- Opening -------------------------------------------------------------------------------------------

Status HaplyForceDevice::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  const std::string where = capabilities_.name + " at " + options_.address;
  const auto address = read_haply_address(options_.address, options_.other_host);
  if (!address) return tl::unexpected(address.error());
  if (haply_built_in() && !options_.device.empty() && !is_haply_id(options_.device))
    return fail("is no id of an Inverse3", "--haply-device " + options_.device, "write it as Haply Hub shows it: 049D");
  listed_text_.clear();
  closed_text_.clear();
  opening_ = Opening::waits;
  const std::uint32_t bad_before = bad_;
  const Status started = link_.start({.address = *address,
                                      .other_host = options_.other_host,
                                      .connect_s = options_.connect_s,
                                      .retry_s = options_.retry_s,
                                      .largest_message = kHaplyLargestMessage,
                                      .realtime = options_.realtime});
  if (!started) return started;
  const std::int64_t give_up = haply_now_ns() + ns_of(3.0 * options_.connect_s);
  while (opening_ == Opening::waits && haply_now_ns() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Opening came_to = opening_;
  HaplyProblem problem = came_to == Opening::listed ? listing_.load() : HaplyProblem::silent;
  if (came_to == Opening::closed) problem = closed_by_;
  if (bad_ != bad_before) problem = static_cast<HaplyProblem>(bad_ & 0xffu);
  if (problem != HaplyProblem::none) {
    link_.stop();
    return tl::unexpected(haply_error(problem, where, came_to == Opening::closed ? closed_text_ : listed_text_));
  }
  if (capabilities_.serial != id_) capabilities_.serial = id_;
  capabilities_.senses_rotation.fill(grip_used_);
  listen_for_events(*address);
  opened_.store(true, std::memory_order_release);
  return {};
}

void HaplyForceDevice::close() {
  opened_ = false;
  link_.stop();
  events_.stop();
}

/// Without them everything works; that they are not heard is said in the report.
void HaplyForceDevice::listen_for_events(const HaplyAddress& service) {
  seen_alarms_ = events_.alarms();
  if (options_.events_port == 0) return;
  static_cast<void>(events_.start({.address = {.host = service.host, .port = std::to_string(options_.events_port)},
                                   .other_host = options_.other_host,
                                   .connect_s = options_.connect_s,
                                   .retry_s = 4.0 * options_.retry_s,
                                   .largest_message = kHaplyLargestMessage,
                                   .thread = "haply-events"},
                                  id_));
}

// --- Link's thread: in ---------------------------------------------------------------------------------

void HaplyForceDevice::on_open() noexcept {
  known_.clear();
  listed_ = unheard_ = pending_ = pushes_ = false;
  owed_ = unasked_ = 0;
  unturned_ = kMostUnturned;  // the first one has to say it
  orientation_ = Quat(1.0, 0.0, 0.0, 0.0);
  order_ = {};
  orders_.take(order_);  // for the connection before
  order_ = {};
  order_at_ns_ = sent_at_ns_ = haply_now_ns();
  listing_ = HaplyProblem::no_device;
  count_up(connects_);
  connection_.fetch_add(1, std::memory_order_release);
}

void HaplyForceDevice::on_closed(HaplyProblem why, const std::string& detail) noexcept {
  closed_by_ = std::exchange(unheard_, false) ? HaplyProblem::silent : why;
  if (connection_.load(kLax) % 2 == 1) connection_.fetch_add(1, std::memory_order_release);
  if (opening_ != Opening::waits) return;
  closed_text_ = detail;
  opening_ = Opening::closed;
}

/// Ours among those of the message, or null with the reason in listing_.
const HaplyEntry* HaplyForceDevice::find_ours() {
  if (id_.empty() && message_.devices.size() == 1) id_ = message_.devices.front().id;
  for (const HaplyEntry& device : message_.devices) {
    if (device.id == id_) return &device;
  }
  if (listing_ == HaplyProblem::none) connection_.fetch_add(2, std::memory_order_release);  // else a tick may miss it
  listing_ = message_.devices.empty() ? HaplyProblem::no_device
             : id_.empty()            ? HaplyProblem::several
                                      : HaplyProblem::other_device;
  return nullptr;
}

void HaplyForceDevice::note_bad(HaplyProblem problem) noexcept {
  bad_ = ((bad_.load(kLax) >> 8) + 1) << 8 | static_cast<std::uint32_t>(problem);
}

void HaplyForceDevice::measure_round_trip() noexcept {
  if (owed_ == 1) round_trip_us_.add(static_cast<std::uint64_t>((haply_now_ns() - sent_at_ns_) / 1000));
  if (owed_ > 0) {
    --owed_;
    unasked_ = std::max(0, unasked_ - 1);
  } else if (listed_) {
    count_unasked();
  }
}

void HaplyForceDevice::count_unasked() {
  unasked_ += kAnswersForOne;
  if (unasked_ < kMostUnasked * kAnswersForOne) return;
  unasked_ = 0;
  note_bad(HaplyProblem::unasked);
  link_.reconnect();
}

/// The finger points where the grip does, along its y, with the same side up. A few messages may leave the turn out;
/// false: nobody knows how it is turned.
bool HaplyForceDevice::take_grip() {
  unturned_ = message_.grip.turned ? 0 : std::min(unturned_, kMostUnturned) + 1;
  if (message_.grips != 1 || message_.grip.lies || unturned_ > kMostUnturned) return false;
  const double half = std::sqrt(0.5);
  const Quat finger_in_grip(half, 0.0, 0.0, half);
  if (message_.grip.turned) orientation_ = glm::normalize(message_.grip.orientation * finger_in_grip);
  return true;
}

void HaplyForceDevice::take_state(const HaplyEntry& device, bool first) {
  listing_ = first && device.status.in_use ? HaplyProblem::in_use : HaplyProblem::none;
  if (listing_ == HaplyProblem::in_use) return;
  if (device.problem != HaplyProblem::none) return note_bad(device.problem);
  if (!device.own_axes) return note_bad(HaplyProblem::other_frame);
  if (grip_used_ && !take_grip()) return note_bad(HaplyProblem::grip);
  heard_.put({.position_m = device.position_m,
              .velocity_m_per_s = device.velocity_m_per_s,
              .orientation = orientation_,
              .has_velocity = device.has_velocity,
              .usable = device.status.usable(),
              .calibrated = device.status.calibrated,
              .buttons = message_.grip.buttons,
              .connection = connection_.load(kLax),
              .at_ns = options_.clock()});
}

void HaplyForceDevice::on_message(std::string_view text) noexcept {
  measure_round_trip();
  const bool first = !listed_;
  if (!read_haply(text, known_, message_)) {
    note_bad(HaplyProblem::not_understood);
  } else {
    if (first) vector_ = message_.has_session;
    if (opening_ == Opening::waits) grip_used_ = message_.grips == 1 && message_.grip.turned;
    if (const HaplyEntry* ours = find_ours(); ours != nullptr)
      take_state(*ours, first || listing_ == HaplyProblem::in_use);
    known_ = message_.devices;
  }
  listed_ = true;
  count_up(in_);
  if (opening_ != Opening::waits) return;
  for (const HaplyEntry& device : message_.devices) listed_text_ += (listed_text_.empty() ? "" : ", ") + device.id;
  opening_ = Opening::listed;
}

// --- Link's thread: out --------------------------------------------------------------------------------

void HaplyForceDevice::put_force(std::string& out, const Vec3& force_n) noexcept {
  write_haply_force(out, id_, force_n, vector_);
  pushes_ = force_n != Vec3(0.0);
  pending_ = false;
  count_up(out_);
  if (owed_++ > 0) count_up(out_of_turn_);
  sent_at_ns_ = haply_now_ns();
}

bool HaplyForceDevice::last(std::string& out) noexcept {
  if (!listed_ || id_.empty()) return false;
  put_force(out, Vec3(0.0));
  return true;
}

bool HaplyForceDevice::next(std::string& out) noexcept {
  const std::int64_t now = haply_now_ns();
  if (!listed_) {  // it speaks first; one that never does is connected to anew
    if (!unheard_ && now - sent_at_ns_ > ns_of(options_.connect_s)) {
      unheard_ = true;
      link_.reconnect();
    }
    return false;
  }
  if (orders_.take(order_)) {
    pending_ = true;
    order_at_ns_ = now;
  }
  if (listing_ != HaplyProblem::none && !pushes_) {
    if (now - sent_at_ns_ < kAskListEvery_ns) return false;
    out = kHaplyAskList;
    owed_ = 1;
    sent_at_ns_ = now;
    return true;
  }
  const std::uint32_t stops = stops_.load(std::memory_order_acquire), bad = bad_.load(kLax);
  const bool stalled = now - order_at_ns_ > ns_of(options_.our_stall_s);
  // From before it knew of what has happened since.
  const bool outdated = order_.stops != stops || order_.bad != bad || order_.connection != connection_.load(kLax);
  if (stalled || outdated || listing_ != HaplyProblem::none) order_.force_n = Vec3(0.0);
  // What was sent last has no force: nothing is urgent, and a service that keeps lying is not asked again at once.
  const bool must_stop = stops != stops_sent_ || bad != bad_sent_;
  const bool at_once = pushes_ && (must_stop || order_.force_n == Vec3(0.0));
  if (owed_ >= kMostOwed || (owed_ > 0 && !at_once)) return false;
  const bool keeps_alive = stalled && now - sent_at_ns_ > kKeepAliveEvery_ns;
  if (!at_once && !pending_ && !keeps_alive) return false;
  stops_sent_ = stops;
  bad_sent_ = bad;
  put_force(out, order_.force_n);
  return true;
}

// --- Servo thread --------------------------------------------------------------------------------------

void HaplyForceDevice::fail_by(HaplyProblem problem) noexcept {
  if (machine_.state() == DeviceState::faulted || !machine_.fail(fault_of(problem))) return;
  fault_by_.store(problem, kLax);
}

void HaplyForceDevice::follow_connection() noexcept {
  const std::uint32_t connection = connection_.load(std::memory_order_acquire);
  if (connection != seen_connection_) {
    seen_connection_ = connection;
    machine_.enter(DeviceState::absent);
    quiet_ = 0;
    quiet_s_ = silent_s_ = 0.0;
  }
  const bool there = connection % 2 == 1 && listing_.load(kLax) == HaplyProblem::none;
  if (!there) {
    machine_.enter(DeviceState::absent);
  } else if (machine_.state() == DeviceState::absent) {
    machine_.enter(DeviceState::open);
    late_.forget();
    silent_s_ = 0.0;
  }
  if (const std::uint32_t bad = bad_.load(std::memory_order_acquire); bad != seen_bad_) {
    seen_bad_ = bad;
    fail_by(static_cast<HaplyProblem>(bad & 0xffu));
  }
  if (const std::uint32_t alarms = events_.alarms(); alarms != seen_alarms_) {
    seen_alarms_ = alarms;
    fail_by(HaplyProblem::alarm);
  }
  if (const std::uint32_t stops = stops_.load(std::memory_order_acquire); stops != seen_stops_) {
    seen_stops_ = stops;
    machine_.apply(DeviceRequest::stop);
  }
}

void HaplyForceDevice::follow_answers(double dt_s) noexcept {
  fresh_ = heard_.take(newest_) && newest_.connection == seen_connection_;
  quiet_s_ += dt_s;
  // Of whatever comes, states that are none as well: who sends those is not silent, and keeps the fault that they are.
  const std::uint64_t in = in_.load(kLax);
  silent_s_ = fresh_ || std::exchange(seen_in_, in) != in ? 0.0 : silent_s_ + dt_s;
  if (fresh_) {
    // Late: an answer after exchanges without force. LatenessWatch takes 1.5 periods for late.
    if (late_.add(quiet_s_, 0.64 * (options_.quiet_ticks + 1) * dt_s) && machine_.ready()) fail_by(HaplyProblem::slow);
    quiet_ = 0;
    quiet_s_ = 0.0;
    return;
  }
  if (quiet_ < options_.quiet_ticks && ++quiet_ == options_.quiet_ticks) count_up(quiet_exchanges_);
  if (silent_s_ <= options_.silence_s || machine_.state() == DeviceState::absent) return;
  fail_by(HaplyProblem::silent);
  quiet_s_ = silent_s_ = 0.0;
  link_.reconnect();
}

void HaplyForceDevice::follow_status() noexcept {
  if (newest_.connection != seen_connection_) return;
  const DeviceState state = machine_.state();
  if (state == DeviceState::open && newest_.usable) machine_.enter(DeviceState::firmware);
  const bool past_open = state == DeviceState::firmware || state == DeviceState::homing || state == DeviceState::ready;
  if (past_open && !newest_.usable) fail_by(HaplyProblem::not_started);
  if (state == DeviceState::ready && !newest_.calibrated) fail_by(HaplyProblem::position);
  if (state == DeviceState::homing && newest_.usable && newest_.calibrated) machine_.enter(DeviceState::ready);
}

Vec3 HaplyForceDevice::force_to_send(const Vec3& wanted_n) noexcept {
  if (!machine_.ready()) return Vec3(0.0);
  const double strength = glm::length(wanted_n);
  if (!std::isfinite(strength)) {
    fail_by(HaplyProblem::bad_command);
    return Vec3(0.0);
  }
  if (quiet_ >= options_.quiet_ticks) return Vec3(0.0);
  return strength > options_.peak_force_n ? wanted_n * (options_.peak_force_n / strength) : wanted_n;
}

ForceSample HaplyForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  follow_connection();
  follow_answers(dt_s);
  follow_status();
  machine_.apply(command.request);
  if (command.request == DeviceRequest::clear_fault) {
    fault_by_.store(HaplyProblem::none, kLax);
    late_.forget();
  }
  ForceSample sample;
  sample.force_n = force_to_send(command.force_n);
  sample.state = machine_.state();
  sample.fault = machine_.fault();
  if (newest_.connection != 0) {
    sample.position_m = newest_.position_m - options_.centre_m;
    if (newest_.has_velocity) sample.velocity_m_per_s = newest_.velocity_m_per_s;
    sample.age_s = static_cast<double>(options_.clock() - newest_.at_ns) * 1e-9;
    sample.orientation = newest_.orientation;
    sample.buttons = newest_.buttons;
  }
  orders_.put({sample.force_n, seen_stops_, seen_bad_, seen_connection_});
  link_.wake();
  return sample;
}

// --- Any thread ----------------------------------------------------------------------------------------

bool HaplyForceDevice::emergency_stop() noexcept {
  stops_.fetch_add(1, std::memory_order_release);
  link_.wake();
  return true;
}

/// Behind what it is: the grip, and what the service warns of.
std::string HaplyForceDevice::details() const {
  std::string text = capabilities_.rotations_sensed() > 0 ? ", turned by its VerseGrip" : "";
  if (options_.events_port == 0) return text;
  if (!events_.heard()) text += "; events are not heard on port " + std::to_string(options_.events_port);
  const std::string event = events_.newest();
  return event.empty() ? text : text + "; its service warned: " + event;
}

bool HaplyForceDevice::report(LinkReport& out) const {
  out.connected = connection_.load(kLax) % 2 == 1;
  const HaplyProblem listing = listing_.load(kLax), fault = fault_by_.load(kLax);
  // Its serial number is written while it is opened.
  if (out.connected && listing == HaplyProblem::none && opened_.load(std::memory_order_acquire))
    out.identity = "device " + capabilities_.serial + details();
  const HaplyProblem problem = !out.connected ? closed_by_.load(kLax) : listing != HaplyProblem::none ? listing : fault;
  const std::string detail = problem == HaplyProblem::alarm ? events_.newest() : std::string();
  if (problem != HaplyProblem::none) out.problem = haply_error(problem, capabilities_.name, detail).message();
  out.rate_hz = capabilities_.rate_hz;
  out.packets_in = out.frames = in_.load(kLax);
  out.packets_out = out_.load(kLax);
  out.connects = connects_.load(kLax);
  out.errors = bad_.load(kLax) >> 8;
  out.late = quiet_exchanges_.load(kLax);
  out.round_trip_us = &round_trip_us_;
  return true;
}

}  // namespace tangent
