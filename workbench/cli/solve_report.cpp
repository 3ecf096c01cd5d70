#include "workbench/cli/solve_report.h"

#include "core/io/file_name.h"
#include "core/lab/audit/finger_size.h"
#include "core/preset/schema.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/mesh_text.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

namespace tangent {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Distribution& d) {
  return {{"count", d.count}, {"mean", d.mean}, {"p50", d.p50}, {"p99", d.p99}, {"p99_9", d.p999}, {"max", d.max}};
}

Json to_json(const Preset& preset) {
  Json out;
  for (const PresetKey& key : preset_keys()) {
    Json& slot = out[std::string(key.table)][std::string(key.key)];
    const double value = key.get(preset);
    if (key.kind == KeyKind::choice)
      slot = key.value_text(value);
    else if (key.kind == KeyKind::integer)
      slot = static_cast<int>(value);
    else
      slot = value;
  }
  return out;
}

template <class Names>
Json counts_json(const SolveStatistics& statistics, const Names& names) {
  Json out;
  for (const auto name : names) out[to_string(name)] = statistics.count(name);
  return out;
}

template <class Names>
std::string counts_text(const SolveStatistics& statistics, const Names& names) {
  std::string text;
  for (const auto name : names) {
    if (statistics.count(name) == 0) continue;
    text += std::string(text.empty() ? "" : ", ") + to_string(name) + " " + std::to_string(statistics.count(name));
  }
  return text;
}

std::string iterations_text(const Distribution& d) {
  if (d.count == 0) return "none: there is no such tick";
  return format("mean %.3f  p50 %.0f  p99 %.0f  p99.9 %.0f  max %.0f", d.mean, d.p50, d.p99, d.p999, d.max);
}

/// Changes from tick to tick, as rendered and as decided before fading. `scale`: from SI to `unit`.
std::string roughness_text(const SignalRoughness& rendered, const SignalRoughness& decided, double scale,
                           const char* unit) {
  const auto one = [&](const SignalRoughness& s) {
    return format("%.3g %s a tick, %llu changes unexplained by the motion%s", s.mean * scale, unit,
                  (unsigned long long)s.unexplained,
                  s.unexplained > 0 ? format(", by up to %.4g %s", s.largest * scale, unit).c_str() : "");
  };
  return one(rendered) + "; before fading " + one(decided) + "\n";
}

Json roughness_json(const SignalRoughness& s, const std::string& unit) {
  return {{"mean_change_" + unit, s.mean},
          {"unexplained_ticks", s.unexplained},
          {"largest_unexplained_" + unit, s.largest}};
}

std::string size_text(const SolveReport& report) {
  if (report.planar == nullptr) return count_text(report.mesh->usable_triangle_count(), "triangle", "triangles");
  return (report.planar->closed() ? "closed" : "open") +
         (" polygon, " + count_text(report.planar->patch_count(), "vertex", "vertices"));
}

std::string finger_text(const Finger& finger) {
  switch (finger.shape) {
    case FingerShape::point:
      return "point finger";
    case FingerShape::sphere:
      return format("sphere finger of %g mm", finger.radius_m * 1e3);
    case FingerShape::ellipsoid:
      return format("ellipsoid finger of %g, %g, %g mm", finger.semi_axes_m.x * 1e3, finger.semi_axes_m.y * 1e3,
                    finger.semi_axes_m.z * 1e3);
    case FingerShape::capsule:
      return format("capsule finger of %g mm, half length %g mm", finger.radius_m * 1e3, finger.half_length_m * 1e3);
  }
  return {};
}

std::string scene_name(const SolveReport& report) {
  return report.mesh != nullptr ? report.mesh->name() : report.planar->polygon().name;
}

/// With the one that goes to standard error.
std::vector<std::string> all_notes(const SolveReport& report) {
  std::vector<std::string> all = report.notes();
  if (!report.touch_note.empty()) all.push_back(report.touch_note);
  return all;
}

Json mesh_json(const SolveReport& report) {
  const ContactMesh& mesh = *report.mesh;
  return {{"name", file_name_text(mesh.name())}, {"hash", hash_text(mesh.content_hash())},
          {"triangles", mesh.triangle_count()},  {"usable_triangles", mesh.usable_triangle_count()},
          {"defects", defects_json(mesh)},       {"notes", all_notes(report)}};
}

std::string causes_text(const SolveReport& report) {
  if (!report.causes) return {};
  std::string text;
  for (const TickCause cause : kTickCauses) {
    const std::uint64_t count = (*report.causes)[static_cast<std::size_t>(cause)];
    if (count > 0) text += (text.empty() ? "" : ", ") + std::string(to_string(cause)) + " " + std::to_string(count);
  }
  return "  explained   " + (text.empty() ? "nothing to explain" : text) + "\n";
}

}  // namespace

std::vector<std::string> SolveReport::notes() const {
  std::vector<std::string> all = mesh != nullptr ? mesh->notes() : std::vector<std::string>{};
  const double longest_m = mesh != nullptr ? longest_side_m(*mesh) : planar->size_m();
  if (std::string size = finger_size_note(longest_m, preset.preset.finger); !size.empty())
    all.push_back(std::move(size));
  return all;
}

std::string solve_text(const SolveReport& report) {
  const SolveStatistics& s = report.statistics;
  const Preset& preset = report.preset.preset;
  const Distribution ns = s.solve_ns();
  std::string text = format("%s on %s (%s), %s, method %s%s\n", count_text(s.ticks(), "tick", "ticks").c_str(),
                            scene_name(report).c_str(), size_text(report).c_str(), finger_text(preset.finger).c_str(),
                            to_string(preset.solver.method), report.interrupted ? ", interrupted" : "");
  text += "  status      " + counts_text(s, kTickStatuses) + "\n";
  text += "  events      " + counts_text(s, kTickEvents) + "\n";
  if (s.searching() > 0)
    text += format("  searching   %llu ticks whose search for deeper places went on at the next\n",
                   (unsigned long long)s.searching());
  text += causes_text(report);
  text += "  iterations  " + iterations_text(s.iterations()) + "\n";
  text += "    no event  " + iterations_text(s.event_free_iterations()) + "\n";
  text += format("  error       max %.4g um of converged ticks (tolerance %g um)\n", s.max_error_m() * 1e6,
                 preset.solver.tolerance_m * 1e6);
  text += "  force       " + roughness_text(s.roughness().force, s.roughness().decided_force, 1e3, "mN");
  text += "  display     " + roughness_text(s.roughness().display, s.roughness().decided_display, 1e6, "um");
  text += format("  tick time   p50 %.2f us  p99 %.2f us  p99.9 %.2f us  max %.2f us\n", ns.p50 * 1e-3, ns.p99 * 1e-3,
                 ns.p999 * 1e-3, ns.max * 1e-3);
  text += format("  seconds     loading %.3f, solving %.3f\n", report.load_seconds, report.solve_seconds);
  text += format("  memory      %.3f MB of scene\n", 1e-6 * static_cast<double>(report.scene_bytes));
  const std::string defects = report.mesh != nullptr ? defects_text(*report.mesh) : std::string();
  if (!defects.empty()) text += "mesh: found and dealt with (numbers of the first)\n" + defects;
  for (const std::string& note : report.notes()) text += "note: " + note + "\n";
  return text;
}

Json solve_json(const SolveReport& report) {
  const SolveStatistics& s = report.statistics;
  Json scene = {{"dimensions", report.planar != nullptr ? 2 : 3}, {"memory_bytes", report.scene_bytes}};
  if (report.planar != nullptr) {
    scene["name"] = scene_name(report);
    scene["vertices"] = report.planar->patch_count();
    scene["closed"] = report.planar->closed();
    scene["notes"] = all_notes(report);
  }
  Json out = {
      {"program_version", TANGENT_VERSION},
      {"scene", scene},
      {"mesh", report.mesh != nullptr ? mesh_json(report) : Json()},
      {"poses", {{"name", report.poses_name}, {"count", report.poses}}},
      {"preset", {{"name", file_name_text(report.preset_name)}, {"values", to_json(report.preset.preset)}}},
      {"interrupted", report.interrupted},
      {"ticks", s.ticks()},
      {"statuses", counts_json(s, kTickStatuses)},
      {"events", counts_json(s, kTickEvents)},
      {"searching", s.searching()},
      {"iterations", {{"all", to_json(s.iterations())}, {"event_free", to_json(s.event_free_iterations())}}},
      {"max_error_m", s.max_error_m()},
      {"roughness",
       {{"force", roughness_json(s.roughness().force, "n")},
        {"decided_force", roughness_json(s.roughness().decided_force, "n")},
        {"display", roughness_json(s.roughness().display, "m")},
        {"decided_display", roughness_json(s.roughness().decided_display, "m")}}},
      {"solve_ns", to_json(s.solve_ns())},
      {"seconds", {{"load", report.load_seconds}, {"solve", report.solve_seconds}}},
  };
  if (report.causes)
    for (const TickCause cause : kTickCauses)
      out["explained"][to_string(cause)] = (*report.causes)[static_cast<std::size_t>(cause)];
  return out;
}

}  // namespace tangent
