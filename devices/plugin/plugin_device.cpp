#include "devices/plugin/plugin_device.h"

#include "core/base/float_state.h"
#include "devices/gate/limits.h"
#include "devices/plugin/plugin_process.h"
#include "devices/plugin/plugin_within.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace tangent {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;

void add_one(std::atomic<std::uint64_t>& counter) noexcept { counter.store(counter.load(kRelaxed) + 1, kRelaxed); }

std::unique_ptr<PluginLine> make_line(const PluginOptions& options) {
  if (options.in_process) return std::make_unique<PluginWithin>(options);
  return std::make_unique<PluginProcess>(options);
}

std::array<bool, 3> three_bits(std::uint32_t bits) { return {(bits & 1u) != 0, (bits & 2u) != 0, (bits & 4u) != 0}; }

ForceCapabilities to_capabilities(const Result<tangent_device_capabilities>& said, const PluginOptions& options) {
  ForceCapabilities can;
  can.name = "plug-in " + options.path.filename().string();
  can.homing_s = 0.0;
  if (!said) return can;
  if (said->name[0] != '\0') can.name = said->name;
  can.serial = said->serial;
  can.pushes_along = three_bits(said->pushes_along);
  can.senses_rotation = three_bits(said->senses_rotation);
  can.buttons = static_cast<int>(said->buttons);
  can.peak_force_n = said->peak_force_n;
  can.continuous_force_n = said->continuous_force_n;
  can.position_resolution_m = said->position_resolution_m;
  can.apparent_mass_kg = said->apparent_mass_kg;
  can.largest_stiffness_n_per_m = said->largest_stiffness_n_per_m;
  can.largest_damping_n_s_per_m = said->largest_damping_n_s_per_m;
  const auto vector = [](const double(&v)[3]) { return Vec3(v[0], v[1], v[2]); };
  can.workspace_half_size_m = vector(said->workspace_half_size_m);
  const double* q = said->frame_rotation;
  can.frame = {.rotation = Quat(q[0], q[1], q[2], q[3]), .origin_m = vector(said->frame_origin_m)};
  can.rate_hz = said->rate_hz;
  can.homing_s = said->homing_s;
  can.firmware_timeout_s = said->firmware_timeout_s;
  return can;
}

Result<tangent_device_capabilities> describe(PluginLine& line, const PluginOptions& options) {
  if (options.path.empty())
    return fail("no plug-in is named", "--force plugin", "name its shared library: --plugin PATH.so");
  return line.describe();
}

}  // namespace

PluginForceDevice::PluginForceDevice(PluginOptions options)
    : options_(std::move(options)),
      line_(make_line(options_)),
      said_(describe(*line_, options_)),
      capabilities_(to_capabilities(said_, options_)),
      judge_(capabilities_),
      wait_s_(options_.wait_s) {}

Status PluginForceDevice::open() {
  if (opened_) return fail("is already open", capabilities_.name, "close it first");
  if (!said_) return tl::unexpected(said_.error());
  if (const Status makes_sense = check_capabilities(capabilities_); !makes_sense) return makes_sense;
  if (const Status ok = line_->open(*said_); !ok) return ok;
  opened_ = true;
  judge_ = PluginJudge(capabilities_);
  behind_ = false;
  return {};
}

void PluginForceDevice::close() {
  if (!opened_) return;
  line_->close();
  opened_ = false;
}

void PluginForceDevice::count(const PluginTurn& turn) noexcept {
  add_one(commands_);
  if (turn.answered) add_one(answers_);
  if (turn.answered && turn.answer.number < number_) add_one(late_);
  if (turn.connected && !turn.answered) add_one(unanswered_);
  if (turn.connected && judge_.withholds()) add_one(withheld_);
}

ForceSample PluginForceDevice::exchange(const ForceCommand& command, double dt_s) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  PluginCommand out{.number = ++number_, .connection = judge_.connection()};
  const bool finite = std::isfinite(command.force_n.x + command.force_n.y + command.force_n.z);
  sent_n_ = judge_.begin(finite ? command.force_n : Vec3(0.0), number_, dt_s);
  out.command = {.size = sizeof out.command,
                 .request = static_cast<std::uint32_t>(command.request),
                 .tick = command.tick,
                 .dt_s = dt_s,
                 .force_n = {sent_n_.x, sent_n_.y, sent_n_.z}};
  const PluginTurn turn = line_->exchange(out, behind_ ? 0.0 : wait_s_);
  behind_ = turn.connected && !turn.answered;
  const ForceSample sample = judge_.end(turn, command);
  count(turn);
  garbage_.store(judge_.garbage(), kRelaxed);
  return sample;
}

bool PluginForceDevice::emergency_stop() noexcept { return line_->emergency_stop(); }

bool PluginForceDevice::report(LinkReport& out) const {
  line_->report(out);
  out.packets_out = commands_.load(kRelaxed);
  out.packets_in = answers_.load(kRelaxed);
  out.lost = unanswered_.load(kRelaxed);
  out.late = late_.load(kRelaxed);
  out.refused_sends = withheld_.load(kRelaxed);
  out.rate_hz = capabilities_.rate_hz;
  out.resolution_m = capabilities_.position_resolution_m;
  out.firmware_timeout_s = capabilities_.firmware_timeout_s;
  const PluginGarbage garbage = garbage_.load(kRelaxed);
  if (garbage != PluginGarbage::none && out.problem.empty())
    out.problem = std::string(to_string(garbage)) + "; the plug-in has to be mended, or its device looked at; then arm";
  return true;
}

}  // namespace tangent
