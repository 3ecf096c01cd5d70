// The memory that the program shares with the process of a plug-in: one part that the program writes, which the other
// can only read, and one for the way back. Waiting and waking by futexes; nothing in it is a pointer or an index.
#pragma once

#include "devices/plugin/plugin_line.h"
#include "devices/plugin/shared_slot.h"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tangent {

inline constexpr std::size_t kRegionPage = 4096;
inline constexpr std::uint32_t kRegionMark = 0x74616e33;  ///< of this layout; program and host are built together
inline constexpr int kRegionDescriptor = 3, kLifeDescriptor = 4;  ///< of the plug-in's process

/// How far the plug-in's process is.
enum class HostPhase : std::uint32_t { starting, described, opened, failed, ended };
/// In which of the plug-in's functions it is.
enum class HostPlace : std::uint32_t { own, loading, capabilities, open, exchange, stop, close };
const char* to_string(HostPlace place);

struct alignas(kRegionPage) ToHost {
  std::uint32_t mark = 0;
  std::uint32_t realtime = 0;
  std::int64_t program = 0;  ///< its process id
  double watchdog_s = 0.0, hang_s = 0.0, end_s = 0.0;
  std::uint64_t memory_bytes = 0;            ///< process_limits.h
  std::atomic<std::uint32_t> bell{0};        ///< rung for each command, and for the end
  std::atomic<std::uint32_t> end{0};         ///< not 0: close the device and end
  std::atomic<std::uint32_t> connection{0};  ///< PluginCommand::connection of this process
  std::atomic<std::uint32_t> stops{0};       ///< emergency stops asked for
  SharedSlot<PluginCommand> command;
};

struct alignas(kRegionPage) ToProgram {
  std::atomic<std::uint32_t> bell{0};  ///< rung for each answer; by the program, too, when the process has died
  std::atomic<HostPhase> phase{HostPhase::starting};
  std::atomic<HostPlace> place{HostPlace::own};
  std::atomic<std::uint32_t> refused{0};  ///< allocations that got no memory
  SharedSlot<tangent_device_capabilities> capabilities;
  SharedSlot<PluginAnswer> answer;
  SharedSlot<PluginText> what, remedy;  ///< of HostPhase::failed, and of a verdict
};

/// Both parts, mapped. Move-only in effect: made once.
class PluginRegion {
 public:
  PluginRegion() = default;
  ~PluginRegion();
  PluginRegion(const PluginRegion&) = delete;
  PluginRegion& operator=(const PluginRegion&) = delete;

  /// The program: new memory. False: there is none.
  bool create() noexcept;
  /// The plug-in's process. False: it is not that of a program of this version.
  bool attach(int descriptor) noexcept;

  int descriptor() const { return descriptor_; }
  ToHost& to_host() { return *to_host_; }
  ToProgram& to_program() { return *to_program_; }
  const ToProgram& to_program() const { return *to_program_; }

 private:
  bool map(int descriptor, int to_host_access) noexcept;
  int descriptor_ = -1;
  ToHost* to_host_ = nullptr;
  ToProgram* to_program_ = nullptr;
};

/// Sleeps while `word` is `seen`, until it is rung or `until_ns` (CLOCK_MONOTONIC).
void wait_for_bell(const std::atomic<std::uint32_t>& word, std::uint32_t seen, std::int64_t until_ns) noexcept;
void ring_bell(std::atomic<std::uint32_t>& word) noexcept;
std::int64_t plugin_now_ns() noexcept;

}  // namespace tangent
