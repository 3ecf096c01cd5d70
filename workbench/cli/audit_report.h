// Report of a mesh audit, as text and as JSON.
#pragma once

#include "core/lab/audit/mesh_audit.h"
#include "core/lab/measure/perception.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tangent {

/// `condition`: index into kPerceptionThresholds; worst edges and verdict are given for it.
std::string audit_text(const MeshAudit& audit, const PerceptionAudit& perception, int condition,
                       const ContactMesh& mesh);
/// The layout is documented and stable (workbench/README.md, "Files").
nlohmann::ordered_json audit_json(const MeshAudit& audit, const PerceptionAudit& perception, int condition,
                                  const ContactMesh& mesh);

}  // namespace tangent
