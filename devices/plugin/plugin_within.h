// A plug-in within this process, by choice: nothing stands between the two. A crash in it is ours, a hang holds the
// servo thread (which exchange_watch.h notices), and an allocation is not seen.
#pragma once

#include "devices/plugin/plugin_library.h"
#include "devices/plugin/plugin_line.h"
#include "devices/plugin/plugin_options.h"
#include "devices/plugin/shared_slot.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

namespace tangent {

class PluginWithin final : public PluginLine {
 public:
  explicit PluginWithin(const PluginOptions& options) : options_(options) {}

  Result<tangent_device_capabilities> describe() override;
  Status open(const tangent_device_capabilities& as_said) override;
  void close() override;
  PluginTurn exchange(const PluginCommand& command, double wait_s) noexcept override;
  bool emergency_stop() noexcept override;
  void report(LinkReport& out) const override;

 private:
  PluginOptions options_;
  std::mutex stop_lock_;  ///< held by an emergency stop, and to take the library away
  std::unique_ptr<PluginLibrary> library_;
  std::atomic<bool> open_{false};
  std::atomic<std::uint32_t> connection_{0};
  std::atomic<PluginVerdict> verdict_{PluginVerdict::none};
  SharedSlot<PluginText> said_;  ///< by exchange, of what failed
};

/// Fails where the plug-in says something else about its device than before.
Status same_as_said(const tangent_device_capabilities& now, const tangent_device_capabilities& before,
                    const std::string& where);

}  // namespace tangent
