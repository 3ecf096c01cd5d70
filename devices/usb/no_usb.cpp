// Replaces the transport where libusb is missing: every call fails with that message.
#include "devices/usb/usb_link.h"

namespace tangent {

struct UsbLink::Impl {
  UsbCounters counters;
  std::string serial;
};

bool usb_built_in() { return false; }
Result<std::vector<UsbDeviceInfo>> list_usb_devices(const UsbMatch&, int) {
  return tl::unexpected(usb_error(UsbProblem::no_library, "USB"));
}

UsbLink::UsbLink(UsbLinkOptions, UsbLinkHandler&, UsbTap*) : impl_(std::make_unique<Impl>()) {}
UsbLink::~UsbLink() = default;
Status UsbLink::start() { return tl::unexpected(usb_error(UsbProblem::no_library, "USB")); }
void UsbLink::stop() {}
void UsbLink::wake() noexcept {}
bool UsbLink::connected() const noexcept { return false; }
UsbProblem UsbLink::problem() const noexcept { return UsbProblem::no_library; }
const UsbCounters& UsbLink::counters() const noexcept { return impl_->counters; }
bool UsbLink::send(std::span<const std::uint8_t>) noexcept { return false; }
bool UsbLink::send_control(const UsbControl&) noexcept { return false; }
const std::string& UsbLink::serial() const noexcept { return impl_->serial; }
bool UsbLink::can_send() const noexcept { return false; }
void UsbLink::reconnect() noexcept {}

}  // namespace tangent
