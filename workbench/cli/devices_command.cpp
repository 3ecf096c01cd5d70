// workbench devices: lists attached devices, their capabilities, and why one can't be opened; --check: brings one up;
// --calibrate: measures its torque scale.
#include "core/io/atomic_file.h"
#include "workbench/bringup/scale_calibration.h"
#include "workbench/cli/calibrate_device.h"
#include "workbench/cli/check_device.h"
#include "workbench/cli/command.h"
#include "workbench/cli/device_list.h"
#include "workbench/cli/device_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/refuse.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct DevicesOptions {
  std::filesystem::path json;
  DeviceCheck check;
  std::string calibrated;  ///< empty: none
};

/// The names of --force that can be brought up.
const std::vector<std::string_view>& checked_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const std::string& name : force_device_names())
      if (name != "none") all.push_back(name);
    return all;
  }();
  return names;
}

/// What makes no sense together.
Status check_usage(const DeviceCheck& check, const std::string& calibrated) {
  const std::string& kind = calibrated.empty() ? check.kind : calibrated;
  if (kind.empty() && (!check.out.empty() || !check.packets.empty() || check.without_waiting))
    return fail("is missing", {}, "say which device, or leave --out, --packets and --without-waiting out");
  if (check.without_waiting && !are_simulated({kind, "none"}))
    return fail("is of a real device, which keeps real time", {}, "leave --without-waiting out");
  return {};
}

Status run_devices(const std::filesystem::path& json_file, const DeviceOptions& drivers) {
  nlohmann::json report = nlohmann::json::array();
  const std::string text = list_devices(drivers, report);
  if (!json_file.empty()) {
    if (Status written = write_file_atomic(json_file, report.dump(2) + "\n"); !written) return written;
  }
  std::fputs(text.c_str(), stdout);
  return {};
}

Result<int> run_one(const DevicesOptions& options) {
  if (options.calibrated.empty()) return check_device(options.check);
  const DeviceCheck& given = options.check;
  return calibrate_device({options.calibrated, given.drivers, given.packets, given.without_waiting});
}

}  // namespace

void add_devices_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "devices", "What is attached, what it can do, why it can't be opened");
  auto options = std::make_shared<DevicesOptions>();
  DeviceCheck& check = options->check;
  add_text_option(*command, "--json", options->json, "What is attached, for programs", "F.json");
  add_choice_option(*command, "--check", checked_names(),
                    "Bring this force device up, step by step: it asks before anything moves",
                    [&check](int i) { check.kind = checked_names()[static_cast<std::size_t>(i)]; });
  add_choice_option(*command, "--calibrate", calibrated_names(),
                    "Measure the torque scale of a Falcon with a spring scale, step by step; simulated: a rehearsal",
                    [&o = *options](int i) { o.calibrated = calibrated_names()[static_cast<std::size_t>(i)]; });
  for (const char* other : {"--check", "--json"}) exclude_each_other(*command, "--calibrate", other);
  add_text_option(*command, "--out", check.out, "Protocol of --check; beside it the same as a page, F.md", "F.json");
  add_number_option(*command, "--limit-n", {.min = 0.1, .max = 20, .unit = "N"},
                    "Largest force of --check (default 1), never above the device's continuous one",
                    [&check](double v) { check.most_n = v; });
  add_flag(*command, "--without-waiting", check.without_waiting,
           "--check or --calibrate of a simulated device in simulated time, its hand led as the person is asked to");
  add_text_option(*command, "--packets", check.packets,
                  "Log every USB packet of --check or --calibrate to this file, for bug reports", "F.txt");
  for (const char* other : {"--out", "--limit-n"}) exclude_each_other(*command, "--calibrate", other);
  add_driver_options(*command, check.drivers);
  on_run(*command, [options, &result] {
    refuse_failed(options->calibrated.empty() ? "--check" : "--calibrate",
                  check_usage(options->check, options->calibrated));
    if (options->check.kind.empty() && options->calibrated.empty()) {
      const Status status = run_devices(options->json, options->check.drivers);
      if (!status) print_message("devices", status.error().message());
      result.exit_code = status ? kDone : kFailed;
      return;
    }
    const Result<int> code = run_one(*options);
    if (!code) print_message("devices", code.error().message());
    result.exit_code = code ? *code : kFailed;
  });
}

}  // namespace tangent
