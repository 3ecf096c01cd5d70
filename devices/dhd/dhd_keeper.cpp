// Opening, closing and looking for the device again: the parts of DhdForceDevice outside an exchange.
#include "devices/dhd/dhd_errors.h"
#include "devices/dhd/dhd_force_device.h"
#include "devices/dhd/dhd_models.h"
#include "devices/gate/limits.h"
#include "devices/link_report.h"

#include <algorithm>
#include <ctime>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

constexpr auto kRelaxedDhdKeeper = std::memory_order_relaxed;
constexpr long kDhdLook_ns = 2'000'000;
constexpr double kWatchdogStep_s = 125e-6;
constexpr int kButtonsOfTheirHandles = 1;
constexpr double kReachOfRadius = 2.0;  // the handle gets beyond the ball, but not twice as far
constexpr int kMostDevices = 16;

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

std::string dhd_name(const dhd::Api& api, char id) {
  const dhd::Model& model = dhd::model_of(api.get_system_type(id));
  const char* said = api.get_system_name(id);
  return model.type == 0 && said != nullptr ? said : model.name;
}

int dhd_serial(const dhd::Api& api, char id) {
  unsigned short serial[4] = {};  // with room for an SDK that writes a wider number
  return api.get_serial_number(serial, id) < 0 ? -1 : serial[0];
}

std::vector<FoundDhd> look_for_dhd(const dhd::Api& api) {
  std::vector<FoundDhd> found;
  const int count = std::clamp(api.get_device_count(), 0, kMostDevices);
  for (int i = 0; i < count; ++i) {
    FoundDhd& one = found.emplace_back();
    const int id = api.open_id(static_cast<char>(i));
    if (id < 0) {
      one.problem = dhd::to_error(api.error_get_last(), "device " + std::to_string(i));
      continue;
    }
    one.name = dhd_name(api, static_cast<char>(id));
    one.serial = dhd_serial(api, static_cast<char>(id));
    api.close(static_cast<char>(id));
  }
  return found;
}

std::string listed(const std::vector<FoundDhd>& found) {
  std::string text;
  for (const FoundDhd& one : found) {
    if (!text.empty()) text += ", ";
    if (!one.problem.what.empty())
      text += "one that can't be opened: " + one.problem.what;
    else
      text += one.name + (one.serial < 0 ? ", without a serial number" : ", serial " + std::to_string(one.serial));
  }
  return text;
}

}  // namespace

Result<std::vector<FoundDhd>> find_dhd_devices(const DhdOptions& options) {
  const auto api = dhd::load(options.library);
  if (!api) return tl::unexpected(api.error());
  return look_for_dhd(*api);
}

DhdForceDevice::DhdForceDevice(const DhdOptions& options) : options_(options) {
  capabilities_.name = "Force Dimension device";
  capabilities_.frame = dhd::device_frame();
  capabilities_.rate_hz = 1000.0;
  capabilities_.homing_s = 0.0;
}

// --- Opening and closing -------------------------------------------------------------------------------

/// Its ID. By its serial number, once that is known.
Result<int> DhdForceDevice::attach() {
  if (options_.serial >= 0) {
    const int id = api_.open_serial(options_.serial);
    if (id >= 0) return id;
    newest_error_.store(api_.error_get_last(), kRelaxedDhdKeeper);
    return tl::unexpected(
        dhd::to_error(api_.error_get_last(), "Force Dimension, serial " + std::to_string(options_.serial)));
  }
  const int count = api_.get_device_count();
  if (count > 1)
    return fail("several are attached: " + listed(look_for_dhd(api_)), "Force Dimension",
                "choose one: --dhd-serial NUMBER");
  const int id = api_.open_id(0);
  if (id >= 0) return id;
  newest_error_.store(api_.error_get_last(), kRelaxedDhdKeeper);
  return tl::unexpected(dhd::to_error(api_.error_get_last(), "Force Dimension"));
}

Status DhdForceDevice::learn(int wide_id) {
  const char id = static_cast<char>(wide_id);
  const dhd::Model& model = dhd::model_of(api_.get_system_type(id));
  ForceCapabilities can = capabilities_;
  can.name = dhd_name(api_, id);
  const int serial = dhd_serial(api_, id);
  can.serial = serial < 0 ? std::string() : std::to_string(serial);
  can.peak_force_n = options_.peak_n > 0.0 ? options_.peak_n : model.peak_n;
  can.largest_stiffness_n_per_m = model.stiffness_n_per_m;
  can.workspace_half_size_m = Vec3(model.workspace_radius_m);
  can.buttons = kButtonsOfTheirHandles;
  can.senses_rotation.fill(api_.has_wrist(id));
  unsigned char watchdog = 0;
  if (api_.get_watchdog != nullptr && api_.get_watchdog(&watchdog, id) >= 0)
    can.firmware_timeout_s = kWatchdogStep_s * watchdog;
  if (const Status sense = check_capabilities(can); !sense) return sense;
  capabilities_ = std::move(can);
  identity_ = capabilities_.name + ", serial " + (serial < 0 ? "not known" : capabilities_.serial);
  reach_m_ = kReachOfRadius * model.workspace_radius_m;
  if (serial >= 0) options_.serial = serial;  // when it comes back, this one
  return {};
}

Status DhdForceDevice::open() {
  if (phase_.load() != Phase::closed) return fail("is already open", capabilities_.name, "close it first");
  if (!loaded_) {
    auto api = dhd::load(options_.library);
    if (!api) return tl::unexpected(api.error());
    api_ = *api;
    loaded_ = true;
  }
  const auto id = attach();
  if (!id) return tl::unexpected(id.error());
  if (const Status learnt = learn(*id); !learnt) {
    api_.close(static_cast<char>(*id));
    return learnt;
  }
  id_.store(static_cast<char>(*id));
  keeper_ends_.store(false);
  try {
    keeper_ = std::thread([this]() noexcept { keep(); });
  } catch (const std::system_error&) {
    api_.close(static_cast<char>(*id));
    return fail("no thread could be started", capabilities_.name, "end other programs, or raise the limit on threads");
  }
  forget_errors();
  connects_.fetch_add(1, kRelaxedDhdKeeper);
  phase_.store(Phase::attached, std::memory_order_release);
  return {};
}

void DhdForceDevice::close() {
  if (phase_.load() == Phase::closed) return;
  keeper_ends_.store(true);
  keeper_.join();
  if (phase_.load() != Phase::away) let_go();
  phase_.store(Phase::closed);
  machine_.enter(DeviceState::absent);
}

void DhdForceDevice::let_go() noexcept {
  const char id = id_.load();
  api_.set_force(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, id);
  api_.stop(id);
  api_.close(id);
}

// --- The keeper ----------------------------------------------------------------------------------------

void DhdForceDevice::keep() noexcept {
  const timespec pause{.tv_sec = 0, .tv_nsec = kDhdLook_ns};
  while (!keeper_ends_.load(kRelaxedDhdKeeper)) {
    const Phase phase = phase_.load(std::memory_order_acquire);
    if (emergency_.load() && phase == Phase::attached) {
      api_.stop(id_.load());
      emergency_.store(false);
    }
    if (phase == Phase::lost) {
      let_go();
      next_try_ns_ = monotonic_ns() + static_cast<std::int64_t>(options_.reopen_s * 1e9);
      phase_.store(Phase::away, std::memory_order_release);
    } else if (phase == Phase::away && monotonic_ns() >= next_try_ns_) {
      look_again();
    }
    nanosleep(&pause, nullptr);
  }
}

void DhdForceDevice::look_again() noexcept {
  next_try_ns_ = monotonic_ns() + static_cast<std::int64_t>(options_.reopen_s * 1e9);
  const auto id = attach();
  if (!id) return;
  const char found = static_cast<char>(*id);
  const int serial = dhd_serial(api_, found);
  if (serial >= 0 && std::to_string(serial) != capabilities_.serial) {  // another one in its place
    api_.close(found);
    return;
  }
  id_.store(found);
  forget_errors();
  connects_.fetch_add(1, kRelaxedDhdKeeper);
  emergency_.store(false);
  phase_.store(Phase::attached, std::memory_order_release);
}

bool DhdForceDevice::emergency_stop() noexcept {
  emergency_.store(true);
  return true;
}

// --- What it says --------------------------------------------------------------------------------------

bool DhdForceDevice::report(LinkReport& out) const {
  out.connected = phase_.load() == Phase::attached;
  out.identity = identity_;
  out.rate_hz = capabilities_.rate_hz;
  out.firmware_timeout_s = capabilities_.firmware_timeout_s;
  out.frames = frames_;
  out.errors = errors_;
  out.connects = connects_;
  const int code = newest_error_.load(), cause = force_off_cause_.load();
  if (code != 0)
    out.problem = dhd::to_error(code, capabilities_.name).message();
  else if (cause >= 0)
    out.problem = dhd::force_off_error(cause, capabilities_.name).message();
  else if (!calibrated_.load())
    out.problem = dhd::to_error(12, capabilities_.name).message();  // DHD_ERROR_DEVICE_NOT_READY
  else if (out.connected && capabilities_.peak_force_n <= 0.0)
    out.problem = dhd::peak_not_known(capabilities_.name).message();
  return true;
}

}  // namespace tangent
