// An emulated USB bus: umockdev provides sysfs and hot-plug events to Debian's libusb, the shim provides the device
// nodes, and a thread drives the devices at 1 kHz.
#pragma once

#include "tests/devices/usb/emulation/umockdev_node.h"
#include "tests/devices/usb/emulation/usbfs_shim.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>

typedef struct _UMockdevTestbed UMockdevTestbed;

namespace tangent::emulation {

class Testbed {
 public:
  Testbed();
  ~Testbed();
  Testbed(const Testbed&) = delete;
  Testbed& operator=(const Testbed&) = delete;

  UMockdevTestbed* mock() const { return testbed_; }

 private:
  UMockdevTestbed* testbed_;
};

/// What emulates the device node.
enum class NodeBy { shim, umockdev };

/// One device on the testbed's bus.
class PluggedDevice {
 public:
  PluggedDevice(Testbed& testbed, UsbModel& model, int address, NodeBy by = NodeBy::shim);
  ~PluggedDevice();
  PluggedDevice(const PluggedDevice&) = delete;
  PluggedDevice& operator=(const PluggedDevice&) = delete;

  void plug_in(int open_error = 0);
  void unplug();  ///< at any time, also during transfers
  /// The device's clock: a thread at 1 kHz. Without it, tick by hand.
  void run();
  void halt();
  UsbfsBoard board;

 private:
  Testbed& testbed_;
  UsbModel& model_;
  int address_;
  NodeBy by_;
  std::unique_ptr<UmockdevNode> mock_node_;
  std::string node_, syspath_;
  bool plugged_ = false;
  std::atomic<bool> running_{false};
  std::thread clock_;
};

}  // namespace tangent::emulation
