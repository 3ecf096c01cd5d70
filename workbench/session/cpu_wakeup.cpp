#include "workbench/session/cpu_wakeup.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>

namespace tangent {

void CpuWakeup::hold(bool wanted) {
  if (wanted == wanted_) return;
  wanted_ = wanted;
  if (file_ >= 0) ::close(file_);  // which gives it up
  file_ = -1;
  if (!wanted) return;
  file_ = ::open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t longest_us = 0;
  if (file_ < 0 || ::write(file_, &longest_us, sizeof longest_us) == sizeof longest_us) return;
  ::close(file_);
  file_ = -1;
}

}  // namespace tangent
