// Every contact of a finger on a closed body, by winding numbers, without the solver's steps, proofs or derivatives:
// what a search may find, and which of it is stable.
//
// Over a patch the travel, what the finger's support misses a place by in its plane, is a map to the plane. Round a
// cell whose zero it turns once, forwards round a sink or a source, backwards round a saddle. Over a closed surface
// these turns add up to its Euler characteristic (Poincare and Hopf): 0 for a torus. So a list that adds up has no gap
// that an odd number of contacts could hide in.
#include "core/surface/mesh_patch.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// A ball along an axis that bulges by kSpindle, its support by the angle on the meridian.
struct CapsuleByAngle {
  double radius_m, half_length_m;
  Vec3 centre, axis;

  Vec3 support(const Vec3& normal) const {
    const double a = half_length_m * std::sqrt(1.0 + kSpindle * kSpindle), b = half_length_m * kSpindle;
    const double along = glm::dot(normal, axis);
    const Vec3 across = normal - along * axis;
    const double sideways = glm::length(across), t = std::atan2(b * sideways, a * along);
    return centre - a * std::cos(t) * axis - (b * std::sin(t) / sideways) * across - radius_m * normal;
  }
};

struct Miss {
  Vec3 travel, normal;
  double depth_m = 0.0;
};

struct FoundContact {
  int turns = 0;  ///< of the travel round it
  double depth_m = 0.0, error_m = 0.0;
  double det = 0.0, trace = 0.0;  ///< of M: a step ds in the plane changes the travel by -M ds
  bool stable() const { return det > 0.0 && trace > 0.0; }
};

class PatchContacts {
 public:
  PatchContacts(const PnPatch& patch, const CapsuleByAngle& finger) : patch_(patch), finger_(finger) {
    const Vec3 axis = unit(patch.normals[n200] + patch.normals[n020] + patch.normals[n002]);
    x_ = unit(glm::cross(axis, std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    y_ = glm::cross(axis, x_);
  }

  void find(int cells, std::vector<FoundContact>& found) const {
    const double side = 1.0 / cells;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        const Vec2 a(i * side, j * side), b(a.x + side, a.y), c(a.x, a.y + side), d(b.x, c.y);
        look({a, b, c}, found);
        if (i + j + 1 < cells) look({b, d, c}, found);
      }
  }

 private:
  using Cell = std::array<Vec2, 3>;

  Miss miss(const Vec2& uv) const {
    const Vec3 normal = evaluate_normal(patch_, uv.x, uv.y);
    const Vec3 off = finger_.support(normal) - evaluate_point(patch_, uv.x, uv.y);
    const double over = glm::dot(off, normal);
    return {off - over * normal, normal, -over};
  }
  Vec2 in_plane(const Vec2& uv) const {
    const Vec3 travel = miss(uv).travel;
    return {glm::dot(travel, x_), glm::dot(travel, y_)};
  }
  int turns(const Cell& cell) const {
    const auto turn = [](const Vec2& p, const Vec2& q) { return std::atan2(p.x * q.y - p.y * q.x, glm::dot(p, q)); };
    const Vec2 a = in_plane(cell[0]), b = in_plane(cell[1]), c = in_plane(cell[2]);
    return static_cast<int>(std::lround((turn(a, b) + turn(b, c) + turn(c, a)) / (360.0 * kDegree)));
  }

  /// What 2 kStep along u and v change.
  static constexpr double kStep = 1e-6;
  template <class Of>
  static auto change(Of of, const Vec2& at, const Vec2& along) {
    return of(at + kStep * along) - of(at - kStep * along);
  }

  /// From a cell that the travel turns round to the zero in it: Newton's steps, no longer than the cell.
  Vec2 zero(const Cell& cell) const {
    Vec2 at = (cell[0] + cell[1] + cell[2]) / 3.0;
    const double longest = glm::distance(cell[0], cell[1]);
    const auto of = [&](const Vec2& uv) { return in_plane(uv); };
    for (int i = 0; i < 50; ++i) {
      const Vec2 f = in_plane(at), fu = change(of, at, {1.0, 0.0}), fv = change(of, at, {0.0, 1.0});
      Vec2 step = 2.0 * kStep / (fu.x * fv.y - fu.y * fv.x) * Vec2(f.x * fv.y - f.y * fv.x, fu.x * f.y - fu.y * f.x);
      step *= std::min(1.0, longest / glm::length(step));
      at -= step;
    }
    return at;
  }

  void look(const Cell& cell, std::vector<FoundContact>& found) const {
    FoundContact contact;
    contact.turns = turns(cell);
    if (contact.turns == 0) return;
    const Vec2 at = zero(cell), u(1.0, 0.0), v(0.0, 1.0);
    const Miss here = miss(at);
    contact.depth_m = here.depth_m;
    contact.error_m = glm::length(here.travel);
    const auto travel = [&](const Vec2& uv) { return miss(uv).travel; };
    const auto point = [&](const Vec2& uv) { return evaluate_point(patch_, uv.x, uv.y); };
    const Vec3 mu = -change(travel, at, u), mv = -change(travel, at, v), su = change(point, at, u),
               sv = change(point, at, v);
    const auto area = [&](const Vec3& p, const Vec3& q) { return glm::dot(glm::cross(p, q), here.normal); };
    contact.det = area(mu, mv) / area(su, sv);
    contact.trace = (area(mu, sv) + area(su, mv)) / area(su, sv);
    found.push_back(contact);
  }

  const PnPatch& patch_;
  const CapsuleByAngle& finger_;
  Vec3 x_, y_;
};

std::vector<FoundContact> every_contact(const ContactMesh& mesh, const CapsuleByAngle& finger) {
  std::vector<FoundContact> found;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const PnPatch patch = make_patch(mesh, t);
    PatchContacts(patch, finger).find(16, found);
  }
  return found;
}

}  // namespace

TEST_CASE("where a capsule touches a torus: each contact by brute force, which are stable, and what a tick shows" *
          doctest::skip(testing::kSanitized)) {
  const auto torus = generate_mesh("torus", {});
  REQUIRE(torus);
  const ScenePtr scene = scene_of(*torus);
  Preset preset;
  preset.solver.method = Method::robust;
  preset.finger.shape = FingerShape::capsule;
  preset.finger.radius_m = 0.008;
  preset.finger.half_length_m = 0.010;
  struct Pose {
    FingerPose finger;
    int stable;
    double shown_m;  ///< depth
    int turns;       ///< -1: the shown place is a saddle, which no finger would rest at: `facing`, not a contact
  };
  const Pose poses[] = {// Outside; the surface is weak in one direction, det M 0.04.
                        {{{-0.0049068887829580386, -0.0018296632501952294, 0.03110531392818567},
                          {-0.5079788991772165, -0.090420412057016009, 0.85529247625294613, 0.047501233028695335}},
                         1,
                         -0.0226265,
                         1},
                        // Across the tube: four contacts, all unstable. The one that is shown has det M -0.58.
                        {{{-0.031078657034384314, -0.0068126892133906431, -0.0044374950407303883},
                          {-0.25795240647071749, -0.65346452588990145, 0.41340766665678064, 0.579257085022573}},
                         0,
                         0.0342024,
                         -1}};
  for (const Pose& pose : poses) {
    CAPTURE(pose.shown_m);
    const CapsuleByAngle finger{preset.finger.radius_m, preset.finger.half_length_m,
                                pose.finger.position - scene->mesh().origin(),
                                pose.finger.orientation * Vec3(1.0, 0.0, 0.0)};
    int turns = 0, stable = 0, shown = 0;
    const TickOutput tick = solve_once(scene, preset, pose.finger);
    for (const FoundContact& c : every_contact(scene->mesh(), finger)) {
      CHECK(c.error_m < 1e-9);
      CHECK((c.det > 0.0) == (c.turns > 0));
      turns += c.turns;
      stable += c.stable();
      if (std::abs(c.depth_m - tick.penetration_m) > 1e-7) continue;
      ++shown;
      CHECK(c.turns == pose.turns);
      CHECK(c.stable() == (pose.turns > 0));
    }
    CHECK(turns == 0);
    CHECK(stable == pose.stable);
    CHECK(shown == 1);
    CHECK(std::abs(tick.penetration_m - pose.shown_m) < 1e-6);
    CHECK((tick.status == TickStatus::facing) == (pose.turns < 0));
    CHECK(is_converged(tick.status) == (pose.turns > 0));
  }
}
