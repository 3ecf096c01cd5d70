// workbench export: a recording's ticks for other programs.
#include "workbench/recording/export.h"

#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct ExportCommandOptions {
  std::filesystem::path recording, out;
  std::string channels;
  ExportOptions wanted;
};

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::string name;
  for (const char c : text + ",") {
    if (c != ',') {
      name += c;
    } else if (!name.empty()) {
      names.push_back(std::move(name));
      name.clear();
    }
  }
  return names;
}

Status run_export(ExportCommandOptions& options) {
  const InterruptGuard guard;
  options.wanted.cancelled = [] { return InterruptGuard::requested(); };
  std::error_code error;
  if (std::filesystem::equivalent(options.recording, options.out, error))
    return fail("would be written over its own source", options.out.string(), "choose another name with --out");
  const Result<std::uint64_t> ticks = export_ticks(options.recording, options.out, options.wanted);
  if (!ticks) return tl::unexpected(ticks.error());
  std::printf("%s: %llu ticks\n", options.out.c_str(), static_cast<unsigned long long>(*ticks));
  return {};
}

}  // namespace

void add_export_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "export", "Write a recording's ticks as CSV, MCAP or MATLAB file");
  auto options = std::make_shared<ExportCommandOptions>();
  add_text_option(*command, "RECORDING", options->recording, "A recording", "F.sqlite", Needed::yes);
  add_text_option(*command, "--out", options->out, "By its ending: .csv, as solve writes it, .mcap or .mat",
                  "F.csv|F.mcap|F.mat", Needed::yes);
  constexpr NumberRange kSeconds{.min = -1e9, .max = 1e9, .unit = "s"};
  add_number_option(*command, "--from", kSeconds, "First time (default: the first tick's)",
                    [options](double v) { options->wanted.from_s = v; });
  add_number_option(*command, "--to", kSeconds, "Last time (default: the last tick's)",
                    [options](double v) { options->wanted.to_s = v; });
  add_text_option(*command, "--channels", options->channels,
                  "Columns, separated by commas (default: in a CSV those of ticks.csv, else all)", "a,b");
  on_run(*command, [options, &result] {
    const ExportOptions& wanted = options->wanted;
    if (wanted.from_s && wanted.to_s && *wanted.from_s > *wanted.to_s)
      refuse_option("--to", "is before --from: there is nothing in between");
    options->wanted.channels = names_in(options->channels);
    if (const Status usage = check_export(options->out, options->wanted); !usage) {
      print_message("export", usage.error().message());
      result.exit_code = kUsage;
      return;
    }
    const Status status = run_export(*options);
    if (!status) print_message("export", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
