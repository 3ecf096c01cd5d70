// Creases and vertices: no round finger is kept off one that it touches or can come to touch.
#include "core/contact/prove/feature_proof.h"

#include "core/contact/edge_fan.h"
#include "core/contact/prove/certain_margin.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Of contacts put on features: how far a finger beside one is told that it may go until it can be there.
struct Told {
  int missed = 0, told = 0, all = 0, glance_tells_more = 0;
  double nearest = 0.0;  ///< the farthest, as a ratio to how far it is

  /// A contact at a point with that normal, at a height, and a centre some way off.
  void ask(PatchCache& cache, const TriangleFeature& feature, const Vec3& point, const Vec3& normal, Random& random) {
    const double height = random.in(0.001, 0.030), way = std::pow(10.0, random.in(-4.5, -2.0));
    const Vec3 centre = point + height * normal + way * random.direction();
    const RankBound bound{random.in(0.5, 1.5) * height, random.below(2) ? 1.0 : 2.0};
    // The bound rises by so much on the way there.
    if (!(height < bound.rank_m + (bound.closing - 1.0) * way - 1e-9)) return;
    const double enough = random.below(2) ? 0.0 : std::pow(10.0, random.in(-4.0, -2.0));
    const auto margin_of = [&](bool glance) {
      return exclude_feature_contacts(cache, feature, NormalForm::bernstein, centre, bound, enough, glance).margin_m;
    };
    const double margin = margin_of(false), or_none = margin_of(true);
    ++all;
    missed += margin > way * (1.0 + 1e-9) + 1e-12;
    missed += or_none >= enough && or_none > way * (1.0 + 1e-9) + 1e-12;
    glance_tells_more += enough > 0.0 && or_none >= enough && margin < kAtOnceShare * enough;
    told += margin > 0.0;
    if (margin > 0.0) nearest = std::max(nearest, margin / way);
  }

  void check() const {
    MESSAGE(missed << " missed of " << all << ", " << told << " excluded, by up to " << nearest << " of the way");
    CHECK(all > rounds(10000));
    CHECK(missed == 0);
    CHECK(glance_tells_more == 0);
    CHECK(told > all / 20);
    CHECK(nearest > 0.5);  // and does not fall far short
  }
};

}  // namespace

TEST_CASE("no round finger is kept off a crease or a rim that it touches or can come to touch within the margin") {
  Random random(321);
  Told told;
  for (const ContactMesh& mesh : creased_meshes_and_rims()) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(40000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), side = random.below(3);
      if (mesh.edge_kind(t, side) == EdgeKind::smooth) continue;
      if (const std::optional<SurfaceSample> s = place_on_fan(cache, t, side, random))
        told.ask(cache, {t, side}, s->point, s->normal, random);
    }
  }
  told.check();
}

TEST_CASE("no round finger is kept off a vertex that it touches or can come to touch within the margin") {
  Random random(323);
  Told told;
  for (const ContactMesh& mesh : creased_meshes_and_rims()) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(20000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), corner = random.below(3);
      if (const std::optional<Vec3> normal = normal_of_corner(mesh, t, corner, random))
        told.ask(cache, {t, corner, true}, mesh.position(t, corner), *normal, random);
    }
  }
  told.check();
}

TEST_CASE("beside a contact on a vertex its edges are excluded, by parts where they bend") {
  Random random(331);
  int edges = 0, excluded = 0;
  for (const ContactMesh& mesh : creased_meshes_and_rims()) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(40000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), corner = random.below(3);
      const std::optional<Vec3> normal = normal_of_corner(mesh, t, corner, random);
      if (!normal) continue;
      const double height = random.in(0.005, 0.020);
      const Vec3 centre = mesh.position(t, corner) + height * *normal;
      for (const std::uint32_t side : {corner, (corner + 2) % 3}) {
        if (mesh.edge_kind(t, side) == EdgeKind::smooth) continue;
        ++edges;
        excluded +=
            exclude_feature_contacts(cache, {t, side}, NormalForm::bernstein, centre, {1.5 * height}).margin_m > 0.0;
      }
    }
  }
  MESSAGE(excluded << " of " << edges << " edges excluded");
  CHECK(100.0 * excluded > 89.0 * edges);  // 88.2 in 100 as a whole, 90.1 by parts
}
