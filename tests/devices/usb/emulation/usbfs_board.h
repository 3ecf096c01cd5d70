// Emulates the usbfs device node of one model: URBs are submitted, completed and reaped, interfaces claimed, the device
// unplugged at any time. Linux's ioctls, with pointers of this process.
#pragma once

#include "tests/devices/usb/emulation/usb_model.h"

#include <sys/ioctl.h>

#include <linux/usbdevice_fs.h>

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

namespace tangent::emulation {

class UsbfsBoard {
 public:
  explicit UsbfsBoard(UsbModel& model) : model_(model) {}

  /// 0 or -errno. Any thread.
  int ioctl(unsigned long request, void* argument);
  void tick();
  /// Everything in flight ends with -ESHUTDOWN; every later ioctl but reaping with -ENODEV.
  void unplug();
  void plug_in();
  bool plugged() const { return plugged_; }
  void vanish_handle();  ///< the node was closed: URBs are forgotten
  template <class F>
  auto with_model(F&& f) {
    const std::scoped_lock lock(mutex_);
    return f();
  }

  int claim_error = 0;  ///< errno that claiming returns; 0: none
  /// Called, under the lock, when there is something to reap, and when there no longer is.
  std::function<void(bool ready)> on_ready;

 private:
  int submit(usbdevfs_urb* urb);
  int discard(usbdevfs_urb* urb);
  int reap(void** out);
  /// `data`: what an IN transfer brought, into the buffer from `at` on.
  void complete(usbdevfs_urb* urb, int status, int actual, Bytes data = {}, std::size_t at = 0);
  void serve_in();
  void submit_control(usbdevfs_urb* urb);

  std::mutex mutex_;
  UsbModel& model_;
  /// As in Linux, the host's memory is written when it reaps, in its own thread; for URBs never reaped, not at all.
  struct Done {
    usbdevfs_urb* urb = nullptr;
    int status = 0, actual = 0;
    Bytes data;
    std::size_t at = 0;
  };
  std::deque<usbdevfs_urb*> waiting_;
  std::deque<Done> done_;
  std::atomic<bool> plugged_{true};
};

}  // namespace tangent::emulation
