// Between the driver in the servo thread and a plug-in, wherever that runs: a command out, an answer in, without
// waiting longer than said. Two of them: a process of its own (plugin_process.h) and this one (plugin_within.h).
#pragma once

#include "core/base/result.h"
#include "devices/link_report.h"
#include "devices/plugin/tangent_device.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace tangent {

/// Why a plug-in's exchange is over, until a person clears it.
enum class PluginVerdict : std::uint32_t {
  none,
  failed,     ///< exchange said that the device is lost
  allocated,  ///< exchange allocated memory
  hung,       ///< exchange took too long
  silent,     ///< no command came, and the device was stopped
  stopped,    ///< the device was told to stop past the servo
};

struct PluginCommand {
  std::uint64_t number = 0;      ///< from 1
  std::uint32_t connection = 0;  ///< that its force was worked out for: another plug-in gets no force by it
  std::uint32_t reserved = 0;
  tangent_device_command command{};

  bool pushes() const noexcept {
    return command.force_n[0] != 0.0 || command.force_n[1] != 0.0 || command.force_n[2] != 0.0;
  }
  void take_force_away() noexcept {
    for (double& force : command.force_n) force = 0.0;
  }
};

struct PluginAnswer {
  std::uint64_t number = 0;  ///< of the command that it answers
  PluginVerdict verdict = PluginVerdict::none;
  std::uint32_t reserved = 0;
  tangent_device_sample sample{};
};

/// A sentence from the plug-in's side; ends with 0, cut where it is too long.
struct PluginText {
  std::array<char, 512> text{};
  explicit PluginText(std::string_view from = {}) noexcept {
    const std::size_t size = from.size() < text.size() ? from.size() : text.size() - 1;
    for (std::size_t i = 0; i < size; ++i) text[i] = from[i];
  }
  std::string_view view() const noexcept {
    const std::string_view all(text.data(), text.size());
    return all.substr(0, all.find('\0'));
  }
};

/// What an exchange gave.
struct PluginTurn {
  bool connected = false;        ///< a plug-in is there that opened its device
  std::uint32_t connection = 0;  ///< another one for each plug-in that was
  bool answered = false;
  PluginAnswer answer{};
};

class PluginLine {
 public:
  virtual ~PluginLine() = default;
  /// What the device can do, without opening it. Before open.
  virtual Result<tangent_device_capabilities> describe() = 0;
  /// Fails where the plug-in does, or where it says something else about its device than `as_said`.
  virtual Status open(const tangent_device_capabilities& as_said) = 0;
  virtual void close() = 0;
  /// Servo thread, after open. Waits for the answer to this command until `wait_s` are over.
  virtual PluginTurn exchange(const PluginCommand& command, double wait_s) noexcept = 0;
  /// Any thread.
  virtual bool emergency_stop() noexcept = 0;
  /// Any thread: connected, identity, problem, connects.
  virtual void report(LinkReport& out) const = 0;
};

/// "exchange took too long": for people.
const char* to_string(PluginVerdict verdict);
const char* remedy(PluginVerdict verdict);

}  // namespace tangent
