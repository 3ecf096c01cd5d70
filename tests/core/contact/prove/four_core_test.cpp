// A finger's core asked of four parts at once, in floats: no part that it touches is told to be missed, and nearly all
// that doubles tell are.
#include "core/contact/prove/four_core.h"
#include "core/contact/contact_rank.h"
#include "core/finger/plane_contact.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kRoom = 1e-6;  // ratio to the coordinates, as the contact hierarchy's
constexpr float kLeastCosine = 0.06f;

/// A place on a part with a normal of its cone, the part's box and cone of random size about them.
struct Part {
  Vec3 point, normal, middle, half;
  NormalCone cone;
  SurfaceBounds bounds() const { return {middle, half, cone}; }
};

Part random_part(Random& random, double size_m) {
  const double wide = size_m * std::pow(10.0, random.in(-4.0, -0.5)), angle = std::pow(10.0, random.in(-3.0, 0.1));
  Part part;
  part.point = size_m * random.in_cube(1.0);
  part.normal = random.direction();
  part.half = wide * Vec3(random.in(0.0, 1.0), random.in(0.0, 1.0), random.in(0.0, 1.0));
  part.middle = part.point + part.half * random.in_cube(1.0);
  const Vec3 across = unit(glm::cross(part.normal, random.direction()));
  const double off = random.in(0.0, 1.0) * angle;
  part.cone = {std::cos(off) * part.normal + std::sin(off) * across, std::cos(angle)};
  return part;
}

Finger random_finger(Random& random, FingerShape shape, double size_m) {
  Finger finger = finger_of(shape);
  const double scale = size_m / 0.02 * std::pow(10.0, random.in(-0.5, 0.5));
  finger.radius_m *= scale;
  finger.half_length_m *= scale * random.in(0.1, 2.0);
  finger.semi_axes_m *= scale * Vec3(random.in(0.5, 2.0), random.in(0.5, 2.0), random.in(0.5, 2.0));
  return finger;
}

FourParts in_floats(const std::array<Part, 4>& parts, const Vec3& centre, double way_m, double far_m, double deep_m) {
  FourParts four;
  double size = glm::length(centre);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const SurfaceBounds bounds = parts[lane].bounds();
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      four.away[at][lane] = static_cast<float>(centre[k]) - static_cast<float>(bounds.middle[k]);
      four.half[at][lane] = static_cast<float>(bounds.half[k]);
      four.axis[at][lane] = static_cast<float>(bounds.normals.axis[k]);
    }
    four.cos_half[lane] = static_cast<float>(bounds.normals.cos_half - 1e-7);
    four.sin_half[lane] = static_cast<float>(bounds.sine + 1e-7);
    four.radius_m[lane] = static_cast<float>(bounds.radius_m * (1.0 + 1e-7));
    size = std::max(size, glm::length(bounds.middle) + bounds.radius_m);
  }
  four.way_m = Four{} + static_cast<float>(way_m);
  four.far_m = Four{} + static_cast<float>(far_m);
  four.deep_m = Four{} + static_cast<float>(deep_m);
  four.room_m = static_cast<float>(2.0 * kRoom * size);
  return four;
}

/// Of one part, by doubles: what FourCore::misses asks.
bool missed_in_doubles(const FingerCore& core, const Part& part, double way_m, double far_m, double deep_m) {
  const SurfaceBounds bounds = part.bounds();
  const double rank = core.reach_m() - core.ball_m() - deep_m;
  return core.apart_m(bounds.middle, bounds.half) > far_m || (deep_m > 0.0 && core.least_rank(bounds.normals) > rank) ||
         !can_touch_at_a_glance(core, bounds, way_m);
}

}  // namespace

TEST_CASE("of four parts at once an ellipsoid or a capsule misses none that it touches, in floats, too") {
  Random random(45);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule})
    for (const double size_m : {1e-9, 0.02, 1e6}) {
      CAPTURE(static_cast<int>(shape));
      CAPTURE(size_m);
      int wrong = 0, told = 0, told_in_doubles = 0, all = 0;
      for (int i = 0; i < rounds(20000); ++i) {
        const Finger finger = random_finger(random, shape, size_m);
        std::array<Part, 4> parts;
        for (Part& part : parts) part = random_part(random, size_m);
        const std::uint32_t touched = random.below(4);
        const Part& part = parts[touched];
        // It rests on the first part after a way of at most that far, and is asked before.
        const double way = random.below(3) ? size_m * std::pow(10.0, random.in(-4.0, -1.0)) : 0.0;
        const FingerPose there =
            resting_on(finger, part.point, part.normal, random.in(-0.3, 1.0) * finger.reach_m(), random);
        FingerPose here = there;
        const double turns = random.in(0.0, 1.0);
        here.position += (1.0 - turns) * way * random.direction();
        here.orientation =
            glm::normalize(glm::angleAxis(turns * way / finger.reach_m(), random.direction()) * there.orientation);
        const FingerCore core(finger, here);
        const double rank = contact_rank(finger, contact_on_plane(finger, there, part.point, part.normal));
        // As the hierarchy asks: of ranks up to that one after the way, and just so.
        const double counts = rank + way + 1e-9 * size_m;
        const bool deep_asked = counts < core.deep_rank_m();
        const double far = core.outside_at(counts, way);
        const double deep = deep_asked ? core.reach_m() - core.ball_m() - counts : 0.0;
        const FourMask missed = FourCore(core).misses(in_floats(parts, here.position, way, far, deep), kLeastCosine);
        wrong += missed[touched] != 0;
        for (std::size_t lane = 0; lane < 4; ++lane) {
          if (!(parts[lane].cone.cos_half > kLeastCosine + 1e-6)) continue;
          ++all;
          told += missed[lane] != 0;
          told_in_doubles += missed_in_doubles(core, parts[lane], way, far, deep);
        }
      }
      MESSAGE(told << " of " << all << " missed, " << told_in_doubles << " in doubles");
      CHECK(wrong == 0);
      CHECK(told_in_doubles > all / 4);
      CHECK(told > 0.99 * told_in_doubles);
    }
}
