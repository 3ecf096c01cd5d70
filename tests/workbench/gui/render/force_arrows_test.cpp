// The 3D view, the plot and the panels say the same of the two forces.
#include "workbench/gui/render/force_arrows.h"

#include "core/lab/objects/generate.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/render/scene_sketch.h"
#include "workbench/gui/render/staged_scene.h"

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct Drawn {
  std::vector<std::string> labels;
  std::size_t cones = 0;
};

/// The force of a tick as the 3D view draws it.
Drawn drawn_force(const ContactScene& scene, const TickRecord& tick, const std::optional<Vec3>& felt) {
  SceneFrame frame;
  frame.tick = tick;
  frame.felt_force_n = felt;
  Camera camera;
  camera.frame(world_bounds(scene));
  Sketch sketch;
  sketch.begin(camera.target, camera.distance_m);
  std::vector<SceneLabel> labels;
  const double scale = choose_force_scale(frame, camera, 0.0);
  draw_force(sketch, {scene, NormalForm::bernstein, frame, camera, 800, 600, scale}, labels);
  Drawn out;
  for (const SceneLabel& label : labels) out.labels.push_back(label.text);
  for (const Solid& solid : sketch.solids()) out.cones += solid.shape == SolidShape::cone;
  return out;
}

}  // namespace

TEST_CASE("one arrow where computed and felt force agree, two with their names where they don't") {
  CHECK(force_arrows({0, 0, 2.0}, Vec3{0, 0, 2.001}).same);
  CHECK(force_arrows({0, 0, 2.0}, std::nullopt).felt_n == 2.0);
  CHECK_FALSE(force_arrows({0, 0, 2.0}, Vec3{0, 2.0, 0}).same);  // as large, elsewhere
  CHECK_FALSE(force_arrows({0, 0, 2.0}, Vec3(0.0)).same);
  CHECK(force_arrows(Vec3(std::nan("")), std::nullopt).computed_n == 0.0);
}

TEST_CASE("without force let through the 3D view and the plot both say what is computed and that nothing is felt") {
  HeadlessApp ui;
  const auto run_to_contact = [&] {
    for (int i = 0; i < 200; ++i) {
      ui.app().advance(20);
      ui.frame();
      const ServoRecord* record = ui.model().time().tick().record();
      if (glm::length(record->tick.output.force_n) > 0.1) return *record;
    }
    FAIL("no force");
    return ServoRecord{};
  };
  ui.model().devices().stop();
  ui.app().advance(5);
  ServoRecord record = run_to_contact();
  const auto curve = [&](Channel channel) {
    return ui.model().time().store().value(static_cast<std::size_t>(channel), record.tick.tick);
  };
  CHECK(curve(Channel::force_felt) == 0.0f);
  CHECK(curve(Channel::force_computed) == static_cast<float>(glm::length(record.tick.output.force_n)));
  const ContactScene& scene = *ui.model().scene().current();
  Drawn drawn = drawn_force(scene, record.tick, record.device.force_command_n);
  CHECK(drawn.cones == 1);  // of the computed force
  REQUIRE(drawn.labels.size() == 2);
  CHECK(drawn.labels[0].find(" N computed") != std::string::npos);
  CHECK(drawn.labels[1] == "0.00 N felt");

  drawn = drawn_force(scene, record.tick, 0.5 * record.tick.output.force_n);
  CHECK(drawn.cones == 2);
  drawn = drawn_force(scene, record.tick, record.tick.output.force_n);
  CHECK(drawn.cones == 1);
  CHECK(drawn.labels.size() == 1);
  // The plot's legend names both.
  CHECK(ui.app().items().find("plots/force/computed") != nullptr);
  CHECK(ui.app().items().find("plots/force/felt") != nullptr);
}
