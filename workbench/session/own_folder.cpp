#include "workbench/session/own_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace tangent {

Result<std::filesystem::path> make_own_folder() {
  std::error_code failed;
  const std::filesystem::path root = std::filesystem::temp_directory_path(failed);
  std::string name = ((failed ? std::filesystem::path("/tmp") : root) / "tangent-workbench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    return fail(std::string("no folder can be made: ") + std::strerror(errno), name,
                "set TMPDIR to a folder with room");
  return std::filesystem::path(name);
}

Result<OwnFolder> OwnFolder::make() {
  Result<std::filesystem::path> path = make_own_folder();
  if (!path) return tl::unexpected(path.error());
  return OwnFolder(std::move(*path));
}

OwnFolder::~OwnFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace tangent
