#include "devices/plugin/plugin_within.h"

#include <cstring>

namespace tangent {

Status same_as_said(const tangent_device_capabilities& now, const tangent_device_capabilities& before,
                    const std::string& where) {
  if (std::memcmp(&now, &before, sizeof now) == 0) return {};
  return fail("says something else about its device than when it was chosen", where, "choose the device again");
}

Result<tangent_device_capabilities> PluginWithin::describe() {
  auto loaded = PluginLibrary::load(options_.path, options_.settings);
  if (!loaded) return tl::unexpected(loaded.error());
  return (*loaded)->capabilities();
}

Status PluginWithin::open(const tangent_device_capabilities& as_said) {
  auto loaded = PluginLibrary::load(options_.path, options_.settings);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto can = (*loaded)->capabilities();
  if (!can) return tl::unexpected(can.error());
  if (const Status same = same_as_said(*can, as_said, options_.path.string()); !same) return same;
  if (const Status ok = (*loaded)->open(); !ok) return ok;
  library_ = std::move(*loaded);
  verdict_.store(PluginVerdict::none);
  connection_.fetch_add(1);
  open_.store(true);
  return {};
}

void PluginWithin::close() {
  const std::lock_guard lock(stop_lock_);  // after a stop that goes on
  open_.store(false);
  library_.reset();
}

PluginTurn PluginWithin::exchange(const PluginCommand& command, double) noexcept {
  PluginTurn turn{.connected = open_.load(), .connection = connection_.load()};
  if (!turn.connected) return turn;
  PluginCommand passed = command;
  if (command.command.request == TANGENT_DEVICE_CLEAR_FAULT) verdict_.store(PluginVerdict::none);
  if (verdict_.load() != PluginVerdict::none) passed.take_force_away();
  turn.answered = true;
  turn.answer.number = command.number;
  if (!library_->exchange(passed.command, turn.answer.sample)) {
    said_.put(PluginText(library_->error_text()));
    verdict_.store(PluginVerdict::failed);
    library_->stop();
  }
  turn.answer.verdict = verdict_.load();
  // An emergency stop may have come while this force was on its way to the device.
  if (turn.answer.verdict != PluginVerdict::none && passed.pushes()) library_->stop();
  return turn;
}

// Past the servo's thread, which may be held in exchange: by the plug-in's own stop, from this thread.
bool PluginWithin::emergency_stop() noexcept {
  const std::lock_guard lock(stop_lock_);
  if (!open_.load()) return false;
  PluginVerdict none = PluginVerdict::none;
  verdict_.compare_exchange_strong(none, PluginVerdict::stopped);
  library_->stop();
  return true;
}

void PluginWithin::report(LinkReport& out) const {
  out.connected = open_.load();
  out.connects = connection_.load();
  out.identity = options_.path.filename().string() + ", within this program";
  const PluginVerdict verdict = verdict_.load();
  if (verdict == PluginVerdict::none) return;
  PluginText said;
  std::uint32_t none = 0;
  out.problem = options_.path.string() + ": " + to_string(verdict);
  if (verdict == PluginVerdict::failed && said_.take(said, none)) out.problem += ": " + std::string(said.view());
  out.problem += std::string("; ") + remedy(verdict);
}

}  // namespace tangent
