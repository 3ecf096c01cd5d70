#include "workbench/sweep/instruction_count.h"

#include <cstring>

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tangent::sweep {

std::optional<std::uint64_t> count_instructions(const std::function<void()>& work) {
  perf_event_attr wanted;
  std::memset(&wanted, 0, sizeof wanted);
  wanted.size = sizeof wanted;
  wanted.type = PERF_TYPE_HARDWARE;
  wanted.config = PERF_COUNT_HW_INSTRUCTIONS;
  wanted.disabled = 1;
  wanted.exclude_kernel = 1;
  wanted.exclude_hv = 1;
  const int counter = static_cast<int>(::syscall(SYS_perf_event_open, &wanted, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
  if (counter < 0) {
    work();
    return std::nullopt;
  }
  ::ioctl(counter, PERF_EVENT_IOC_ENABLE, 0);
  work();
  ::ioctl(counter, PERF_EVENT_IOC_DISABLE, 0);
  std::uint64_t count = 0;
  const bool read = ::read(counter, &count, sizeof count) == sizeof count && count > 0;
  ::close(counter);
  return read ? std::optional(count) : std::nullopt;
}

}  // namespace tangent::sweep
