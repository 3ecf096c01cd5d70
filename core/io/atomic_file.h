// Atomic file writing: a temporary file beside the target, then a rename. A reader never sees half a file, and a
// failure leaves the old file unchanged.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent {

/// A file being written. The target is unchanged until `commit`; without it the destructor removes the temporary file.
/// A target that is a device or a pipe (/dev/stdout) is written directly. A symbolic link is followed: the file it
/// names is replaced, the link stays.
class AtomicFile {
 public:
  /// Fails when the target is a directory, is write-protected, or its directory takes no new file.
  static Result<AtomicFile> create(const std::filesystem::path& target);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Buffered. The first failure is kept: later calls and `commit` return it again.
  Status write(std::string_view bytes);

  /// Puts the file in place; call once, last. `durable`: it also survives a power cut.
  Status commit(bool durable = false);

  const std::filesystem::path& path() const { return target_; }
  /// The file that takes the target's place, for a library that opens files by name itself; nothing else then writes.
  const std::filesystem::path& being_written() const { return temporary_.empty() ? target_ : temporary_; }

 private:
  AtomicFile() = default;
  void flush();
  void record_failure(const char* doing);

  std::filesystem::path target_;     ///< as the user named it, for messages
  std::filesystem::path place_;      ///< with links resolved
  std::filesystem::path temporary_;  ///< empty: written directly, or committed
  int known_as_ = -1;                ///< where remove_temporary_files finds its name
  std::string buffer_;
  int fd_ = -1;
  Status status_;
};

/// Removes the temporary files of all files that are being written, for a process that is about to end by a signal.
/// Any thread, and in a signal handler. Of more than 64 at a time the others stay.
void remove_temporary_files() noexcept;

/// Writes the whole file at once. `durable`: it also survives a power cut, which may cost a wait for the disk.
Status write_file_atomic(const std::filesystem::path& target, std::string_view content, bool durable = true);

}  // namespace tangent
