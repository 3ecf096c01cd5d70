// Creases and vertices: no round finger is kept off one that it touches or can come to touch.
#include "core/contact/prove/feature_proof.h"

#include "core/contact/edge_fan.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

/// With rims, where a third of the faces is missing.
ContactMesh open_stone() {
  const PolygonMesh whole = make_icosphere(0.030, 2);
  PolygonMesh stone;
  Random random(322);
  for (const Vec3& p : whole.positions) stone.positions.push_back(p * random.in(0.9, 1.1));
  for (std::size_t f = 0; f + 1 < whole.face_offsets.size(); ++f) {
    if (random.below(3) == 0) continue;
    for (std::uint32_t i = whole.face_offsets[f]; i < whole.face_offsets[f + 1]; ++i)
      stone.corner_position.push_back(whole.corner_position[i]);
    stone.face_offsets.push_back(static_cast<std::uint32_t>(stone.corner_position.size()));
  }
  ContactMeshOptions options;
  options.crease_rad = 20.0 * kDegree;
  return *ContactMesh::build(stone, options);
}

}  // namespace

TEST_CASE("no round finger is kept off a crease or a rim that it touches or can come to touch within the margin") {
  Random random(321);
  int missed = 0, told = 0, all = 0, none_is_less = 0;
  double nearest = 0.0;
  std::vector<ContactMesh> meshes = creased_meshes();
  meshes.push_back(open_stone());
  for (const ContactMesh& mesh : meshes) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(40000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), side = random.below(3);
      if (mesh.edge_kind(t, side) == EdgeKind::smooth) continue;
      const EdgeFan& fan = cache.fan(t, side, random.in(0.0, 1.0), NormalForm::bernstein);
      if (!fan.convex()) continue;
      const double angle = random.in(0.0, 1.0) * std::atan2(fan.far.y, fan.far.x);
      SurfaceSample s;
      edge_sample(fan, Vec2(std::cos(angle), std::sin(angle)), s);
      const double height = random.in(0.001, 0.030), way = std::pow(10.0, random.in(-4.5, -2.0));
      const Vec3 centre = s.point + height * s.normal + way * random.direction();
      const RankBound bound{random.in(0.5, 1.5) * height, random.below(2) ? 1.0 : 2.0};
      // The bound rises by so much on the way there.
      if (!(height < bound.rank_m + (bound.closing - 1.0) * way - 1e-9)) continue;
      const double enough = random.below(2) ? 0.0 : std::pow(10.0, random.in(-4.0, -2.0));
      const TriangleFeatures features{t, random.below(2) ? side : TriangleFeatures::kAll};
      const double margin = exclude_feature_contacts(cache, features, NormalForm::bernstein, centre, bound, enough);
      const double or_none =
          exclude_feature_contacts(cache, features, NormalForm::bernstein, centre, bound, enough, nullptr, true);
      ++all;
      missed += margin > way * (1.0 + 1e-9) + 1e-12;
      missed += or_none >= enough && or_none > way * (1.0 + 1e-9) + 1e-12;
      none_is_less += enough > 0.0 && (or_none >= enough) != (margin >= enough);
      told += margin > 0.0;
      if (margin > 0.0) nearest = std::max(nearest, margin / way);
    }
  }
  MESSAGE(missed << " missed of " << all << ", " << told << " excluded, by up to " << nearest << " of the way");
  CHECK(missed == 0);
  CHECK(none_is_less == 0);
  CHECK(told > all / 20);
  CHECK(nearest > 0.5);  // and does not fall far short
}
