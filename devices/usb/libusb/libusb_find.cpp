#include "devices/usb/libusb/libusb_find.h"

#include <algorithm>

namespace tangent {

namespace {

bool has_interface(libusb_device* device, const std::array<std::uint8_t, 3>& wanted) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(device, &config) != 0 &&
      libusb_get_config_descriptor(device, 0, &config) != 0) {
    return false;
  }
  bool found = false;
  for (int i = 0; i < config->bNumInterfaces; ++i) {
    for (int j = 0; j < config->interface[i].num_altsetting; ++j) {
      const libusb_interface_descriptor& d = config->interface[i].altsetting[j];
      found = found || (d.bInterfaceClass == wanted[0] && d.bInterfaceSubClass == wanted[1] &&
                        d.bInterfaceProtocol == wanted[2]);
    }
  }
  libusb_free_config_descriptor(config);
  return found;
}

std::string string_of(libusb_device_handle* handle, std::uint8_t index) {
  std::array<unsigned char, 128> text{};
  if (index == 0) return {};
  const int got = libusb_get_string_descriptor_ascii(handle, index, text.data(), static_cast<int>(text.size()));
  return got > 0 ? std::string(text.begin(), text.begin() + got) : std::string();
}

/// Opens a device and claims its interface; returns 0 or libusb's error code. `serial`: of the device, if not empty; of
/// another, LIBUSB_ERROR_NO_DEVICE, without touching its interface.
int open_and_claim(libusb_device* device, int interface_number, LibusbHandle& out, const std::string& serial = {}) {
  libusb_device_handle* raw = nullptr;
  if (const int code = libusb_open(device, &raw); code != 0) return code;
  LibusbHandle handle(raw);
  if (!serial.empty()) {
    libusb_device_descriptor d{};
    libusb_get_device_descriptor(device, &d);
    if (string_of(raw, d.iSerialNumber) != serial) return LIBUSB_ERROR_NO_DEVICE;
  }
  if (interface_number >= 0) {
    libusb_set_auto_detach_kernel_driver(raw, 1);
    if (const int code = libusb_claim_interface(raw, interface_number); code != 0) return code;
  }
  out = std::move(handle);
  return 0;
}

/// Calls `each(device)` for every match until it returns true.
template <class Each>
void each_match(libusb_context* context, const UsbMatch& match, Each&& each) {
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context, &list);
  for (ssize_t i = 0; i < count; ++i) {
    if (matches(list[i], match) && each(list[i])) break;
  }
  if (count >= 0) libusb_free_device_list(list, 1);
}

}  // namespace

Result<LibusbContext> open_libusb() {
  libusb_context* context = nullptr;
  if (const int code = libusb_init(&context); code != 0) {
    return fail(std::string("libusb does not start (") + libusb_error_name(code) + ")", "USB",
                "check that /dev/bus/usb can be read");
  }
  return LibusbContext(context);
}

bool matches(libusb_device* device, const UsbMatch& match) {
  libusb_device_descriptor d{};
  if (libusb_get_device_descriptor(device, &d) != 0) return false;
  if (match.vendor != 0 && d.idVendor != match.vendor) return false;
  if (!match.products.empty() &&
      std::find(match.products.begin(), match.products.end(), d.idProduct) == match.products.end()) {
    return false;
  }
  return !match.interface_class || has_interface(device, *match.interface_class);
}

UsbProblem problem_of(int code) {
  switch (code) {
    case 0:
      return UsbProblem::none;
    case LIBUSB_ERROR_ACCESS:
      return UsbProblem::no_permission;
    case LIBUSB_ERROR_BUSY:
      return UsbProblem::busy;
    case LIBUSB_ERROR_NOT_FOUND:
      return UsbProblem::wrong_interface;
    case LIBUSB_ERROR_NO_DEVICE:
      return UsbProblem::not_attached;
    default:
      return UsbProblem::other;
  }
}

std::string serial_of(libusb_device_handle* handle) {
  libusb_device_descriptor d{};
  return libusb_get_device_descriptor(libusb_get_device(handle), &d) == 0 ? string_of(handle, d.iSerialNumber)
                                                                          : std::string();
}

LibusbHandle open_first(libusb_context* context, const UsbMatch& match, int interface_number, UsbProblem& problem) {
  LibusbHandle handle;
  problem = UsbProblem::not_attached;
  int found = 0;
  if (match.alone && match.serial.empty()) each_match(context, match, [&](libusb_device*) { return ++found > 1; });
  if (found > 1) {
    problem = UsbProblem::several;
    return handle;
  }
  each_match(context, match, [&](libusb_device* device) {
    const UsbProblem why = problem_of(open_and_claim(device, interface_number, handle, match.serial));
    if (why != UsbProblem::not_attached) problem = why;  // another serial number is no problem
    return handle != nullptr;
  });
  return handle;
}

Result<std::vector<UsbDeviceInfo>> list_usb_devices(const UsbMatch& match, int interface_number) {
  auto context = open_libusb();
  if (!context) return tl::unexpected(context.error());
  std::vector<UsbDeviceInfo> found;
  each_match(context->get(), match, [&](libusb_device* device) {
    libusb_device_descriptor d{};
    libusb_get_device_descriptor(device, &d);
    UsbDeviceInfo info{.vendor = d.idVendor,
                       .product = d.idProduct,
                       .bus = libusb_get_bus_number(device),
                       .address = libusb_get_device_address(device)};
    LibusbHandle handle;
    const int code = open_and_claim(device, interface_number, handle);
    info.problem = problem_of(code);
    if (code != 0) info.problem_detail = libusb_error_name(code);
    if (handle) {
      info.product_name = string_of(handle.get(), d.iProduct);
      info.serial = string_of(handle.get(), d.iSerialNumber);
      if (interface_number >= 0) libusb_release_interface(handle.get(), interface_number);
    }
    found.push_back(info);
    return false;
  });
  return found;
}

bool usb_built_in() { return true; }

}  // namespace tangent
