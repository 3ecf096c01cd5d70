#include "workbench/cli/device_list.h"

#include "devices/cld/cld_controller.h"
#include "devices/found_device.h"
#include "workbench/bringup/proved_devices.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

namespace tangent {
namespace {

constexpr int kAskFor_ms = 1000;  // a controller answers within a few ms

std::string timeout_text(double seconds) {
  return seconds > 0.0 ? format("stops by itself %.0f ms after the last command", seconds * 1e3)
                       : "no time-out of its own";
}

std::string known(double value, const char* pattern) { return value > 0.0 ? format(pattern, value) : "not known"; }

std::string force_text(const std::string& name, const ForceCapabilities& c) {
  if (c.peak_force_n <= 0.0 && !c.simulated) return name + "\n  force      not known until it is opened, as the rest\n";
  std::string text = format(
      "%s\n  force      peak %s, continuous %s, along %s\n  stable     up to %s and %s\n"
      "  position   %s steps; workspace %.0f x %.0f x %.0f mm; rotations sensed: %s; %d buttons\n",
      name.c_str(), known(c.peak_force_n, "%.1f N").c_str(), known(c.continuous_force_n, "%.1f N").c_str(),
      pushed_axes(c).c_str(), known(c.largest_stiffness_n_per_m, "%.0f N/m").c_str(),
      known(c.largest_damping_n_s_per_m, "%.0f N s/m").c_str(), known(c.position_resolution_m * 1e6, "%.0f um").c_str(),
      c.workspace_half_size_m.x * 2e3, c.workspace_half_size_m.y * 2e3, c.workspace_half_size_m.z * 2e3,
      sensed_rotations(c).c_str(), c.buttons);
  if (!(c.frame == DeviceFrame{})) text += "  frame      " + frame_text(c.frame) + "\n";
  return text + format("  mass       %s apparent\n  rate       %.0f Hz\n  firmware   %s\n",
                       known(c.apparent_mass_kg * 1e3, "%.0f g").c_str(), c.rate_hz,
                       timeout_text(c.firmware_timeout_s).c_str());
}

std::string display_text(const std::string& name, double travel_m, double step_m, double bandwidth_hz, double rate_hz,
                         double timeout_s) {
  std::string text = name + format("\n  travel     %.1f mm, %.2f um steps\n", travel_m * 1e3, step_m * 1e6);
  if (bandwidth_hz > 0.0) text += format("  bandwidth  %.1f Hz\n", bandwidth_hz);
  return text + format("  rate       %.0f Hz\n  firmware   %s\n", rate_hz, timeout_text(timeout_s).c_str());
}

std::string problem_text(const Error& problem) {
  std::string text = "  " + problem.what + "\n";
  return problem.remedy.empty() ? text : text + "  " + problem.remedy + "\n";
}

// --- Force devices -------------------------------------------------------------------------------------

/// What was proved on it, and when; empty: nothing.
std::string proved_line(const FoundDevice& found) {
  const std::filesystem::path path = proved_devices_path();
  if (path.empty() || found.serial.empty()) return {};
  const auto proved = read_proved(path, found.kind, found.serial);
  if (!proved) return proved.error().message();
  return *proved ? proved_text(**proved) : std::string();
}

std::string found_text(const FoundDevice& found, const DeviceOptions& options, nlohmann::json& report) {
  report.push_back({{"kind", found.kind}, {"name", found.name}, {"can_be_opened", found.can_be_opened()}});
  if (!found.serial.empty()) report.back()["serial"] = found.serial;
  const std::string name = found.kind + (found.name.empty() ? "" : ": " + found.name) +
                           (found.serial.empty() ? "" : ", serial " + found.serial);
  if (!found.can_be_opened()) {
    report.back()["problem"] = found.problem.message();
    return name + "\n" + problem_text(found.problem);
  }
  if (!found.attached) {
    report.back()["attached"] = false;
    return name +
           ", set up on this machine\n  whether it is attached only opening it tells: workbench devices --check " +
           found.kind + "\n";
  }
  const std::string proved = proved_line(found);
  if (!proved.empty()) report.back()["brought_up"] = proved;
  const auto made = make_devices({found.kind, "none"}, options);
  const std::string text = made && made->force ? force_text(name, made->force->capabilities()) : name + "\n";
  return text + "  proved     " + (proved.empty() ? "nothing yet: workbench devices --check " + found.kind : proved) +
         "\n";
}

std::string force_devices_text(const DeviceOptions& options, nlohmann::json& report) {
  const std::vector<FoundDevice> all = find_force_devices(options);
  std::string text;
  for (const std::string& kind : sought_force_devices()) {
    bool any = false;
    for (const FoundDevice& found : all)
      if (found.kind == kind) text += found_text(found, options, report), any = true;
    if (!any) text += kind + ": none attached\n";
  }
  return text;
}

// --- Contact displays ----------------------------------------------------------------------------------

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

/// `named`: what it is and where; the text of one that can be opened.
std::string cld_text(const std::string& named, nlohmann::json& entry) {
  const LinkReport said = ask_cld();
  if (said.identity.empty()) {
    entry["problem"] = usb_error(UsbProblem::wrong_interface, "CLD controller").message();
    return named + "\n  does not answer as a CLD controller\n  load its firmware (devices/cld_protocol.md)\n";
  }
  entry["identity"] = said.identity;
  entry["travel_m"] = said.travel_m;
  return display_text(named + ", " + said.identity, said.travel_m, said.resolution_m, said.bandwidth_hz, said.rate_hz,
                      said.firmware_timeout_s);
}

std::string maestro_text(const std::string& named, nlohmann::json&) {
  const DisplayCapabilities can = MaestroDisplay().capabilities();
  return display_text(named, can.travel_m, can.resolution_m, 0.0, can.rate_hz, can.firmware_timeout_s) +
         "  open loop: its position is where it was sent\n";
}

struct DisplayOnUsb {
  const char* name;
  UsbLinkOptions (*link)();
  std::string (*text)(const std::string& named, nlohmann::json& entry);
};
constexpr DisplayOnUsb kDisplaysOnUsb[] = {{"CLD controller", cld_link_options, cld_text},
                                           {"Pololu Maestro", maestro_link_options, maestro_text}};

std::string usb_name(const UsbDeviceInfo& d, const char* kind) {
  std::string text = format("%s %04x:%04x on bus %d, address %d", kind, d.vendor, d.product, d.bus, d.address);
  if (!d.product_name.empty()) text += ", " + d.product_name;
  if (!d.serial.empty()) text += ", serial " + d.serial;
  return text;
}

std::string attached_text(const UsbDeviceInfo& d, const DisplayOnUsb& kind, nlohmann::json& report) {
  report.push_back({{"kind", kind.name},
                    {"vendor", d.vendor},
                    {"product", d.product},
                    {"bus", d.bus},
                    {"address", d.address},
                    {"can_be_opened", d.problem == UsbProblem::none}});
  if (d.problem == UsbProblem::none) return kind.text(usb_name(d, kind.name), report.back());
  report.back()["problem"] = usb_error(d.problem, kind.name, d.problem_detail).message();
  return usb_name(d, kind.name) + "\n" + problem_text(usb_error(d.problem, "", d.problem_detail));
}

std::string displays_text(nlohmann::json& report) {
  std::string text;
  for (const DisplayOnUsb& kind : kDisplaysOnUsb) {
    const UsbLinkOptions link = kind.link();
    const auto found = list_usb_devices(link.match, link.interface_number);
    if (!found) {
      report.push_back({{"problem", found.error().message()}});
      return text + found.error().what + "\n  " + found.error().remedy + "\n";
    }
    if (found->empty()) text += std::string(kind.name) + ": none attached\n";
    for (const UsbDeviceInfo& d : *found) text += attached_text(d, kind, report);
  }
  return text;
}

}  // namespace

std::string list_devices(const DeviceOptions& options, nlohmann::json& report) {
  const auto simulated = make_devices(DeviceNames{});
  const ForceCapabilities& force = simulated->force->capabilities();
  const DisplayCapabilities& display = simulated->display->capabilities();
  std::string text = "Simulated\n\n" + force_text(force.name, force) + "\n" +
                     display_text(display.name, display.travel_m, display.resolution_m, display.bandwidth_hz,
                                  display.rate_hz, display.firmware_timeout_s);
  const std::string forces = force_devices_text(options, report);
  if (!forces.empty()) text += "\nForce devices\n\n" + forces;
  return text + "\nContact displays on USB\n\n" + displays_text(report);
}

}  // namespace tangent
