#include "devices/base/realtime_thread.h"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>

namespace tangent {

bool ask_for_realtime(int priority) noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL);  // ns; the default delays wake-ups by up to 50 us
  sched_param wanted{};
  wanted.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
}

}  // namespace tangent
