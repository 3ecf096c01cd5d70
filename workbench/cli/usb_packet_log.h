// --packets of a guided run: every USB packet of the device in a file.
#pragma once

#include "devices/usb/packet_recorder.h"

#include <filesystem>
#include <memory>
#include <utility>

namespace tangent {

class UsbPacketLog {
 public:
  /// `file` empty: nothing is logged. Fails where it can't be written.
  static Result<UsbPacketLog> create(const std::filesystem::path& file) {
    UsbPacketLog log;
    if (file.empty()) return log;
    auto recorder = PacketRecorder::create(file);
    if (!recorder) return tl::unexpected(recorder.error());
    log.recorder_ = std::move(*recorder);
    return log;
  }
  UsbTap* tap() { return recorder_.get(); }  ///< null: none; must outlive the device
  /// Fails when something that should be in the file is not.
  Status complete() const { return recorder_ != nullptr ? recorder_->complete() : Status{}; }
  /// The device was left behind, and goes on to use it.
  void leave_behind() { static_cast<void>(recorder_.release()); }

 private:
  std::unique_ptr<PacketRecorder> recorder_;
};

}  // namespace tangent
