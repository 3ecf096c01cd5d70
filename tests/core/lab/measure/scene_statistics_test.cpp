#include "core/lab/measure/scene_statistics.h"

#include "core/base/units.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

TickOutput tick(TickStatus status, TickEvent event, int iterations, const Vec3& normal = Vec3(0, 0, 1)) {
  TickOutput o;
  o.status = status;
  o.event = event;
  o.iterations = iterations;
  o.normal = normal;
  o.error_m = 1e-7 * iterations;
  return o;
}

TickInput pose(double x) {
  TickInput input;
  input.finger.position = Vec3(x, 0, 0);
  return input;
}

const Vec3 kTurned(std::sin(20.0 * kDegree), 0.0, std::cos(20.0 * kDegree));

}  // namespace

TEST_CASE("counts and percentiles of a run made by hand") {
  const std::vector<TickInput> inputs{pose(0), pose(0), pose(0), pose(0), pose(0)};
  const std::vector<TickOutput> outputs{
      tick(TickStatus::face, TickEvent::first, 9), tick(TickStatus::face, TickEvent::none, 1),
      tick(TickStatus::unconverged, TickEvent::reseed, 50), tick(TickStatus::edge, TickEvent::switched, 4),
      tick(TickStatus::free, TickEvent::none, 3)};
  const std::vector<double> ns{900, 100, 5000, 400, 300};
  const RunStatistics s = run_statistics(inputs, outputs, ns);
  CHECK(s.ticks == 5);
  CHECK(s.unconverged() == 1);
  CHECK(s.first_unconverged == 2);
  CHECK(s.count(TickEvent::reseed) == 1);
  CHECK(s.count(TickEvent::switched) == 1);
  CHECK(s.count(TickStatus::edge) == 1);
  CHECK(s.not_finite == 0);
  CHECK(s.max_error_m == approx(9e-7));  // the unconverged tick's does not count
  CHECK(s.iterations.count == 2);
  CHECK(s.iterations.mean == approx(2.0));
  CHECK(s.all_iterations.max == 50.0);
  CHECK(s.ns.max == 5000.0);
  CHECK(s.eventless_ns.max == 300.0);
  CHECK(s.seeding_ns.count == 2);
  CHECK(s.seeding_ns.p50 == 900.0);
}

TEST_CASE("a jump of the normal counts only without event and where the finger moved little") {
  const auto jumps = [](TickEvent event, double step_m, const Vec3& normal) {
    const std::vector<TickInput> inputs{pose(0), pose(step_m)};
    const std::vector<TickOutput> outputs{tick(TickStatus::face, TickEvent::first, 1),
                                          tick(TickStatus::face, event, 1, normal)};
    return run_statistics(inputs, outputs, {}).unmarked_jumps;
  };
  CHECK(jumps(TickEvent::none, 1e-4, kTurned) == 1);
  CHECK(jumps(TickEvent::none, 1e-3, kTurned) == 0);
  CHECK(jumps(TickEvent::switched, 1e-4, kTurned) == 0);
  CHECK(jumps(TickEvent::none, 1e-4, Vec3(0, 0, 1)) == 0);
}

TEST_CASE("anything not finite in a tick is counted") {
  for (int field = 0; field < 4; ++field) {
    TickOutput o = tick(TickStatus::face, TickEvent::none, 1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (field == 0) o.contact.y = nan;
    if (field == 1) o.force_n.x = std::numeric_limits<double>::infinity();
    if (field == 2) o.cld_m = nan;
    if (field == 3) o.normal.z = nan;
    CHECK_FALSE(tangent::all_finite(o));
    CHECK(run_statistics(std::vector{pose(0)}, std::vector{o}, {}).not_finite == 1);
  }
}

TEST_CASE("differences are lengths and angles - unconverged ticks are left out") {
  TickOutput a = tick(TickStatus::face, TickEvent::none, 1), b = tick(TickStatus::face, TickEvent::none, 1, kTurned);
  b.contact = Vec3(3e-3, 4e-3, 0);
  b.force_n = Vec3(0, 0, 0.25);
  b.cld_m = -2e-3;
  const OutputDifference d = difference(a, b);
  CHECK(d.contact_m == approx(5e-3));
  CHECK(d.normal_rad == approx(20.0 * kDegree));
  CHECK(d.force_n == approx(0.25));
  CHECK(d.display_m == approx(2e-3));

  RunComparison comparison;
  comparison.add(a, b);
  comparison.add(a, tick(TickStatus::unconverged, TickEvent::none, 1));
  comparison.leave_out();
  const RunDifference run = comparison.result();
  CHECK(run.compared == 1);
  CHECK(run.left_out == 2);
  CHECK(run.contact_m.max == approx(5e-3));
}
