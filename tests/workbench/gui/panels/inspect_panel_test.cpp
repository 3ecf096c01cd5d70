// Mesh inspection: maps, findings, creases, slices, control nets.
#include "tests/support/sanitized.h"
#include "tests/workbench/gui/running_app.h"

#include "tests/support/approx.h"
#include "workbench/gui/panels/panels.h"

#include <iterator>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

TEST_CASE("a map is chosen in its panel, its worst place gone to, its range dragged at the colour bar" *
          doctest::skip(testing::kSanitized)) {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.run(50);
  ui.click("map/quantity");
  ui.click("map/quantity/Curvature");
  ui.frames(2);
  REQUIRE(ui.model().map().on);
  REQUIRE(ui.model().map().paint().has_value());
  CHECK(ui.app().items().find("view/map_bar") != nullptr);
  const Camera before = ui.model().view().camera;
  ui.click("map/worst/0");
  CHECK(ui.model().view().picked_triangle == ui.model().map().worst()[0].triangle);
  CHECK(glm::length(ui.model().view().camera.target - ui.model().map().worst()[0].point_world) < 1e-12);
  CHECK(ui.model().view().camera.yaw_rad != before.yaw_rad);
  ui.click("map/low");
  ui.frame();
  ui.type("5");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().map().low() == 5.0);
  CHECK_FALSE(ui.model().map().automatic_range());
  const ItemRect bar = *ui.app().items().find("view/map_bar");
  const double high = ui.model().map().high();
  const ImVec2 upper{bar.centre().x, bar.min.y + 60.0f};
  ui.move(upper);
  ui.press();
  ui.move({upper.x, upper.y + 20.0f});
  ui.move({upper.x, upper.y + 40.0f});
  ui.release();
  CHECK(ui.model().map().high() > high);
  CHECK(ui.model().map().low() == 5.0);
  ui.click("map/auto");
  CHECK(ui.model().map().automatic_range());
  ui.click("map/quantity");
  ui.click("map/quantity/None");
  CHECK_FALSE(ui.model().map().paint().has_value());
}

TEST_CASE("a finding is listed, gone to, marked, isolated and left again") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "fin_on_plate";
  RunningApp ui(options, 1280.0f, 2400.0f);
  ui.frame();
  REQUIRE(ui.model().scene().findings() != nullptr);
  REQUIRE(ui.model().scene().findings()->count(FindingKind::non_manifold_edge) > 0);
  const std::string kind = "inspect/" + std::to_string(static_cast<int>(FindingKind::non_manifold_edge));
  ui.click(kind);
  ui.click(kind + "/0");
  const MeshFinding& finding = ui.model().scene().findings()->of(FindingKind::non_manifold_edge)[0];
  CHECK(ui.model().view().inspection().marked.size() >= 3);
  CHECK(glm::length(ui.model().view().camera.target - (ui.model().scene().current()->mesh().origin() + finding.place)) <
        1e-12);
  ui.click("inspect/isolate");
  REQUIRE(ui.model().view().isolation != nullptr);
  std::size_t kept = 0;
  for (const std::uint8_t k : ui.model().view().isolation->kept) kept += k;
  CHECK(kept >= ui.model().view().inspection().marked.size());
  CHECK(kept < ui.model().scene().current()->mesh().triangle_count() / 2);
  ui.click("inspect/isolate_part");
  std::size_t part = 0;
  for (const std::uint8_t k : ui.model().view().isolation->kept) part += k;
  CHECK(part > kept);
  ui.click("inspect/show_all");
  CHECK(ui.model().view().isolation == nullptr);
  CHECK(ui.model().view().inspection().marked.empty());
}

TEST_CASE("the crease angle is live: the mesh is built anew, the view and the picked triangle stay") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh_options.normals = NormalSource::computed;
  RunningApp ui(options, 1280.0f, 3000.0f);
  ui.run(50);
  REQUIRE(ui.model().scene().audit()->crease_edges == 0);
  ui.drag("view", {40.0f, 10.0f});
  const Camera camera = ui.model().view().camera;
  ui.model().view().picked_triangle = 3;
  ui.click("inspect/crease");
  ui.frame();
  ui.type("2");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().scene().crease_angle_rad() == approx(2.0 * kDegree));
  CHECK(ui.model().scene().audit()->crease_edges == ui.model().scene().audit()->edges);
  CHECK(ui.model().view().camera == camera);
  CHECK(ui.model().view().picked_triangle == 3);
  ui.run(50);
  CHECK(ui.model().time().tick().problem().empty());
}

TEST_CASE("a slice cuts the picture open and lets the pointer through") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.frame();
  ui.click("inspect/slice");
  ui.click("inspect/slice/across the view");
  REQUIRE(ui.model().view().slice.has_value());
  const auto& scene = *ui.model().scene().current();
  const Camera& camera = ui.model().view().camera;
  const auto whole = pick_triangle(scene, camera, Vec2(200, 150), 400, 300);
  const auto cut = pick_triangle(scene, camera, Vec2(200, 150), 400, 300, ui.model().view().slice);
  REQUIRE(whole);
  REQUIRE(cut);
  CHECK(cut.distance_m > whole.distance_m + 0.05);  // the far wall, seen from inside
  ui.click("inspect/slice_flip");
  CHECK(pick_triangle(scene, camera, Vec2(200, 150), 400, 300, ui.model().view().slice).triangle == whole.triangle);
  const double at = ui.model().view().slice->offset_m;
  ui.drag("inspect/slice_at", {15.0f, 0.0f});
  CHECK(ui.model().view().slice->offset_m > at);
}

TEST_CASE("a slice across the view, chosen again, is across the view as it is now") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  ui.frame();
  const auto choose = [&] {
    ui.click("inspect/slice");
    ui.click("inspect/slice/across the view");
    REQUIRE(ui.model().view().slice.has_value());
    return glm::dot(ui.model().view().slice->normal, ui.model().view().camera.forward());
  };
  CHECK(choose() == approx(-1.0));
  ui.model().view().camera.orbit(0.8, 0.2);
  CHECK(glm::dot(ui.model().view().slice->normal, ui.model().view().camera.forward()) > -0.95);
  CHECK(choose() == approx(-1.0));
}

TEST_CASE("the slice's choice says what the plane is, whoever set it") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 2400.0f);
  const auto rest_of_row = [&] {
    ui.frames(2);
    return ui.app().items().find("inspect/slice_at") != nullptr;
  };
  CHECK(slice_choice(std::nullopt) == "no slice");
  CHECK_FALSE(rest_of_row());
  ui.model().view().slice = SlicePlane{{0.0, -1.0, 0.0}, 0.001};
  CHECK(rest_of_row());
  CHECK(slice_choice(ui.model().view().slice) == "across y");
  ui.click("inspect/slice_flip");
  CHECK(slice_choice(ui.model().view().slice) == "across y");
  ui.model().view().slice = SlicePlane{glm::normalize(Vec3(1.0, 2.0, 0.5)), 0.0};
  CHECK(slice_choice(ui.model().view().slice) == "across the view");
  ui.click("inspect/slice");
  ui.click("inspect/slice/across x");
  CHECK(slice_choice(ui.model().view().slice) == "across x");
  ui.click("inspect/slice");
  ui.click("inspect/slice/no slice");
  CHECK_FALSE(rest_of_row());
}

TEST_CASE("the picked triangle's control net can be copied with every digit") {
  RunningApp ui(HeadlessApp::deterministic_options(), 1280.0f, 3000.0f);
  ui.model().view().picked_triangle = 7;
  ui.frame();
  ui.click("mesh/copy_net");
  const std::string text = ImGui::GetClipboardText();
  CHECK(text.find("b111,") != std::string::npos);
  CHECK(text.find("n101,") != std::string::npos);
  const Vec3 corner =
      ui.model().scene().current()->mesh().origin() + ui.model().scene().current()->mesh().position(7, 0);
  double x = 0, y = 0, z = 0;
  REQUIRE(std::sscanf(text.c_str() + text.find("b300,"), "b300,%lf,%lf,%lf", &x, &y, &z) == 3);
  CHECK(glm::length(Vec3(x, y, z) - corner) < 1e-16);
}
