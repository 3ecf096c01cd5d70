// Proofs about the parts of triangles with crease edges.
#include "core/contact/prove/triangle_proof.h"

#include "core/contact/contact_rank.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/prove/clearance_check.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/features.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <vector>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("where a face beside a crease holds a contact a start near it is given") {
  const ScenePtr scene = spot_scene(10.0);
  const ContactMesh& mesh = scene->mesh();
  PatchCache cache(mesh);
  SolverSettings settings;
  const Finger finger = sphere_preset(0.020, Method::robust).finger;
  Random random(18);
  int contacts = 0, excluded = 0, started = 0;
  for (int i = 0; i < rounds(4000); ++i) {
    const std::uint32_t t = random.below(mesh.triangle_count());
    if (!mesh.usable(t) || mesh.interior(t)) continue;
    const double u = random.in(0.1, 0.8), v = random.in(0.1, 0.9 - u), height = random.in(0.005, 0.02);
    SurfaceSample there;
    cache.sample(t, settings.normal_form, u, v, there);
    const Stability stability = normal_bend(there).at_height(height);
    if (!stability.stable() || stability.det < 0.2) continue;
    ++contacts;
    ContactContext context{cache, settings, finger, {there.point + height * there.normal, {}}, mesh.origin()};
    PartOfTriangle face{t};
    const PatchExclusion proof = exclude_part(context, face, {height + 1e-3, 2.0}, 1e-3);
    excluded += !proof.possible;
    started += std::abs(proof.u - u) + std::abs(proof.v - v) < 0.1;
  }
  MESSAGE(contacts << " contacts, " << started << " with a start near them");
  CHECK(contacts > 100);
  CHECK(excluded == 0);
  CHECK(100 * started > 95 * contacts);
}

namespace {

/// Contacts exactly over the corners of a mesh, and on its smooth edges: how many, and how many of them every triangle
/// there excludes.
struct OnBorders {
  int contacts = 0, excluded = 0;
};

OnBorders contacts_on_borders(const ContactMesh& mesh, const Finger& finger) {
  PatchCache cache(mesh);
  SolverSettings settings;
  Random random(27);
  const double height = finger.reach_m() - 1e-3;  // of a sphere
  OnBorders count;
  const auto ask = [&](const SurfaceSample& place, auto around) {
    const FingerPose pose = resting_on(finger, place.point, place.normal, 1e-3, random);
    ContactContext context{cache, settings, finger, pose, mesh.origin()};
    std::optional<FingerCore> core;
    if (!is_round(finger)) context.core = &core.emplace(finger, pose);
    ++count.contacts;
    bool excluded = true;
    around([&](std::uint32_t t) { excluded = excluded && excludes_triangle(context, t, {height + 0.05, 2.0}); });
    count.excluded += excluded;
  };
  const std::uint32_t step = std::max(1u, mesh.triangle_count() / static_cast<std::uint32_t>(rounds(600)));
  for (std::uint32_t t = 0; t < mesh.triangle_count(); t += step)
    for (std::uint32_t k = 0; k < 3; ++k) {
      SurfaceSample corner, edge;
      cache.sample(t, settings.normal_form, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, corner);
      cache.sample(t, settings.normal_form, k == 2 ? 0.0 : 0.5, k == 0 ? 0.0 : 0.5, edge);
      if (normal_bend(corner).at_height(height).stable())
        ask(corner, [&](auto exclude) {
          around_vertex(mesh, t, k, [&](std::uint32_t other, std::uint32_t) { exclude(other); });
        });
      if (mesh.edge_kind(t, k) != EdgeKind::smooth || !normal_bend(edge).at_height(height).stable()) continue;
      ask(edge, [&](auto exclude) {
        exclude(t);
        exclude(mesh.across(t, k).triangle);
      });
    }
  return count;
}

}  // namespace

TEST_CASE("a contact exactly on a corner or an edge is not excluded by all triangles there, whatever rounding does") {
  ContactMeshOptions given;
  given.normals = NormalSource::file;
  const std::vector<ScenePtr> scenes{scene_of(make_icosphere(0.040, 4), given), scene_of(make_icosphere(0.040, 3)),
                                     scene_of(make_torus(0.040, 0.015, 48, 24), given), spot_scene(45.0),
                                     scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3}))};
  std::vector<Finger> fingers(3);
  fingers[0].shape = FingerShape::sphere;
  fingers[1].shape = FingerShape::capsule;
  fingers[2].shape = FingerShape::ellipsoid;
  for (const Finger& finger : fingers) {
    OnBorders all;
    for (const ScenePtr& scene : scenes) {
      const OnBorders here = contacts_on_borders(scene->mesh(), finger);
      all.contacts += here.contacts;
      all.excluded += here.excluded;
    }
    CAPTURE(static_cast<int>(finger.shape));
    MESSAGE(all.contacts << " contacts, " << all.excluded << " excluded by all");
    CHECK(all.contacts > rounds(5000));
    CHECK(all.excluded == 0);
  }
}

TEST_CASE("what a look at creases and corners costs is counted, and none where a distance tells") {
  const ScenePtr scene = spot_scene(10.0);
  const ContactMesh& mesh = scene->mesh();
  PatchCache cache(mesh);
  int near = 0, far = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t) || mesh.interior(t)) continue;
    const Vec3 middle = (mesh.position(t, 0) + mesh.position(t, 1) + mesh.position(t, 2)) / 3.0;
    each_feature(mesh, t, [&](const TriangleFeature& feature) {
      const auto tests = [&](double height_m) {
        return exclude_feature_contacts(cache, feature, NormalForm::bernstein, middle + height_m * mesh.normal(t, 0),
                                        {0.025, 1.0}, 1e-3)
            .tests;
      };
      near += tests(0.020);
      far += tests(0.100);
    });
  }
  CHECK(near > 1000);
  CHECK(far == 0);
}

TEST_CASE("a margin that is not said to be a rank's keeps contacts of every rank away, those that don't count, too") {
  Random random(29);
  std::vector<ContactMesh> meshes = creased_meshes_and_rims();
  meshes.push_back(*ContactMesh::build(make_icosphere(0.030, 3)));
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    Finger finger = finger_of(shape);
    int wrong = 0, by_rank = 0, by_miss = 0;
    for (const ContactMesh& mesh : meshes) {
      PatchCache cache(mesh);
      const SolverSettings settings;
      for (int i = 0; i < rounds(8000); ++i) {
        PartOfTriangle part{random.below(mesh.triangle_count())};
        const std::uint32_t k = random.below(3);
        SurfaceSample s;
        const int kind = static_cast<int>(random.below(3));
        if (kind == 0) {
          const Vec2 at = random.barycentric();
          cache.sample(part.triangle, settings.normal_form, at.x, at.y, s);
        } else if (kind == 1 && mesh.edge_kind(part.triangle, k) != EdgeKind::smooth) {
          part.part = side_part(k);
          const std::optional<SurfaceSample> on_fan = place_on_fan(cache, part.triangle, k, random);
          if (!on_fan) continue;
          s = *on_fan;
        } else {
          const std::optional<Vec3> normal = normal_of_corner(mesh, part.triangle, k, random);
          if (!normal) continue;
          part.part = corner_part(k);
          s.point = mesh.position(part.triangle, k);
          s.normal = *normal;
        }
        const double depth = random.in(-0.010, 0.010);
        const FingerPose there = resting_on(finger, s.point, s.normal, depth, random);
        const PlaneContact contact = contact_on_plane(finger, there, s.point, s.normal);
        if (part.part == SearchPart::face && is_round(finger) && !normal_bend(s).at_height(contact.height_m).stable())
          continue;
        if (part.part != SearchPart::face && contact.height_m < 0.0) continue;  // a fan is touched from outside only
        const double rank = contact_rank(finger, contact) + random.in(-5e-3, 1e-3);
        double gone = 0.0;
        const FingerPose here = before(finger, there, random.below(2) ? random.in(0.0, 2e-3) : 0.0, random, gone);
        ContactContext context{cache, settings, finger, here, mesh.origin()};
        std::optional<FingerCore> core;
        if (!is_round(finger)) context.core = &core.emplace(finger, here);
        const double enough = random.below(2) ? random.in(0.0, 4e-3) : 0.0;
        const PatchExclusion proof = exclude_part(context, part, {rank, random.below(2) ? 1.0 : 2.0}, enough);
        if (!(proof.margin_m > gone * (1.0 + 1e-9) + 1e-12)) {
          by_miss += proof.margin_m > 0.0 && !proof.by_rank;
          continue;
        }
        by_rank += proof.by_rank;
        wrong += !proof.by_rank;
      }
    }
    MESSAGE(by_rank << " behind by rank, " << by_miss << " excluded up to their contacts, " << wrong << " wrongly");
    CHECK(wrong == 0);
    CHECK(by_rank > rounds(8000) / 80);
    CHECK(by_miss > rounds(8000) / 80);
  }
}

TEST_CASE("a glance from ahead excludes no face that a round finger may touch before it has gone as far as asked") {
  Random random(131);
  std::vector<ContactMesh> meshes = creased_meshes_and_rims();
  meshes.push_back(*ContactMesh::build(rough_ball(random)));
  const Finger finger = finger_of(FingerShape::sphere);
  const SolverSettings settings;
  int all = 0, excluded = 0, behind = 0, wrong = 0;
  for (const ContactMesh& mesh : meshes) {
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(20000); ++i) {
      const PartOfTriangle face{random.below(mesh.triangle_count())};
      const Vec2 at = random.barycentric();
      SurfaceSample s;
      cache.sample(face.triangle, settings.normal_form, at.x, at.y, s);
      const FingerPose there = resting_on(finger, s.point, s.normal, random.in(-0.010, 0.010), random);
      const PlaneContact contact = contact_on_plane(finger, there, s.point, s.normal);
      if (!normal_bend(s).at_height(contact.height_m).stable()) continue;
      double gone = 0.0;
      const FingerPose here = before(finger, there, std::pow(10.0, random.in(-5.0, -2.0)), random, gone);
      const RankBound bound{contact_rank(finger, contact) + random.in(-0.020, 0.005), random.below(2) ? 1.0 : 2.0};
      const double enough = gone * std::pow(10.0, random.in(-1.0, 1.0));
      const bool counts = contact_rank(finger, contact) < bound.rank_m + (bound.closing - 1.0) * gone;
      ContactContext context{cache, settings, finger, here, mesh.origin()};
      int tests = 0;
      const bool told = excludes_at_a_glance(context, nullptr, face, bound, enough, tests);
      ++all;
      excluded += told;
      behind += told && enough > gone;  // only a contact that doesn't count may be there
      wrong += told && enough > gone * (1.0 + 1e-9) + 1e-12 && counts;
    }
  }
  MESSAGE(excluded << " of " << all << " excluded, " << behind << " that hold contacts which don't count, " << wrong
                   << " wrongly");
  CHECK(wrong == 0);
  CHECK(excluded > all / 20);
  CHECK(behind > all / 100);
}
