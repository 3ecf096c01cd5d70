#include "workbench/sweep/plan_digest.h"

#include <array>
#include <cstdio>
#include <fstream>

namespace tangent::sweep {
namespace {

/// FNV-1a, fed in parts.
class Digest {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  void add_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    if (!file || !std::filesystem::is_regular_file(path, error)) return add("missing");
    std::string part(std::size_t{1} << 20, '\0');
    while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0)
      add({part.data(), static_cast<std::size_t>(file.gcount())});
    add("end");
  }
  std::string text() const {
    std::array<char, 17> out{};
    std::snprintf(out.data(), out.size(), "%016llx", static_cast<unsigned long long>(value_));
    return out.data();
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

}  // namespace

std::string plan_digest(const Plan& plan) {
  Digest digest;
  // Without folders: the same plan beside the same files elsewhere is the same plan.
  std::vector<std::string> names;
  for (const auto& mesh : plan.meshes) names.push_back(mesh.filename().string());
  for (const std::string& poses : plan.poses) names.push_back(std::filesystem::path(poses).filename().string());
  digest.add(format_plan(plan, names));
  for (const auto& mesh : plan.meshes) digest.add_file(mesh);
  for (const std::string& poses : plan.poses)
    if (!is_made(poses)) digest.add_file(poses);
  return digest.text();
}

}  // namespace tangent::sweep
