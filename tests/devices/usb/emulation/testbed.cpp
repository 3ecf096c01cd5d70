#include "tests/devices/usb/emulation/testbed.h"

#include <umockdev.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace tangent::emulation {

namespace {

std::string hex(const Bytes& bytes) {
  std::string text;
  char digits[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits, sizeof digits, "%02X", byte);
    text += digits;
  }
  return text;
}

std::string number(const char* pattern, int value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

}  // namespace

Testbed::Testbed() : testbed_(umockdev_testbed_new()) {}
Testbed::~Testbed() { g_object_unref(testbed_); }

PluggedDevice::PluggedDevice(Testbed& testbed, UsbModel& model, int address, NodeBy by)
    : board(model),
      testbed_(testbed),
      model_(model),
      address_(address),
      by_(by),
      node_(number("/dev/bus/usb/001/%03d", address)),
      syspath_(number("/sys/devices/pci0000:00/usb1/1-%d", address)) {}

PluggedDevice::~PluggedDevice() {
  halt();
  if (plugged_) unplug();
}

void PluggedDevice::plug_in(int open_error) {
  board.plug_in();
  if (by_ == NodeBy::shim) attach_board(node_, board, open_error);
  const Bytes d = model_.descriptors();
  const auto id = [&d](std::size_t at) { return number("%04x", d[at] | (d[at + 1] << 8)); };
  const std::string device = "P: " + syspath_.substr(4) + "\nN: bus/usb/" + node_.substr(13) +
                             "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\n" + "E: DEVNAME=" + node_ +
                             "\nE: BUSNUM=001\n" + number("E: DEVNUM=%03d\n", address_) + "A: busnum=1\n" +
                             number("A: devnum=%d\n", address_) + "A: idVendor=" + id(8) + "\nA: idProduct=" + id(10) +
                             "\nA: bConfigurationValue=1\nA: speed=12\nH: descriptors=" + hex(d) + "\n";
  // Before the node is there: who opens one that nobody answers for is aborted by umockdev.
  if (by_ == NodeBy::umockdev) mock_node_ = std::make_unique<UmockdevNode>(testbed_.mock(), node_, board);
  GError* error = nullptr;
  if (!umockdev_testbed_add_from_string(testbed_.mock(), device.c_str(), &error)) {
    std::fprintf(stderr, "testbed: %s\n", error->message);
    std::abort();
  }
  umockdev_testbed_uevent(testbed_.mock(), syspath_.c_str(), "add");
  plugged_ = true;
}

void PluggedDevice::unplug() {
  board.unplug();
  if (by_ == NodeBy::shim) detach_board(node_);
  umockdev_testbed_uevent(testbed_.mock(), syspath_.c_str(), "remove");
  umockdev_testbed_remove_device(testbed_.mock(), syspath_.c_str());
  mock_node_.reset();
  plugged_ = false;
}

void PluggedDevice::run() {
  running_ = true;
  clock_ = std::thread([this] {
    timespec due{};
    clock_gettime(CLOCK_MONOTONIC, &due);
    while (running_) {
      due.tv_nsec += 1'000'000;
      if (due.tv_nsec >= 1'000'000'000) {
        due.tv_nsec -= 1'000'000'000;
        ++due.tv_sec;
      }
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
      board.tick();
    }
  });
}

void PluggedDevice::halt() {
  running_ = false;
  if (clock_.joinable()) clock_.join();
}

}  // namespace tangent::emulation
