// Proofs for fingers that are not round: the core is as linear as they take it for, and no contact comes up within a
// margin, on faces, creases and vertices, however the finger goes and turns.
#include "core/contact/prove/core_proof.h"

#include "core/base/tolerances.h"
#include "core/contact/prove/clearance_check.h"
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/prove/core_corner_proof.h"
#include "core/contact/prove/core_feature_proof.h"
#include "core/contact/prove/linear_core.h"
#include "core/contact/prove/triangle_proof.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/features.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr FingerShape kCoreShapes[] = {FingerShape::ellipsoid, FingerShape::capsule};

PolygonMesh bent_triangle(Random& random, double spread) {
  const Vec3 up = random.direction();
  std::array<Vec3, 3> p, n;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = random.in_cube(0.004);
    p[k] -= glm::dot(p[k], up) * up;
    n[k] = unit(up + spread * random.direction());
  }
  return one_triangle(p, n);
}

/// All of its edges are creases, convex and hollow ones.
ContactMesh sharp_ball(Random& random) {
  ContactMeshOptions options;
  options.crease_rad = 0.1;
  PolygonMesh ball = make_icosphere(0.010, 1);
  for (Vec3& p : ball.positions) p *= random.in(0.8, 1.2);
  ball.normals.clear();
  ball.corner_normal.clear();
  return *ContactMesh::build(ball, options);
}

/// What proofs read, for one pose.
struct Prover {
  PatchCache cache;
  SolverSettings settings;
  Finger finger;

  template <class Prove>
  double margin(const FingerPose& pose, Prove prove) {
    ContactContext context{cache, settings, finger, pose, Vec3(0.0)};
    const FingerCore core(finger, pose);
    context.core = &core;
    return prove(context, core);
  }
};

/// Contacts up to a millimetre deep or as far off, seen from up to `farthest_m` away: `make` gives point and normal of
/// one, `prove` the margin there. Returns the share of poses from which something was proved.
template <class Make, class Prove>
double share_proved(const ContactMesh& mesh, FingerShape shape, int count, double farthest_m, Random& random, Make make,
                    Prove prove) {
  Prover prover{PatchCache(mesh), SolverSettings{}, finger_of(shape)};
  int proved = 0, wrong = 0;
  for (int i = 0; i < count; ++i) {
    const auto [point, normal] = make(prover.cache);
    const FingerPose there = resting_on(prover.finger, point, normal, random.in(-1e-3, 1e-3), random);
    double gone = 0.0;
    const FingerPose here = before(prover.finger, there, random.in(0.0, farthest_m), random, gone);
    const double margin = prover.margin(here, prove);
    proved += margin > 0.0;
    wrong += margin > gone * (1.0 + 1e-9) + 1e-12;
  }
  CHECK(wrong == 0);
  return static_cast<double>(proved) / count;
}

/// Contacts of any depth, until the centre is far behind their planes, seen from where they just begin to count.
/// Returns how many were excluded wrongly, and how many poses at which something was; `prove` gets the bound, too.
template <class Make, class Prove>
std::pair<int, int> excluded_by_rank(const ContactMesh& mesh, FingerShape shape, int count, Random& random, Make make,
                                     Prove prove) {
  Prover prover{PatchCache(mesh), SolverSettings{}, finger_of(shape)};
  int wrong = 0, proved = 0;
  for (int i = 0; i < count; ++i) {
    const auto [point, normal] = make(prover.cache);
    const double depth = random.in(-2e-3, 2.0 * prover.finger.reach_m());
    const FingerPose there = resting_on(prover.finger, point, normal, depth, random);
    const double rank = contact_rank(prover.finger, contact_on_plane(prover.finger, there, point, normal));
    double gone = 0.0;
    const FingerPose here = before(prover.finger, there, random.below(2) ? random.in(0.0, 4e-3) : 0.0, random, gone);
    const double closing = random.below(2) ? 1.0 : 2.0;
    const RankBound bound{rank - (closing - 1.0) * gone + 1e-9, closing};
    const double margin = prover.margin(
        here, [&](ContactContext& context, const FingerCore& core) { return prove(context, core, bound); });
    proved += margin > 0.0;
    wrong += margin > gone * (1.0 + 1e-9) + 1e-12;
  }
  return {wrong, proved};
}

/// Counts whatever its rank.
constexpr RankBound kAnyRank{1e3, 2.0};
/// All those contacts count, and none much further off.
RankBound up_to_them(FingerShape shape) { return {finger_of(shape).reach_m() + 1.1e-3, 1.0}; }

}  // namespace

TEST_CASE("over a patch the core is linear in the normal but for what is said, and on its long axis where it is thin") {
  Random random(71);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    int over = 0, known = 0;
    for (int i = 0; i < rounds(4000); ++i) {
      const PnPatch patch =
          PatchPiece(make_patch(*ContactMesh::build(bent_triangle(random, random.in(0.0, 0.5))), 0)).patch;
      const FingerCore core(finger_of(shape), {random.in_cube(0.01), random.orientation()});
      const Vec3 axis = unit(patch.normals[n200] + patch.normals[n020] + patch.normals[n002]);
      for (const LinearCore& l : {linear_core(core, patch.normals, axis), segment_core(core, patch.normals, axis)}) {
        if (!(l.off_m < 1e3)) continue;
        ++known;
        const Vec2 at = random.barycentric();
        const double w = 1.0 - at.x - at.y;
        const auto& c = patch.normals;
        const Vec3 n = w * w * c[n200] + at.x * at.x * c[n020] + at.y * at.y * c[n002] +
                       2.0 * (w * at.x * c[n110] + at.x * at.y * c[n011] + w * at.y * c[n101]);
        const Vec3 e = core.support(unit(n)).point - l.point - l.scale * core.derivative(l.support, n);
        const Vec3 direction = unit(glm::cross(axis, random.direction()));
        double steepest = 0.0;
        for (const Vec3& slope : l.slopes) steepest = std::max(steepest, std::abs(glm::dot(slope, direction)));
        const double across = std::abs(glm::dot(e - (glm::dot(e, axis) / glm::dot(n, axis)) * n, direction));
        over += across > l.slope_share * steepest + std::abs(glm::dot(l.bend, direction)) +
                             l.rest_m / glm::dot(unit(n), axis) + 1e-12;
        over += std::abs(glm::dot(e, axis)) > l.along_m + 1e-12;
      }
    }
    CHECK(over == 0);
    CHECK(known > rounds(2000));
  }
}

namespace {

FourVec3 lanes_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  FourVec3 lanes;
  for (int k = 0; k < 3; ++k)
    lanes[static_cast<std::size_t>(k)] =
        Four{static_cast<float>(a[k]), static_cast<float>(b[k]), static_cast<float>(c[k]), static_cast<float>(a[k])};
  return lanes;
}
Vec3 lane(const FourVec3& lanes, std::size_t i) { return {lanes[0][i], lanes[1][i], lanes[2][i]}; }

}  // namespace

TEST_CASE("the core's points for control normals are control points of its points over a patch but for what is said") {
  Random random(80);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    int over = 0, known = 0;
    double nearest = 0.0;
    for (int i = 0; i < rounds(40000); ++i) {
      const PnPatch patch =
          PatchPiece(make_patch(*ContactMesh::build(bent_triangle(random, random.in(0.0, 0.5))), 0)).patch;
      const FingerCore core(finger_of(shape), {random.in_cube(0.01), random.orientation()});
      const auto& n = patch.normals;
      const CoreControlPoints control(core, lanes_of(n[n200], n[n020], n[n002]), lanes_of(n[n110], n[n011], n[n101]));
      if (!(control.off_m < 1e3)) continue;
      std::array<Vec3, 6> points;
      for (std::size_t k = 0; k < 3; ++k) {
        points[std::array{n200, n020, n002}[k]] = core.centre() + lane(control.corners, k);
        points[std::array{n110, n011, n101}[k]] = core.centre() + lane(control.sides, k);
      }
      ++known;
      const Vec2 at = random.barycentric();
      const double w = 1.0 - at.x - at.y;
      const auto mixed = [&](const std::array<Vec3, 6>& of) {
        return w * w * of[n200] + at.x * at.x * of[n020] + at.y * at.y * of[n002] +
               2.0 * (w * at.x * of[n110] + at.x * at.y * of[n011] + w * at.y * of[n101]);
      };
      const CoreSupport there = core.support(unit(mixed(patch.normals)));
      const double off = glm::distance(there.point, mixed(points));
      over += off > control.off_m || there.length < control.least_length_m;
      nearest = std::max(nearest, off / control.off_m);
    }
    MESSAGE(known << " known, off by up to " << nearest << " of what is said");
    CHECK(over == 0);
    CHECK(known > 1000);
    CHECK(nearest > 0.2);
  }
}

TEST_CASE("a core that is not as linear over a patch as is asked for is told so, every other as without a limit") {
  Random random(76);
  int within = 0, beyond = 0;
  for (const FingerShape shape : kCoreShapes)
    for (int i = 0; i < 1000; ++i) {
      const PnPatch patch =
          PatchPiece(make_patch(*ContactMesh::build(bent_triangle(random, random.in(0.0, 0.3))), 0)).patch;
      const FingerCore core(finger_of(shape), {random.in_cube(0.01), random.orientation()});
      const Vec3 axis = unit(patch.normals[n200] + patch.normals[n020] + patch.normals[n002]);
      const LinearCore free = linear_core(core, patch.normals, axis);
      const double limit = std::pow(10.0, random.in(-5.0, -2.0));
      const LinearCore limited = linear_core(core, patch.normals, axis, limit);
      if (free.off_m < limit) {
        ++within;
        CHECK(limited.off_m == free.off_m);
        CHECK(limited.slopes == free.slopes);
        CHECK(limited.least_length_m == free.least_length_m);
      } else {
        ++beyond;
        CHECK(limited.off_m == std::numeric_limits<double>::infinity());
      }
    }
  CHECK(within > 200);
  CHECK(beyond > 200);
}

TEST_CASE("a patch known roughly is excluded by the same margin or by none where no place on it is asked for") {
  Random random(77);
  int excluded = 0, held = 0, other = 0, lost = 0, heights = 0;
  for (int i = 0; i < 4000; ++i) {
    const PnPatch patch = make_patch(*ContactMesh::build(bent_triangle(random, random.in(0.0, 0.4))), 0);
    const Vec3 normal = unit(patch.normals[n200] + patch.normals[n020] + patch.normals[n002]);
    const Vec3 centre = patch.origin + random.in(1e-3, 1e-2) * normal + random.in_cube(6e-3);
    StandIn rough{{patch.offsets[b030], patch.offsets[b003]}, {}};
    // Six slopes, or the one of a long core, mostly across the normals.
    rough.spread_count = random.below(2) ? 6 : 1;
    rough.spread.fill(random.in_cube(2e-3));
    for (std::size_t k = 1; k < rough.spread_count; ++k) rough.spread[k] = random.in_cube(5e-4);
    rough.bend = random.in_cube(2e-4);
    rough.rest_m = std::pow(10.0, random.in(-6.0, -3.0));
    const double enough = random.below(2) ? random.in(1e-6, 2e-3) : 0.0;
    const PatchExclusion asked = exclude_contact(patch, centre, enough, rough);
    rough.place_wanted = false;
    rough.height_matters_m = random.in(0.0, 1e-2);
    const PatchExclusion unasked = exclude_contact(patch, centre, enough, rough);
    (asked.possible ? held : excluded) += 1;
    if (unasked.possible) {
      lost += !asked.possible;
      other += unasked.margin_m != 0.0;
    } else {
      other += asked.possible || asked.margin_m != unasked.margin_m;
    }
    other += asked.least_height_m > rough.height_matters_m && unasked.least_height_m != asked.least_height_m;
    other += unasked.least_height_m != 0.0 && unasked.least_height_m != asked.least_height_m;
    heights += unasked.least_height_m > 0.0;
  }
  CHECK(other == 0);
  CHECK(lost < excluded / 20);
  CHECK(excluded > 400);
  CHECK(held > 400);
  CHECK(heights > 100);
}

TEST_CASE("a piece of a patch is the patch there, and bisected all over it") {
  Random random(72);
  const PnPatch patch = make_patch(*ContactMesh::build(bent_triangle(random, 0.5)), 0);
  PatchPiece piece(patch);
  for (int depth = 0; depth < 6; ++depth) {
    const Vec2 at = random.barycentric();
    const Vec2 whole = piece.at(at.x, at.y);
    CHECK(glm::distance(evaluate_point(piece.patch, at.x, at.y), evaluate_point(patch, whole.x, whole.y)) < 1e-15);
    CHECK(glm::distance(evaluate_normal(piece.patch, at.x, at.y), evaluate_normal(patch, whole.x, whole.y)) < 1e-12);
    PatchPiece first, second;
    bisect(piece, first, second);
    CHECK(first.depth == depth + 1);
    piece = random.below(2) ? first : second;
  }
}

TEST_CASE("no contact of an ellipsoid or a capsule comes up on a face within the margin, gentle or strongly bent") {
  Random random(73);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    for (const double spread : {0.1, 0.4}) {
      double proved = 0.0;
      for (int i = 0; i < rounds(100); ++i) {
        const ContactMesh mesh = *ContactMesh::build(bent_triangle(random, spread));
        // Without a margin to reach it tells of the pose as it is alone.
        const double enough = random.below(2) ? random.in(1e-6, 2e-3) : 0.0;
        proved += share_proved(
            mesh, shape, 20, enough > 0.0 ? 4e-3 : 0.0, random,
            [&](PatchCache& cache) {
              const Vec2 at = random.barycentric();
              SurfaceSample s;
              cache.sample(0, NormalForm::bernstein, at.x, at.y, s);
              return std::pair(s.point, s.normal);
            },
            [&](ContactContext& context, const FingerCore& core) {
              return exclude_face_by_core(context, core, 0, kAnyRank, enough).margin_m;
            });
      }
      CHECK(proved > (rounds(100) == 100 ? 10.0 : 0.0));  // of few rounds the share says little
    }
  }
}

TEST_CASE("the corners of a face exclude no contact of an ellipsoid or a capsule, beside creases, too") {
  Random random(79);
  std::vector<ContactMesh> meshes = creased_meshes_and_rims();
  meshes.push_back(*ContactMesh::build(rough_ball(random)));
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    int excluded = 0, all = 0, wrong = 0;
    double nearest = 0.0;
    for (const ContactMesh& mesh : meshes) {
      PatchCache cache(mesh);
      for (int i = 0; i < rounds(20000); ++i) {
        Finger finger = finger_of(shape);
        finger.semi_axes_m *= Vec3(random.in(0.2, 2.0), random.in(0.2, 2.0), random.in(0.2, 2.0));
        finger.half_length_m *= random.in(0.1, 1.5);
        const NormalForm form = random.below(2) ? NormalForm::bernstein : NormalForm::vlachos;
        const std::uint32_t t = random.below(mesh.triangle_count());
        // Half of them on a side, where all else may be clear.
        const Vec2 inside = random.barycentric();
        const Vec2 at = random.below(2) ? inside : Vec2(inside.x, random.below(2) ? 0.0 : 1.0 - inside.x);
        const SurfaceSample s = evaluate(make_patch(mesh, t, form), at.x, at.y);
        const double depth = random.in(-0.01, 2.0 * finger.reach_m());
        const FingerPose there = resting_on(finger, s.point, s.normal, depth, random);
        double gone = 0.0;
        const double way = random.below(2) ? std::pow(10.0, random.in(-4.5, -1.5)) : 0.0;
        const FingerPose here = before(finger, there, way, random, gone);
        const FingerCore core(finger, here);
        const double enough = random.below(2) ? gone * std::pow(10.0, random.in(-1.0, 1.0)) : 0.0;
        const double margin = corner_exclusion_by_core(cache, t, form, core, enough);
        ++all;
        excluded += margin > 0.0;
        wrong += margin > gone * (1.0 + 1e-9) + 1e-12;
        if (way > 0.0) nearest = std::max(nearest, margin / gone);
      }
    }
    MESSAGE(excluded << " of " << all << " excluded, by up to " << nearest << " of the way, " << wrong << " by more");
    CHECK(wrong == 0);
    CHECK(excluded > all / 400);
    CHECK(nearest > 0.4);
  }
}

TEST_CASE("no rank excludes a contact of an ellipsoid or a capsule, however deep, or seen from inside") {
  Random random(77);
  const auto on_face = [&](PatchCache& cache, std::uint32_t t) {
    const Vec2 at = random.barycentric();
    SurfaceSample s;
    cache.sample(t, NormalForm::bernstein, at.x, at.y, s);
    return std::pair(s.point, s.normal);
  };
  const ContactMesh sharp = sharp_ball(random);
  const ContactMesh sheet = *ContactMesh::build(bent_triangle(random, 0.3));
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    int wrong = 0, on_faces = 0;
    for (int i = 0; i < rounds(400); ++i) {
      const ContactMesh mesh = *ContactMesh::build(bent_triangle(random, random.in(0.0, 0.6)));
      const double enough = random.below(2) ? random.in(1e-6, 2e-3) : 0.0;
      const auto [w, proved] = excluded_by_rank(
          mesh, shape, 20, random, [&](PatchCache& cache) { return on_face(cache, 0); },
          [&](ContactContext& context, const FingerCore& core, const RankBound& bound) {
            return exclude_face_by_core(context, core, 0, bound, enough).margin_m;
          });
      wrong += w;
      on_faces += proved;
    }
    CHECK(wrong == 0);
    CHECK(on_faces > 0);
    std::uint32_t t = 0;
    const auto features = [&](ContactContext& context, const FingerCore& core, const RankBound& bound) {
      const double enough = random.below(2) ? 1e9 : 0.0;
      return least_margin(context.cache.mesh(), t, [&](const TriangleFeature& feature) {
        return exclude_feature_by_core(context, core, feature, bound, enough);
      });
    };
    const auto at_vertex = [&](PatchCache&) {
      t = random.below(sharp.triangle_count());
      const std::uint32_t k = random.below(3);
      Vec3 normal(0.0);
      around_vertex(sharp, t, k, [&](std::uint32_t at, std::uint32_t corner) {
        normal += random.in(0.0, 1.0) * sharp.normal(at, corner);
      });
      return std::pair(sharp.position(t, k), unit(normal));
    };
    const auto [wrong_at, at_vertices] = excluded_by_rank(sharp, shape, rounds(8000), random, at_vertex, features);
    CHECK(wrong_at == 0);
    CHECK(at_vertices > 0);
    const auto on_rim = [&](PatchCache& cache) {
      t = 0;
      SurfaceSample s;
      const double f = random.in(0.0, 1.0);
      cache.sample(0, NormalForm::bernstein, f, random.below(2) ? 0.0 : 1.0 - f, s);
      return std::pair(s.point, random.direction());
    };
    CHECK(excluded_by_rank(sheet, shape, rounds(8000), random, on_rim, features).first == 0);
  }
}

TEST_CASE("a glance from a core that lies ahead excludes no contact of an ellipsoid or a capsule within its reach") {
  Random random(76);
  const ContactMesh mesh = *ContactMesh::build(make_icosphere(0.010, 2));
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    std::uint32_t t = 0;
    const double excluded = share_proved(
        mesh, shape, rounds(4000), 4e-3, random,
        [&](PatchCache& cache) {
          t = random.below(mesh.triangle_count());
          const Vec2 at = random.barycentric();
          SurfaceSample s;
          cache.sample(t, NormalForm::bernstein, at.x, at.y, s);
          return std::pair(s.point, s.normal);
        },
        [&](ContactContext& context, const FingerCore& core) {
          FingerCore own = core;
          own.move_to(core.centre() + 1e-3 * random.direction());  // the finger itself is elsewhere
          context.core = &own;
          const double enough = random.in(1e-5, 1e-3);
          int tests = 0;
          const PartOfTriangle face{t, SearchPart::face};
          return excludes_at_a_glance(context, &core, face, kAnyRank, enough, tests) ? enough : 0.0;
        });
    CHECK(excluded > 0.01);
  }
}

TEST_CASE("where a face holds a contact of an ellipsoid or a capsule its rank is that of a contact there, or unknown") {
  Random random(75);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    Prover prover{PatchCache(*ContactMesh::build(bent_triangle(random, 0.1))), SolverSettings{}, finger_of(shape)};
    int wrong = 0, ranked = 0;
    const int count = rounds(2000);
    for (int i = 0; i < count; ++i) {
      const ContactMesh mesh = *ContactMesh::build(bent_triangle(random, random.in(0.0, 0.4)));
      PatchCache cache(mesh);
      const Vec2 at = random.barycentric();
      SurfaceSample s;
      cache.sample(0, NormalForm::bernstein, at.x, at.y, s);
      const FingerPose pose = resting_on(prover.finger, s.point, s.normal, random.in(-1e-3, 1e-3), random);
      const FingerCore core(prover.finger, pose);
      ContactContext context{cache, prover.settings, prover.finger, pose, Vec3(0.0)};
      context.core = &core;
      const PatchExclusion proof = exclude_face_by_core(context, core, 0, kAnyRank, 0.0);
      if (!(proof.height_m > 0.0)) continue;
      ++ranked;
      SurfaceSample there;
      cache.sample(0, NormalForm::bernstein, proof.u, proof.v, there);
      const PlaneContact found = contact_on_plane(prover.finger, pose, there.point, there.normal);
      wrong += found.error_m > kHeightGuess * core.reach_m() ||
               std::abs(contact_rank(prover.finger, found) - proof.height_m) > 1e-12;
    }
    CHECK(wrong == 0);
    CHECK(ranked > 4 * count / 10 - 10);  // of 2,000 942 and 871; the others are unstable, or places near one
  }
}

TEST_CASE("no contact of an ellipsoid or a capsule comes up on a crease or a vertex within the margin") {
  Random random(74);
  const ContactMesh mesh = sharp_ball(random);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    std::uint32_t t = 0;
    const double on_edges = share_proved(
        mesh, shape, rounds(4000), 8e-3, random,
        [&](PatchCache& cache) {
          for (;;) {
            t = random.below(mesh.triangle_count());
            const std::uint32_t k = random.below(3);
            if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
            const EdgeFan& fan = cache.fan(t, k, random.in(0.0, 1.0), NormalForm::bernstein);
            if (!fan.convex()) continue;
            const double turn = random.in(0.0, std::atan2(fan.far.y, fan.far.x));
            SurfaceSample s;
            edge_sample(fan, {std::cos(turn), std::sin(turn)}, s);
            return std::pair(s.point, s.normal);
          }
        },
        [&](ContactContext& context, const FingerCore& core) {
          return least_margin(mesh, t, [&](const TriangleFeature& feature) {
            return exclude_feature_by_core(context, core, feature, up_to_them(shape), 1e9);
          });
        });
    CHECK(on_edges > 0.01);
    const double on_vertices = share_proved(
        mesh, shape, rounds(4000), 8e-3, random,
        [&](PatchCache&) {
          t = random.below(mesh.triangle_count());
          const std::uint32_t k = random.below(3);
          Vec3 normal(0.0);
          around_vertex(mesh, t, k, [&](std::uint32_t at, std::uint32_t corner) {
            normal += random.in(0.0, 1.0) * mesh.normal(at, corner);
          });
          return std::pair(mesh.position(t, k), unit(normal));
        },
        [&](ContactContext& context, const FingerCore& core) {
          return least_margin(mesh, t, [&](const TriangleFeature& feature) {
            return exclude_feature_by_core(context, core, feature, up_to_them(shape), 1e9);
          });
        });
    CHECK(on_vertices > 0.01);
  }
}

TEST_CASE("ground that the tree takes for steady under an ellipsoid or a capsule is steady by its patch, too") {
  Random random(78);
  PolygonMesh body = make_icosphere(0.036, 3);
  for (Vec3& p : body.positions) p *= 1.0 + 0.03 * std::sin(200.0 * p.x) + 0.03 * std::sin(230.0 * p.y);
  body.normals.clear();
  body.corner_normal.clear();
  const ContactMesh mesh = *ContactMesh::build(body);
  const ContactHierarchy tree = ContactHierarchy::build(mesh);
  for (const FingerShape shape : kCoreShapes) {
    CAPTURE(static_cast<int>(shape));
    PatchCache cache(mesh);
    const Finger finger = finger_of(shape);
    int steady = 0, wrong = 0;
    for (int i = 0; i < 50; ++i) {
      const FingerPose pose{(0.036 + finger.reach_m()) * random.direction(), random.orientation()};
      const FingerCore core(finger, pose);
      ContactQuery query;
      query.centre = pose.position;
      query.core = &core;
      query.steady_ground = query.steady_only = true;
      query.region.include(Vec3(-1.0));
      query.region.include(Vec3(1.0));
      query.margin_m = random.in(0.0, 1e-3);
      limit_query(query, finger, finger.reach_m() + 0.004);
      tree.visit(query, [&](std::uint32_t t, ContactQuery& q) {
        ++steady;
        wrong += !may_be_steady_for_core(q, cache.bend(t, NormalForm::bernstein).least,
                                         cache.patch(t, NormalForm::bernstein));
        return true;
      });
    }
    CHECK(steady > 0);
    CHECK(wrong == 0);
  }
}
