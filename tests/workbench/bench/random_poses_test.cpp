// Random poses on every hard case: no NaN in the output, and robust always converges.
#include "tests/core/scenes.h"
#include "workbench/bench/bench_case.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

using namespace tangent;
using namespace tangent::bench;
using tangent::test::Random;

namespace {

/// Poses per case. TANGENT_RANDOM_POSES sets their number, TANGENT_RANDOM_CASE selects one case: a million of each
/// takes hours.
long pose_count() {
  if (const char* wanted = std::getenv("TANGENT_RANDOM_POSES")) return std::max(1L, std::atol(wanted));
  return test::rounds(1000);
}

/// TANGENT_RANDOM_SEED selects other poses.
std::uint64_t first_seed() {
  const char* wanted = std::getenv("TANGENT_RANDOM_SEED");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 100;
}

bool wanted(const BenchCase& c) {
  const char* name = std::getenv("TANGENT_RANDOM_CASE");
  return !name || c.name == name;
}

struct Counts {
  bool built = false;
  long ticks = 0;
  long not_finite = 0;  ///< output or kept state
  long not_unit = 0;    ///< normals
  long untrue = 0;      ///< converged by name, but with an error over the tolerance or a force over the limit
  long unconverged = 0;
};

bool kept_is_finite(const TickState& s) {
  return is_finite(s.plane.point) && is_finite(s.plane.normal) && std::isfinite(s.plane.u) &&
         std::isfinite(s.plane.v) && std::isfinite(glm::dot(s.plane.turn, s.plane.turn)) &&
         is_finite(s.last_converged.point) && is_finite(s.last_converged.normal);
}

/// Anywhere around, on and in the mesh, in random orientations; every fourth pose is a jump, the others continue from
/// it.
Counts random_poses(const BenchCase& c, long poses, std::uint64_t seed) {
  Counts counts;
  const Result<bench::ScenePtr> scene = build_scene(c);
  if (!scene) return counts;
  counts.built = true;
  const Box& box = (*scene)->mesh().bounds();
  const Vec3 half = 0.5 * box.size() + Vec3(c.preset.finger.reach_m());
  const Vec3 middle = (*scene)->mesh().origin() + box.centre();
  const double size = glm::length(box.size());
  Random random(seed);
  Stepper stepper(*scene);
  TickState state;
  Vec3 centre(0.0);
  for (; counts.ticks < poses; ++counts.ticks) {
    centre = counts.ticks % 4 ? centre + random.in_cube(0.002 * size) : half * random.in_cube(1.0);
    const TickInput input{1e-3 * static_cast<double>(counts.ticks), {middle + centre, random.orientation()}};
    const TickOutput out = stepper.step(c.preset, input, state);
    const bool unconverged = out.status == TickStatus::unconverged;
    counts.not_finite += !test::all_finite(out) || !kept_is_finite(state);
    counts.not_unit += !(std::abs(glm::length(out.normal) - 1.0) < 1e-9);
    counts.untrue += is_converged(out.status) && !(out.error_m < c.preset.solver.tolerance_m);
    counts.untrue += !(glm::length(out.force_n) <= c.preset.force.limit_n * (1.0 + 1e-12));
    counts.unconverged += unconverged;
  }
  return counts;
}

}  // namespace

TEST_CASE("random poses on every hard case put out no NaN, and robust has an answer to each") {
  std::vector<BenchCase> cases = hard_cases();
  std::erase_if(cases, [](const BenchCase& c) { return !wanted(c); });
  REQUIRE(!cases.empty());
  std::vector<Counts> counts(cases.size());
  std::atomic<std::size_t> next{0};
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
      workers.emplace_back([&] {
        for (std::size_t k = next++; k < cases.size(); k = next++)
          counts[k] = random_poses(cases[k], pose_count(), first_seed() + k);
      });
  }
  long ticks = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    CAPTURE(cases[k].name);
    CHECK(counts[k].built);
    CHECK(counts[k].not_finite == 0);
    CHECK(counts[k].not_unit == 0);
    CHECK(counts[k].untrue == 0);
    CHECK(counts[k].unconverged == 0);
    ticks += counts[k].ticks;
  }
  MESSAGE(ticks << " random poses on " << cases.size() << " hard cases");
}

namespace {

/// Of a million random poses on the capsule's case those that once had no answer, and how deep the contact is.
struct HardPose {
  FingerPose finger;
  double penetration_m;  ///< of the contact; 0: none is found, and a plane is turned to face the finger
  bool saddle = false;   ///< of an unstable contact, which is as good as none
};
const HardPose kHardPoses[] = {
    // The surface's weak direction (det M of 0.02 and 0.04): steps too short to arrive from any seed.
    {{{0.036257960329207306, 0.021647348459245618, -0.0035787812426245234},
      {0.90848836309671832, -0.19441954881853207, 0.24440751045071885, -0.27769570034540608}},
     0.022774},
    {{{-0.0049068887829580386, -0.0018296632501952294, 0.03110531392818567},
      {-0.5079788991772165, -0.090420412057016009, 0.85529247625294613, 0.047501233028695335}},
     -0.022627},
    // Inside the tube and along it: no stable contact, and none unstable that a seed runs into.
    {{{0.04115417905616147, 0.0020659305407445352, -0.00048502533802356914},
      {0.80535821218007475, -0.038714473566988206, 0.047592799839945722, -0.58960517722789685}},
     0.0},
    {{{0.031009751383898089, 0.014079180438336062, -0.0015198395123949119},
      {-0.71634948405176802, 0.39734377913868563, -0.030337179927552988, 0.57274863019704947}},
     0.0},
    {{{-0.031078657034384314, -0.0068126892133906431, -0.0044374950407303883},
      {-0.25795240647071749, -0.65346452588990145, 0.41340766665678064, 0.579257085022573}},
     0.0342024,
     true},  // across the tube: none of the four there is stable (core/contact/every_contact_test.cpp)
    {{{-0.013281290477628046, -0.035361852646265006, 0.0037411095221624941},
      {0.084505217558282761, 0.15531951042324418, -0.28036383702986062, 0.94346745400845944}},
     0.0},
    {{{0.0096691344620638987, 0.03802832546618104, 0.0027421365422258606},
      {-0.96141858715716344, -0.020353912115933404, -0.1419605240183402, 0.23474928785991864}},
     0.0},
};

}  // namespace

TEST_CASE("a capsule in and around a torus has an answer where seeds arrive late, and where there is no contact") {
  const std::vector<BenchCase> cases = hard_cases();
  const auto c =
      std::find_if(cases.begin(), cases.end(), [](const BenchCase& x) { return x.name == "capsule_finger_on_torus"; });
  REQUIRE(c != cases.end());
  const Result<bench::ScenePtr> scene = build_scene(*c);
  REQUIRE(scene.has_value());
  for (const HardPose& pose : kHardPoses) {
    CAPTURE(pose.finger.position.x);
    const TickOutput out = test::solve_once(*scene, c->preset, pose.finger);
    CHECK(out.status != TickStatus::unconverged);
    CHECK((out.status == TickStatus::facing) == (pose.saddle || pose.penetration_m == 0.0));
    CHECK((out.error_m < c->preset.solver.tolerance_m) == (pose.penetration_m != 0.0));
    if (pose.penetration_m != 0.0) {
      CHECK(std::abs(out.penetration_m - pose.penetration_m) < 1e-6);
    } else {  // seen from inside, so that the force leads out
      const Vec3 centre = pose.finger.position - out.contact;
      CHECK(glm::dot(centre, out.normal) < 0.0);
      CHECK(out.penetration_m > 0.0);
    }
  }
}
