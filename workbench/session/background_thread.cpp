#include "workbench/session/background_thread.h"

#include <algorithm>
#include <thread>

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace tangent {

void yield_to_servo_and_window() {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, 10);
#endif
}

unsigned background_threads() { return std::clamp(std::thread::hardware_concurrency(), 2u, 5u) - 1; }

}  // namespace tangent
