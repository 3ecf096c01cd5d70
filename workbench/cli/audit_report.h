// A mesh's health, for people and for programs.
#pragma once

#include "core/mesh/mesh_audit.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tangent {

std::string audit_text(const MeshAudit& audit, const ContactMesh& mesh);
/// The layout is part of the program's contract (README, "Files").
nlohmann::ordered_json audit_json(const MeshAudit& audit, const ContactMesh& mesh);

}  // namespace tangent
