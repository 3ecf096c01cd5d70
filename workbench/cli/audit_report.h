// A mesh's health, for people and for programs.
#pragma once

#include "core/lab/audit/mesh_audit.h"
#include "core/lab/measure/perception.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tangent {

/// `condition`: index into kPerceptionThresholds of the one that the worst edges and the verdict are for.
std::string audit_text(const MeshAudit& audit, const PerceptionAudit& perception, int condition,
                       const ContactMesh& mesh);
/// The layout is part of the program's contract (workbench/README.md, "Files").
nlohmann::ordered_json audit_json(const MeshAudit& audit, const PerceptionAudit& perception, int condition,
                                  const ContactMesh& mesh);

}  // namespace tangent
