#include "workbench/gui/model/recording_model.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <string_view>
#include <utility>

namespace tangent {

namespace {

Result<RecordingModel::Loaded> load_recording(const std::filesystem::path& path, OpenedRecording::Options options,
                                              const Finger& finger) {
  const std::shared_ptr<const ContactScene> in_use = options.scene;
  Result<std::unique_ptr<OpenedRecording>> recording = OpenedRecording::open(path, std::move(options));
  if (!recording) return tl::unexpected(recording.error());
  RecordingModel::Loaded loaded{std::move(*recording), std::nullopt};
  const OpenedRecording& opened = *loaded.recording;
  if (opened.scene() != nullptr && opened.scene() != in_use)
    loaded.scene = load_built(opened.scene(), opened.source() != nullptr ? opened.source()->mesh : nullptr, finger);
  return loaded;
}

}  // namespace

RecordingModel::RecordingModel(const AppOptions& options, const SceneModel& scene, const PresetModel& presets,
                               const TimeModel& time, MessageLog& messages, std::function<void(Loaded)> loaded)
    : options_(options),
      scene_(scene),
      presets_(presets),
      time_(time),
      messages_(messages),
      loaded_(std::move(loaded)) {}

bool RecordingModel::is_recording(const std::filesystem::path& file) {
  if (file.extension() == ".sqlite") return true;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  constexpr std::string_view kBegin = "SQLite format 3";
  std::array<char, kBegin.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == kBegin;
}

void RecordingModel::open(const std::filesystem::path& file) {
  if (job_.valid()) {
    next_ = file;
    return;
  }
  path_ = file;
  const double ticks =
      std::min(options_.history_s * options_.servo_hz, static_cast<double>(kLargestHistoryBytes / sizeof(ServoRecord)));
  OpenedRecording::Options options{static_cast<std::size_t>(std::max(1.0, ticks)), !options_.deterministic,
                                   scene_.current()};
  if (options_.deterministic) return take(load_recording(file, std::move(options), presets_.current().finger));
  job_ = std::async(std::launch::async, [file, options = std::move(options), finger = presets_.current().finger] {
    return load_recording(file, options, finger);
  });
}

bool RecordingModel::busy() const {
  return opening() || (time_.recording() != nullptr && (time_.recording()->loading() || time_.selection_loading()));
}

void RecordingModel::update() {
  if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  Result<Loaded> loaded = job_.get();
  if (next_) return open(*std::exchange(next_, std::nullopt));
  take(std::move(loaded));
}

void RecordingModel::take(Result<Loaded> loaded) {
  if (loaded)
    loaded_(std::move(*loaded));
  else
    messages_.say(Severity::error, loaded.error().message());
}

}  // namespace tangent
