// A Haply Inverse3, driven through Haply's Inverse Service on this machine.
//
//   servo thread                    link's thread                            Inverse Service
//   exchange  -- order (mailbox) -->  one message, the force       -- JSON -->
//             <-- heard (mailbox) --  its answer, the state        <-- JSON --
// The service answers each message with one state, and is sent the next force only after its answer; zero force is
// sent at once. It applies a force once and forgets it. Neither thread waits for the other.
//
// The state is the service's word with three exceptions: an Inverse3 is `firmware` until it is homed in this
// connection, which takes its calibration (a person puts it into its inkwell); a fault stays until it is cleared; and
// it is absent while the service does not list it.
//
// The orientation is that of the VerseGrip, where the service lists one when the device is opened; a finger points
// where the grip does.
//
// Zero force: when two exchanges in a row found no new answer, in the exchange after a message that is not understood
// or a position where no Inverse3 can be, without the VerseGrip that gave the orientation, after an event that reports
// an error, after the connection ended, after emergency_stop, and by the link's thread when no exchange came for
// our_stall_s.
#pragma once

#include "devices/base/log_histogram.h"
#include "devices/base/mailbox.h"
#include "devices/force_device.h"
#include "devices/gate/freshness.h"
#include "devices/haply/haply_codec.h"
#include "devices/haply/haply_events.h"
#include "devices/haply/haply_link.h"
#include "devices/haply/haply_options.h"

#include <atomic>
#include <string>
#include <vector>

namespace tangent {

class HaplyForceDevice final : public ForceDevice, private HaplyLinkHandler {
 public:
  explicit HaplyForceDevice(const HaplyOptions& options = {});
  ~HaplyForceDevice() override { close(); }

  /// Constant from open on: only then it is known whether there is a VerseGrip.
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  /// Connects and waits for the list of devices, three times connect_s at most. Fails when the service does not
  /// answer, lists no Inverse3, or several of which none was chosen (the error lists them), or another program's.
  Status open() override;
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The link's thread sends zero force at once, and none but zero until it is homed again.
  bool emergency_stop() noexcept override;
  bool report(LinkReport& out) const override;

 private:
  struct Order {
    Vec3 force_n{0.0};
    std::uint32_t stops = 0, bad = 0, connection = 0;  ///< that the servo knew of
  };
  struct Heard {
    Vec3 position_m{0.0}, velocity_m_per_s{0.0};
    Quat orientation{1.0, 0.0, 0.0, 0.0};
    bool has_velocity = false, usable = false, calibrated = false;
    std::uint32_t buttons = 0, connection = 0;
    std::int64_t at_ns = 0;
  };
  enum class Opening : std::uint8_t { waits, listed, closed };

  void listen_for_events(const HaplyAddress& service);

  std::string details() const;

  // Link's thread.
  void on_open() noexcept override;
  void on_message(std::string_view text) noexcept override;
  bool next(std::string& out) noexcept override;
  bool last(std::string& out) noexcept override;
  void on_closed(HaplyProblem why, const std::string& detail) noexcept override;
  const HaplyEntry* find_ours();
  void take_state(const HaplyEntry& device, bool first);
  bool take_grip();
  void count_unasked();
  void note_bad(HaplyProblem problem) noexcept;
  void measure_round_trip() noexcept;
  void put_force(std::string& out, const Vec3& force_n) noexcept;

  // Servo thread.
  void follow_connection() noexcept;
  void follow_answers(double dt_s) noexcept;
  void follow_status() noexcept;
  void fail_by(HaplyProblem problem) noexcept;
  Vec3 force_to_send(const Vec3& wanted_n) noexcept;

  HaplyOptions options_;
  ForceCapabilities capabilities_;
  HaplyLink link_;
  HaplyEvents events_;
  Mailbox<Order> orders_;  ///< servo to link
  Mailbox<Heard> heard_;   ///< link to servo

  // Written by the link's thread, read by any.
  std::atomic<std::uint32_t> connection_{0};  ///< odd while connected, another one after every change, of the list too
  std::atomic<Opening> opening_{Opening::waits};
  std::atomic<HaplyProblem> closed_by_{HaplyProblem::none}, listing_{HaplyProblem::none};
  std::atomic<std::uint32_t> bad_{0};  ///< count of bad messages << 8 | problem of the last
  std::atomic<std::uint64_t> in_{0}, out_{0}, connects_{0}, out_of_turn_{0};
  LogHistogram round_trip_us_;
  // Written by any thread.
  std::atomic<std::uint32_t> stops_{0};
  // Written by the servo's.
  std::atomic<HaplyProblem> fault_by_{HaplyProblem::none};
  std::atomic<std::uint64_t> quiet_exchanges_{0};

  // Link's thread; `id_`, `grip_used_` and the texts are read by open as well, after what it waits for.
  std::string id_, listed_text_, closed_text_;
  HaplyMessage message_;
  std::vector<HaplyEntry> known_;
  bool listed_ = false, unheard_ = false, vector_ = true, pending_ = false, pushes_ = false;
  bool grip_used_ = false;
  Quat orientation_{1.0, 0.0, 0.0, 0.0};
  int owed_ = 0;      ///< answers
  int unasked_ = 0;   ///< answers to nothing in this connection, each as many as the answers that make up for it
  int unturned_ = 0;  ///< states in a row that don't say how the VerseGrip is turned
  Order order_;
  std::uint32_t stops_sent_ = 0, bad_sent_ = 0;
  std::int64_t order_at_ns_ = 0, sent_at_ns_ = 0;

  // Servo thread.
  std::atomic<bool> opened_{false};  ///< report reads it in another thread
  bool fresh_ = false;
  DeviceStateMachine machine_;
  Heard newest_;
  std::uint32_t seen_connection_ = 0, seen_bad_ = 0, seen_stops_ = 0, seen_alarms_ = 0;
  int quiet_ = 0;
  std::uint64_t seen_in_ = 0;              ///< messages
  double quiet_s_ = 0.0, silent_s_ = 0.0;  ///< since the last good state; since anything came
  LatenessWatch late_;
};

}  // namespace tangent
