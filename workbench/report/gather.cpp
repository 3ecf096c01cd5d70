#include "core/lab/explain/explain_tick.h"
#include "workbench/report/motion_parts.h"
#include "workbench/report/report_data.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr std::uint64_t kReplayedWhole = 200'000;  // ticks: a second or so

/// What one recording's parts are gathered with.
struct Gathering {
  Recording& recording;
  const GatherOptions& options;
  RecordingReport& report;
  Known<RecordedScenes> scenes;

  bool cancelled() const { return options.cancelled(); }
};

Known<MeshAudit> audit_of(Gathering& g, const RecordedScene& recorded, std::uint64_t& vertices) {
  if (!g.scenes) return tl::unexpected(g.scenes.error());
  const ContactScene& scene = *g.scenes->at(recorded.id);
  SceneSource source = g.options.source;
  if (!g.options.scene || scene_hash(*g.options.scene) != recorded.hash) {
    Result<SceneSource> kept = g.recording.scene_source(recorded.id);
    if (!kept) return tl::unexpected(kept.error().message());
    source = std::move(*kept);
  }
  if (source.polygon) vertices = source.polygon->vertices.size();
  if (!source.mesh) return tl::unexpected(std::string("a 2D scene has no mesh to audit"));
  return audit_mesh(*source.mesh, scene.mesh());
}

void gather_scenes(Gathering& g) {
  for (const RecordedScene& recorded : g.recording.scenes()) {
    const auto use = g.report.summary.scenes.find(recorded.id);
    if (use == g.report.summary.scenes.end()) continue;
    SceneReport scene{recorded, use->second};
    scene.audit = audit_of(g, recorded, scene.vertices);
    g.report.scenes.push_back(std::move(scene));
  }
}

void gather_replay(Gathering& g) {
  ReplayOptions options;
  options.scene = g.options.scene;
  options.cancelled = g.options.cancelled;
  g.report.replayed_whole = g.report.info.ticks <= kReplayedWhole;
  options.every_second = !g.report.replayed_whole;
  Result<ReplayReport> replayed = replay(g.report.path, options);
  if (replayed)
    g.report.replayed = std::move(*replayed);
  else
    g.report.replayed = tl::unexpected(replayed.error().message());
}

Known<std::string> picture(const Gathering& g, const TickBefore& before, bool dark) {
  if (!g.options.draw)
    return tl::unexpected(std::string("this program was built without the window, which draws them"));
  Result<std::string> png = g.options.draw({before.scene, before.preset, before.tick, dark});
  if (!png) return tl::unexpected(png.error().message());
  return std::move(*png);
}

void explain(Gathering& g, ExplainedTick& explained) {
  if (!g.scenes) {
    explained.why = explained.light = explained.dark = tl::unexpected(g.scenes.error());
    return;
  }
  const Result<TickBefore> before = tick_before(g.recording, *g.scenes, explained.worst.tick);
  if (!before) {
    explained.why = explained.light = explained.dark = tl::unexpected(before.error().message());
    return;
  }
  explained.output = before->tick.output;
  const TickExplanation why = explain_tick(before->scene, before->preset, before->tick.input, before->tick.kept);
  explained.cause = why.cause;
  explained.why = explanation_text(why);
  if (before->scene->planar() != nullptr) {
    explained.light = explained.dark = tl::unexpected(std::string("2D scenes are not drawn"));
    return;
  }
  explained.light = picture(g, *before, false);
  explained.dark = picture(g, *before, true);
}

void gather_explanations(Gathering& g) {
  for (const TickTrouble trouble : kTickTroubles) {
    const WorstTick& worst = g.report.summary.worst[static_cast<std::size_t>(trouble)];
    if (worst.count == 0 || g.cancelled()) continue;
    ExplainedTick explained;
    explained.trouble = trouble;
    explained.worst = worst;
    explain(g, explained);
    g.report.explained.push_back(std::move(explained));
  }
}

void gather_methods(Gathering& g) {
  if (!g.scenes) {
    g.report.methods = tl::unexpected(g.scenes.error());
    return;
  }
  const Result<std::vector<bench::MotionPart>> parts = motion_parts(g.recording, *g.scenes, g.options.most_ticks);
  if (!parts) {
    g.report.methods = tl::unexpected(parts.error().message());
    return;
  }
  bench::CompareMethodsOptions methods = g.options.methods;
  methods.stop = g.options.cancelled;
  const bench::TickClock clock;
  if (auto compared = bench::compare_methods(*parts, clock, methods)) g.report.methods = std::move(*compared);
}

void keep_used_presets(const Recording& recording, RecordingReport& report) {
  for (const auto& [id, preset] : recording.presets())
    if (report.summary.presets.contains(id)) report.presets[id] = preset;
}

bool keeps_all_scenes(const Recording& recording) {
  return std::all_of(recording.scenes().begin(), recording.scenes().end(),
                     [](const RecordedScene& scene) { return scene.has_bytes; });
}

}  // namespace

Result<RecordingReport> gather(const std::filesystem::path& path, const GatherOptions& options) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  RecordingReport report;
  report.path = path;
  report.info = recording->info();
  if (report.info.ticks == 0)
    return fail("holds no tick", path.string(), "record something first: workbench record --out F.sqlite");
  Result<std::vector<RecordedValue>> values = recording->values();
  if (!values) return tl::unexpected(values.error());
  report.values = std::move(*values);
  Result<std::vector<RecordedEvent>> events = recording->events();
  if (!events) return tl::unexpected(events.error());
  report.events = std::move(*events);
  Result<RecordingSummary> summary = summarise(*recording, options.cancelled);
  if (!summary) return tl::unexpected(summary.error());
  report.summary = std::move(*summary);
  keep_used_presets(*recording, report);

  Gathering g{*recording, options, report, tl::unexpected(std::string())};
  Result<RecordedScenes> scenes = scenes_of(*recording, options.scene);
  if (!scenes && (options.scene || keeps_all_scenes(*recording))) return tl::unexpected(scenes.error());
  if (scenes)
    g.scenes = std::move(*scenes);
  else  // recorded with --no-mesh: the page says so
    g.scenes = tl::unexpected(scenes.error().message());
  // Times first: what draws starts threads of its own.
  for (void (*part)(Gathering&) : {gather_methods, gather_scenes, gather_replay, gather_explanations}) {
    part(g);
    if (options.cancelled()) return fail("interrupted", path.string());
  }
  return report;
}

}  // namespace tangent
