// Defects found by the mesh builder, as text and as JSON.
#pragma once

#include "core/mesh/contact_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace tangent {

/// {"kind": {"count": n, "first": [...]}}, kinds that did not occur left out.
nlohmann::ordered_json defects_json(const ContactMesh& mesh);
/// One line per kind that occurred, indented by two blanks, with the first indices; empty when there is none.
std::string defects_text(const ContactMesh& mesh);
/// 16 hex digits.
std::string hash_text(std::uint64_t hash);

}  // namespace tangent
