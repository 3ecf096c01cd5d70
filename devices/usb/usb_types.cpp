#include "devices/usb/usb_types.h"

#include "devices/usb/usb_link.h"

#include <ctime>

namespace tangent {

Error usb_error(UsbProblem problem, const std::string& where, const std::string& detail) {
  const std::string note = detail.empty() ? "" : " (" + detail + ")";
  switch (problem) {
    case UsbProblem::none:
      return {"no problem", where, ""};
    case UsbProblem::no_library:
      return {"this program was built without libusb", where, "install libusb-1.0-0-dev and build again"};
    case UsbProblem::not_attached:
      return {"is not attached", where, "plug it in"};
    case UsbProblem::no_permission:
      return {"may not be opened by this user" + note, where,
              "copy devices/60-tangent-workbench.rules to /etc/udev/rules.d, run `udevadm control --reload`, and plug "
              "it in again"};
    case UsbProblem::busy:
      return {"is in use by another program or driver" + note, where, "close what uses it"};
    case UsbProblem::wrong_interface:
      return {"has no interface that speaks the protocol" + note, where, "load its firmware (devices/cld_protocol.md)"};
    case UsbProblem::several:
      return {"is attached more than once", where, "choose one by its serial number, or unplug the others"};
    case UsbProblem::other:
      return {"can't be opened" + note, where, "unplug it and plug it in again"};
  }
  return {};
}

std::int64_t usb_now_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

}  // namespace tangent
