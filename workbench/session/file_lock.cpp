#include "workbench/session/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace tangent {

namespace {

/// Who held it before may have removed the file: then another one locks a new file of that name.
bool is_removed(int file) {
  struct stat facts {};
  return ::fstat(file, &facts) == 0 && facts.st_nlink == 0;
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file, double wait_s) {
  constexpr auto kPause = std::chrono::milliseconds(5);
  const std::filesystem::path lock = file.string() + ".lock";
  const auto open = [&] { return ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600); };
  file_ = open();
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  while (file_ >= 0) {
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) {
      if (!is_removed(file_)) return;
      ::close(file_);
      file_ = open();
      continue;
    }
    if (std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    ::close(file_);
    file_ = -1;
  }
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace tangent
