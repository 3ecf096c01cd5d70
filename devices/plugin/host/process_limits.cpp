#include "devices/plugin/host/process_limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace tangent {

namespace {

/// What the kernel holds against RLIMIT_DATA, and the first thread's stack.
std::uint64_t data_bytes() noexcept {
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  std::uint64_t pages = 0;
  const bool read = std::fscanf(file, "%*u %*u %*u %*u %*u %" SCNu64, &pages) == 1;
  std::fclose(file);
  return read ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

bool lower(__rlimit_resource_t of, rlim_t soft, rlim_t hard) noexcept {
  rlimit limit{};
  if (getrlimit(of, &limit) != 0) return false;
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min(limit.rlim_max, soft);
  return setrlimit(of, &limit) == 0;
}

}  // namespace

bool limit_memory(std::uint64_t bytes) noexcept {
  if (bytes == 0) return true;
  const std::uint64_t has = data_bytes();
  return has != 0 && lower(RLIMIT_DATA, has + bytes, has + bytes);
}

bool limit_realtime(double seconds) noexcept {
  constexpr double kMost_s = 1e6;
  const auto us = static_cast<rlim_t>(std::ceil(1e6 * std::clamp(seconds, 1e-3, kMost_s)));
  return lower(RLIMIT_RTTIME, us, 2 * us);
}

}  // namespace tangent
