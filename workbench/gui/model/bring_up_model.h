// A guided bring-up of the chosen force device (workbench/bringup/), which the session gives up meanwhile.
#pragma once

#include "workbench/bringup/bring_up_protocol.h"
#include "workbench/bringup/bring_up_runner.h"
#include "workbench/gui/model/asked_since.h"
#include "workbench/gui/model/device_model.h"

#include <memory>
#include <optional>

namespace tangent {

class BringUpModel {
 public:
  /// `deterministic`: in simulated time, by `advance`. `kept`: file of what was proved; empty: not kept.
  BringUpModel(DeviceModel& devices, MessageLog& messages, bool deterministic, std::filesystem::path kept);

  /// The session ends, and the device is opened for the bring-up. Nothing moves. A message where there is none.
  void begin();
  /// Zero force; the device goes back to a session, which arms nothing.
  void end();
  void stop();  ///< zero force; what was found stays in view
  bool open() const { return protocol_.has_value(); }
  bool under_way() const { return runner_ != nullptr && !view().ended; }

  void update();  ///< once a frame
  void advance(std::uint64_t ticks);
  void answer(BringUpAnswer answer);
  bool settled() const;  ///< an answer makes sense now: not right after the question before, with a real device
  const BringUpView& view() const { return protocol_->result; }
  const ForceCapabilities& capabilities() const { return protocol_->device; }
  const BringUpProtocol& protocol() const { return *protocol_; }
  /// Writes the protocol, "bring-up-KIND-SERIAL.json", into the current folder.
  void save();

 private:
  DeviceModel& devices_;
  MessageLog& messages_;
  bool deterministic_;
  std::filesystem::path kept_;
  std::unique_ptr<BringUpRunner> runner_;
  std::optional<BringUpProtocol> protocol_;
  bool noted_ = false;  ///< that it has ended
  AskedSince asked_;
};

}  // namespace tangent
