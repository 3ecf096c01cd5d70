// The same input gives bitwise identical results: in debug and release, traced and untraced, warm and cold.
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstring>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Of the path below: of all its ticks, and of the first tenth alone, which is what sanitized and debug builds take.
struct Golden {
  std::uint64_t all, first;
};
// They change when the solver computes differently: read the new ones off the failing test, in debug and in release,
// and say in the commit what changed them.
constexpr Golden kGoldenPaper{0x3cc4b7b0487c8346ull, 0x73ade9e4194d51adull};
constexpr Golden kGoldenNewton{0x7f6d3d50996b66a2ull, 0x9aa8c45fa97d4566ull};
constexpr Golden kGoldenRobust{0x9fabf12a48d26700ull, 0x2177d5cd822a9757ull};
/// Robust with force.contacts = all; the others with deepest.
constexpr Golden kGoldenEveryPlace{0xfdc8813cee77c627ull, 0x9f7fb886845e5ac0ull};

constexpr int kScenes = 3;

/// Rounded to 2^-30: the meshes' sines and cosines may differ in the last place from one processor to another.
double snapped(double x) { return std::round(x * 0x1p30) * 0x1p-30; }
Vec3 snapped(const Vec3& v) { return {snapped(v.x), snapped(v.y), snapped(v.z)}; }

/// The mesh with snapped positions and the builder's normals, snapped, as file normals.
ScenePtr portable_scene(const PolygonMesh& source) {
  const auto built = ContactMesh::build(source);
  REQUIRE(built.has_value());
  PolygonMesh mesh;
  mesh.name = "portable";
  for (std::uint32_t t = 0; t < built->triangle_count(); ++t) {
    if (!built->usable(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto index = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(snapped(built->origin() + built->position(t, k)));
      mesh.normals.push_back(snapped(built->normal(t, k)));
      mesh.corner_position.push_back(index);
      mesh.corner_normal.push_back(index);
    }
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  return scene_of(mesh);
}

std::vector<ScenePtr> scenes() {
  return {portable_scene(make_torus(0.040, 0.015, 48, 24)),
          portable_scene(*generate_mesh("cube", {.rounding_m = 1.5e-3})), portable_scene(*generate_mesh("octagon"))};
}

/// Turns v about the given axis by the angle whose half has tangent t: no sine, no cosine.
Vec3 turned(const Vec3& v, const Vec3& axis, double t) {
  const double c = (1.0 - t * t) / (1.0 + t * t), s = 2.0 * t / (1.0 + t * t);
  return c * v + s * glm::cross(axis, v) + (1.0 - c) * glm::dot(axis, v) * axis;
}

/// A finger that circles round the mesh on slowly changing great circles, in and out of contact, now and then leaping.
class Path {
 public:
  TickInput next() {
    if (tick_ % 500 == 0) axis_ = random_.direction();
    direction_ = tick_ % 5000 == 4999 ? random_.direction() : unit(turned(direction_, axis_, 0.0008));
    const double distance = 0.052 + 0.030 * static_cast<double>((tick_ / 7) % 1000) / 1000.0;
    const Quat pitch = glm::normalize(Quat(1.0, 0.1 * direction_.x, 0.3 * direction_.y, 0.0));
    return {1e-3 * static_cast<double>(tick_++), {distance * direction_, pitch}};
  }

 private:
  Random random_{50};
  Vec3 direction_{1.0, 0.0, 0.0}, axis_{0.0, 0.0, 1.0};
  int tick_ = 0;
};

Preset golden_preset(Method method) {
  Preset preset = sphere_preset(0.020, method);
  preset.solver.gain_curvature_m = 0.015;
  preset.solver.max_iterations = 60;
  return preset;
}

std::uint64_t path_hash(Method method, int ticks, ForceContacts contacts = ForceContacts::deepest) {
  BitHash hash;
  Preset preset = golden_preset(method);
  preset.force.contacts = contacts;
  for (const ScenePtr& scene : scenes()) {
    Stepper stepper(scene);
    TickState state;
    Path path;
    for (int i = 0; i < ticks / kScenes; ++i) hash.add(stepper.step(preset, path.next(), state));
  }
  return hash.value();
}

std::string hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llxull", static_cast<unsigned long long>(value));
  return text;
}

void check_golden(const Golden& golden, Method method, int ticks, ForceContacts contacts = ForceContacts::deepest) {
  CHECK(hex(path_hash(method, ticks / 10, contacts)) == hex(golden.first));
  if (rounds(ticks) == ticks) CHECK(hex(path_hash(method, ticks, contacts)) == hex(golden.all));
}

bool same_bits(const TickOutput& a, const TickOutput& b) {
  BitHash x, y;
  x.add(a), y.add(b);
  return x.value() == y.value();
}

}  // namespace

TEST_CASE("golden hash of 120,000 ticks of the paper's method: the same bits in debug and release") {
  check_golden(kGoldenPaper, Method::paper, 120'000);
}
TEST_CASE("golden hash of 120,000 ticks of newton: the same bits in debug and release") {
  check_golden(kGoldenNewton, Method::newton, 120'000);
}
TEST_CASE("golden hash of a million ticks of robust: the same bits in debug and release") {
  check_golden(kGoldenRobust, Method::robust, 1'020'000);
}
TEST_CASE("golden hash of 120,000 ticks of robust with force from all places: the same bits in debug and release") {
  check_golden(kGoldenEveryPlace, Method::robust, 120'000, ForceContacts::all);
}

TEST_CASE("traced and untraced ticks give the same bits") {
  const auto all = scenes();
  auto trace = std::make_unique<IterationTrace>();
  for (const Method method : kSmoothMethods) {
    const Preset preset = golden_preset(method);
    int different = 0;
    for (const ScenePtr& scene : all) {
      Stepper plain(scene), traced(scene);
      TickState a, b;
      Path path;
      for (int i = 0; i < rounds(6000); ++i) {
        const TickInput input = path.next();
        trace->clear();
        different += !same_bits(plain.step(preset, input, a), traced.step(preset, input, b, trace.get()));
      }
    }
    CAPTURE(name_of(method));
    CHECK(different == 0);
  }
}

TEST_CASE("a cold stepper gives a recorded tick the same bits: replay, scrubbing and A/B rest on it") {
  const auto all = scenes();
  for (const Method method : kSmoothMethods) {
    const Preset preset = golden_preset(method);
    int different = 0, different_state = 0;
    for (const ScenePtr& scene : all) {
      Stepper stepper(scene);
      TickState state;
      Path path;
      for (int i = 0; i < rounds(6000); ++i) {
        TickRecord record;
        record.kept = state;
        record.input = path.next();
        record.output = stepper.step(preset, record.input, state);
        Stepper cold(scene);
        TickState again = record.kept;
        different += !same_bits(cold.step(preset, record.input, again), record.output);
        different_state +=
            again.plane.triangle != state.plane.triangle || again.plane.u != state.plane.u ||
            again.plane.normal != state.plane.normal || again.clearance.margin_m != state.clearance.margin_m ||
            again.clearance.centre != state.clearance.centre || again.clearance.watched != state.clearance.watched;
      }
    }
    CAPTURE(name_of(method));
    CHECK(different == 0);
    CHECK(different_state == 0);
  }
}

TEST_CASE("a stepper that has just stepped other ticks gives a recorded tick the same bits") {
  const auto scene = scenes()[0];
  const Preset preset = golden_preset(Method::robust);
  std::vector<TickRecord> records;
  Stepper stepper(scene);
  TickState state;
  Path path;
  for (int i = 0; i < 3000; ++i) {
    TickRecord record;
    record.kept = state;
    record.input = path.next();
    record.output = stepper.step(preset, record.input, state);
    records.push_back(record);
  }
  Random random(51);
  int different = 0;
  for (int i = 0; i < rounds(6000); ++i) {
    const TickRecord& record = records[random.below(3000)];
    TickState again = record.kept;
    different += !same_bits(stepper.step(preset, record.input, again), record.output);
  }
  CHECK(different == 0);
}

TEST_CASE("a preset changed between ticks acts on the next tick, and back again gives the same bits") {
  Preset bernstein = golden_preset(Method::robust), vlachos = bernstein;
  vlachos.solver.normal_form = NormalForm::vlachos;
  for (const ScenePtr& scene : scenes()) {
    Stepper changing(scene);
    TickState state;
    Path path;
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
      const Preset& preset = i % 3 == 0 ? vlachos : bernstein;
      const TickInput input = path.next();
      TickState again = state;
      const TickOutput warm = changing.step(preset, input, state);
      different += !same_bits(warm, Stepper(scene).step(preset, input, again));
    }
    CHECK(different == 0);
  }
}

TEST_CASE("a tick's kept state is plain bytes: a copy of it goes on in the same way") {
  static_assert(std::is_trivially_copyable_v<TickState>);
  static_assert(std::is_trivially_copyable_v<TickRecord>);
  static_assert(sizeof(TickState) <= 1024);
  const auto scene = scenes()[1];
  const Preset preset = golden_preset(Method::robust);
  Stepper a(scene), b(scene);
  TickState state;
  Path path;
  for (int i = 0; i < 500; ++i) a.step(preset, path.next(), state);
  unsigned char bytes[sizeof(TickState)];
  std::memcpy(bytes, &state, sizeof state);
  TickState copy;
  std::memcpy(&copy, bytes, sizeof copy);
  Path ahead = path;
  int different = 0;
  for (int i = 0; i < 500; ++i)
    different += !same_bits(a.step(preset, path.next(), state), b.step(preset, ahead.next(), copy));
  CHECK(different == 0);
}
