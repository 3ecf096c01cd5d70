// workbench figures: reproduces the paper's figures and its curvature table.
#include "workbench/cli/command.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

/// The table beside the paper's "less than 0.4 % at five segments".
std::string deviation_text() {
  std::string text =
      "curvature of the rendered curve against the circle's, over the paper's arc (the paper: under 0.4 % at five "
      "segments)\n"
      "  placement   local centre   segments   RMS, %    largest, %\n";
  for (const DeviationRow& row : deviation_rows())
    text +=
        format("  %-11s %-14s %8d   %-9.4g %-9.4g\n", row.placement == ArcPlacement::tangent ? "tangent" : "inscribed",
               row.centre == LocalCentre::bisectors ? "bisectors" : "midpoint", row.segments, 100.0 * row.deviation.rms,
               100.0 * row.deviation.largest);
  return text;
}

Status write_figures(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    return fail("this folder can't be made", folder.string(), "name another with --out");
  for (const Figure& figure :
       {contact_location_figure(), iterations_figure(), travel_figure(), patches_figure(), labels_figure(),
        tangents_figure(), angles_figure(), lines_figure(), conditions_figure(true), conditions_figure(false),
        curvature_figure(), inner_corner_figure()}) {
    if (Status status = write_figure(figure, folder); !status) return status;
    std::fputs(format("%s.svg: %s\n", (folder / figure.name).c_str(), figure.title.c_str()).c_str(), stdout);
  }
  std::fputs(deviation_text().c_str(), stdout);
  return {};
}

}  // namespace

void add_figures_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "figures", "The paper's figures: SVG, with the data as CSV beside each");
  auto folder = std::make_shared<std::filesystem::path>();
  add_text_option(*command, "--out", *folder, "Folder to write into; made if it isn't there", "DIR", Needed::yes);
  on_run(*command, [folder, &result] {
    const Status status = write_figures(*folder);
    if (!status) print_message("figures", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
