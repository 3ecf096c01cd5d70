// workbench audit: what a contact solver will meet on a mesh.
#include "core/base/atomic_file.h"
#include "workbench/cli/audit_report.h"
#include "workbench/cli/command.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/messages.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace tangent {
namespace {

struct AuditOptions {
  MeshOptions mesh;
  std::filesystem::path json;
};

Status run_audit(const AuditOptions& options) {
  const Result<LoadedMesh> loaded = load_mesh(options.mesh);
  if (!loaded) return tl::unexpected(loaded.error());
  const MeshAudit audit = audit_mesh(loaded->source, loaded->mesh);
  if (!options.json.empty()) {
    const std::string text = audit_json(audit, loaded->mesh).dump(2) + "\n";
    if (Status status = write_file_atomic(options.json, text); !status) return status;
  }
  std::fputs(audit_text(audit, loaded->mesh).c_str(), stdout);
  return {};
}

}  // namespace

void add_audit_command(CLI::App& app, CommandResult& result) {
  CLI::App* command = app.add_subcommand("audit", "Mesh health: counts, boundaries, defects, angles, smoothness");
  auto options = std::make_shared<AuditOptions>();
  add_mesh_options(*command, options->mesh);
  command->add_option("--json", options->json, "The same for programs")->type_name("F.json");
  command->callback([options, &result] {
    const Status status = run_audit(*options);
    if (!status) print_message("audit", status.error().message());
    result.exit_code = status ? kDone : kFailed;
  });
}

}  // namespace tangent
