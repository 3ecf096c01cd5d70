// A disk that has no more room, for tests.
#pragma once

#include <doctest/doctest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/resource.h>

namespace tangent::testing {

/// While it exists, files of this process, and of those that it starts, grow to `bytes` at most: a write beyond fails
/// as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before_) == 0);
    rlimit small = before_;
    small.rlim_cur = static_cast<rlim_t>(bytes);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  }
  /// 64 KiB more than a recording's log has now.
  explicit FullDisk(const std::string& recording) : FullDisk(std::filesystem::file_size(recording + "-wal") + 65'536) {}
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

}  // namespace tangent::testing
