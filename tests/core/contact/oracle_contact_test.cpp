#include "core/contact/follow/step_rule.h"
#include "tests/core/oracle.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

// On the oracle's folded patches a finger often has several contacts; the oracle gives one, stable or not.
// So the solvers start beside the oracle's place, as tracking does.
struct OracleContact {
  ScenePtr scene;
  double radius_m;
  Vec3 centre, contact, normal;
  double u, v, height_m, penetration_m;
  Stability stability;
  double conditioning;  // of the 2x2 Newton system, 0 (singular) to 1
};

std::vector<OracleContact> oracle_contacts() {
  const auto patches = read_oracle("pn_patch.json")["patches"];
  const auto contacts = read_oracle("pn_contact.json")["contacts"];
  std::vector<OracleContact> all;
  for (const auto& c : contacts) {
    const auto& j = patches[c["patch"].get<std::size_t>()];
    const std::array<Vec3, 3> p{vec3(j["positions"][0]), vec3(j["positions"][1]), vec3(j["positions"][2])};
    const std::array<Vec3, 3> n{vec3(j["normals"][0]), vec3(j["normals"][1]), vec3(j["normals"][2])};
    OracleContact o;
    o.scene = scene_of(one_triangle(p, n));
    o.radius_m = c["finger_radius_m"].get<double>();
    o.centre = vec3(c["centre_m"]);
    o.contact = vec3(c["contact_m"]);
    o.normal = vec3(c["normal"]);
    o.u = c["u"].get<double>();
    o.v = c["v"].get<double>();
    o.height_m = c["height_m"].get<double>();
    o.penetration_m = c["penetration_m"].get<double>();
    const SurfaceSample s = evaluate(make_pn_patch(p, n), o.u, o.v);
    const double h = o.height_m;
    o.stability = face_stability({s.point, s.point_u, s.point_v, s.normal, s.normal_u, s.normal_v},
                                 {s.point_u + h * s.normal_u, s.point_v + h * s.normal_v});
    const Vec3 xu = s.point_u + h * s.normal_u, xv = s.point_v + h * s.normal_v;
    o.conditioning = glm::length(glm::cross(xu, xv)) / (glm::dot(xu, xu) + glm::dot(xv, xv));
    all.push_back(o);
  }
  return all;
}

struct Outcome {
  int tried = 0, found = 0;
  double contact_m = 0.0, normal = 0.0, penetration_m = 0.0;
};

/// Starts `away` barycentric units beside each contact that `takes` accepts.
template <class Takes>
Outcome track_oracle(Method method, double away, Takes takes) {
  Outcome outcome;
  for (const OracleContact& o : oracle_contacts()) {
    if (!takes(o)) continue;
    Preset preset = sphere_preset(o.radius_m, method);
    preset.solver.tolerance_m = 1e-14;  // an error e leaves a deviation of e / det M
    preset.solver.max_iterations = 500;
    Stepper stepper(o.scene);
    TickState state;
    state.plane.feature = Feature::face;
    state.plane.triangle = 0;
    state.plane.u = o.u + away * (o.u < 0.4 ? 1.0 : -1.0);
    state.plane.v = o.v + away * (o.v < 0.4 ? 1.0 : -1.0);
    const TickOutput out = stepper.step(preset, at_position(0.0, o.centre), state);
    ++outcome.tried;
    const double contact = glm::length(out.contact - o.contact);
    if (out.status == TickStatus::unconverged || contact > 1e-6) continue;
    ++outcome.found;
    outcome.contact_m = std::max(outcome.contact_m, contact);
    outcome.normal = std::max(outcome.normal, glm::length(out.normal - o.normal));
    outcome.penetration_m = std::max(outcome.penetration_m, std::abs(out.penetration_m - o.penetration_m));
  }
  MESSAGE(std::string(to_string(method)) << ": " << outcome.found << " of " << outcome.tried
                                         << " found; largest deviation: contact " << outcome.contact_m << " m, normal "
                                         << outcome.normal << ", penetration " << outcome.penetration_m << " m");
  return outcome;
}

}  // namespace

TEST_CASE("newton finds every contact of the oracle to a nanometre, unstable ones too") {
  const Outcome all = track_oracle(Method::newton, 1e-3, [](const OracleContact&) { return true; });
  CHECK(all.tried == 288);
  CHECK(all.found == all.tried);
  // Where the system is all but singular, the rounding of the oracle's own finger centre is amplified too far.
  const Outcome o = track_oracle(Method::newton, 1e-3, [](const OracleContact& c) { return c.conditioning > 1e-3; });
  CHECK(o.tried >= 280);
  CHECK(o.contact_m <= 1e-9);
  CHECK(o.penetration_m <= 1e-9);
}

TEST_CASE("robust finds every stable contact of the oracle to a nanometre") {
  const Outcome o = track_oracle(Method::robust, 1e-3, [](const OracleContact& c) { return c.stability.stable(); });
  CHECK(o.tried > 150);
  CHECK(o.found == o.tried);
  CHECK(o.contact_m <= 1e-9);
  CHECK(o.penetration_m <= 1e-9);
}

TEST_CASE("the paper's iteration finds the contacts of the gently curved patches of the oracle to a nanometre") {
  // With a gain up to 1 it contracts where the eigenvalues of M lie between 0 and 2.
  const Outcome o = track_oracle(Method::paper, 1e-3, [](const OracleContact& c) {
    const double half = 0.5 * c.stability.trace;
    const double spread = std::sqrt(std::max(0.0, half * half - c.stability.det));
    return half - spread > 0.2 && half + spread < 1.8;
  });
  CHECK(o.tried > 80);
  CHECK(o.found == o.tried);
  CHECK(o.contact_m <= 1e-9);
  CHECK(o.penetration_m <= 1e-9);
}

TEST_CASE("from nothing, robust settles on a contact no shallower than a stable one of the oracle") {
  int compared = 0;
  for (const OracleContact& o : oracle_contacts()) {
    if (!o.stability.stable() || o.height_m < 0.0) continue;
    Stepper stepper(o.scene);
    TickState state;
    const TickOutput out = stepper.step(sphere_preset(o.radius_m, Method::robust), at_position(0.0, o.centre), state);
    CHECK(out.status != TickStatus::unconverged);
    CHECK(out.penetration_m >= o.penetration_m - 1e-6);
    ++compared;
  }
  CHECK(compared > 100);
}
