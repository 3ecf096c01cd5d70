// A disk that has no more room, for tests.
#pragma once

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <string>

#include <sys/resource.h>

namespace tangent::test {

/// While it exists, files take 64 KiB more than a recording's log has now: the write then fails as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(const std::string& recording) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before_) == 0);
    rlimit small = before_;
    small.rlim_cur = static_cast<rlim_t>(std::filesystem::file_size(recording + "-wal")) + 65'536;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  }
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

}  // namespace tangent::test
