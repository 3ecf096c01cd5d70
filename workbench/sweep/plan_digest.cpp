#include "workbench/sweep/plan_digest.h"

#include "core/base/fnv.h"

#include <fstream>

namespace tangent::sweep {
namespace {

void add_file(Fnv& digest, const std::filesystem::path& path) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(path, error);  // opening a pipe would wait for its writer
  std::ifstream file;
  if (regular) file.open(path, std::ios::binary);
  if (!file.is_open()) {
    digest.add("missing");
    return;
  }
  std::string part(std::size_t{1} << 20, '\0');
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0)
    digest.add({part.data(), static_cast<std::size_t>(file.gcount())});
  digest.add("end");
}

void add_values(Fnv& digest, const Plan& plan) {
  // Without folders: the same plan beside the same files elsewhere is the same plan.
  std::vector<std::string> names;
  for (const auto& mesh : plan.meshes) names.push_back(mesh.filename().string());
  for (const std::string& poses : plan.poses) names.push_back(std::filesystem::path(poses).filename().string());
  digest.add(format_plan(plan, names));
}

}  // namespace

std::string plan_digest(const Plan& plan) {
  Fnv digest;
  add_values(digest, plan);
  for (const auto& mesh : plan.meshes) add_file(digest, mesh);
  for (const std::string& poses : plan.poses)
    if (!is_made(poses)) add_file(digest, poses);
  return digest.text();
}

std::string plan_values_digest(const Plan& plan) {
  Fnv digest;
  add_values(digest, plan);
  return digest.text();
}

std::vector<std::string> plan_input_digests(const Plan& plan) {
  std::vector<std::string> out;
  const auto add = [&](const std::filesystem::path& path) {
    Fnv digest;
    add_file(digest, path);
    out.push_back(digest.text());
  };
  for (const auto& mesh : plan.meshes) add(mesh);
  for (const std::string& poses : plan.poses) {
    if (is_made(poses))
      out.emplace_back("made");
    else
      add(poses);
  }
  return out;
}

}  // namespace tangent::sweep
