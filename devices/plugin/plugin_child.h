// One process of a plug-in, from start to end. Ends with this object.
#pragma once

#include "core/base/result.h"
#include "devices/plugin/plugin_options.h"
#include "devices/plugin/plugin_region.h"

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace tangent {

/// Lets another thread wake one that waits for a process.
class PluginWake {
 public:
  PluginWake();
  ~PluginWake();
  PluginWake(const PluginWake&) = delete;
  PluginWake& operator=(const PluginWake&) = delete;
  void wake() noexcept;
  void clear() noexcept;
  /// Until it is woken, or the time is over; clears.
  void wait(int most_ms) noexcept;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

enum class ChildNews { none, said_something, died };

class PluginChild {
 public:
  PluginChild() = default;
  ~PluginChild() { kill(); }
  PluginChild(const PluginChild&) = delete;
  PluginChild& operator=(const PluginChild&) = delete;

  /// "run" or "describe". The thread that calls has to live as long as the process, which ends with it.
  Status start(const PluginOptions& options, PluginRegion& region, const std::string& what_for);
  bool started() const { return id_ > 0; }
  /// Waits for news, `wake` or the end of the time; negative: for as long as it takes.
  ChildNews wait(const PluginWake& wake, int most_ms) noexcept;
  /// At once. Afterwards it is dead, and `death` says how it died.
  void kill() noexcept;
  /// "ended by signal 6 (Aborted)"; after it died.
  std::string death() const;
  /// It ended by this signal.
  bool died_of(int signal) const;

 private:
  void reap() noexcept;
  pid_t id_ = 0;
  int life_ = -1;  ///< reading end of a pipe that only the process holds open
  int status_ = 0;
  bool reaped_ = false;
};

/// The program that plug-ins run in: as asked for, or beside this program, or in libexec of the same installation.
Result<std::filesystem::path> plugin_host(const PluginOptions& options);

}  // namespace tangent
