// What a report says of one recording, as plain data; the page is written from it alone.
#pragma once

#include "core/lab/audit/mesh_audit.h"
#include "core/lab/explain/tick_cause.h"
#include "workbench/bench/compare_methods.h"
#include "workbench/recording/replay.h"
#include "workbench/report/recording_summary.h"

#include <functional>
#include <string>
#include <vector>

namespace tangent {

/// A value, or why there is none: a sentence for the page.
template <class T>
using Known = tl::expected<T, std::string>;

/// A tick as a picture shows it: `tick.kept` is the state before it.
struct TickToDraw {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  TickRecord tick;
  bool dark = false;
};
/// Gives the bytes of a PNG file.
using DrawTick = std::function<Result<std::string>(const TickToDraw&)>;

struct SceneReport {
  RecordedScene recorded;
  RecordingSummary::Use use;
  std::uint64_t vertices = 0;  ///< of a polygon
  Known<MeshAudit> audit = tl::unexpected(std::string());
};

/// The worst tick of a kind: why, what cures it, what it looks like.
struct ExplainedTick {
  TickTrouble trouble = TickTrouble::unconverged;
  WorstTick worst;
  TickOutput output;
  TickCause cause = TickCause::not_told;
  Known<std::string> why = tl::unexpected(std::string());                                          ///< explanation_text
  Known<std::string> light = tl::unexpected(std::string()), dark = tl::unexpected(std::string());  ///< PNG
};

struct RecordingReport {
  std::filesystem::path path;
  RecordingInfo info;
  std::map<std::uint32_t, Preset> presets;  ///< those that ticks name
  std::vector<RecordedValue> values;
  std::vector<RecordedEvent> events;
  RecordingSummary summary;
  std::vector<SceneReport> scenes;  ///< those that ticks name
  Known<ReplayReport> replayed = tl::unexpected(std::string());
  bool replayed_whole = false;           ///< else a tick a second
  std::vector<ExplainedTick> explained;  ///< of every kind that there is
  Known<bench::MethodComparison> methods = tl::unexpected(std::string());
};

struct GatherOptions {
  /// In place of the mesh of recordings without theirs; must have the recorded hash.
  std::shared_ptr<const ContactScene> scene;
  SceneSource source;                 ///< of it
  DrawTick draw;                      ///< empty: no pictures
  std::uint64_t most_ticks = 20'000;  ///< of the motion that every method solves
  bench::CompareMethodsOptions methods;
  std::function<bool()> cancelled = [] { return false; };
};

/// Reads it, solves what has to be solved, and draws. Fails where the recording can't be read, is empty, or
/// `cancelled`.
Result<RecordingReport> gather(const std::filesystem::path& path, const GatherOptions& options);

}  // namespace tangent
