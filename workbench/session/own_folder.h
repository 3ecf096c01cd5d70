// A new folder in the one for temporary files, which nobody else can write to or have made before: a known name in a
// shared folder could be a link that another user put there.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <utility>

namespace tangent {

/// Stays.
Result<std::filesystem::path> make_own_folder();

/// Deleted with this object, and all that is in it.
class OwnFolder {
 public:
  static Result<OwnFolder> make();
  ~OwnFolder();
  OwnFolder(OwnFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  OwnFolder& operator=(OwnFolder&&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit OwnFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace tangent
