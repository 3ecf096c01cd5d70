#include "devices/falcon/falcon_driver.h"

#include "devices/falcon/falcon_calibration.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace tangent {

namespace {

constexpr std::uint32_t kMostGarbage = 2;     // in a row
constexpr std::uint32_t kMostUnanswered = 2;  // likewise

// x to the right, y up, z towards the person; in the world x is away from the person and z up.
constexpr Quat kToWorld{0.5, 0.5, -0.5, -0.5};

bool may_be_calibrated(const FalconOptions& o) {
  return o.torque_counts_per_nm > 0.0 || std::any_of(o.kept.begin(), o.kept.end(), [](const auto& kept) {
           return kept.second.torque_counts_per_nm > 0.0;
         });
}

}  // namespace

ForceCapabilities falcon_capabilities(const FalconOptions& options) {
  ForceCapabilities can;
  can.name = may_be_calibrated(options) ? "Novint Falcon" : "Novint Falcon, torque not calibrated";
  can.serial = options.serial;
  can.buttons = 4;
  can.peak_force_n = may_be_calibrated(options) ? kFalconPeak_n : kFalconUncalibratedPeak_n;
  can.position_resolution_m = 63.5e-6;  // advertised: more than 400 steps to the inch
  can.workspace_half_size_m = kFalconHalfSize_m;
  can.frame.rotation = kToWorld;
  can.rate_hz = 1000.0;
  can.homing_s = 0.0;
  return can;
}

std::array<std::int16_t, 3> falcon_counts(const Vec3& position_m, const Vec3& force_n, double counts_per_nm, int most,
                                          double& share) noexcept {
  share = 0.0;
  if (!is_finite(force_n)) return {};
  const auto torques = falcon_torques(position_m + kFalconCentre_m, force_n);
  if (!torques) return {};
  // A positive count turns an arm towards smaller angles.
  const Vec3 counts = -counts_per_nm * *torques;
  const double largest = std::max({std::abs(counts.x), std::abs(counts.y), std::abs(counts.z)});
  if (!std::isfinite(largest)) return {};
  share = largest > most ? most / largest : 1.0;
  std::array<std::int16_t, 3> out{};
  for (int i = 0; i < 3; ++i) {
    const double count = std::clamp(std::trunc(share * counts[i]), -1.0 * most, 1.0 * most);
    out[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(count);
  }
  return out;
}

FalconDriver::FalconDriver(const FalconOptions& options, std::vector<std::uint8_t> firmware, Firmwares kept)
    : options_(options),
      kept_(firmware.empty() ? std::move(kept) : Firmwares()),
      capabilities_(falcon_capabilities(options)),
      line_(options.line, std::move(firmware)),
      scale_(options.torque_counts_per_nm) {}

// The servo reads the scale after it has seen the connection, and what it posts to an older one is not sent.
void FalconDriver::opened(const std::string& serial, std::int64_t now_ns) noexcept {
  if (options_.torque_counts_per_nm == 0.0) {
    const auto kept = options_.kept.find(serial);
    scale_.store(kept != options_.kept.end() ? kept->second.torque_counts_per_nm : 0.0, std::memory_order_relaxed);
  }
  const auto firmware = kept_.find(serial);
  line_.opened(now_ns, firmware != kept_.end() ? &firmware->second : nullptr);
}

// In this order: a fault that is cleared in between leaves it faulted, never held without a fault that says so.
void FalconDriver::stop() noexcept {
  line_.hold();
  was_stopped_.store(true, std::memory_order_relaxed);
}

void FalconDriver::follow_connection() noexcept {
  const std::uint32_t connection = line_.connection();
  if (connection == seen_connection_) return;
  machine_.enter(DeviceState::absent);
  if (connection % 2 == 1) machine_.enter(DeviceState::open);
  heard_ = homing_wanted_ = position_known_ = false;
  place_m_ = kFalconCentre_m;
  legs_homed_.store(0, std::memory_order_relaxed);
  counts_per_nm_ = scale_.load(std::memory_order_relaxed);
  seen_connection_ = connection;
}

/// The newest answer as a place, which the last one is near to; a place after a jump is looked for from the middle.
void FalconDriver::measure() noexcept {
  FalconHeard heard;
  if (!line_.take(heard) || heard.connection != seen_connection_) return;
  // Encoders that stand still are the same place to the last bit: the gate takes one for stuck by that.
  const bool same = heard_ && position_known_ && heard.answer.encoder == newest_.answer.encoder;
  newest_ = heard;
  heard_ = true;
  legs_homed_.store(std::popcount(unsigned{heard.answer.homed}), std::memory_order_relaxed);
  if (same) return;
  const Vec3 angles = falcon_angles(heard.answer.encoder);
  auto place = falcon_forward(angles, place_m_);
  if (!place || !falcon_plausible(*place)) place = falcon_forward(angles);
  position_known_ = place && falcon_plausible(*place);
  if (position_known_) place_m_ = *place;
}

void FalconDriver::watch(const ForceCommand& command, std::int64_t now_ns) noexcept {
  if (machine_.state() == DeviceState::absent) return;
  const FalconPhase phase = line_.phase();
  if (phase == FalconPhase::no_firmware || phase == FalconPhase::not_loaded) machine_.fail(DeviceFault::firmware);
  if (was_stopped_.load(std::memory_order_relaxed)) machine_.fail(DeviceFault::watchdog);
  if (phase != FalconPhase::running || !heard_) return;
  if (machine_.state() == DeviceState::firmware) {  // it moves nothing by itself: nobody has to ask for it
    machine_.enter(DeviceState::homing);
    homing_wanted_ = true;
  }
  if (machine_.state() == DeviceState::open) machine_.enter(DeviceState::firmware);
  const bool backwards = std::exchange(last_ns_, now_ns) > now_ns;
  const double silent_s = static_cast<double>(now_ns - newest_.at_ns) * 1e-9;
  if (line_.garbage() >= kMostGarbage) machine_.fail(DeviceFault::sensor);
  if (line_.unanswered() >= kMostUnanswered || !(silent_s <= options_.silence_s))
    machine_.fail(DeviceFault::disconnected);
  if (!machine_.ready()) return;
  if (backwards || silent_s < -1e-9 || !position_known_ || !newest_.answer.all_homed()) {
    machine_.fail(DeviceFault::sensor);
    homing_wanted_ = false;  // it has to find its zero again
  }
  if (!is_finite(command.force_n)) machine_.fail(DeviceFault::bad_command);
}

void FalconDriver::carry_out(DeviceRequest request) noexcept {
  if (machine_.apply(request)) {
    if (request == DeviceRequest::home) homing_wanted_ = true;
    if (request == DeviceRequest::clear_fault) {
      was_stopped_.store(false, std::memory_order_relaxed);
      line_.release();
      line_.try_again();
    }
    return;
  }
  if (machine_.state() == DeviceState::homing && newest_.answer.all_homed() && position_known_)
    machine_.enter(DeviceState::ready);
}

FalconCommand FalconDriver::command_for(const Vec3& force_n, double& share) const noexcept {
  FalconCommand out;
  share = 0.0;
  out.homing = homing_wanted_;
  out.lamps = machine_.ready() ? kFalconGreen : machine_.state() == DeviceState::homing ? kFalconBlue : kFalconRed;
  if (!machine_.ready()) return out;
  const Vec3 place_m = place_m_ - kFalconCentre_m;
  if (counts_per_nm_ > 0.0) {
    out.torque = falcon_counts(place_m, force_n, counts_per_nm_, kFalconMostCounts, share);
    return out;
  }
  // The gate may let more through: it knows what was said of the one that may come.
  const double asked_n = glm::length(force_n);
  const double limited = asked_n > kFalconUncalibratedPeak_n ? kFalconUncalibratedPeak_n / asked_n : 1.0;
  out.torque = falcon_counts(place_m, limited * force_n, kFalconUncalibratedScale, kFalconUncalibratedCounts, share);
  share *= limited;
  return out;
}

void FalconDriver::listen() noexcept {
  follow_connection();
  measure();
}

ForceSample FalconDriver::exchange(const ForceCommand& command, std::int64_t (*now_ns)() noexcept) noexcept {
  listen();
  return respond(command, now_ns());
}

ForceSample FalconDriver::exchange(const ForceCommand& command, std::int64_t now_ns) noexcept {
  listen();
  return respond(command, now_ns);
}

ForceSample FalconDriver::respond(const ForceCommand& command, std::int64_t now_ns) noexcept {
  watch(command, now_ns);
  carry_out(command.request);
  double share = 0.0;
  line_.post(command_for(command.force_n, share), seen_connection_);
  ForceSample sample;
  sample.state = machine_.state();
  sample.fault = machine_.fault();
  if (!heard_) return sample;
  sample.position_m = place_m_ - kFalconCentre_m;
  sample.age_s = static_cast<double>(now_ns - newest_.at_ns) * 1e-9;
  sample.buttons = newest_.answer.buttons;
  if (machine_.ready() && !line_.withholds()) sample.force_n = share * command.force_n;
  return sample;
}

}  // namespace tangent
