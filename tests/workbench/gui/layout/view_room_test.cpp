#include "tests/workbench/gui/headless_app.h"

#include "core/mesh/contact_mesh.h"
#include "tests/support/approx.h"
#include "workbench/gui/layout/view_room.h"
#include "workbench/gui/render/camera_text.h"
#include "workbench/gui/render/scene_overlay.h"

#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Extent {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

/// Of the mesh's vertices in the picture.
Extent extent_of(const AppModel& model, int w, int h) {
  Extent e;
  const ContactMesh& mesh = model.scene().current()->mesh();
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    for (const Vec3& p : mesh.positions(t)) {
      const Vec3 at = model.view().camera.project(mesh.origin() + p, w, h);
      e.left = std::min(e.left, at.x), e.right = std::max(e.right, at.x);
      e.top = std::min(e.top, at.y), e.bottom = std::max(e.bottom, at.y);
    }
  }
  return e;
}

}  // namespace

TEST_CASE("a standard view frames the whole scene anew, and keeps near to what was gone near to") {
  HeadlessApp ui;
  ui.model().view().frame_scene();
  ui.model().view().look_from_standard(StandardView::top);
  Camera expected = ui.model().view().camera;
  expected.frame(world_bounds(*ui.model().scene().current()), 1.05, ui.model().view().rooms);
  CHECK(ui.model().view().camera == expected);
  ui.model().view().camera.zoom(0.3);
  const double near = ui.model().view().camera.distance_m;
  ui.model().view().look_from_standard(StandardView::front);
  CHECK(ui.model().view().camera.distance_m == near);
}

TEST_CASE("rooms are what a card in the corner and bars along the edges leave") {
  const auto [middle, beside, above] = rooms_beside({600.0, 400.0}, 40.0, 20.0, {200.0, 220.0});
  CHECK(middle.width == approx(0.5));
  CHECK(middle.height == approx(0.9));
  CHECK(middle.shift.x == approx(0.0).scale(1.0));
  CHECK(middle.shift.y == approx(-0.05));
  CHECK(beside.width == approx(0.95));
  CHECK(beside.shift.x == approx(0.225));
  CHECK(above.width == approx(1.45));
  CHECK(above.height == approx(0.35));
  CHECK(above.shift.y == approx(0.225));
  for (const ViewRoom& room : rooms_beside({10.0, 0.0}, 40.0, 20.0, {200.0, 220.0}))
    CHECK((room.width > 0.0 && room.height > 0.0));
}

TEST_CASE("nothing that is drawn over the picture lies on the object, whatever it is and wherever it is seen from") {
  for (const auto& [width, height] : {std::pair{1280.0f, 720.0f}, {2560.0f, 1440.0f}, {1000.0f, 900.0f}}) {
    for (const char* object :
         {"torus", "icosphere", "cube", "cylinder", "tetrahedron", "triangle", "saddle", "two_plates", "open_bowl"}) {
      AppOptions options = HeadlessApp::deterministic_options();
      options.mesh = object;
      HeadlessApp ui(options, width, height);
      for (const bool map : {false, true}) {
        ui.model().map().on = map;
        ui.frames(2);
        ui.model().view().frame_scene();
        const ItemRect view = *ui.app().items().find("view");
        const int w = static_cast<int>(view.max.x - view.min.x), h = static_cast<int>(view.max.y - view.min.y);
        const float below_toggles = ui.app().items().find("view/Display")->max.y;
        const Vec2 cards = overlay_cards(ui.model().view().toggles, ImGui::GetIO().Fonts->Fonts[0]->FontSize,
                                         view.max.y - below_toggles)
                               .size;
        const double toggles = static_cast<double>(below_toggles - view.min.y);
        const ItemRect* bar = map ? ui.app().items().find("view/map_bar") : nullptr;
        const double right = bar != nullptr ? static_cast<double>(bar->min.x - view.min.x) : w;
        for (const NamedView& v : kStandardViews) {
          CAPTURE(std::string(object));
          CAPTURE(std::string(v.name));
          CAPTURE(width);
          CAPTURE(map);
          ui.model().view().look_from_standard(v.view);
          const Extent e = extent_of(ui.model(), w, h);
          CAPTURE(e.bottom - (h - cards.y));
          CAPTURE(e.left - cards.x);
          CHECK((e.left >= cards.x || e.bottom <= h - cards.y));
          CHECK(e.top >= toggles);
          CHECK(e.bottom <= h);
          CHECK(e.right <= right);
          CHECK(e.left >= 0.0);
          CHECK(e.right - e.left + e.bottom - e.top > 0.25 * h);  // and it is no speck
        }
      }
    }
  }
}

TEST_CASE(
    "in a low picture the cards stand side by side, and what still does not fit is left out: nothing reaches into the "
    "toggles") {
  const float em = 10.0f;
  SceneToggles toggles;
  toggles.cld_inset = toggles.axes = toggles.colour_bar = toggles.planes = true;
  const OverlayCards high = overlay_cards(toggles, em, 1e4f);
  CHECK((high.inset && high.scales && !high.beside));
  bool beside = false, alone = false, none = false;
  for (float room = static_cast<float>(high.size.y) + 20.0f; room > 0.0f; room -= 1.0f) {
    CAPTURE(room);
    const OverlayCards cards = overlay_cards(toggles, em, room);
    CHECK(cards.size.y <= static_cast<double>(room));
    CHECK((cards.size.x > 0.0) == (cards.inset || cards.scales));
    if (cards.beside) CHECK(cards.size.x > 1.9 * high.size.x);
    CHECK((!cards.beside || (cards.inset && cards.scales)));
    beside |= cards.beside;
    alone |= cards.inset != cards.scales;
    none |= !cards.inset && !cards.scales;
  }
  CHECK((beside && alone && none));
  toggles.cld_inset = false;
  CHECK(!overlay_cards(toggles, em, 100.0f).beside);
}
