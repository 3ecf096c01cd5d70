#include "workbench/session/two_threads.h"

#include <future>

namespace tangent {

void run_on_two_threads(const std::function<void()>& a, const std::function<void()>& b) {
  std::future<void> other = std::async(std::launch::async, b);
  a();  // where it throws, the future waits for the other
  other.get();
}

}  // namespace tangent
