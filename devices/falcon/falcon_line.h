// The link's half of the Falcon's driver: finds out whether the device runs its firmware, uploads it where not, then
// sends the newest command and hands over the newest answer. A transport calls the functions of its thread; the servo
// posts and takes. The two share mailboxes and atomics; neither waits. Times are given, so tests can make them.
//
// The device answers each command once, and there is one in flight at a time. Whether an answer is missing is judged
// here, after everything that had come was read, so that a servo or a link that slept is not taken for a silent device.
// The next command goes out
//   without any torque     when no answer has come for answer_s, when none could be sent for so long, when what came
//                          was no packet, after hold(), and when the servo has posted nothing for servo_gone_s
//   at once                after hold()
#pragma once

#include "devices/base/mailbox.h"
#include "devices/falcon/falcon_codec.h"
#include "devices/falcon/falcon_script.h"

#include <atomic>
#include <string>
#include <vector>

namespace tangent {

struct FalconHeard {
  FalconAnswer answer;
  std::int64_t at_ns = 0;
  std::uint32_t connection = 0;
};

/// What the servo wants, made from what it knew of that connection.
struct FalconOrder {
  FalconCommand command;
  std::uint32_t connection = 0;
};

enum class FalconPhase : std::uint8_t {
  asking,     ///< whether it runs its firmware
  uploading,  ///< the firmware
  running,
  no_firmware,  ///< it runs none, and none was given
  not_loaded,   ///< the upload failed again and again
};

struct FalconLineOptions {
  double answer_s = 3e-3;       ///< longest time for an answer
  double question_s = 0.1;      ///< for an answer to whether its firmware runs, three times
  double servo_gone_s = 20e-3;  ///< without a command for this long there is no torque
  int attempts = 5;             ///< to upload the firmware
};

class FalconLine {
 public:
  FalconLine(const FalconLineOptions& options, std::vector<std::uint8_t> firmware);

  // Transport's thread.
  /// `firmware`: of this device, which must outlive the connection; null: the one that was given at first.
  void opened(std::int64_t now_ns, const std::vector<std::uint8_t>* firmware = nullptr) noexcept;
  void closed() noexcept;
  void packet(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept;  ///< as it came, with its status
  void control_done(bool good, std::int64_t now_ns) noexcept { script_.control_done(good, now_ns); }
  void turn(FalconWire& wire, std::int64_t now_ns) noexcept;

  // Servo's thread.
  /// Of another connection than the one that is open it does nothing.
  void post(const FalconCommand& command, std::uint32_t connection) noexcept { orders_.put({command, connection}); }
  bool take(FalconHeard& heard) noexcept { return heard_.take(heard); }

  // Any thread.
  void hold() noexcept;  ///< no torque until release
  void release() noexcept { held_.store(false, kRelaxed); }
  void end() noexcept { ending_.store(true, kRelaxed); }  ///< the next command is the last: nothing
  /// Asks, and uploads, once more, where no firmware answers.
  void try_again() noexcept { again_.store(true, kRelaxed); }
  std::uint32_t connection() const noexcept { return connection_.load(std::memory_order_acquire); }  ///< odd: connected
  FalconPhase phase() const noexcept { return phase_.load(std::memory_order_acquire); }
  /// Commands in a row that were not answered in time, or could not be sent.
  std::uint32_t unanswered() const noexcept { return unanswered_.load(kRelaxed); }
  /// It sends no torque, whatever is posted, until an answer comes.
  bool withholds() const noexcept { return withholds_.load(kRelaxed); }
  /// Packets' worth of bytes that were none since the last good answer.
  std::uint32_t garbage() const noexcept { return garbage_.load(kRelaxed); }
  std::uint64_t answers() const noexcept { return answers_.load(kRelaxed); }
  std::uint64_t lost() const noexcept { return lost_.load(kRelaxed); }  ///< commands without an answer in time
  std::uint64_t skipped() const noexcept { return skipped_.load(kRelaxed); }
  std::uint64_t uploads() const noexcept { return uploads_.load(kRelaxed); }  ///< begun
  /// "the firmware, piece 12 of 137: wrong answer"; empty: no step has failed.
  std::string failed_step() const;

 private:
  static constexpr auto kRelaxed = std::memory_order_relaxed;
  void ask(std::int64_t now_ns) noexcept;
  void turn_asking(FalconWire& wire, std::int64_t now_ns) noexcept;
  void turn_uploading(FalconWire& wire, std::int64_t now_ns) noexcept;
  void turn_running(FalconWire& wire, std::int64_t now_ns) noexcept;
  void upload(std::int64_t now_ns) noexcept;
  void note_failed_step() noexcept;
  bool is_answering(std::int64_t now_ns) const noexcept;
  void take_answer(const FalconPacket& packet, std::int64_t now_ns) noexcept;
  void take_order(std::int64_t now_ns) noexcept;
  bool send(FalconWire& wire, FalconCommand command, std::int64_t now_ns) noexcept;
  void not_answered() noexcept;
  void set_doubt(bool doubt) noexcept;
  void enter(FalconPhase phase) noexcept { phase_.store(phase, std::memory_order_release); }

  const FalconLineOptions options_;
  const std::vector<std::uint8_t> firmware_;
  Mailbox<FalconOrder> orders_;
  Mailbox<FalconHeard> heard_;
  std::atomic<std::uint32_t> connection_{0}, garbage_{0}, unanswered_{0};
  std::atomic<FalconPhase> phase_{FalconPhase::asking};
  std::atomic<bool> held_{false}, stop_now_{false}, ending_{false}, again_{false}, withholds_{false};
  std::atomic<std::uint64_t> answers_{0}, lost_{0}, skipped_{0}, uploads_{0};
  std::atomic<std::uint32_t> failed_at_{0};  ///< step, piece and cause, packed; 0: none
  std::atomic<std::size_t> pieces_{0};       ///< of the firmware of this connection

  // Transport's thread.
  const std::vector<std::uint8_t>* loads_ = &firmware_;  ///< on this connection
  FalconScript script_;
  FalconParser parser_;
  FalconPacket asked_{};
  FalconCommand wanted_;
  int questions_ = 0, attempts_ = 0, refusals_ = 0;
  bool fresh_ = false, in_flight_ = false, doubt_ = false, pushing_ = false, ended_ = false;
  std::int64_t sent_ns_ = 0, wanted_ns_ = 0, answered_ns_ = 0, blocked_ns_ = 0;  ///< blocked: since when; 0: not
};

}  // namespace tangent
