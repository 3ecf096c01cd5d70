// Opening, closing and looking for the device again: the parts of HdForceDevice outside its frames.
#include "devices/gate/limits.h"
#include "devices/link_report.h"
#include "devices/openhaptics/hd_errors.h"
#include "devices/openhaptics/hd_force_device.h"
#include "devices/openhaptics/hd_setups.h"

#include <ctime>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

constexpr auto kRelaxedKeeper = std::memory_order_relaxed;
constexpr std::int64_t kLook_ns = 2'000'000;     // how often the keeper looks
constexpr std::int64_t kStandIn_ns = 1'000'000;  // between two ticks that it calls
constexpr unsigned long kSchedulerRate_hz = 1000;

std::atomic<bool> scheduler_taken{false};  // the library has one for the whole process

std::int64_t clock_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void sleep_ns(std::int64_t ns) {
  const timespec pause{.tv_sec = 0, .tv_nsec = static_cast<long>(ns)};
  nanosleep(&pause, nullptr);
}

std::int64_t ns_of(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

hd::Enum best_style(int styles) {
  for (const hd::Enum style : {hd::kAuto, hd::kInkwell, hd::kEncoderReset})
    if ((static_cast<hd::Enum>(styles) & style) != 0) return style;
  return 0;
}

}  // namespace

HdForceDevice::HdForceDevice(HdOptions options) : options_(std::move(options)) {
  capabilities_.name = "OpenHaptics device";
  capabilities_.frame = hd::device_frame();
  capabilities_.rate_hz = static_cast<double>(kSchedulerRate_hz);
  capabilities_.homing_s = 0.0;
}

// --- Opening and closing -------------------------------------------------------------------------------

Status HdForceDevice::attach() {
  drain();
  device_ = api_.init_device(options_.device.empty() ? nullptr : options_.device.c_str());
  const std::string where = options_.device.empty() ? "OpenHaptics' default device" : options_.device;
  if (const hd::ErrorCode code = drain(); code != hd::kSuccess) {
    newest_error_.store(code, kRelaxedKeeper);
    if (device_ != hd::kInvalidHandle) api_.disable_device(std::exchange(device_, hd::kInvalidHandle));
    return tl::unexpected(hd::to_error(code, where));
  }
  if (device_ == hd::kInvalidHandle)
    return fail("there is no such device", where, "set it up with the maker's setup program (Touch_Setup)");
  return {};
}

/// What the device says about itself; at its return, that it is the same.
Status HdForceDevice::learn() {
  if (const Status new_enough = hd::check_version(api_.get_string(hd::kVersion)); !new_enough) return new_enough;
  ForceCapabilities can = hd::read_capabilities(api_);
  if (opened_ && can.serial != capabilities_.serial)
    return fail("another device is there, serial " + can.serial, capabilities_.name, "choose the device again");
  if (opened_) return {};
  if (const Status sense = check_capabilities(can); !sense) return sense;
  capabilities_ = std::move(can);
  const char* driver = api_.get_string(hd::kDriver);
  identity_ =
      capabilities_.name + ", serial " + capabilities_.serial + ", driver " + (driver != nullptr ? driver : "?");
  hd::Corners usable{};
  api_.get_doublev(hd::kUsableWorkspace, usable.data());
  api_.get_doublev(hd::kMaxWorkspace, reach_.data());
  centre_m_ = hd::centre_m(usable);
  int styles = 0;
  api_.get_integerv(hd::kCalibrationStyles, &styles);
  style_ = best_style(styles);
  drain();
  return {};
}

Status HdForceDevice::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  if (const Status chosen = hd::check_choice(options_); !chosen) return chosen;
  if (!loaded_) {
    auto api = hd::load(options_.library);
    if (!api) return tl::unexpected(api.error());
    api_ = *api;
    loaded_ = true;
  }
  if (scheduler_taken.exchange(true))
    return fail("this program uses one already, and the library keeps the time for one", "OpenHaptics",
                "close the other device, or end the program");
  Status status = attach();
  if (status) status = learn();
  if (!status) {
    if (device_ != hd::kInvalidHandle) api_.disable_device(std::exchange(device_, hd::kInvalidHandle));
    scheduler_taken.store(false);
    return status;
  }
  if (options_.reset_encoders && style_ == hd::kEncoderReset) api_.update_calibration(style_);
  api_.enable(hd::kForceOutput);
  note(drain());
  opened_ = true;
  attached_.store(true);
  connects_.fetch_add(1, kRelaxedKeeper);
  return {};
}

void HdForceDevice::close() {
  if (!opened_) return;
  stop_calling();
  if (attached_.exchange(false)) {
    api_.disable(hd::kForceOutput);
    api_.disable_device(std::exchange(device_, hd::kInvalidHandle));
    drain();
  }
  machine_.enter(DeviceState::absent);
  clean_frames_ = 0;
  opened_ = false;
  scheduler_taken.store(false);
}

// --- The library's scheduler ---------------------------------------------------------------------------

hd::CallbackCode HdForceDevice::called(void* device) noexcept {
  auto& me = *static_cast<HdForceDevice*>(device);
  me.last_call_ns_.store(clock_ns(), kRelaxedKeeper);
  if (me.ticking_.test_and_set(std::memory_order_acquire)) return hd::kContinue;
  if (me.stopping_.load(std::memory_order_acquire)) {
    me.zero_frame();
  } else {
    me.in_frame_call_ = true;
    me.tick_.run(me.tick_.context);
    me.in_frame_call_ = false;
  }
  me.ticking_.clear(std::memory_order_release);
  return hd::kContinue;
}

Status HdForceDevice::start_scheduler() {
  drain();
  api_.set_scheduler_rate(kSchedulerRate_hz);
  drain();  // some devices know no other rate, and refuse to be told
  last_call_ns_.store(clock_ns(), kRelaxedKeeper);
  callback_ = api_.schedule_asynchronous(&HdForceDevice::called, this, hd::kPriority);
  if (const hd::ErrorCode code = drain(); code != hd::kSuccess)
    return tl::unexpected(hd::to_error(code, "hdScheduleAsynchronous"));
  api_.start_scheduler();
  const hd::ErrorCode code = drain();
  if (code == hd::kSuccess || hd::is_frame_error(code)) return {};
  api_.unschedule(callback_);
  return tl::unexpected(hd::to_error(code, "hdStartScheduler"));
}

void HdForceDevice::stop_scheduler() {
  api_.stop_scheduler();
  api_.unschedule(callback_);
}

Status HdForceDevice::start_calling(const DeviceTick& tick) {
  if (keeper_.joinable()) return {};
  tick_ = tick;
  stopping_.store(false);
  if (const Status started = start_scheduler(); !started) return started;
  keeper_ends_.store(false);
  try {
    keeper_ = std::thread([this]() noexcept { keep(); });
  } catch (const std::system_error&) {
    stop_scheduler();
    return fail("no thread could be started", capabilities_.name, "end other programs, or raise the limit on threads");
  }
  return {};
}

void HdForceDevice::stop_calling() {
  if (!keeper_.joinable()) return;
  keeper_ends_.store(true);
  keeper_.join();
  if (!attached_.load()) return;
  const std::uint64_t before = last_frames_.load(std::memory_order_acquire);
  stopping_.store(true, std::memory_order_release);
  const std::int64_t until_ns = clock_ns() + ns_of(options_.last_frame_s);
  while (last_frames_.load(std::memory_order_acquire) == before && clock_ns() < until_ns) sleep_ns(kStandIn_ns);
  stop_scheduler();  // no tick is called any more, also where a call of the library's comes late
}

// --- The keeper ----------------------------------------------------------------------------------------

void HdForceDevice::keep() noexcept {
  while (!keeper_ends_.load(kRelaxedKeeper)) {
    if (attached_.load()) {
      watch();
      sleep_ns(kLook_ns);
    } else {
      stand_in(clock_ns());
      sleep_ns(kStandIn_ns);
    }
  }
}

void HdForceDevice::watch() noexcept {
  const bool silent = clock_ns() - last_call_ns_.load(kRelaxedKeeper) > ns_of(options_.silence_s);
  if (lost_.exchange(false) || emergency_.exchange(false))
    detach(DeviceFault::disconnected);
  else if (silent)
    detach(DeviceFault::watchdog);
}

/// Not by the library's word alone. False: it hangs, and this is closed meanwhile.
bool HdForceDevice::wait_for_last_call() noexcept {
  while (ticking_.test_and_set(std::memory_order_acquire)) {
    if (keeper_ends_.load(kRelaxedKeeper)) return false;
    sleep_ns(kStandIn_ns);
  }
  ticking_.clear(std::memory_order_release);
  return true;
}

void HdForceDevice::detach(DeviceFault fault) {
  api_.disable(hd::kForceOutput);
  stop_scheduler();
  if (!wait_for_last_call()) return;
  api_.disable_device(std::exchange(device_, hd::kInvalidHandle));
  drain();
  machine_.fail(fault);  // the scheduler runs no more: nothing else uses it
  clean_frames_ = 0;
  fault_shown_ = false;
  next_try_ns_ = clock_ns() + ns_of(options_.reopen_s);
  attached_.store(false);
}

void HdForceDevice::stand_in(std::int64_t now_ns) noexcept {
  if (ticking_.test_and_set(std::memory_order_acquire)) return;
  tick_.run(tick_.context);
  ticking_.clear(std::memory_order_release);
  if (now_ns < next_try_ns_) return;
  next_try_ns_ = now_ns + ns_of(options_.reopen_s);
  Status back = attach();
  if (back) back = learn();
  if (back) {
    api_.enable(hd::kForceOutput);
    lost_.store(false);
    emergency_.store(false);
    machine_.enter(DeviceState::absent);
    back = start_scheduler();
  }
  if (back) {
    newest_error_.store(hd::kSuccess, kRelaxedKeeper);
    connects_.fetch_add(1, kRelaxedKeeper);
    attached_.store(true);
  } else if (device_ != hd::kInvalidHandle) {
    api_.disable_device(std::exchange(device_, hd::kInvalidHandle));
  }
}

bool HdForceDevice::emergency_stop() noexcept {
  emergency_.store(true);
  return true;
}

// --- What it says --------------------------------------------------------------------------------------

bool HdForceDevice::report(LinkReport& out) const {
  out.connected = attached_.load();
  out.identity = identity_;
  out.rate_hz = capabilities_.rate_hz;
  out.frames = frames_;
  out.errors = errors_;
  out.connects = connects_;
  const hd::ErrorCode code = newest_error_.load(kRelaxedKeeper);
  const hd::Enum needs = needs_.load(kRelaxedKeeper);
  if (code != hd::kSuccess)
    out.problem = hd::to_error(code, capabilities_.name).message();
  else if (needs != 0 && needs != hd::kCalibrationOk)
    out.problem = hd::calibration_needed(style_, capabilities_.name).message();
  return true;
}

}  // namespace tangent
