#include "core/io/replaceable_file.h"

#include <fstream>
#include <string>

namespace tangent {
namespace {

constexpr std::size_t kLooked = std::size_t{1} << 16;

}  // namespace

Status check_replaceable(const std::filesystem::path& path, std::string_view kind,
                         const std::function<bool(std::string_view beginning)>& is_ours) {
  std::error_code error;
  if (path.empty() || !std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return fail("is there already, and can't be read to see what it is", path.string(),
                "choose another name, or remove it");
  std::string beginning(kLooked, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  if (beginning.empty() || is_ours(beginning)) return {};
  return fail("is there already, and is not " + std::string(kind) + ", which alone is replaced", path.string(),
              "choose another name, or remove it");
}

}  // namespace tangent
