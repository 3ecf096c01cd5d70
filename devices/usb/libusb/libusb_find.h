// Finding and opening devices with libusb. Only this folder includes libusb.
#pragma once

#include "devices/usb/usb_types.h"

#include <libusb.h>

#include <memory>

namespace tangent {

struct LibusbContextCloser {
  void operator()(libusb_context* c) const { libusb_exit(c); }
};
struct LibusbHandleCloser {
  void operator()(libusb_device_handle* h) const { libusb_close(h); }
};
using LibusbContext = std::unique_ptr<libusb_context, LibusbContextCloser>;
using LibusbHandle = std::unique_ptr<libusb_device_handle, LibusbHandleCloser>;

/// Fails, with libusb's error name, when libusb can't be initialised.
Result<LibusbContext> open_libusb();
/// Whether an attached device matches; false if its descriptors can't be read.
bool matches(libusb_device* device, const UsbMatch& match);
UsbProblem problem_of(int libusb_code);

/// The serial number that an open device says; empty: none, or it can't be read. Asks the device.
std::string serial_of(libusb_device_handle* handle);

/// Opens the first device that matches and claims its interface (-1: none). Null when there is none; `problem` says
/// why.
LibusbHandle open_first(libusb_context* context, const UsbMatch& match, int interface_number, UsbProblem& problem);

}  // namespace tangent
