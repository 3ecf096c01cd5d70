#include "devices/plugin/host/plugin_host.h"

#include "devices/plugin/host/allocation_watch.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <ctime>

namespace tangent {

namespace {

constexpr long kLook_ns = 2'000'000;
constexpr std::int64_t kMostWait_ns = 100'000'000;  ///< the main thread looks whether it is to end

double seconds_since(std::int64_t then_ns, std::int64_t now_ns) { return 1e-9 * static_cast<double>(now_ns - then_ns); }

}  // namespace

void PluginHost::end_watch() {
  watching_ends_.store(true);
  if (watching_.joinable()) watching_.join();
}

void PluginHost::watch() {
  stops_seen_ = region_.to_host().stops.load();
  watching_ = std::thread([this]() noexcept { run_watch(); });
}

// --- Second thread -------------------------------------------------------------------------------------

/// Once; until a person has cleared it.
void PluginHost::stop_by(PluginVerdict verdict) noexcept {
  PluginVerdict none = PluginVerdict::none;
  if (verdict_.compare_exchange_strong(none, verdict)) library_.stop();
}

void PluginHost::look(std::int64_t now_ns) noexcept {
  const ToHost& from = region_.to_host();
  const std::int64_t began_ns = exchange_began_ns_.load(), came_ns = command_came_ns_.load();
  const std::uint32_t stops = from.stops.load();
  if (stops != stops_seen_) {
    stops_seen_ = stops;
    verdict_.store(PluginVerdict::stopped);
    library_.stop();
  }
  if (began_ns != 0 && seconds_since(began_ns, now_ns) > from.hang_s) stop_by(PluginVerdict::hung);
  if (came_ns != 0 && seconds_since(came_ns, now_ns) > from.watchdog_s) stop_by(PluginVerdict::silent);
}

double PluginHost::longest_end_s(PluginRegion& region) noexcept {
  constexpr double kShortest_s = 2.0, kLongest_s = 3600.0;
  return std::clamp(region.to_host().end_s, kShortest_s, kLongest_s);
}

/// The program is gone, or says so: the device is stopped at once, closed if the main thread comes to it.
void PluginHost::end_with_program() noexcept {
  ending_.store(true);
  if (serving_.load()) library_.stop();
  const timespec a_while{0, 10'000'000};
  const std::int64_t began_ns = plugin_now_ns();
  while (!watching_ends_.load() && seconds_since(began_ns, plugin_now_ns()) < longest_end_s(region_))
    nanosleep(&a_while, nullptr);
  if (!watching_ends_.load()) ::_exit(1);
}

void PluginHost::run_watch() noexcept {
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, SIGTERM);
  const timespec between{0, kLook_ns};
  while (!watching_ends_.load()) {
    if (sigtimedwait(&end, nullptr, &between) == SIGTERM || ::getppid() != region_.to_host().program)
      return end_with_program();
    if (serving_.load()) look(plugin_now_ns());
  }
}

// --- Main thread ---------------------------------------------------------------------------------------

// What the first exchange allocates it may keep: tables of the dynamic linker, buffers of the C library.
void PluginHost::answer(const PluginCommand& command) {
  PluginCommand passed = command;
  if (command.command.request == TANGENT_DEVICE_CLEAR_FAULT) verdict_.store(PluginVerdict::none);
  const bool for_another = command.connection != region_.to_host().connection.load();
  if (for_another || verdict_.load() != PluginVerdict::none) passed.take_force_away();
  PluginAnswer out;
  ToProgram& to = region_.to_program();
  to.place.store(HostPlace::exchange);
  exchange_began_ns_.store(plugin_now_ns());
  count_allocations();
  const bool went = library_.exchange(passed.command, out.sample);
  const std::uint64_t allocations = counted_allocations();
  exchange_began_ns_.store(0);
  to.place.store(HostPlace::own);
  if (!went) {
    to.what.put(PluginText(library_.error_text()));
    stop_by(PluginVerdict::failed);
  }
  if (allocations > 0 && !first_exchange_) stop_by(PluginVerdict::allocated);
  first_exchange_ = false;
  out.number = command.number;
  out.verdict = verdict_.load();
  // The second thread may have stopped the device while this force was on its way to it.
  if (out.verdict != PluginVerdict::none && passed.pushes()) library_.stop();
  to.answer.put(out);
  ring_bell(to.bell);
}

void PluginHost::serve() {
  const ToHost& from = region_.to_host();
  PluginCommand command;
  std::uint32_t sequence = 0;
  from.command.take(command, sequence);  // for the process before this one
  serving_.store(true);
  region_.to_program().phase.store(HostPhase::opened, std::memory_order_release);
  static_cast<void>(::write(kLifeDescriptor, "o", 1) == 1);
  while (from.end.load() == 0 && !ending_.load()) {
    const std::uint32_t seen = from.bell.load(std::memory_order_acquire);
    if (from.command.take(command, sequence)) {
      command_came_ns_.store(plugin_now_ns());
      answer(command);
    } else if (from.end.load() == 0) {
      wait_for_bell(from.bell, seen, plugin_now_ns() + kMostWait_ns);
    }
  }
  serving_.store(false);
  end_watch();
}

}  // namespace tangent
