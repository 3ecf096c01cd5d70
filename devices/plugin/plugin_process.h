// A plug-in in a process of its own, workbench-plugin: started, watched, ended and started again by a thread of this
// class; the servo's thread only uses the shared memory.
#pragma once

#include "devices/plugin/plugin_child.h"
#include "devices/plugin/plugin_line.h"
#include "devices/plugin/plugin_options.h"
#include "devices/plugin/plugin_region.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tangent {

class PluginProcess final : public PluginLine {
 public:
  explicit PluginProcess(const PluginOptions& options) : options_(options) {}
  ~PluginProcess() override { end(); }

  Result<tangent_device_capabilities> describe() override;
  Status open(const tangent_device_capabilities& as_said) override;
  void close() override { end(); }
  PluginTurn exchange(const PluginCommand& command, double wait_s) noexcept override;
  bool emergency_stop() noexcept override;
  void report(LinkReport& out) const override;

 private:
  void end();
  // Its own thread.
  void run();
  Status start_one(PluginChild& child);
  void watch_one(PluginChild& child);
  bool hangs() noexcept;
  void say(const std::string& problem);
  void opened(Status status);

  PluginOptions options_;
  PluginRegion region_;
  bool mapped_ = false;
  tangent_device_capabilities as_said_{};
  std::thread thread_;
  PluginWake wake_;  ///< of that thread
  std::atomic<bool> ending_{false}, connected_{false};
  std::atomic<std::uint32_t> connection_{0};
  std::atomic<std::uint64_t> sent_{0};  ///< newest number
  std::atomic<PluginVerdict> verdict_{PluginVerdict::none};

  // Its own thread.
  std::uint64_t sent_before_ = 0, answered_ = 0;
  std::int64_t behind_since_ns_ = 0;
  std::uint32_t connections_before_ = 0;  ///< of the open that goes on

  mutable std::mutex mutex_;
  std::condition_variable first_done_;
  std::optional<Status> first_;  ///< of open
  std::string problem_;

  std::uint32_t answer_sequence_ = 0;  ///< servo thread
};

}  // namespace tangent
