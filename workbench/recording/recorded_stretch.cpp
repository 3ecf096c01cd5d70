#include "workbench/recording/recorded_stretch.h"

#include <set>
#include <system_error>

namespace tangent {
namespace {

constexpr std::size_t kBatch = 4096;  // ticks a transaction

/// The presets and scenes that the ticks name.
Status put_named(RecordingFile& file, const RecordedStretch& stretch) {
  std::set<std::uint32_t> presets, scenes;
  const HistorySnapshot& records = stretch.run.records;
  for (std::size_t i = 0; i < records.size(); ++i) {
    presets.insert(records[i].tick.preset_id);
    scenes.insert(records[i].scene_id);
  }
  for (const std::uint32_t id : presets) {
    if (id >= stretch.run.presets.size()) return fail("preset " + std::to_string(id) + " is gone");
    if (Status ok = file.add_preset(id, stretch.run.presets[id]); !ok) return ok;
  }
  for (const std::uint32_t id : scenes) {
    const auto scene = stretch.run.scenes.find(id);
    if (scene == stretch.run.scenes.end()) return fail("the mesh of scene " + std::to_string(id) + " is gone");
    const auto known = stretch.scenes.find(id);
    const bool whole = known != stretch.scenes.end() && (known->second.source.mesh || known->second.source.polygon);
    const std::string name = known != stretch.scenes.end() ? known->second.name : scene->second->mesh().name();
    if (Status ok = file.add_scene(id, *scene->second, name, whole ? &known->second.source : nullptr); !ok) return ok;
  }
  return {};
}

Status put_ticks(RecordingFile& file, const RecordedStretch& stretch) {
  const HistorySnapshot& records = stretch.run.records;
  const std::uint64_t first = records.oldest().tick.tick, last = records.newest().tick.tick;
  for (std::size_t i = 0; i < records.size();) {
    RecordedBatch batch;
    for (const std::size_t end = std::min(records.size(), i + kBatch); i < end; ++i) batch.ticks.push_back(records[i]);
    if (i == records.size())
      for (const RecordedEvent& event : stretch.events)
        if (first <= event.tick && event.tick <= last) batch.events.push_back(event);
    if (Status ok = file.write(batch); !ok) return ok;
  }
  return {};
}

}  // namespace

Status write_stretch(const RecordedStretch& stretch, const std::filesystem::path& path) {
  if (stretch.run.records.empty()) return fail("there is no tick to record", path.string(), "let the servo run first");
  Result<RecordingFile> file = RecordingFile::create(path, stretch.values);
  if (!file) return tl::unexpected(file.error());
  Status done = put_named(*file, stretch);
  if (done) done = put_ticks(*file, stretch);
  if (done) done = file->close();
  if (done) return done;
  { const RecordingFile closed = std::move(*file); }
  RecordingFile::remove_parts(path);
  return done;
}

}  // namespace tangent
