#include "core/shading/ramp.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a display that has its own converged plane does not ramp with the force") {
  Preset preset;
  RenderedState last;
  last.has = 1;
  last.force_n = {0.0, 0.0, 2.0};
  last.cld_m = 0.004;
  const FingerWay way{Vec3(0.0), 1e-3};
  for (const bool display_ramps : {true, false}) {
    Rendered decided;
    decided.cld_m = -0.006;
    ramp_what_was_rendered(preset, way, 0.5, display_ramps, last, decided);
    const double left = 0.5 / (0.5 + 1e-3 / preset.safety.unconverged_ramp_s);
    CHECK(decided.cld_m == (display_ramps ? approx(left * 0.004) : approx(-0.006)));
    CHECK(decided.force_n.z == approx(left * 2.0));
  }
}
