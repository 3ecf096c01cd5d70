// A plug-in at work in its own process: commands in, answers out, and a second thread that stops the device when the
// plug-in hangs, when no command comes, and when the program dies.
//
//   main thread   waits for a command, calls the plug-in's exchange, answers
//   second        every 2 ms looks whether that goes on; calls the plug-in's stop
#pragma once

#include "devices/plugin/plugin_library.h"
#include "devices/plugin/plugin_region.h"

#include <atomic>
#include <cstdint>
#include <thread>

namespace tangent {

class PluginHost {
 public:
  PluginHost(PluginRegion& region, PluginLibrary& library) : region_(region), library_(library) {}
  ~PluginHost() { end_watch(); }
  PluginHost(const PluginHost&) = delete;
  PluginHost& operator=(const PluginHost&) = delete;

  /// Watches from now on. SIGTERM, which comes when the program dies too, has to be blocked in every thread.
  void watch();
  /// After the plug-in has opened its device; returns when the program wants the end, or is gone. Nobody calls stop any
  /// more then.
  void serve();
  /// How long closing the device may take when the program is gone; then this process just ends.
  static double longest_end_s(PluginRegion& region) noexcept;

 private:
  void answer(const PluginCommand& command);
  void stop_by(PluginVerdict verdict) noexcept;
  void look(std::int64_t now_ns) noexcept;
  void end_watch();
  void run_watch() noexcept;
  void end_with_program() noexcept;

  PluginRegion& region_;
  PluginLibrary& library_;
  std::thread watching_;
  std::atomic<bool> ending_{false}, watching_ends_{false};
  std::atomic<bool> serving_{false};
  std::atomic<std::int64_t> exchange_began_ns_{0};  ///< 0: none goes on
  std::atomic<std::int64_t> command_came_ns_{0};    ///< 0: none yet
  std::atomic<PluginVerdict> verdict_{PluginVerdict::none};
  std::uint32_t stops_seen_ = 0;  ///< second thread
  bool first_exchange_ = true;
};

}  // namespace tangent
