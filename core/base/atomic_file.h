// Files that appear under their name only when they are complete: everything goes to a temporary file
// beside the target, which is then renamed. On failure the target keeps what it had.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent {

/// A file written as a stream. commit() puts it under its name; destruction without it leaves nothing.
class AtomicFile {
 public:
  /// Fails, naming the path and the system's reason, where nothing can be written. A symbolic link is
  /// followed. A device or pipe (/dev/stdout) is written straight: there is nothing to rename.
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Buffered.
  Status write(std::string_view text);
  /// Completes the file; nothing may be written afterwards. `durable`: it also survives a power cut.
  Status commit(bool durable = false);
  const std::filesystem::path& path() const { return path_; }

 private:
  AtomicFile() = default;
  Status flush();
  tl::unexpected<Error> system_failure(int error) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty: written straight, or committed
  std::string buffer_;
  int file_ = -1;
};

/// The whole file at once, durably.
Status write_file_atomic(const std::filesystem::path& path, std::string_view contents);

}  // namespace tangent
