// An emulated Inverse Service with one or several Inverse3, on 127.0.0.1, in a thread of its own: what Haply's pages
// say it answers, or something else on request.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tangent::testing {

/// What comes back for a message.
struct HaplyReply {
  enum class How : std::uint8_t { send, nothing, hold, close, reset, half_frame, flood };
  How how = How::send;
  std::string text;  ///< to send, or to hold
};

struct HaplyServiceOptions {
  std::vector<std::string> devices{"049D"};
  bool old_format = false;  ///< 3.1: no session_id, forces as `values`
  bool calibrated = true, power = true, in_use = false;
  std::string permutation = "XYZ";
  bool realtime = false;                                ///< its thread asks for SCHED_FIFO
  std::optional<Quat> grip = Quat(1.0, 0.0, 0.0, 0.0);  ///< how the VerseGrip is turned; null: none is there
  double mass_kg = 0.0;                                 ///< of a finger that nothing holds; 0: it stays where it is
};

class HaplyService {
 public:
  /// What to reply to the n-th message (from 1; 0: the list on connecting), given what would be right.
  using Policy = std::function<HaplyReply(std::uint64_t n, const std::string& right)>;

  explicit HaplyService(HaplyServiceOptions options = {});
  ~HaplyService();
  HaplyService(const HaplyService&) = delete;
  HaplyService& operator=(const HaplyService&) = delete;

  std::string address() const;
  // Any thread; each takes effect before it returns.
  void set_policy(Policy policy);  ///< null: the right one
  void set_options(const HaplyServiceOptions& options);
  void put_finger(const Vec3& position_m);  ///< in Haply's axes
  void push(const std::string& text);       ///< to every client, unasked, as the events' port does
  void release_held();                      ///< sends what was held back
  void drop();                              ///< resets every connection
  void go_away();                           ///< as drop, and refuses connections
  void come_back();                         ///< listens again, on the same port

  std::uint64_t received() const;  ///< messages, of all connections
  std::uint64_t forces() const;    ///< set_cursor_force among them
  Vec3 force_n() const;            ///< the newest
  Vec3 finger_m() const;
  std::vector<std::string> asked() const;  ///< the newest ten messages, oldest first
  bool closed_politely() const;            ///< the last connection that ended did so by a WebSocket's close

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent::testing
