// Two pieces of work that don't depend on each other: core has no threads of its own, who calls it may have two.
#pragma once

#include <cstddef>
#include <functional>

namespace tangent {

/// Does both, in any order or at once; returns when both are done.
using RunBoth = std::function<void(const std::function<void()>&, const std::function<void()>&)>;
inline void run_in_turn(const std::function<void()>& a, const std::function<void()>& b) { a(), b(); }

/// Calls work(first, last) for both halves of the numbers below `count`: the first begins at 0, and is all that there
/// is of less than two.
template <class Work>
void run_halves(const RunBoth& run_both, std::size_t count, const Work& work) {
  if (count < 2) return work(std::size_t{0}, count);
  run_both([&] { work(std::size_t{0}, count / 2); }, [&] { work(count / 2, count); });
}

}  // namespace tangent
