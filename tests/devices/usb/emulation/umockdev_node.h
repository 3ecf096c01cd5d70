// The same board behind umockdev's own device node: its ioctl handler copies between processes and takes about 0.4 ms
// per call. For tests where speed does not matter and no code of this project may be between libusb and the node.
#pragma once

#include "tests/devices/usb/emulation/usbfs_board.h"

#include <memory>
#include <string>

typedef struct _UMockdevTestbed UMockdevTestbed;

namespace tangent::emulation {

class UmockdevNode {
 public:
  /// Before the node is in the testbed, so that nobody finds one without an answer.
  UmockdevNode(UMockdevTestbed* testbed, const std::string& path, UsbfsBoard& board);
  ~UmockdevNode();
  UmockdevNode(const UmockdevNode&) = delete;
  UmockdevNode& operator=(const UmockdevNode&) = delete;

 private:
  UMockdevTestbed* testbed_;
  std::string path_;
};

}  // namespace tangent::emulation
