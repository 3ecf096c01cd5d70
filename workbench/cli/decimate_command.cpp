// workbench decimate: reduces a mesh to the fewest triangles that a finger can't tell from the original.
#include "core/io/atomic_file.h"
#include "core/io/file_name.h"
#include "core/io/mesh_io.h"
#include "core/io/rendering_condition.h"
#include "core/lab/gains/gain_tuning.h"
#include "core/lab/measure/decimate.h"
#include "core/lab/measure/perception.h"
#include "workbench/cli/command.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/own_file.h"
#include "workbench/cli/text_format.h"
#include "workbench/session/exploration_poses.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace tangent {
namespace {

constexpr std::uint64_t kDeviationSamples = 200000;
constexpr double kDeviationShare = 1e-3;  // of the longest side, by default
/// Collapses check the deviation one way, at samples. When the full two-way deviation is larger than allowed,
/// decimation is repeated with the distance reduced by this factor.
constexpr double kTighten = 0.6;
constexpr int kMostRounds = 4;

struct DecimateOptions {
  MeshOptions mesh;
  std::filesystem::path out, json;
  int condition = threshold_index("P1");
  double deviation_m = 0.0;  ///< 0: kDeviationShare
};

struct DecimateReport {
  std::string mesh;
  PerceptionThreshold threshold;
  DecimateLimits limits;
  double deviation_limit_m = 0.0;
  DecimateResult result;
  PerceptionAudit angles_before, angles_after;
  std::uint64_t over_before = 0, over_after = 0;  ///< curve edges above the limit
  SurfaceDeviation new_from_old, old_from_new;    ///< of points on the new surface from the old one, and vice versa
  RunScore run;
  bool within() const { return std::max(new_from_old.largest_m, old_from_new.largest_m) <= deviation_limit_m; }
};

/// Lower end of the confidence interval; pilot conditions only have a mean.
double angle_limit_deg(const PerceptionThreshold& t) { return t.interval_deg ? t.interval_deg->first : t.mean_deg; }

std::uint64_t count_over(const ContactMesh& mesh, double limit_deg) {
  const FacetAngles angles = facet_angles(mesh);
  std::uint64_t sides = 0;
  for (std::size_t t = 0; t < angles.sense.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      sides += angles.sense[t][k] == EdgeSense::curve &&
               static_cast<double>(angles.angle_deg[t][k]) > limit_deg * (1.0 + 1e-6);
  return sides / 2;
}

Result<std::shared_ptr<const ContactScene>> scene_of(const PolygonMesh& mesh) {
  ContactMeshOptions options;
  options.normals = NormalSource::file;
  Result<ContactMesh> built = ContactMesh::build(mesh, options);
  if (!built) return tl::unexpected(built.error());
  return ContactScene::build(std::move(*built));
}

/// Decimates and measures; repeats with a smaller distance until the result is within the allowed deviation.
/// Precondition: an InterruptGuard.
Status decimate_within(const ContactScene& original, DecimateReport& report,
                       std::shared_ptr<const ContactScene>& coarse) {
  for (int round = 0; round < kMostRounds; ++round) {
    report.result = decimate(original, report.limits, [] { return !InterruptGuard::requested(); });
    auto scene = scene_of(report.result.mesh);
    if (!scene) return tl::unexpected(scene.error());
    coarse = *scene;
    report.new_from_old = surface_deviation(*coarse, original, kDeviationSamples);
    report.old_from_new = surface_deviation(original, *coarse, kDeviationSamples);
    if (report.within() || report.result.stopped) return {};
    report.limits.deviation_m *= kTighten;
  }
  return {};
}

std::string deviation_text(const char* from, const SurfaceDeviation& d) {
  return format("  %-26s mean %.4g um, RMS %.4g um, largest %.4g um (%llu points%s)\n", from, 1e6 * d.mean_m,
                1e6 * d.rms_m, 1e6 * d.largest_m, (unsigned long long)d.samples,
                d.unresolved ? format(", %llu unresolved", (unsigned long long)d.unresolved).c_str() : "");
}

std::string report_text(const DecimateReport& r) {
  const double limit = angle_limit_deg(r.threshold);
  std::string text = format("%s under %s: facets may turn by %.2f deg%s\n", r.mesh.c_str(),
                            std::string(r.threshold.condition).c_str(), limit,
                            r.threshold.interval_deg ? ", the lower end of the threshold's interval"
                                                     : ", the mean of a pilot study; there is no interval");
  text += format("  triangles                  %llu -> %llu, factor %.2f%s\n", (unsigned long long)r.result.before,
                 (unsigned long long)r.result.after,
                 static_cast<double>(r.result.before) / static_cast<double>(std::max<std::uint64_t>(1, r.result.after)),
                 r.result.stopped ? " (interrupted: it could be coarser)" : "");
  text += format("  angles of smooth edges     median %.3f -> %.3f deg, largest %.3f -> %.3f deg\n",
                 r.angles_before.median_curve_deg, r.angles_after.median_curve_deg, r.angles_before.largest_curve_deg,
                 r.angles_after.largest_curve_deg);
  text += format("  above the limit            %llu of %llu -> %llu of %llu%s\n", (unsigned long long)r.over_before,
                 (unsigned long long)r.angles_before.curve_edges, (unsigned long long)r.over_after,
                 (unsigned long long)r.angles_after.curve_edges,
                 r.over_after ? ": edges of the original that no collapse could better; none was made" : "");
  text += format("  smooth surface, limit      %.4g um\n", 1e6 * r.deviation_limit_m);
  text += deviation_text("  new from old", r.new_from_old) + deviation_text("  old from new", r.old_from_new);
  if (!r.within()) text += "  the limit was not kept everywhere; give a larger one, or look at the mesh there\n";
  text += format(
      "  solver on the result       %llu ticks, %llu unconverged, %.3f iterations a tick, error %.3g um at most\n",
      (unsigned long long)r.run.ticks, (unsigned long long)r.run.unconverged, r.run.mean_iterations(),
      1e6 * r.run.max_error_m);
  return text;
}

nlohmann::ordered_json to_json(const SurfaceDeviation& d) {
  return {{"samples", d.samples},
          {"unresolved", d.unresolved},
          {"mean_m", d.mean_m},
          {"rms_m", d.rms_m},
          {"largest_m", d.largest_m}};
}

nlohmann::ordered_json report_json(const DecimateReport& r) {
  return {{"program_version", TANGENT_VERSION},
          {"mesh", file_name_text(r.mesh)},
          {"condition", r.threshold.condition},
          {"pilot", !r.threshold.interval_deg.has_value()},
          {"angle_limit_deg", angle_limit_deg(r.threshold)},
          {"triangles_before", r.result.before},
          {"triangles_after", r.result.after},
          {"median_deg", {{"before", r.angles_before.median_curve_deg}, {"after", r.angles_after.median_curve_deg}}},
          {"largest_deg", {{"before", r.angles_before.largest_curve_deg}, {"after", r.angles_after.largest_curve_deg}}},
          {"edges_above", {{"before", r.over_before}, {"after", r.over_after}}},
          {"deviation_limit_m", r.deviation_limit_m},
          {"new_from_old", to_json(r.new_from_old)},
          {"old_from_new", to_json(r.old_from_new)},
          {"within", r.within()},
          {"solver",
           {{"ticks", r.run.ticks},
            {"unconverged", r.run.unconverged},
            {"mean_iterations", r.run.mean_iterations()},
            {"max_error_m", r.run.max_error_m}}},
          {"interrupted", r.result.stopped}};
}

Status run_decimate(const DecimateOptions& options, bool& complete) {
  for (const auto& path : {options.out, options.json}) {
    if (path.empty()) continue;
    if (const Result<AtomicFile> file = AtomicFile::create(path); !file) return tl::unexpected(file.error());
  }
  Result<LoadedMesh> loaded = load_mesh(options.mesh);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto original = ContactScene::build(std::move(loaded->mesh));
  if (!original) return tl::unexpected(original.error());
  const ContactMesh& mesh = (*original)->mesh();
  const Vec3 size = mesh.bounds().size();

  DecimateReport report;
  report.mesh = mesh.name();
  report.threshold = kPerceptionThresholds[static_cast<std::size_t>(options.condition)];
  report.deviation_limit_m =
      options.deviation_m > 0.0 ? options.deviation_m : kDeviationShare * std::max({size.x, size.y, size.z});
  report.limits.angle_deg = angle_limit_deg(report.threshold);
  report.limits.deviation_m = report.deviation_limit_m;
  std::shared_ptr<const ContactScene> coarse;
  const InterruptGuard interrupt;  // until the last file is in place
  if (Status status = decimate_within(**original, report, coarse); !status) return status;
  report.angles_before = audit_perception(mesh, facet_angles(mesh));
  report.angles_after = audit_perception(coarse->mesh(), facet_angles(coarse->mesh()));
  report.over_before = count_over(mesh, report.limits.angle_deg);
  report.over_after = count_over(coarse->mesh(), report.limits.angle_deg);
  const Preset preset;
  Stepper stepper(coarse);
  const auto explored = exploration_poses(*coarse, preset.finger, ExplorationKind::around, ExplorationPace::steady);
  if (!explored) return tl::unexpected(explored.error());
  report.run = score_run(stepper, preset, explored->poses);

  if (Status status = write_obj(report.result.mesh, options.out, options.mesh.metres_per_unit, kDecimated); !status)
    return status;
  if (!options.json.empty())
    if (Status status = write_file_atomic(options.json, report_json(report).dump(2) + "\n"); !status) return status;
  std::fputs(report_text(report).c_str(), stdout);
  complete = !report.result.stopped && report.within();
  return {};
}

}  // namespace

void add_decimate_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(
      app, "decimate",
      "Reduce a mesh to as few triangles as a finger can't tell from the original, under a rendering condition");
  auto options = std::make_shared<DecimateOptions>();
  add_mesh_options(*command, options->mesh);
  add_text_option(*command, "--out", options->out, "The coarse mesh, with normals, in the unit of MESH", "F.obj",
                  Needed::yes);
  add_choice_option(*command, "--condition", kArcConditionNames,
                    "Whose threshold no smooth edge may exceed (default P1: force and tactile shading)",
                    [options = options.get()](int i) {
                      options->condition = threshold_index(kArcConditionNames[static_cast<std::size_t>(i)]);
                    });
  add_number_option(*command, "--max-deviation-um", {.min = 1e-3, .max = 1e6, .unit = "um"},
                    "Distance that the smooth surfaces keep, both ways (default: 0.1 % of the longest side)",
                    [options = options.get()](double um) { options->deviation_m = um / 1e6; });
  add_text_option(*command, "--json", options->json, "The report for programs", "F.json");
  on_run(*command, [options, &result] {
    bool complete = false;
    const Status status = run_decimate(*options, complete);
    if (!status) print_message("decimate", status.error().message());
    result.exit_code = status && complete ? kDone : kFailed;
  });
}

}  // namespace tangent
