// A force device whose microcontroller speaks the force messages of the CLD protocol (devices/cld_protocol.md) over a
// serial line, as USB CDC.
//
//   servo thread             line's thread
//   exchange  -- command --> frames out
//             <-- news ----- frames in, checked
// Two mailboxes: the newest wins, neither waits. The line's thread alone uses the port; it opens it again after it was
// unplugged. It stops the firmware by itself when it finds trouble.
//
// No force goes out for a position older than two and a half of the device's sample periods, which is no fault: a frame
// was late. After 10 ms it is one. The force comes back at 2 N a millisecond.
#pragma once

#include "devices/base/mailbox.h"
#include "devices/force_device.h"
#include "devices/serial/serial_conversation.h"
#include "devices/serial/serial_options.h"
#include "devices/serial/serial_port.h"
#include "devices/serial/serial_ports.h"

#include <array>
#include <atomic>
#include <string>
#include <thread>

namespace tangent {

class SerialForceDevice final : public ForceDevice {
 public:
  explicit SerialForceDevice(const SerialForceOptions& options = {});
  ~SerialForceDevice() override;

  /// What its firmware said; before it is open the name alone.
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  /// Asks the firmware what it is. Fails when there is no port, several, or one that can't be opened, when nothing
  /// answers on it, and when what answers makes no sense.
  Status open() override;
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  /// The line's thread drops what is queued and sends a stop.
  bool emergency_stop() noexcept override;
  bool report(LinkReport& out) const override;

  /// Any thread: exchanges whose command was handed to the port, or replaced by a newer one; bytes that came and went.
  std::uint64_t carried() const noexcept { return carried_.load(std::memory_order_acquire); }
  std::uint64_t bytes_in() const noexcept { return bytes_in_.load(std::memory_order_acquire); }
  std::uint64_t bytes_out() const noexcept { return bytes_out_.load(std::memory_order_acquire); }
  /// Processor time of the line's thread. Owner's thread, while open.
  double line_processor_s() const;

 private:
  struct Order {
    ForceCommandMessage command;
    std::uint64_t exchange = 0;
    std::uint32_t connection = 0;  ///< it was made for
  };

  Status ask();
  void describe(const SerialPortInfo& port);
  Error no_answer() const;

  // Line's thread.
  void run() noexcept;
  void look_for_it() noexcept;
  void discard_orders() noexcept;
  void turn() noexcept;
  void take_bytes(std::int64_t now_ns) noexcept;
  void take_orders() noexcept;
  void speak(std::int64_t now_ns) noexcept;
  void flush() noexcept;
  void say_goodbye() noexcept;
  void lose() noexcept;
  void publish() noexcept;
  void wait(int milliseconds) noexcept;

  // Servo thread.
  DeviceState state_now(std::int64_t now_ns, DeviceFault& fault) noexcept;
  void request(DeviceRequest request, DeviceState state) noexcept;
  Vec3 force_to_send(const ForceCommand& command, bool fresh, double dt_s) noexcept;
  void wake() noexcept;

  SerialForceOptions options_;
  ForceCapabilities capabilities_;
  std::string path_;  ///< that it is opened by
  double sample_s_ = 1e-3;
  bool opened_ = false;
  std::thread thread_;
  int wake_fd_;  ///< for as long as the device lives: emergency_stop may come at any time
  std::atomic<bool> ending_{false}, stop_now_{false};
  std::atomic<SerialRequest> request_{SerialRequest::none};
  Mailbox<Order> orders_;     ///< servo to line
  Mailbox<SerialNews> told_;  ///< line to servo

  // Written by the line's thread, read by any.
  std::atomic<std::uint64_t> carried_{0}, bytes_in_{0}, bytes_out_{0}, reads_{0}, writes_{0}, connects_{0}, held_up_{0};
  std::atomic<std::uint64_t> frames_{0}, crc_errors_{0}, skipped_bytes_{0}, lost_{0}, doubled_{0}, late_{0},
      lost_by_device_{0}, refused_{0};
  std::atomic<bool> connected_{false}, silent_{false};
  std::atomic<SerialTrouble> trouble_{SerialTrouble::none};
  std::atomic<int> open_error_{0};

  // Line's thread.
  SerialPort port_;
  SerialConversation conversation_;
  Order order_;
  bool has_order_ = false;
  SerialRequest wanted_ = SerialRequest::none;  ///< goes out with the next order
  std::uint64_t composed_ = 0;                  ///< exchange of the order in out_
  std::array<std::uint8_t, SerialConversation::kLargestTurn> out_{};
  std::size_t out_from_ = 0, out_to_ = 0;
  std::int64_t blocked_since_ns_ = 0;  ///< 0: it is not
  std::int64_t next_look_ns_ = 0;

  // Servo thread.
  SerialNews news_;
  std::uint64_t exchanges_ = 0;
  std::uint32_t homed_connection_ = 0, silent_connection_ = 0;
  Vec3 sent_n_{0.0};
  bool returning_ = false;  ///< the force comes back after samples were late
};

}  // namespace tangent
