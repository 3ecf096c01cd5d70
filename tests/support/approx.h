// Numbers known to a share of themselves.
#pragma once

#include <doctest/doctest.h>

namespace tangent::test {

/// Equal to what differs from `value` by less than a share of it, 1.2e-5 or what `.epsilon` says. doctest::Approx by
/// itself takes the share of one more than the value, so that far below 1 all numbers are equal; `.scale` adds that,
/// for values that may be zero.
inline doctest::Approx approx(double value) { return doctest::Approx(value).scale(0.0); }

}  // namespace tangent::test
