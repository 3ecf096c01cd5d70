// workbench devices: lists attached devices, their capabilities, and why one can't be opened.
#include "core/io/atomic_file.h"
#include "devices/cld/cld_controller.h"
#include "devices/device_set.h"
#include "workbench/cli/command.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

namespace tangent {
namespace {

constexpr int kAskFor_ms = 1000;  // a controller answers within a few ms

std::string timeout_text(double seconds) {
  return seconds > 0.0 ? format("stops by itself %.0f ms after the last command", seconds * 1e3)
                       : "no time-out of its own";
}

std::string force_text(const ForceCapabilities& c) {
  std::string text = format(
      "%s\n  force      peak %.1f N, continuous %.1f N, along %s\n  stable     up to %.0f N/m and %.0f N s/m\n"
      "  position   %.0f um steps; workspace %.0f x %.0f x %.0f mm; rotations sensed: %s; %d buttons\n",
      c.name.c_str(), c.peak_force_n, c.continuous_force_n, pushed_axes(c).c_str(), c.largest_stiffness_n_per_m,
      c.largest_damping_n_s_per_m, c.position_resolution_m * 1e6, c.workspace_half_size_m.x * 2e3,
      c.workspace_half_size_m.y * 2e3, c.workspace_half_size_m.z * 2e3, sensed_rotations(c).c_str(), c.buttons);
  if (!(c.frame == DeviceFrame{})) text += "  frame      " + frame_text(c.frame) + "\n";
  return text + format("  mass       %.0f g apparent\n  rate       %.0f Hz\n  firmware   %s\n",
                       c.apparent_mass_kg * 1e3, c.rate_hz, timeout_text(c.firmware_timeout_s).c_str());
}

std::string display_text(const std::string& name, double travel_m, double step_m, double bandwidth_hz, double rate_hz,
                         double timeout_s) {
  std::string text = name + format("\n  travel     %.1f mm, %.2f um steps\n", travel_m * 1e3, step_m * 1e6);
  if (bandwidth_hz > 0.0) text += format("  bandwidth  %.1f Hz\n", bandwidth_hz);
  return text + format("  rate       %.0f Hz\n  firmware   %s\n", rate_hz, timeout_text(timeout_s).c_str());
}

/// Queries the first CLD controller's identity; empty when it does not answer.
LinkReport ask_cld() {
  LinkReport report;
  CldController cld;
  if (!cld.open()) return report;
  for (int waited = 0; waited < kAskFor_ms; waited += 5) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    cld.exchange({}, 5e-3);
    cld.report(report);
    if (!report.identity.empty()) break;
  }
  report.round_trip_us = report.arrival_us = nullptr;
  return report;
}

std::string usb_name(const UsbDeviceInfo& d, const char* kind) {
  std::string text = format("%s %04x:%04x on bus %d, address %d", kind, d.vendor, d.product, d.bus, d.address);
  if (!d.product_name.empty()) text += ", " + d.product_name;
  if (!d.serial.empty()) text += ", serial " + d.serial;
  return text;
}

nlohmann::json usb_json(const UsbDeviceInfo& d, const char* kind) {
  nlohmann::json j{{"kind", kind}, {"vendor", d.vendor},   {"product", d.product},
                   {"bus", d.bus}, {"address", d.address}, {"can_be_opened", d.problem == UsbProblem::none}};
  if (d.problem != UsbProblem::none) j["problem"] = usb_error(d.problem, kind, d.problem_detail).message();
  return j;
}

std::string attached_text(const UsbDeviceInfo& d, const char* kind, bool cld, nlohmann::json& report) {
  report.push_back(usb_json(d, kind));
  if (d.problem != UsbProblem::none) {
    const Error why = usb_error(d.problem, "", d.problem_detail);
    return usb_name(d, kind) + "\n  " + why.what + "\n  " + why.remedy + "\n";
  }
  if (!cld) {
    const DisplayCapabilities can = MaestroDisplay().capabilities();
    return display_text(usb_name(d, kind), can.travel_m, can.resolution_m, 0.0, can.rate_hz, can.firmware_timeout_s) +
           "  open loop: its position is where it was sent\n";
  }
  const LinkReport said = ask_cld();
  if (said.identity.empty()) {
    report.back()["problem"] = usb_error(UsbProblem::wrong_interface, kind).message();
    return usb_name(d, kind) +
           "\n  does not answer as a CLD controller\n  load its firmware (devices/cld_protocol.md)\n";
  }
  report.back()["identity"] = said.identity;
  report.back()["travel_m"] = said.travel_m;
  return display_text(usb_name(d, kind) + ", " + said.identity, said.travel_m, said.resolution_m, said.bandwidth_hz,
                      said.rate_hz, said.firmware_timeout_s);
}

Status run_devices(const std::filesystem::path& json_file) {
  std::string text = "Simulated\n\n";
  const auto simulated = make_devices(DeviceNames{});
  const DisplayCapabilities& display = simulated->display->capabilities();
  text += force_text(simulated->force->capabilities()) + "\n" +
          display_text(display.name, display.travel_m, display.resolution_m, display.bandwidth_hz, display.rate_hz,
                       display.firmware_timeout_s);
  text += "\nUSB\n\n";
  nlohmann::json report = nlohmann::json::array();
  struct Kind {
    const char* name;
    UsbLinkOptions link;
    bool cld;
  };
  for (const Kind& kind :
       {Kind{"CLD controller", cld_link_options(), true}, Kind{"Pololu Maestro", maestro_link_options(), false}}) {
    const auto found = list_usb_devices(kind.link.match, kind.link.interface_number);
    if (!found) {
      text += found.error().what + "\n  " + found.error().remedy + "\n";
      report.push_back({{"problem", found.error().message()}});
      break;
    }
    if (found->empty()) text += std::string(kind.name) + ": none attached\n";
    for (const UsbDeviceInfo& d : *found) text += attached_text(d, kind.name, kind.cld, report);
  }
  if (!json_file.empty()) {
    if (Status written = write_file_atomic(json_file, report.dump(2) + "\n"); !written) return written;
  }
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace

void add_devices_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "devices", "What is attached, what it can do, why it can't be opened");
  auto json = std::make_shared<std::filesystem::path>();
  add_text_option(*command, "--json", *json, "USB devices for programs", "F.json");
  on_run(*command, [json, &result] {
    const Status status = run_devices(*json);
    if (!status) print_message("devices", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
