// A file that is only ever appended to, whole lines at a time: a process that is killed leaves at most one torn line,
// which the next one cuts off.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tangent {

struct AppendRules {
  /// What to do where a write failed, for its message; what is in the file stays.
  std::string not_whole = {};
  /// One process at a time has it, and what to do about the other one; empty: any number may, and a failed
  /// write of one may take others' last lines. A disk that knows no locks keeps nobody out.
  std::string in_use = {};
};

class AppendedFile {
 public:
  /// Makes the file, or goes on with it. Fails on what is no file, can't be written or is in use, naming it.
  static Result<AppendedFile> open(const std::filesystem::path& path, AppendRules rules);
  AppendedFile(AppendedFile&& other) noexcept;
  AppendedFile& operator=(AppendedFile&&) = delete;
  ~AppendedFile();

  /// Its first bytes, all whole lines, stay; what is after them is cut off. Once, before anything is added.
  Status keep(std::uint64_t bytes);
  /// A single write. Where it fails nothing of it stays, and it can be tried again.
  Status add(std::string_view lines);
  /// Likewise, and it is on the disk when this returns.
  Status add_durably(std::string_view lines);
  /// On the disk: a power cut takes nothing of what was added.
  Status flush();

  const std::filesystem::path& path() const { return path_; }

 private:
  AppendedFile() = default;
  AppendedFile with_what_is_there();
  Status take_back();
  Status mend();  ///< cuts off what `take_back` could not

  std::filesystem::path path_;
  AppendRules rules_;
  int file_ = -1;
  std::uint64_t bytes_ = 0;  ///< of whole lines
  bool torn_ = false;        ///< there is more after them
};

/// All of it, to an open file; false: errno says why not.
bool write_whole(int file, std::string_view text) noexcept;

}  // namespace tangent
