#include "devices/falcon/falcon_device.h"

#include "core/base/float_state.h"
#include "devices/falcon/falcon_firmware.h"

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr const char* kFalconName = "Novint Falcon";

std::string named(const std::string& serial) {
  return serial.empty() ? kFalconName : std::string(kFalconName) + " " + serial;
}

/// Those that can be read: of one that can't, the device says that it runs none when it is there.
FalconDriver::Firmwares kept_firmwares(const FalconOptions& options) {
  FalconDriver::Firmwares all;
  if (!options.firmware.empty()) return all;
  for (const auto& [serial, kept] : options.kept) {
    if (kept.firmware.empty()) continue;
    if (auto firmware = read_falcon_firmware(kept.firmware, kept.firmware_sha256))
      all.emplace(serial, std::move(firmware->bytes));
  }
  return all;
}

UsbLinkOptions link_for(const FalconOptions& options) {
  UsbLinkOptions link = options.link;
  link.match.serial = options.serial;
  return link;
}

}  // namespace

UsbLinkOptions falcon_link_options() {
  UsbLinkOptions o;
  o.match.vendor = 0x0403;
  o.match.products = {0xcb48};
  o.match.alone = true;
  o.in_endpoint = 0x81;
  o.out_endpoint = 0x02;
  o.bulk = true;
  o.ask_serial = true;
  return o;
}

FalconDevice::FalconDevice(const FalconOptions& options)
    : options_(options),
      capabilities_(falcon_capabilities(options)),
      link_(link_for(options), *this, options.tap),
      driver_(std::make_unique<FalconDriver>(options, std::vector<std::uint8_t>())) {}

Status FalconDevice::check_attached() const {
  if (!options_.serial.empty()) return {};
  const auto found = list_usb_devices(options_.link.match, options_.link.interface_number);
  if (!found) return tl::unexpected(found.error());
  if (found->size() < 2) return {};
  std::vector<std::string> serials;
  for (const UsbDeviceInfo& device : *found)
    serials.push_back(device.serial.empty() ? "(not readable)" : device.serial);
  std::sort(serials.begin(), serials.end());
  std::string list;
  for (const std::string& serial : serials) list += (list.empty() ? "" : ", ") + serial;
  return fail("there are " + std::to_string(found->size()) + ", with the serial numbers " + list, kFalconName,
              "choose one: --falcon-serial NUMBER");
}

Status FalconDevice::open() {
  if (opened_) return fail("is already open", kFalconName, "close it first");
  const std::uint32_t stops_before = stops();
  std::vector<std::uint8_t> bytes;
  if (!options_.firmware.empty()) {
    auto firmware = read_falcon_firmware(options_.firmware, options_.firmware_sha256);
    if (!firmware) return tl::unexpected(firmware.error());
    bytes = std::move(firmware->bytes);
  }
  if (const Status one = check_attached(); !one) return one;
  auto driver = std::make_unique<FalconDriver>(options_, std::move(bytes), kept_firmwares(options_));
  {
    const std::lock_guard lock(driver_lock_);
    driver_.swap(driver);
    if (stops_ != stops_before) driver_->stop();  // one that came meanwhile holds for the new driver, too
  }
  if (const Status started = link_.start(); !started) return started;
  opened_ = true;
  return {};
}

void FalconDevice::close() {
  if (!opened_) return;
  driver_->line().end();
  link_.stop();
  opened_ = false;
}

ForceSample FalconDevice::exchange(const ForceCommand& command, double) noexcept {
  const FloatState as_tested;
  if (!opened_) return {};
  const ForceSample sample = driver_->exchange(command, usb_now_ns);
  link_.wake();
  return sample;
}

void FalconDevice::on_open(UsbLink& link) noexcept {
  {
    const std::lock_guard lock(serial_lock_);
    serial_ = link.serial();
  }
  driver_->opened(link.serial(), usb_now_ns());
}

std::uint32_t FalconDevice::stops() const {
  const std::lock_guard lock(driver_lock_);
  return stops_;
}

bool FalconDevice::emergency_stop() noexcept {
  {
    const std::lock_guard lock(driver_lock_);
    ++stops_;
    driver_->stop();
  }
  link_.wake();
  return true;
}

void FalconDevice::on_packet(UsbLink&, std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  for (std::size_t i = 0; i < last_packet_.size(); ++i) {
    std::uint64_t word = 0;
    for (std::size_t j = 0; j < 8 && 8 * i + j < bytes.size(); ++j) word |= std::uint64_t{bytes[8 * i + j]} << (8 * j);
    last_packet_[i].store(word, kRelaxed);
  }
  last_packet_bytes_.store(static_cast<std::uint32_t>(bytes.size()), kRelaxed);
  driver_->line().packet(bytes, now_ns);
}

std::string FalconDevice::problem() const {
  const std::string name = named(options_.serial);
  if (!link_.connected()) return usb_error(link_.problem(), name).message();
  const FalconLine& line = driver_->line();
  const std::string failed = line.failed_step();
  switch (line.phase()) {
    case FalconPhase::asking:
    case FalconPhase::running:
      return {};
    case FalconPhase::uploading:
      return failed.empty() ? std::string() : Error{"its firmware is loaded again: " + failed, name, "wait"}.message();
    case FalconPhase::no_firmware:
      return Error{"runs no firmware", name, "name its maker's firmware file: --falcon-firmware F"}.message();
    case FalconPhase::not_loaded:
      return Error{"its firmware could not be loaded" + (failed.empty() ? ": it doesn't start" : ", at " + failed),
                   name, "check its power supply, plug it in again without a hub, then arm"}
          .message();
  }
  return {};
}

bool FalconDevice::report(LinkReport& out) const {
  const UsbCounters& usb = link_.counters();
  const std::lock_guard driver_stays(driver_lock_);
  const FalconLine& line = driver_->line();
  out.connected = link_.connected();
  if (out.connected && line.phase() == FalconPhase::running)
    out.identity = "firmware runs, " + std::to_string(driver_->legs_homed()) + " of 3 legs homed" +
                   (driver_->calibrated() ? "" : ", torque not calibrated: 1 N at most");
  {
    const std::lock_guard lock(serial_lock_);
    out.serial = serial_;
  }
  out.problem = problem();
  out.rate_hz = capabilities_.rate_hz;
  out.packets_in = usb.packets_in;
  out.packets_out = usb.packets_out;
  out.controls = usb.controls;
  out.empty_packets = usb.empty_packets;
  out.short_packets = usb.short_packets;
  out.stalls = usb.stalls;
  out.time_outs = usb.time_outs;
  out.errors = usb.errors;
  out.refused_sends = usb.refused_sends;
  out.connects = usb.connects;
  out.frames = line.answers();
  out.skipped_bytes = line.skipped();
  out.lost = line.lost();
  for (std::size_t i = 0; i < out.last_packet.size(); ++i)
    out.last_packet[i] =
        static_cast<std::uint8_t>((last_packet_[i / 8].load(std::memory_order_relaxed) >> (8 * (i % 8))) & 0xffu);
  out.last_packet_bytes = last_packet_bytes_;
  return true;
}

}  // namespace tangent
