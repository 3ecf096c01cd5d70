// The line's thread of the serial force device: the only one that uses the port while it runs.
#include "devices/base/realtime_thread.h"
#include "devices/serial/serial_force_device.h"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace tangent {

namespace {

constexpr std::int64_t kBlocked_ns = 50'000'000;  // a line that takes nothing for so long
constexpr int kTurn_ms = 5, kGoodbye_ms = 50;
constexpr int kMostUnsent_bytes = 48;  // two commands: what the system holds is old when it gets there

}  // namespace

void SerialForceDevice::run() noexcept {
  pthread_setname_np(pthread_self(), "serial");
  if (options_.realtime) ask_for_realtime(kLinkPriority);  // refused: positions and commands wait longer
  connects_.fetch_add(1, std::memory_order_relaxed);
  while (!ending_.load(std::memory_order_relaxed)) {
    if (port_.is_open())
      turn();
    else
      look_for_it();
    publish();
    wait(kTurn_ms);
  }
  say_goodbye();
  publish();
}

// Without a port: a wake-up only says that an order came.
void SerialForceDevice::look_for_it() noexcept {
  discard_orders();
  const std::int64_t now_ns = serial_now_ns();
  if (now_ns < next_look_ns_) return;
  next_look_ns_ = now_ns + static_cast<std::int64_t>(options_.reopen_s * 1e9);
  const int error = port_.open(path_.c_str(), options_.baud);
  open_error_.store(error, std::memory_order_relaxed);
  if (error != 0) return;
  out_from_ = out_to_ = 0;
  blocked_since_ns_ = 0;
  connects_.fetch_add(1, std::memory_order_relaxed);
  conversation_.connected(options_.now_ns());
}

void SerialForceDevice::discard_orders() noexcept {
  orders_.take(order_);
  request_.store(SerialRequest::none, std::memory_order_relaxed);
  stop_now_.store(false, std::memory_order_relaxed);
  has_order_ = false;
  wanted_ = SerialRequest::none;
  carried_.store(order_.exchange, std::memory_order_release);
}

void SerialForceDevice::turn() noexcept {
  take_bytes(options_.now_ns());
  if (!port_.is_open()) return;
  take_orders();
  const std::int64_t now_ns = options_.now_ns();
  speak(now_ns);
  flush();
}

void SerialForceDevice::wait(int milliseconds) noexcept {
  const short wanted = static_cast<short>(out_from_ < out_to_ ? POLLIN | POLLOUT : POLLIN);
  pollfd both[] = {{wake_fd_, POLLIN, 0}, {port_.fd(), wanted, 0}};  // negative ones are passed over
  if (poll(both, 2, milliseconds) <= 0 || (both[0].revents & POLLIN) == 0) return;
  std::uint64_t wakes = 0;
  static_cast<void>(!::read(wake_fd_, &wakes, sizeof wakes));
}

void SerialForceDevice::lose() noexcept {
  port_.close();
  open_error_.store(ENODEV, std::memory_order_relaxed);
  conversation_.closed();
  out_from_ = out_to_ = 0;
  next_look_ns_ = 0;
}

// One portion a turn, so that a flood does not keep it from writing.
void SerialForceDevice::take_bytes(std::int64_t now_ns) noexcept {
  std::array<std::uint8_t, 4096> bytes;
  const int got = port_.read(bytes);
  if (got < 0) return lose();
  if (got == 0) return;
  reads_.fetch_add(1, std::memory_order_relaxed);
  conversation_.receive({bytes.data(), static_cast<std::size_t>(got)}, now_ns);
  publish();
  bytes_in_.fetch_add(static_cast<std::uint64_t>(got), std::memory_order_release);
}

void SerialForceDevice::take_orders() noexcept {
  has_order_ = orders_.take(order_) || has_order_;
  const SerialRequest wanted = request_.exchange(SerialRequest::none, std::memory_order_relaxed);
  if (wanted != SerialRequest::none) wanted_ = wanted;
  // The servo may stand still anywhere: what it worked out for a device that was unplugged is nothing to this one.
  if (has_order_ && order_.connection != conversation_.news().connection) {
    order_.command.force_un = {};
    wanted_ = SerialRequest::none;
  }
  if (stop_now_.exchange(false, std::memory_order_relaxed)) {
    if (out_from_ < out_to_) port_.drop_unsent();
    out_from_ = out_to_ = 0;
    order_.command.force_un = {};
    wanted_ = SerialRequest::stop;
    has_order_ = true;
  }
  if (conversation_.news().informed || !has_order_) return;
  has_order_ = false;
  wanted_ = SerialRequest::none;
  composed_ = order_.exchange;
}

// What can't go out yet waits here, where a newer order replaces it: never behind old ones in the system's buffer.
void SerialForceDevice::speak(std::int64_t now_ns) noexcept {
  if (!has_order_ && !conversation_.has_to_speak(now_ns)) return;
  if (out_from_ < out_to_ || port_.unsent() > kMostUnsent_bytes) {
    held_up_.fetch_add(1, std::memory_order_relaxed);
    if (blocked_since_ns_ == 0) blocked_since_ns_ = now_ns;
    if (now_ns - blocked_since_ns_ > kBlocked_ns) conversation_.note_deaf();
    return;
  }
  blocked_since_ns_ = 0;
  out_from_ = 0;
  if (has_order_) {
    order_.command.request = std::exchange(wanted_, SerialRequest::none);
    composed_ = order_.exchange;
  }
  out_to_ = conversation_.compose(std::exchange(has_order_, false) ? &order_.command : nullptr, now_ns, out_);
}

void SerialForceDevice::flush() noexcept {
  if (out_from_ < out_to_) {
    const int taken = port_.write({out_.data() + out_from_, out_to_ - out_from_});
    if (taken < 0) return lose();
    out_from_ += static_cast<std::size_t>(taken);
    if (taken > 0) writes_.fetch_add(1, std::memory_order_relaxed);
    bytes_out_.fetch_add(static_cast<std::uint64_t>(taken), std::memory_order_release);
  }
  if (out_from_ == out_to_) carried_.store(composed_, std::memory_order_release);
}

// No force, and a stop; then the port is released. A line that takes nothing is not waited for: the firmware's watchdog
// is there.
void SerialForceDevice::say_goodbye() noexcept {
  if (port_.is_open() && conversation_.news().informed) {
    if (out_from_ < out_to_) port_.drop_unsent();
    const ForceCommandMessage stop{{}, SerialRequest::stop};
    out_from_ = 0;
    out_to_ = conversation_.compose(&stop, options_.now_ns(), out_);
    flush();
    for (int ms = 0; ms < kGoodbye_ms && port_.is_open() && (out_from_ < out_to_ || port_.unsent() > 0); ++ms) {
      poll(nullptr, 0, 1);
      flush();
    }
    if (port_.is_open() && port_.unsent() > 0) port_.drop_unsent();  // closing would wait for it, 30 s on Linux
  }
  port_.close();
  conversation_.closed();
  out_from_ = out_to_ = 0;
}

void SerialForceDevice::publish() noexcept {
  constexpr auto relaxed = std::memory_order_relaxed;
  const SerialCounts& counts = conversation_.counts();
  told_.put(conversation_.news());
  connected_.store(conversation_.news().connection % 2 != 0, std::memory_order_release);
  trouble_.store(conversation_.news().trouble, relaxed);
  frames_.store(counts.frames, relaxed);
  crc_errors_.store(counts.crc_errors, relaxed);
  skipped_bytes_.store(counts.skipped_bytes, relaxed);
  lost_.store(counts.lost, relaxed);
  doubled_.store(counts.doubled, relaxed);
  late_.store(counts.late, relaxed);
  lost_by_device_.store(counts.lost_by_device, relaxed);
  refused_.store(counts.refused, relaxed);
}

}  // namespace tangent
