// workbench audit: a mesh's defects and difficulties for a contact solver.
#include "core/io/atomic_file.h"
#include "core/io/rendering_condition.h"
#include "workbench/cli/audit_report.h"
#include "workbench/cli/command.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"
#include "workbench/cli/option.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct AuditOptions {
  MeshOptions mesh;
  std::filesystem::path json, heat_map;
  int condition = threshold_index("C3");  // the finest: nothing shaded, force and contact location felt
};

/// One line per triangle: its largest angle to a neighbour, and how that compares with the threshold.
Status write_heat_map(const AuditOptions& options, const ContactMesh& mesh, const FacetAngles& angles) {
  const PerceptionThreshold& threshold = kPerceptionThresholds[static_cast<std::size_t>(options.condition)];
  const std::vector<float> ratio = felt_ratio(angles, threshold);
  std::string text = "triangle,x_m,y_m,z_m,curve_angle_deg,threshold_ratio\n";
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto p = mesh.positions(t);
    const Vec3 middle = mesh.origin() + (p[0] + p[1] + p[2]) / 3.0;
    text += format("%u,%.9g,%.9g,%.9g,%.6g,%.6g\n", t, middle.x, middle.y, middle.z,
                   static_cast<double>(ratio[t]) * threshold.mean_deg, static_cast<double>(ratio[t]));
  }
  return write_file_atomic(options.heat_map, text);
}

Status run_audit(const AuditOptions& options) {
  const Result<LoadedMesh> loaded = load_mesh(options.mesh);
  if (!loaded) return tl::unexpected(loaded.error());
  const MeshAudit audit = audit_mesh(loaded->source, loaded->mesh);
  const FacetAngles angles = facet_angles(loaded->mesh);
  const PerceptionAudit perception = audit_perception(loaded->mesh, angles);
  if (!options.heat_map.empty()) {
    if (Status status = write_heat_map(options, loaded->mesh, angles); !status) return status;
  }
  if (!options.json.empty()) {
    const std::string text = audit_json(audit, perception, options.condition, loaded->mesh).dump(2) + "\n";
    if (Status status = write_file_atomic(options.json, text); !status) return status;
  }
  std::fputs(audit_text(audit, perception, options.condition, loaded->mesh).c_str(), stdout);
  return {};
}

}  // namespace

void add_audit_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = add_command(app, "audit", "Mesh health: counts, boundaries, defects, angles, smoothness");
  auto options = std::make_shared<AuditOptions>();
  add_mesh_options(*command, options->mesh);
  add_text_option(*command, "--json", options->json, "The same report as JSON", "F.json");
  add_text_option(*command, "--heat-map", options->heat_map,
                  "Per triangle, the largest angle to a neighbour and its ratio to the threshold", "F.csv");
  add_choice_option(*command, "--condition", kArcConditionNames,
                    "Rendering condition of verdict, worst edges and heat map (default C3)",
                    [options = options.get()](int index) {
                      options->condition = threshold_index(kArcConditionNames[static_cast<std::size_t>(index)]);
                    });
  on_run(*command, [options, &result] {
    const Status status = run_audit(*options);
    if (!status) print_message("audit", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
