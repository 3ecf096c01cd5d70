// The 2D algorithm against 40-digit values.
#include "core/planar/track.h"
#include "core/tick/step.h"
#include "tests/core/oracle.h"
#include "tests/core/scenes.h"

using namespace tangent;
using namespace tangent::test;

TEST_CASE("converged 2D contacts agree with the 40-digit oracle to 1e-12 m") {
  const nlohmann::json oracle = read_oracle("curve_2d.json");
  for (const Method method : {Method::paper, Method::newton, Method::robust}) {
    int contacts = 0;
    double worst_m = 0.0, worst_normal = 0.0, worst_t = 0.0;
    for (const auto& entry : oracle.at("curves")) {
      PlanarPolygon polygon;
      for (const auto& v : entry.at("vertices_m"))
        polygon.vertices.emplace_back(v.at(0).get<double>(), v.at(1).get<double>());
      const auto curve = PlanarCurve::build(std::move(polygon));
      REQUIRE(curve.has_value());
      for (const auto& c : entry.at("contacts")) {
        Preset preset = sphere_preset(0.020, method);
        preset.solver.tolerance_m = 1e-15;
        TickState state;
        const Vec3 centre(c.at("centre_m").at(0).get<double>(), c.at("centre_m").at(1).get<double>(), 0.3);
        const TickOutput out = step_planar(*curve, preset, at_position(0.0, centre), state, nullptr);
        CAPTURE(entry.at("segments").get<int>());
        // A contact on a joint belongs to either patch.
        CHECK(std::abs(static_cast<int>(out.triangle) - c.at("vertex").get<int>()) <= 1);
        const Vec3 contact(c.at("contact_m").at(0).get<double>(), c.at("contact_m").at(1).get<double>(), 0.0);
        const Vec3 normal(c.at("normal").at(0).get<double>(), c.at("normal").at(1).get<double>(), 0.0);
        worst_m = std::max({worst_m, glm::length(out.contact - contact),
                            std::abs(0.020 - out.penetration_m - c.at("height_m").get<double>())});
        worst_normal = std::max(worst_normal, glm::length(out.normal - normal));
        if (static_cast<int>(out.triangle) == c.at("vertex").get<int>())
          worst_t = std::max(worst_t, std::abs(out.u - c.at("t").get<double>()));
        ++contacts;
      }
    }
    CAPTURE(name_of(method));
    CHECK(contacts == 60);
    CHECK(worst_m <= 1e-12);
    CHECK(worst_normal <= 1e-12);
    CHECK(worst_t <= 1e-10);
    MESSAGE(name_of(method) << ": " << contacts << " contacts within " << worst_m << " m, normals within "
                            << worst_normal);
  }
}
