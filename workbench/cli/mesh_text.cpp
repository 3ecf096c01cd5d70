#include "workbench/cli/mesh_text.h"

#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

namespace tangent {

std::string hash_text(std::uint64_t hash) { return format("%016llx", static_cast<unsigned long long>(hash)); }

nlohmann::ordered_json defects_json(const ContactMesh& mesh) {
  auto out = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
    const auto kind = static_cast<MeshDefect>(i);
    const MeshDefectList& list = mesh.defects(kind);
    if (list.count != 0) out[to_string(kind)] = {{"count", list.count}, {"first", list.first}};
  }
  return out;
}

std::string defects_text(const ContactMesh& mesh) {
  std::string text;
  for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
    const auto kind = static_cast<MeshDefect>(i);
    const MeshDefectList& list = mesh.defects(kind);
    if (list.count == 0) continue;
    text += "  " + std::to_string(list.count) + " " + to_string(kind) + ":";
    for (const std::uint64_t index : list.first) text += " " + std::to_string(index);
    text += list.count > list.first.size() ? " ...\n" : "\n";
  }
  return text;
}

}  // namespace tangent
