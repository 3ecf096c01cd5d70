// Waiting for events in other threads, by count and content; the time limit only ends a test that hangs.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

namespace tangent::emulation {

template <class Condition>
bool eventually(Condition&& condition, double limit_s = 60.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  return true;
}

}  // namespace tangent::emulation
