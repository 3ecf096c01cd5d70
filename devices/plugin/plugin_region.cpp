#include "devices/plugin/plugin_region.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <ctime>
#include <new>

namespace tangent {

namespace {

static_assert(std::atomic<std::uint32_t>::is_always_lock_free && sizeof(std::atomic<std::uint32_t>) == 4, "a futex");
constexpr std::size_t kBytes = sizeof(ToHost) + sizeof(ToProgram);

}  // namespace

const char* to_string(HostPlace place) {
  switch (place) {
    case HostPlace::own:
      return "between calls of the plug-in";
    case HostPlace::loading:
      return "while it was loaded";
    case HostPlace::capabilities:
      return "in capabilities";
    case HostPlace::open:
      return "in open";
    case HostPlace::exchange:
      return "in exchange";
    case HostPlace::stop:
      return "in stop";
    case HostPlace::close:
      return "in close";
  }
  return "somewhere";
}

PluginRegion::~PluginRegion() {
  if (to_host_ != nullptr) ::munmap(to_host_, sizeof(ToHost));
  if (to_program_ != nullptr) ::munmap(to_program_, sizeof(ToProgram));
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool PluginRegion::map(int descriptor, int to_host_access) noexcept {
  void* first = ::mmap(nullptr, sizeof(ToHost), to_host_access, MAP_SHARED, descriptor, 0);
  if (first == MAP_FAILED) return false;
  to_host_ = static_cast<ToHost*>(first);
  void* second = ::mmap(nullptr, sizeof(ToProgram), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, sizeof(ToHost));
  if (second == MAP_FAILED) return false;
  to_program_ = static_cast<ToProgram*>(second);
  return true;
}

bool PluginRegion::create() noexcept {
  descriptor_ = ::memfd_create("tangent plug-in", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(kBytes)) != 0) return false;
  // A plug-in that cuts it off would take the servo's thread with it, by SIGBUS.
  if (::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0) return false;
  if (!map(descriptor_, PROT_READ | PROT_WRITE)) return false;
  new (to_host_) ToHost();
  new (to_program_) ToProgram();
  to_host_->mark = kRegionMark;
  return true;
}

bool PluginRegion::attach(int descriptor) noexcept {
  struct stat file {};
  if (::fstat(descriptor, &file) != 0 || file.st_size != static_cast<off_t>(kBytes)) return false;
  return map(descriptor, PROT_READ) && to_host_->mark == kRegionMark;
}

std::int64_t plugin_now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void wait_for_bell(const std::atomic<std::uint32_t>& word, std::uint32_t seen, std::int64_t until_ns) noexcept {
  const timespec until{.tv_sec = static_cast<time_t>(until_ns / 1'000'000'000), .tv_nsec = until_ns % 1'000'000'000};
  // With a bit set the time is absolute.
  ::syscall(SYS_futex, &word, FUTEX_WAIT_BITSET, seen, &until, nullptr, FUTEX_BITSET_MATCH_ANY);
}

void ring_bell(std::atomic<std::uint32_t>& word) noexcept {
  word.fetch_add(1, std::memory_order_release);
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace tangent
