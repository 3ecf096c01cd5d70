// The stepper's caches don't change results, and cached edges and vertices equal computed ones.
#include "core/contact/patch_cache.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"
#include "tests/core/spiky_ground.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstring>
#include <memory>

using namespace tangent;
using namespace tangent::test;

namespace {

std::vector<ScenePtr> cached_scenes() {
  std::vector<ScenePtr> all{scene_of(make_icosphere(0.040, 2)),
                            scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3}))};
  for (const char* name : {"cube", "octagon", "cylinder", "cone"}) all.push_back(scene_of(*generate_mesh(name)));
  return all;
}

/// A centre that goes round an object of 80 mm on slowly turning circles, up and down, and now and then leaps or stands
/// still.
class Rounds {
 public:
  TickInput next() {
    const int i = tick_++;
    if (i % 700 == 0) axis_ = random_.direction();
    if (i % 1900 == 1899) direction_ = random_.direction();
    if (i % 97 < 92) direction_ = unit(direction_ + 1e-3 * glm::cross(axis_, direction_));
    const double distance = 0.058 + 0.004 * static_cast<double>(i / 11 % 1000) / 1000.0;
    return {1e-3 * i, {distance * direction_, glm::normalize(Quat(1.0, 0.1 * direction_.x, 0.3 * direction_.y, 0.0))}};
  }

 private:
  Random random_{71};
  Vec3 direction_{1.0, 0.0, 0.0}, axis_{0.0, 0.0, 1.0};
  int tick_ = 0;
};

std::array<double, 14> numbers_of(const TickOutput& o) {
  return {o.u,        o.v,         o.contact.x, o.contact.y, o.contact.z, o.normal.x, o.normal.y,
          o.normal.z, o.force_n.x, o.force_n.y, o.force_n.z, o.cld_m,     o.error_m,  o.penetration_m};
}

bool same_output(const TickOutput& a, const TickOutput& b) {
  const auto x = numbers_of(a), y = numbers_of(b);
  return std::memcmp(x.data(), y.data(), sizeof x) == 0 && a.status == b.status && a.event == b.event &&
         a.triangle == b.triangle && a.iterations == b.iterations && a.triangle_changes == b.triangle_changes;
}

bool same_output(const TrackedPlane& a, const TrackedPlane& b) {
  return a.feature == b.feature && a.side == b.side && a.triangle == b.triangle && a.u == b.u && a.v == b.v &&
         a.point == b.point && a.normal == b.normal && a.turn == b.turn;
}

bool same_output(const TickState& a, const TickState& b) {
  return same_output(a.plane, b.plane) && a.last_converged.point == b.last_converged.point &&
         a.last_converged.normal == b.last_converged.normal && a.has_converged == b.has_converged &&
         a.last_converged_s == b.last_converged_s && a.last_position == b.last_position &&
         a.last_orientation == b.last_orientation && a.last_t_s == b.last_t_s &&
         a.clearance.free_m == b.clearance.free_m && a.clearance.centre == b.clearance.centre;
}

/// Every number of a fan, and its flags.
bool same_output(const EdgeFan& a, const EdgeFan& b) {
  const auto vectors = [](const EdgeFan& f) {
    return std::array{f.point, f.point_f,     f.tangent,    f.tangent_f,     f.e1,
                      f.e2,    f.near_normal, f.far_normal, f.near_normal_f, f.far_normal_f};
  };
  return vectors(a) == vectors(b) && a.tilt_near == b.tilt_near && a.tilt_far == b.tilt_far && a.far == b.far &&
         a.even == b.even && a.cot_half == b.cot_half && a.uniform == b.uniform &&
         (!a.uniform || (a.start == b.start && a.per_length2 == b.per_length2));
}

/// Two meshes in one, side by side.
PolygonMesh side_by_side(const PolygonMesh& a, const PolygonMesh& b, const Vec3& offset) {
  PolygonMesh both = a;
  both.normals.clear();
  both.corner_normal.clear();
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  for (const Vec3& p : b.positions) both.positions.push_back(p + offset);
  for (std::size_t f = 0; f + 1 < b.face_offsets.size(); ++f) {
    for (std::uint32_t c = b.face_offsets[f]; c < b.face_offsets[f + 1]; ++c)
      both.corner_position.push_back(first + b.corner_position[c]);
    both.face_offsets.push_back(static_cast<std::uint32_t>(both.corner_position.size()));
  }
  return both;
}

}  // namespace

TEST_CASE("a tick has the same output and state, bit by bit, with a warm cache, a cold one, and traced") {
  const auto trace = std::make_unique<IterationTrace>();
  for (const ScenePtr& scene : cached_scenes()) {
    for (const FingerShape shape : {FingerShape::sphere, FingerShape::point}) {
      Preset preset;
      preset.finger.shape = shape;
      preset.force.damping_n_s_per_m = 2.0;
      Stepper stepper(scene);
      TickState state;
      Rounds rounds_of;
      int different = 0, different_state = 0, one_plane = 0;
      const int ticks = rounds(2000);
      for (int i = 0; i < ticks; ++i) {
        const TickInput input = rounds_of.next();
        TickState traced_state = state, cold_state = state;
        const TickOutput out = stepper.step(preset, input, state);
        trace->clear();
        Stepper cold(scene), traced(scene);
        different += !same_output(out, cold.step(preset, input, cold_state)) ||
                     !same_output(out, traced.step(preset, input, traced_state, trace.get()));
        different_state += !same_output(state, cold_state) || !same_output(state, traced_state);
        one_plane += out.event == TickEvent::none && out.iterations == 1;
      }
      CAPTURE(scene->mesh().name());
      CAPTURE(static_cast<int>(shape));
      CHECK(different == 0);
      CHECK(different_state == 0);
      CHECK(one_plane > ticks * 3 / 4);
    }
  }
}

TEST_CASE("a fan is the same whatever edge its place in the cache was of before") {
  // Straight edges between flat sides and rims, which are computed in different ways, share the places.
  const ScenePtr scene = scene_of(side_by_side(*generate_mesh("cylinder"), *generate_mesh("cube"), {0.2, 0.0, 0.0}));
  const ContactMesh& mesh = scene->mesh();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.usable(t) && mesh.edge_kind(t, k) != EdgeKind::smooth) edges.emplace_back(t, k);
  REQUIRE(edges.size() > 32);
  Random random(72);
  const auto used = std::make_unique<PatchCache>(mesh);
  int different = 0, uniform = 0, ticks = rounds(4000);
  for (int i = 0; i < ticks; ++i) {
    const auto [t, side] = edges[random.below(static_cast<std::uint32_t>(edges.size()))];
    const double f = random.in(0.0, 1.0);
    const auto fresh = std::make_unique<PatchCache>(mesh);
    const EdgeFan& expected = fresh->fan(t, side, f, NormalForm::bernstein);
    different += !same_output(used->fan(t, side, f, NormalForm::bernstein), expected);
    uniform += expected.uniform;
  }
  CHECK(different == 0);
  CHECK(uniform > ticks / 20);
  CHECK(uniform < ticks - ticks / 20);
}

TEST_CASE(
    "around a vertex the cache gives every face and every crease once, and the same a second time and with more faces "
    "than it holds") {
  const ScenePtr fan = scene_of(*generate_mesh("cone", {.segments = 200}));
  for (const ScenePtr& scene : {scene_of(*generate_mesh("octagon")), fan}) {
    const ContactMesh& mesh = scene->mesh();
    const auto cache = std::make_unique<PatchCache>(mesh);
    std::size_t most = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::size_t faces = 0, creases = 0;
        around_vertex(mesh, t, k, [&](std::uint32_t at, std::uint32_t c) {
          ++faces, creases += mesh.edge_kind(at, c) == EdgeKind::crease;
        });
        for (int time = 0; time < 2; ++time) {
          std::size_t seen = 0, rays = 0, off = 0;
          cache->around(
              t, k, NormalForm::bernstein, [](const Vec3&) { return Vec3(0.0); },
              [&](std::uint32_t at, std::uint32_t c, const SurfaceSample& s) {
                ++seen;
                off += glm::distance(s.point, mesh.position(t, k)) > 1e-15 || mesh.vertex(at, c) != mesh.vertex(t, k);
              },
              [&](std::uint32_t, std::uint32_t, double, const EdgeFan& f) {
                ++rays, off += glm::distance(f.point, mesh.position(t, k)) > 1e-15;
              });
          CHECK(seen == faces);
          CHECK(rays == creases);
          CHECK(off == 0);
        }
        most = std::max(most, faces);
      }
    }
    if (scene == fan) CHECK(most > VertexSurroundings::kCapacity);
  }
}

TEST_CASE("on spikes, along hollow edges and where contacts are lost, a fresh stepper gives the same bits, too") {
  const Spikes ground(1.2e-3, 3);
  const ScenePtr scene = ground.scene();
  for (const FingerShape shape : kFingerShapes) {
    CAPTURE(static_cast<int>(shape));
    Preset preset = sphere_preset(0.002, Method::robust);
    preset.finger = finger_of(shape);
    if (shape == FingerShape::sphere) preset.finger.radius_m = 0.002;
    Stepper stepper(scene);
    TickState state;
    int different = 0;
    for (int i = 0; i < rounds(1500); ++i) {
      const TickInput input = at_position(1e-3 * i, ground.way(1e-3 * i));
      TickState again = state;
      const TickOutput warm = stepper.step(preset, input, state), fresh = Stepper(scene).step(preset, input, again);
      different += warm.contact != fresh.contact || warm.force_n != fresh.force_n || warm.cld_m != fresh.cld_m ||
                   warm.iterations != fresh.iterations || warm.event != fresh.event ||
                   state.clearance.free_m != again.clearance.free_m;
    }
    CHECK(different == 0);
  }
}
