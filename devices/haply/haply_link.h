// Keeps one WebSocket to an Inverse Service: connects, passes messages on, notices when it ends, and connects again.
// All of it runs in the link's own thread; other threads only wake it. It does not interpret the messages.
#pragma once

#include "devices/haply/haply_address.h"
#include "devices/haply/haply_problem.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace tangent {

/// All calls come from the link's thread and must not wait.
class HaplyLinkHandler {
 public:
  virtual ~HaplyLinkHandler() = default;
  virtual void on_open() noexcept = 0;
  /// One whole message; `text` is valid during the call.
  virtual void on_message(std::string_view text) noexcept = 0;
  /// The message to send now; false: none. Asked after every message, wake-up, and sending, and every 5 ms.
  virtual bool next(std::string& out) noexcept = 0;
  /// The last message before the connection is given up on purpose; false: none.
  virtual bool last(std::string& out) noexcept = 0;
  /// It ended, or could not be made.
  virtual void on_closed(HaplyProblem why, const std::string& detail) noexcept = 0;
};

struct HaplyLinkOptions {
  HaplyAddress address;
  bool other_host = false;  ///< else an address that a name stands for must be this machine's, too
  double connect_s = 1.0, retry_s = 0.5;
  std::size_t largest_message = 0;
  bool realtime = false;                 ///< its thread asks for SCHED_FIFO
  const char* thread = "tangent-haply";  ///< its name, 15 characters at most
};

bool haply_built_in();

class HaplyLink {
 public:
  /// `handler` must outlive it.
  explicit HaplyLink(HaplyLinkHandler& handler);
  ~HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;

  /// Starts the thread, which connects. Fails where no thread or descriptor is to be had, or it was not built in.
  Status start(const HaplyLinkOptions& options);
  /// Sends the last message, closes and joins the thread, within 0.5 s. Harmless when not started.
  void stop();
  /// Any thread, also while it is started or stopped, without waiting: next() is asked soon.
  void wake() noexcept;
  /// Any thread while it runs, without waiting: sends the last message, closes, connects again.
  void reconnect() noexcept;

  struct Impl;

 private:
  // As long as the link, not as its thread: who wakes it while it is started or stopped must not write to a descriptor
  // that was closed, and is perhaps another file by now.
  const int bell_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
