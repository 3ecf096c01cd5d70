// A lock between processes on a file that both read, change and write: FILE.lock beside it. Only who
// holds it may remove FILE.lock.
#pragma once

#include <filesystem>

namespace tangent {

class FileLock {
 public:
  /// Waits up to `wait_s` for another holder. The folder must exist.
  explicit FileLock(const std::filesystem::path& file, double wait_s = 1.0);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  /// False: another process holds it, or the folder takes no files.
  bool held() const { return file_ >= 0; }

 private:
  int file_ = -1;
};

}  // namespace tangent
