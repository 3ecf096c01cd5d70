#include "devices/serial/serial_force_device.h"

#include "core/base/float_state.h"
#include "devices/gate/limits.h"

#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <system_error>

namespace tangent {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr double kFreshPeriods = 2.5;       // of samples: the next two ticks' force is zero once they are missing
constexpr double kReturn_n_per_s = 2000.0;  // the gate's slew rate

DeviceFault fault_of(SerialTrouble trouble) {
  switch (trouble) {
    case SerialTrouble::not_measured:
    case SerialTrouble::outside:
    case SerialTrouble::not_unit:
    case SerialTrouble::time_stood:
    case SerialTrouble::time_backwards:
    case SerialTrouble::time_ahead:
    case SerialTrouble::time_slow:
      return DeviceFault::sensor;
    case SerialTrouble::deaf:
    case SerialTrouble::silent:
      return DeviceFault::disconnected;
    default:
      return DeviceFault::firmware;
  }
}

/// An answer after which none will come that fits.
bool refuses(SerialTrouble trouble) {
  return trouble == SerialTrouble::display || trouble == SerialTrouble::version || trouble == SerialTrouble::unfit;
}

SerialRequest on_the_wire(DeviceRequest request) {
  switch (request) {
    case DeviceRequest::home:
      return SerialRequest::home;
    case DeviceRequest::stop:
      return SerialRequest::stop;
    case DeviceRequest::clear_fault:
      return SerialRequest::clear_fault;
    case DeviceRequest::none:
      break;
  }
  return SerialRequest::none;
}

std::array<bool, 3> bits_of(std::uint8_t bits) { return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0}; }

ForceCapabilities named() {
  ForceCapabilities can;
  can.name = "serial force device";
  can.homing_s = 0.0;
  return can;
}

}  // namespace

SerialForceDevice::SerialForceDevice(const SerialForceOptions& options)
    : options_(options), capabilities_(named()), wake_fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

SerialForceDevice::~SerialForceDevice() {
  close();
  if (wake_fd_ >= 0) ::close(wake_fd_);
}

// --- Servo thread --------------------------------------------------------------------------------------

// What arrived wins over what was told: a device that is gone is absent, whatever it said last.
DeviceState SerialForceDevice::state_now(std::int64_t now_ns, DeviceFault& fault) noexcept {
  const auto faulted = [&fault](DeviceFault why) {
    fault = why;
    return DeviceState::faulted;
  };
  if (news_.connection % 2 == 0) return DeviceState::absent;
  if (news_.trouble != SerialTrouble::none) return faulted(fault_of(news_.trouble));
  const bool late = news_.heard && now_ns - news_.arrived_ns > static_cast<std::int64_t>(options_.silence_s * 1e9);
  if (late && silent_connection_ != news_.connection) {
    silent_connection_ = news_.connection;  // latched until a person clears the fault
    request_.store(SerialRequest::stop, kRelaxed);
  }
  const bool silent = silent_connection_ == news_.connection;
  silent_.store(silent, kRelaxed);
  if (silent) return faulted(DeviceFault::disconnected);
  if (!news_.informed || !news_.heard) return DeviceState::open;
  const bool homed = homed_connection_ == news_.connection;  // by this host, since it was plugged in
  switch (news_.state) {
    case CldDeviceState::idle:
      return DeviceState::firmware;
    case CldDeviceState::homing:
      return homed ? DeviceState::homing : DeviceState::firmware;
    case CldDeviceState::ready:
      return homed ? DeviceState::ready : DeviceState::firmware;
    case CldDeviceState::faulted:
      break;
  }
  return faulted(fault_of(news_.fault));
}

void SerialForceDevice::request(DeviceRequest request, DeviceState state) noexcept {
  if (request == DeviceRequest::none) return;
  if (request == DeviceRequest::home) {
    if (state != DeviceState::firmware && state != DeviceState::ready) return;
    homed_connection_ = news_.connection;
  } else {
    homed_connection_ = 0;
  }
  if (request == DeviceRequest::clear_fault) silent_connection_ = 0;
  request_.store(on_the_wire(request), kRelaxed);
}

Vec3 SerialForceDevice::force_to_send(const ForceCommand& command, bool fresh, double dt_s) noexcept {
  Vec3 force = command.force_n;
  for (int axis = 0; axis < 3; ++axis)
    if (!capabilities_.pushes_along[static_cast<std::size_t>(axis)]) force[axis] = 0.0;
  if (!fresh || !is_finite(force)) {
    returning_ = true;
    return Vec3(0.0);
  }
  if (!returning_) return force;
  const Vec3 change = force - sent_n_;
  const double length = std::sqrt(glm::dot(change, change)), most = kReturn_n_per_s * std::min(dt_s, 1e-3);
  if (length > most) return sent_n_ + change * (most / length);
  returning_ = false;
  return force;
}

ForceSample SerialForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  told_.take(news_);
  const std::int64_t now_ns = options_.now_ns();
  ForceSample sample;
  sample.state = state_now(now_ns, sample.fault);
  const bool ready = sample.state == DeviceState::ready;
  sample.age_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, now_ns - news_.measured_ns));
  Order order;
  request(command.request, sample.state);
  if (!ready) returning_ = false;
  sent_n_ = ready ? force_to_send(command, sample.age_s <= kFreshPeriods * sample_s_, dt_s) : Vec3(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double micronewtons = std::clamp(sent_n_[axis] * 1e6, -2e9, 2e9);
    order.command.force_un[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::lround(micronewtons));
  }
  order.exchange = ++exchanges_;
  order.connection = news_.connection;
  orders_.put(order);
  wake();
  sample.position_m = news_.sample.position_m;
  sample.orientation = news_.sample.orientation;
  sample.buttons = news_.buttons;
  sample.force_n = sent_n_;
  return sample;
}

void SerialForceDevice::wake() noexcept {
  const std::uint64_t one = 1;
  static_cast<void>(!::write(wake_fd_, &one, sizeof one));
}

bool SerialForceDevice::emergency_stop() noexcept {
  stop_now_.store(true, kRelaxed);
  wake();
  return true;
}

// --- Opening and closing -------------------------------------------------------------------------------

void SerialForceDevice::describe(const SerialPortInfo& port) {
  const ForceInfo& info = conversation_.info();
  capabilities_ = named();
  capabilities_.serial = info.serial != 0 ? std::to_string(info.serial) : port.serial;
  capabilities_.pushes_along = bits_of(info.pushes_along);
  capabilities_.senses_rotation = bits_of(info.senses_rotation);
  capabilities_.buttons = info.buttons;
  capabilities_.peak_force_n = 1e-3 * info.peak_mn;
  capabilities_.continuous_force_n = 1e-3 * info.continuous_mn;
  capabilities_.position_resolution_m = 1e-9 * info.step_nm;
  capabilities_.apparent_mass_kg = 1e-3 * info.mass_g;
  capabilities_.largest_stiffness_n_per_m = info.stiffness_n_per_m;
  capabilities_.largest_damping_n_s_per_m = 1e-3 * info.damping_mn_s_per_m;
  for (int axis = 0; axis < 3; ++axis)
    capabilities_.workspace_half_size_m[axis] = 1e-6 * info.workspace_um[static_cast<std::size_t>(axis)];
  capabilities_.rate_hz = info.telemetry_hz;
  capabilities_.homing_s = 1e-3 * info.homing_ms;
  capabilities_.firmware_timeout_s = 1e-3 * info.watchdog_ms;
  sample_s_ = 1.0 / capabilities_.rate_hz;
}

Error SerialForceDevice::no_answer() const {
  const SerialTrouble why = conversation_.news().trouble;
  const bool none = why == SerialTrouble::none || why == SerialTrouble::no_answer;
  const char* remedy = none ? "name another port with --serial-port, or load a firmware with force messages "
                              "(devices/serial/README.md)"
                            : "load a firmware that fits (devices/serial/README.md)";
  return {to_string(none ? SerialTrouble::no_answer : why), path_, remedy};
}

// By this thread: the line's is not there yet.
Status SerialForceDevice::ask() {
  conversation_ = SerialConversation();
  conversation_.connected(options_.now_ns());
  const std::int64_t until_ns = serial_now_ns() + static_cast<std::int64_t>(options_.answer_s * 1e9);
  while (!conversation_.news().informed && !refuses(conversation_.news().trouble) && serial_now_ns() < until_ns) {
    const std::int64_t now_ns = options_.now_ns();
    if (out_from_ == out_to_) out_to_ = conversation_.compose(nullptr, now_ns, out_), out_from_ = 0;
    flush();
    wait(10);
    take_bytes(options_.now_ns());
    if (!port_.is_open()) return tl::unexpected(serial_error(ENODEV, path_));
  }
  if (!conversation_.news().informed) return tl::unexpected(no_answer());
  return {};
}

Status SerialForceDevice::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  const auto port = choose_serial_port(options_.port, options_.dev);
  if (!port) return tl::unexpected(port.error());
  path_ = port->by_id.empty() ? port->path : port->by_id;
  if (const int error = port_.open(path_.c_str(), options_.baud); error != 0)
    return tl::unexpected(serial_error(error, path_));
  out_from_ = out_to_ = 0;
  blocked_since_ns_ = 0;
  const auto close_again = [this](const Error& error) {
    say_goodbye();
    return tl::unexpected(error);
  };
  if (const Status answered = ask(); !answered) return close_again(answered.error());
  describe(*port);
  if (const Status sensible = check_capabilities(capabilities_); !sensible) return close_again(sensible.error());
  conversation_.expect(conversation_.info());
  ending_.store(false, kRelaxed);
  silent_.store(false, kRelaxed);
  news_ = {};
  exchanges_ = composed_ = 0;
  homed_connection_ = silent_connection_ = 0;
  discard_orders();  // of the last time
  order_ = {};
  carried_.store(0, kRelaxed);
  try {
    if (wake_fd_ < 0) throw std::system_error(errno, std::generic_category());
    publish();
    thread_ = std::thread([this]() noexcept { run(); });
  } catch (const std::system_error&) {
    return close_again({"no thread could be started", path_, "end other programs, or raise the limit on threads"});
  }
  opened_ = true;
  return {};
}

void SerialForceDevice::close() {
  if (!opened_) return;
  opened_ = false;
  ending_.store(true, kRelaxed);
  wake();
  thread_.join();
}

// --- Any thread ----------------------------------------------------------------------------------------

std::int64_t serial_now_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

double SerialForceDevice::line_processor_s() const {
  clockid_t clock{};
  timespec used{};
  // pthread_t is a number here; the thread is joined by close alone.
  if (!opened_ || pthread_getcpuclockid(const_cast<std::thread&>(thread_).native_handle(), &clock) != 0) return 0.0;
  clock_gettime(clock, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

bool SerialForceDevice::report(LinkReport& out) const {
  out.connected = opened_ && connected_.load(std::memory_order_acquire);
  const SerialTrouble trouble = trouble_.load(kRelaxed);
  if (out.connected) out.identity = (capabilities_.serial.empty() ? path_ : "serial " + capabilities_.serial);
  if (opened_ && !out.connected)
    out.problem = serial_error(open_error_.load(kRelaxed), path_).message();
  else if (trouble != SerialTrouble::none)
    out.problem = path_ + ": " + to_string(trouble);
  else if (silent_.load(kRelaxed))
    out.problem = path_ + ": " + to_string(SerialTrouble::silent);
  out.resolution_m = capabilities_.position_resolution_m;
  out.rate_hz = capabilities_.rate_hz;
  out.firmware_timeout_s = capabilities_.firmware_timeout_s;
  out.packets_in = reads_;
  out.packets_out = writes_;
  out.connects = connects_;
  out.frames = frames_;
  out.crc_errors = crc_errors_;
  out.skipped_bytes = skipped_bytes_;
  out.lost = lost_;
  out.doubled = doubled_;
  out.late = late_;
  out.lost_by_device = lost_by_device_;
  out.refused = refused_;
  out.dropped_commands = held_up_;
  return true;
}

}  // namespace tangent
