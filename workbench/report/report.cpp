#include "workbench/report/report.h"

#include "core/io/atomic_file.h"
#include "workbench/report/page.h"

namespace tangent {

Result<std::filesystem::path> write_report(const ReportOptions& options) {
  // Before the work: whether each can be read at all, and the page written.
  for (const auto& path : options.recordings)
    if (const Result<Recording> recording = Recording::open(path); !recording) return tl::unexpected(recording.error());
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error || !std::filesystem::is_directory(options.folder))
    return fail("is no folder, nor can be made one" + (error ? ": " + error.message() : std::string()),
                options.folder.string(), "name another with --out");
  const std::filesystem::path target = options.folder / "report.html";
  Result<AtomicFile> file = AtomicFile::create(target);
  if (!file) return tl::unexpected(file.error());
  std::vector<RecordingReport> reports;
  for (const auto& path : options.recordings) {
    options.progress(path.string());
    Result<RecordingReport> report = gather(path, options.gather);
    if (!report) return tl::unexpected(report.error());
    reports.push_back(std::move(*report));
  }
  const Result<std::string> page = page_html(reports, {options.command});
  if (!page) return tl::unexpected(page.error());
  if (Status status = file->write(*page); !status) return tl::unexpected(status.error());
  if (Status status = file->commit(); !status) return tl::unexpected(status.error());
  return target;
}

}  // namespace tangent
