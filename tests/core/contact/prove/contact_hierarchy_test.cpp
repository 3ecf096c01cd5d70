// The search over the hierarchy never skips a triangle that holds a contact.
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/patch_cache.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/capped_cylinder.h"
#include "tests/core/creased_meshes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

struct FaceContact {
  std::uint32_t triangle;
  double height_m;
};

/// Contacts of a round finger's centre on the faces, stable or not, by Newton from several starts on every triangle,
/// kept only where it stays inside that triangle.
std::vector<FaceContact> face_contacts(const ContactMesh& mesh, const Vec3& centre) {
  std::vector<FaceContact> contacts;
  Finger finger;
  finger.shape = FingerShape::point;
  const FingerPose pose{centre, Quat(1.0, 0.0, 0.0, 0.0)};
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const PnPatch patch = make_patch(mesh, t);
    for (const Vec2& start : {Vec2(1.0 / 3.0, 1.0 / 3.0), Vec2(0.1, 0.1), Vec2(0.8, 0.1), Vec2(0.1, 0.8)}) {
      double u = start.x, v = start.y;
      for (int i = 0; i < 12; ++i) {
        const SurfaceSample s = evaluate(patch, u, v);
        const PlaneContact c = contact_on_plane(finger, pose, s.point, s.normal);
        if (c.error_m < 1e-12 && u > 0.0 && v > 0.0 && u + v < 1.0) {
          contacts.push_back({t, c.height_m});
          break;
        }
        const ParameterStep step = newton_step(s, contact_jacobian(finger, pose, s, c), c);
        if (!step.valid || std::abs(u + step.da) > 3.0 || std::abs(v + step.db) > 3.0) break;
        u += step.da;
        v += step.db;
      }
    }
  }
  return contacts;
}

std::set<std::uint32_t> visited(const LateHierarchy& tree, const ContactQuery& query) {
  std::set<std::uint32_t> seen;
  tree.visit(query, [&](std::uint32_t t, ContactQuery&) {
    seen.insert(t);
    return true;
  });
  return seen;
}

using Parts = std::set<std::pair<std::uint32_t, SearchPart>>;
Parts visited_parts(const LateHierarchy& tree, const ContactQuery& query) {
  Parts seen;
  tree.visit(query, [&](std::uint32_t t, ContactQuery& q) {
    seen.emplace(t, q.part);
    return true;
  });
  return seen;
}
bool has_side(const ContactMesh& mesh, const Parts& parts, std::uint32_t t, std::uint32_t k) {
  const EdgeLink other = mesh.across(t, k);
  return parts.contains({t, side_part(k)}) ||
         (other.triangle != kNone && parts.contains({other.triangle, side_part(other.edge)}));
}
bool has_corner(const ContactMesh& mesh, const Parts& parts, std::uint32_t t, std::uint32_t k) {
  bool has = false;
  around_vertex(mesh, t, k, [&](std::uint32_t at, std::uint32_t corner) {
    has = has || parts.contains({at, corner_part(corner)});
  });
  return has;
}

struct Findings {
  int contacts = 0, missed = 0;
  double visited_share = 0.0;
};

Findings search(const ScenePtr& scene, int centres, std::uint64_t seed) {
  Random random(seed);
  const ContactMesh& mesh = scene->mesh();
  const double size = glm::length(mesh.bounds().size());
  Findings f;
  for (int i = 0; i < centres; ++i) {
    const Vec3 centre = random.in_cube(0.4 * size);
    ContactQuery query;
    query.centre = centre;
    query.nearest_m = random.in(0.1, 1.0) * size;
    query.inside_m = random.below(2) ? random.in(0.0, 0.5) * size : -1.0;
    const auto seen = visited(scene->hierarchy(), query);
    f.visited_share += static_cast<double>(seen.size()) / mesh.usable_triangle_count() / centres;
    for (const FaceContact& c : face_contacts(mesh, centre)) {
      const bool asked = c.height_m >= 0.0 ? c.height_m <= query.nearest_m : -c.height_m <= query.inside_m;
      if (!asked) continue;
      ++f.contacts;
      f.missed += !seen.contains(c.triangle);
    }
    // While the centre moves by up to the margin, too.
    query.margin_m = 0.05 * size;
    const auto wide = visited(scene->hierarchy(), query);
    const Vec3 moved = centre + query.margin_m * random.in(0.0, 1.0) * random.direction();
    for (const FaceContact& c : face_contacts(mesh, moved)) {
      const double reach = std::abs(c.height_m) + query.margin_m;
      const bool asked = c.height_m >= 0.0 ? reach <= query.nearest_m : reach <= query.inside_m;
      if (!asked) continue;
      ++f.contacts;
      f.missed += !wide.contains(c.triangle);
    }
  }
  return f;
}

}  // namespace

TEST_CASE("a search visits every triangle that holds a contact, from outside and inside, at rest and on the move") {
  std::vector<ScenePtr> scenes{
      scene_of(make_icosphere(0.040, 2)), scene_of(make_torus(0.040, 0.015, 32, 16)),
      scene_of(*generate_mesh("octagon")), scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3})),
      scene_of(height_field(0.05, 12, [](double x, double y) { return 0.01 * std::sin(80 * x) * std::cos(60 * y); }))};
  for (const ScenePtr& scene : scenes) {
    const Findings f = search(scene, rounds(200), 130);
    CHECK(f.contacts > rounds(200) / 4);
    CHECK(f.missed == 0);
    CHECK(f.visited_share < 0.9);
  }
}

TEST_CASE("a search of spot visits every triangle that holds a contact, and few others") {
  const auto spot = spot_scene(180.0);
  const Findings f = search(spot, rounds(40), 131);
  CHECK(f.contacts > rounds(40));
  CHECK(f.missed == 0);
  CHECK(f.visited_share < 0.3);
}

TEST_CASE("a search visits the edges and corners of a box that hold a contact") {
  const auto box = scene_of(*generate_mesh("cube"));
  const ContactMesh& mesh = box->mesh();
  Random random(132);
  int missed = 0, asked = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
      const EdgeLink other = mesh.across(t, k);
      for (int i = 0; i < rounds(40); ++i) {
        // A direction inside the fan of the edge, and one inside the octant of its first corner.
        const double f = random.in(0.0, 1.0), h = random.in(0.001, 0.03);
        const Vec3 on = (1.0 - f) * mesh.position(t, k) + f * mesh.position(t, (k + 1) % 3);
        const Vec3 fan = unit(random.in(0.0, 1.0) * mesh.normal(t, k) +
                              random.in(0.0, 1.0) * mesh.normal(other.triangle, other.edge));
        const Vec3 corner = mesh.position(t, k), octant = unit(glm::sign(corner) * glm::abs(random.direction()));
        ++asked;
        ContactQuery query;
        query.centre = on + h * fan;
        query.nearest_m = 1.001 * h;
        query.inside_m = -1.0;
        missed += !has_side(mesh, visited_parts(box->hierarchy(), query), t, k);
        query.centre = corner + h * octant;
        missed += !has_corner(mesh, visited_parts(box->hierarchy(), query), t, k);
      }
    }
  CHECK(asked > 0);
  CHECK(missed == 0);
}

TEST_CASE("a search visits the creases, rims and corners that hold a contact, at rest and on the move") {
  Random random(133);
  std::vector<ContactMesh> meshes = creased_meshes_and_rims();
  meshes.push_back(*ContactMesh::build(height_field(0.05, 4, [](double, double) { return 0.0; })));
  int missed = 0, sides = 0, corners = 0;
  for (const ContactMesh& mesh : meshes) {
    const LateHierarchy tree(mesh, nullptr);
    PatchCache cache(mesh);
    for (int i = 0; i < rounds(20000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count()), k = random.below(3);
      const double h = random.in(0.001, 0.03);
      ContactQuery query;
      query.margin_m = random.below(2) ? 0.0 : std::pow(10.0, random.in(-5.0, -3.0));
      query.ahead = random.in(0.0, 1.0) * query.margin_m * random.direction();
      query.nearest_m = 1.001 * h + 2.0 * query.margin_m;
      query.inside_m = -1.0;
      const Vec3 moved = 0.999 * random.in(0.0, 1.0) * query.margin_m * random.direction() - query.ahead;
      if (mesh.edge_kind(t, k) != EdgeKind::smooth) {
        if (const std::optional<SurfaceSample> s = place_on_fan(cache, t, k, random)) {
          query.centre = s->point + h * s->normal + moved;
          ++sides;
          missed += !has_side(mesh, visited_parts(tree, query), t, k);
        }
      }
      if (const std::optional<Vec3> normal = normal_of_corner(mesh, t, k, random)) {
        query.centre = mesh.position(t, k) + h * *normal + moved;
        ++corners;
        missed += !has_corner(mesh, visited_parts(tree, query), t, k);
      }
    }
  }
  MESSAGE(sides << " on creases and rims, " << corners << " on corners, " << missed << " missed");
  CHECK(missed == 0);
  CHECK(sides > rounds(10000));
  CHECK(corners > rounds(10000));
}

TEST_CASE("every crease, rim and corner is one part of the search, hollow creases are none") {
  for (const ContactMesh& mesh : creased_meshes_and_rims()) {
    ContactQuery all;
    all.nearest_m = all.inside_m = 1.0;
    all.margin_m = 1.0;
    const LateHierarchy tree(mesh, nullptr);
    std::size_t visits = 0;
    Parts parts;
    tree.visit(all, [&](std::uint32_t t, ContactQuery& q) {
      ++visits;
      parts.emplace(t, q.part);
      return true;
    });
    CHECK(visits == parts.size());
    PatchCache cache(mesh);
    std::size_t faces = 0, sides = 0, hollow = 0, missed = 0, hidden = 0;
    std::set<std::uint32_t> vertices;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      faces += mesh.usable(t);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const EdgeKind kind = mesh.edge_kind(t, k);
        if (mesh.feature_corner(t, k)) missed += !has_corner(mesh, parts, t, k);
        if (mesh.feature_corner(t, k)) vertices.insert(mesh.vertex(t, k));
        if (kind == EdgeKind::smooth || (kind == EdgeKind::crease && mesh.across(t, k).triangle < t)) continue;
        const bool seen = has_side(mesh, parts, t, k);
        ++(seen ? sides : hollow);
        for (int i = 0; i <= 10 && !seen; ++i) hidden += cache.fan(t, k, 0.1 * i, NormalForm::bernstein).convex();
      }
    }
    CHECK(missed == 0);
    CHECK(hidden == 0);
    CHECK(sides > hollow);
    CHECK(parts.size() >= faces + sides + vertices.size());  // a vertex may be that of several fans of triangles
    CHECK(parts.size() <= faces + sides + 2 * vertices.size());
  }
}

TEST_CASE("for fingers that are not round the tilt keeps their contacts in the search") {
  const auto torus = scene_of(make_torus(0.040, 0.015, 32, 16));
  const ContactMesh& mesh = torus->mesh();
  Random random(134);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    Finger finger;
    finger.shape = shape;
    finger.radius_m = 0.008;
    finger.half_length_m = 0.012;
    finger.semi_axes_m = {0.018, 0.010, 0.007};
    int missed = 0;
    std::size_t by_tilt = 0, by_support = 0;
    for (int i = 0; i < rounds(5000); ++i) {
      const std::uint32_t t = random.below(mesh.triangle_count());
      const Vec2 uv = random.barycentric();
      const SurfaceSample s = evaluate(make_patch(mesh, t), uv.x, uv.y);
      FingerPose pose{Vec3(0.0), random.orientation()};
      const Vec3 support = support_point(finger, pose, s.normal);
      const double deepest = -glm::dot(support, s.normal);  // until the centre is behind the plane
      const double depth = i % 2 ? random.in(-0.002, 0.001) : random.in(0.0, 0.98) * deepest;
      pose.position = s.point - depth * s.normal - support;
      ContactQuery query;
      query.centre = pose.position;
      // What a search for contacts of at most this depth's rank asks for (seed.cpp).
      const double rank = finger.reach_m() - depth + 1e-9;
      limit_query(query, finger, rank);
      query.tilt_rad = finger.tilt_rad();
      const auto tilted = visited(torus->hierarchy(), query);
      // The same by support points, here and while the finger moves.
      const FingerCore core(finger, pose);
      query.core = &core;
      limit_query(query, finger, rank);
      const auto supported = visited(torus->hierarchy(), query);
      // From a place that the finger is away from by the margin at most, part of it by turning.
      query.margin_m = 0.003;
      const double way = query.margin_m * random.in(0.0, 1.0), turn = way * random.in(0.0, 1.0);
      pose.position += (way - turn) * random.direction();
      pose.orientation = glm::angleAxis(turn / core.reach_m(), random.direction()) * pose.orientation;
      const FingerCore before(finger, pose);
      query.centre = pose.position;
      query.core = &before;
      limit_query(query, finger, rank + query.margin_m, query.margin_m);
      const auto moved = visited(torus->hierarchy(), query);
      missed += !tilted.contains(t) + !supported.contains(t) + !moved.contains(t);
      by_tilt += tilted.size();
      by_support += supported.size();
    }
    CAPTURE(static_cast<int>(shape));
    CHECK(missed == 0);
    CHECK(by_support < by_tilt);
  }
}

TEST_CASE("the visitor can narrow the search and end it") {
  const auto sphere = scene_of(make_icosphere(0.040, 3));
  ContactQuery query;
  query.centre = Vec3(0.0);  // every triangle holds a contact
  query.nearest_m = query.inside_m = 1.0;
  int all = 0, few = 0, none = 0;
  sphere->hierarchy().visit(query, [&](std::uint32_t, ContactQuery&) { return ++all, true; });
  sphere->hierarchy().visit(query, [&](std::uint32_t, ContactQuery&) { return ++few < 10; });
  sphere->hierarchy().visit(query, [&](std::uint32_t, ContactQuery& q) {
    q.nearest_m = q.inside_m = 0.001;
    return ++none, true;
  });
  CHECK(all == 1280);
  CHECK(few == 10);
  CHECK(none < all / 20);  // what is left of the leaf it was in
}

TEST_CASE("a search of a rim of many edges visits those that the finger can touch, and few others") {
  constexpr int kCorners = 1000;
  for (const double crease_rad : {0.7, 0.001}) {  // the side round, and as flat as it is
    CAPTURE(crease_rad);
    ContactMeshOptions options;
    options.crease_rad = crease_rad;
    const ScenePtr scene = scene_of(capped_cylinder(kCorners), options);
    const ContactMesh& mesh = scene->mesh();
    REQUIRE(mesh.flat_regions().count() == 2);
    PatchCache cache(mesh);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> rim;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (mesh.edge_kind(t, k) == EdgeKind::crease && mesh.flat_regions().of(t) != kNone) rim.emplace_back(t, k);
    REQUIRE(rim.size() == 2 * kCorners);
    Random random(135);
    int missed = 0;
    std::size_t looked_at = 0, corners = 0;
    const int centres = rounds(2000);
    for (int i = 0; i < centres; ++i) {
      const auto& [t, k] = rim[random.below(2 * kCorners)];
      const EdgeFan& fan = cache.fan(t, k, random.in(0.0, 1.0), NormalForm::bernstein);
      const double angle = random.in(0.0, 1.0) * std::acos(fan.far.x), h = random.in(0.001, 0.03);
      SurfaceSample sample;
      edge_sample(fan, Vec2(std::cos(angle), std::sin(angle)), sample);
      ContactQuery query;
      query.margin_m = i % 2 == 0 ? 0.0 : 1e-4;
      query.ahead = random.in(0.0, 1.0) * query.margin_m * random.direction();
      query.tilt_rad = i % 4 < 2 ? 0.0 : 0.02;
      const double lean = random.in(0.0, 1.0) * query.tilt_rad;
      const Vec3 normal = unit(sample.normal + std::tan(lean) * unit(glm::cross(sample.normal, random.direction())));
      const bool inside = i % 8 == 0;  // a contact seen from inside
      query.centre = sample.point + (inside ? -h : h) * normal - query.ahead +
                     0.999 * random.in(0.0, 1.0) * query.margin_m * random.direction();
      query.nearest_m = query.inside_m = 1.001 * h + 2.0 * query.margin_m;
      const Parts parts = visited_parts(scene->hierarchy(), query);
      missed += !has_side(mesh, parts, t, k);
      for (const auto& [visited, part] : parts) {
        looked_at += is_side(part);
        corners += is_corner(part);
      }
    }
    CHECK(missed == 0);
    MESSAGE((looked_at / static_cast<std::size_t>(centres))
            << " of " << rim.size() << " edges are looked at, and " << (corners / static_cast<std::size_t>(centres))
            << " corners");
    CHECK(corners <= looked_at + static_cast<std::size_t>(centres));
    CHECK(looked_at < static_cast<std::size_t>((crease_rad > 0.1 ? 8 : 40) * centres));
  }
}

namespace {

/// Four parts at once are asked in floats, but for fingers that lean: by doubles, with a tilt too small to matter.
ContactQuery in_doubles(ContactQuery query) {
  query.tilt_rad = 1e-300;
  return query;
}

ContactQuery random_query(Random& random, double size_m) {
  ContactQuery query;
  query.centre = random.in_cube(0.6 * size_m) * (random.below(20) == 0 ? std::pow(10.0, random.in(0.0, 40.0)) : 1.0);
  const bool unlimited = random.below(10) == 0;
  query.nearest_m = unlimited ? std::numeric_limits<double>::max() : random.in(0.05, 0.8) * size_m;
  query.inside_m = random.below(2) ? -1.0 : unlimited ? query.nearest_m : random.in(0.0, 0.5) * size_m;
  query.margin_m = random.below(2) ? 0.0 : random.in(0.0, 0.02) * size_m;
  if (query.margin_m > 0.0 && random.below(2)) query.ahead = 0.5 * query.margin_m * random.direction();
  query.steady_ground = random.below(2) != 0;
  return query;
}

}  // namespace

TEST_CASE("floats rule out nothing that doubles don't, and all but the same, however large or small the mesh is") {
  Random random(41);
  std::size_t missed = 0, more = 0, all = 0, whole = 0;
  for (const double size_m : {1e-12, 1e-8, 0.04, 1e3, 1e12, 1e25})
    for (const PolygonMesh& source :
         {make_icosphere(size_m, 4), make_torus(size_m, 0.4 * size_m, 40, 20), make_icosphere(size_m, 0)}) {
      const ScenePtr scene = scene_of(source);
      const LateHierarchy tree(scene->mesh(), nullptr);
      for (int i = 0; i < rounds(60); ++i) {
        const ContactQuery query = random_query(random, size_m);
        const std::set<std::uint32_t> floats = visited(tree, query), doubles = visited(tree, in_doubles(query));
        for (const std::uint32_t t : doubles) missed += !floats.contains(t);
        more += floats.size();
        all += doubles.size();
        whole += scene->mesh().triangle_count();
      }
    }
  MESSAGE(more << " visited in floats, " << all << " in doubles, of " << whole);
  CHECK(missed == 0);
  CHECK(all > whole / 1000);
  CHECK(all < whole / 2);
  CHECK(static_cast<double>(more) < 1.001 * static_cast<double>(all) + 10.0);
}

TEST_CASE("a search that breaks off after every step visits the same triangles in the same order") {
  Random random(42);
  const ScenePtr scene = scene_of(make_torus(0.040, 0.015, 40, 20));
  const LateHierarchy tree(scene->mesh(), nullptr);
  std::size_t parts = 0;
  for (int i = 0; i < rounds(60); ++i) {
    ContactQuery query = random_query(random, 0.04);
    std::vector<std::uint32_t> at_once, in_parts;
    tree.visit(query, [&](std::uint32_t t, ContactQuery&) { return at_once.push_back(t), true; });
    VisitPlace from;
    const auto visit = [&](std::uint32_t t, ContactQuery& q) { return ++q.work, in_parts.push_back(t), true; };
    for (bool through = false; !through; ++parts) {
      query.most_work = query.work + 1;
      through = tree.visit_from(from, query, visit);
    }
    CHECK(at_once == in_parts);
  }
  CHECK(parts > static_cast<std::size_t>(rounds(60)) * 10);
}
