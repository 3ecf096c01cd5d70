// workbench devices: lists attached devices, their capabilities, and why one can't be opened.
#include "core/io/atomic_file.h"
#include "workbench/cli/command.h"
#include "workbench/cli/device_list.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

Status run_devices(const std::filesystem::path& json_file) {
  nlohmann::json report = nlohmann::json::array();
  const std::string text = list_devices({}, report);
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
  add_text_option(*command, "--json", *json, "What is attached, for programs", "F.json");
  on_run(*command, [json, &result] {
    const Status status = run_devices(*json);
    if (!status) print_message("devices", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
