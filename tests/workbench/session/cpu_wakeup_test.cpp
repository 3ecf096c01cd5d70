#include "workbench/session/cpu_wakeup.h"

#include <doctest/doctest.h>

#include <unistd.h>

using namespace tangent;

TEST_CASE("cores are kept awake while that is asked for, where the system allows it") {
  CpuWakeup wakeup;
  CHECK_FALSE(wakeup.held());
  const bool allowed = ::access("/dev/cpu_dma_latency", W_OK) == 0;
  wakeup.hold(true);
  if (!allowed) CHECK_FALSE(wakeup.held());
  const bool got = wakeup.held();
  wakeup.hold(true);
  CHECK(wakeup.held() == got);
  wakeup.hold(false);
  CHECK_FALSE(wakeup.held());
}
