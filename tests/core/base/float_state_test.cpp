#include "core/base/float_state.h"

#include "core/io/pose_file.h"
#include "core/io/scene_file.h"
#include "core/tick/step.h"
#include "tests/support/paths.h"
#include "tests/support/processor_state.h"

#include <doctest/doctest.h>

#include <cfenv>
#include <cstring>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::testing;

#if defined(__x86_64__)
namespace {

/// Everything from the file to the forces, in this state of the processor.
std::vector<TickOutput> ticks_under(unsigned state) {
  const std::string assets = testing::test_assets();
  const ProcessorState csr(state);
  SceneOptions options;
  options.mesh.fit_m = 0.08;
  const auto scene = load_scene(assets + "/meshes/spot.obj", options);
  REQUIRE(scene);
  const auto poses = read_poses(assets + "/poses/spot-r020.csv");
  REQUIRE(poses);
  Stepper stepper(*scene);
  TickState tick;
  std::vector<TickOutput> out;
  for (std::size_t i = 0; i < poses->size(); i += 4) out.push_back(stepper.step(Preset{}, (*poses)[i], tick));
  CHECK((_mm_getcsr() & ~kHappened) == state);
  return out;
}

void check_same_bits(const std::vector<TickOutput>& a, const std::vector<TickOutput>& b) {
  REQUIRE(a.size() == b.size());
  int other = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto bits = [](double x) {
      std::uint64_t u = 0;
      std::memcpy(&u, &x, sizeof u);
      return u;
    };
    for (int k = 0; k < 3; ++k)
      other += bits(a[i].contact[k]) != bits(b[i].contact[k]) || bits(a[i].force_n[k]) != bits(b[i].force_n[k]);
    other += bits(a[i].cld_m) != bits(b[i].cld_m) || bits(a[i].error_m) != bits(b[i].error_m) ||
             bits(a[i].penetration_m) != bits(b[i].penetration_m) || a[i].iterations != b[i].iterations;
  }
  CHECK(other == 0);
}

}  // namespace

TEST_CASE("a library computes the same however the program's processor state is, and leaves it") {
  const std::vector<TickOutput> tested = ticks_under(kAsTested);
  check_same_bits(tested, ticks_under(kFlushed));
  check_same_bits(tested, ticks_under(kUpwards));
  check_same_bits(tested, ticks_under(kTrapping));
}

TEST_CASE("rounding upwards would show: a third is another number") {
  volatile double one = 1.0, three = 3.0;
  const double nearest = one / three;
  const ProcessorState csr(kUpwards);
  CHECK(one / three != nearest);
  const FloatState as_tested;
  CHECK(one / three == nearest);
}
#endif
