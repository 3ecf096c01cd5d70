#include "workbench/recording/export.h"

#include "workbench/recording/exporter.h"

namespace tangent {
namespace {

struct ExportFormat {
  std::string_view ending;
  UsualColumns usual;
  Result<std::unique_ptr<Exporter>> (*make)(const ExportTarget&, std::vector<ExportedColumn>);
};
constexpr ExportFormat kFormats[]{{".csv", UsualColumns::of_ticks_csv, csv_exporter},
                                  {".mcap", UsualColumns::all, mcap_exporter},
                                  {".mat", UsualColumns::all, mat_exporter}};

Result<const ExportFormat*> format_of(const std::filesystem::path& to) {
  const std::string ending = to.extension().string();
  for (const ExportFormat& format : kFormats)
    if (ending == format.ending) return &format;
  return fail("'" + ending + "' is no format that is exported", to.string(), "end the name in .csv, .mcap or .mat");
}

}  // namespace

Status check_export(const std::filesystem::path& to, const ExportOptions& options) {
  const Result<const ExportFormat*> format = format_of(to);
  if (!format) return tl::unexpected(format.error());
  const auto columns = chosen_columns(options.channels, (*format)->usual);
  return columns ? Status() : tl::unexpected(columns.error());
}

Result<std::uint64_t> export_ticks(const std::filesystem::path& from, const std::filesystem::path& to,
                                   const ExportOptions& options) {
  Result<Recording> recording = Recording::open(from);
  if (!recording) return tl::unexpected(recording.error());
  const RecordingInfo& info = recording->info();
  if (Status ok = check_export(to, options); !ok) return tl::unexpected(ok.error());
  const ExportFormat& format = **format_of(to);
  Result<std::unique_ptr<Exporter>> exporter =
      format.make({from, to, info, options.cancelled}, *chosen_columns(options.channels, format.usual));
  if (!exporter) return tl::unexpected(exporter.error());
  const auto tick_at = [&](const std::optional<double>& t_s, std::uint64_t otherwise) -> Result<std::uint64_t> {
    return t_s ? recording->tick_at(*t_s) : Result<std::uint64_t>(otherwise);
  };
  const Result<std::uint64_t> first = tick_at(options.from_s, info.first_tick);
  if (!first) return first;
  Result<TickReader> ticks = recording->ticks(*first, info.last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  std::uint64_t count = 0;
  for (RecordedTick tick;; ++count) {
    if (options.cancelled()) return fail("was interrupted", to.string(), "nothing is left of it");
    const Result<bool> any = ticks->next(tick);
    if (!any) return tl::unexpected(any.error());
    if (!*any || (options.to_s && tick.record.tick.input.t_s > *options.to_s)) break;
    if (Status ok = (*exporter)->add(tick); !ok) return tl::unexpected(ok.error());
  }
  if (count == 0) return fail("has no tick between these times", from.string(), "choose others with --from and --to");
  if (Status ok = (*exporter)->commit(); !ok) return tl::unexpected(ok.error());
  return count;
}

}  // namespace tangent
