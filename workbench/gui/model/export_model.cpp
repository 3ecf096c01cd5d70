#include "workbench/gui/model/export_model.h"

#include "workbench/gui/model/export_samples.h"
#include "workbench/gui/model/local_time.h"
#include "workbench/session/csv_metadata.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

std::filesystem::path free_path(const std::filesystem::path& folder, const std::string& stem, const char* extension) {
  for (int i = 1;; ++i) {
    std::filesystem::path path = folder / (stem + (i > 1 ? "-" + std::to_string(i) : "") + extension);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return path;
  }
}

}  // namespace

ExportModel::ExportModel(const AppOptions& options, MessageLog& messages)
    : messages_(messages), deterministic_(options.deterministic), screenshots_(options.screenshots) {
  if (!screenshots_.empty()) folder_ = screenshots_;
}

void ExportModel::start(std::string what, Work work) {
  if (writing())
    return messages_.say(Severity::warning, what + " is not written: wait for " + what_ + ", or cancel it");
  what_ = std::move(what);
  started_s_ = messages_.now_s();
  stop_ = std::stop_source();
  writing_ = std::async(deterministic_ ? std::launch::deferred : std::launch::async,
                        [work = std::move(work), stop = stop_.get_token()] { return work(stop); });
  if (deterministic_) writing_.wait();
  take_finished();
}

void ExportModel::write_ticks(const HistorySnapshot& records, std::uint64_t from, std::uint64_t to,
                              const FileOrigin& origin) {
  if (records.empty()) return;
  const auto path =
      free_path(folder_, "ticks-" + std::to_string(from) + "-" + std::to_string(to > 0 ? to - 1 : 0), ".csv");
  start(path.filename().string(),
        [records, from, to, path, origin](const std::stop_token& stop) -> Result<std::string> {
          const auto lines = export_samples(records, from, to, path, stop);
          if (!lines) return tl::unexpected(lines.error());
          if (Status beside = write_csv_metadata(path, samples_header(), origin); !beside)
            return tl::unexpected(beside.error());
          return std::to_string(*lines) + " ticks written to " +
                 std::filesystem::absolute(path).lexically_normal().string();
        });
}

void ExportModel::take_finished() {
  if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const Result<std::string> done = writing_.get();
  if (done)
    messages_.say(Severity::note, *done);
  else
    messages_.say(Severity::error, done.error().message());
}

void ExportModel::ask_for_picture(const std::string& what, const Rect& of) {
  picture_request_ = PictureRequest{free_path(folder_, what, ".png"), of};
}

std::optional<std::filesystem::path> ExportModel::take_screenshot_request() {
  if (!std::exchange(screenshot_wanted_, false)) return std::nullopt;
  return free_path(screenshots_, "tangent-workbench-" + local_time("%Y%m%d-%H%M%S"), ".png");
}

}  // namespace tangent
