// Two pieces of work at once, for what core can do in any order (core has no threads of its own).
#pragma once

#include <functional>

namespace tangent {

/// Does `a` here and `b` on a thread of its own; returns when both are done. What `b` throws is thrown here. A RunBoth
/// of core/base/run_both.h.
void run_on_two_threads(const std::function<void()>& a, const std::function<void()>& b);

}  // namespace tangent
