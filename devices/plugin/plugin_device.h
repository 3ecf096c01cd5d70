// The force device "plugin": a shared library of one's own behind tangent_device.h, in a process of its own or, by
// choice, in this one.
//
//   servo thread            a thread of its own            workbench-plugin, the process of its own
//   exchange -- command --> (shared memory, futex) ------> the plug-in's exchange
//            <-- answer --- waits 0.1 ms at most <-------
//                           starts, watches, ends it
//
// States: absent until a process has opened the device, then as the plug-in says; faulted, until a person clears it,
// when it answers garbage, allocates, hangs, fails, or its process ends (plugin_judge.h). Its process is started again
// by itself; nothing arms by itself.
#pragma once

#include "devices/force_device.h"
#include "devices/plugin/plugin_judge.h"
#include "devices/plugin/plugin_line.h"
#include "devices/plugin/plugin_options.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace tangent {

class PluginForceDevice final : public ForceDevice {
 public:
  /// Loads the plug-in to ask what its device can do, in a process that then ends; opens nothing. What failed is said
  /// by open.
  explicit PluginForceDevice(PluginOptions options);
  ~PluginForceDevice() override { close(); }

  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override;
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The plug-in's `stop`, from a thread of its process.
  bool emergency_stop() noexcept override;
  /// No USB: commands and answers are its packets.
  bool report(LinkReport& out) const override;

  /// Servo thread: the force that went out with the last command; less than was asked for after silence and faults.
  const Vec3& sent_n() const { return sent_n_; }
  /// Servo thread: PluginOptions::wait_s from now on.
  void wait_at_most(double wait_s) noexcept { wait_s_ = wait_s; }

 private:
  void count(const PluginTurn& turn) noexcept;

  PluginOptions options_;
  std::unique_ptr<PluginLine> line_;
  Result<tangent_device_capabilities> said_;
  ForceCapabilities capabilities_;
  bool opened_ = false;

  // Servo thread.
  PluginJudge judge_;
  std::uint64_t number_ = 0;
  double wait_s_ = 0.0;
  Vec3 sent_n_{0.0};
  bool behind_ = false;  ///< did not answer in time: it is not waited for until it does

  std::atomic<std::uint64_t> commands_{0}, answers_{0}, unanswered_{0}, late_{0}, withheld_{0};
  std::atomic<PluginGarbage> garbage_{PluginGarbage::none};
};

}  // namespace tangent
