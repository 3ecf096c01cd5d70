#include "workbench/session/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace tangent {

FileLock::FileLock(const std::filesystem::path& file, double wait_s) {
  constexpr auto kPause = std::chrono::milliseconds(5);
  const std::filesystem::path lock = file.string() + ".lock";
  file_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
  while (file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) != 0) {
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
