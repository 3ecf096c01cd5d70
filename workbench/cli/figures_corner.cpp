// The figure of a finger that trembles in an inner corner: the force as it flips, as it is faded, and from both walls.
#include "core/lab/measure/god_object.h"
#include "core/tick/step.h"
#include "workbench/cli/figures.h"

#include <cmath>
#include <numbers>

namespace tangent {
namespace {

constexpr double kCornerRadius = 0.005, kCornerPress = 1e-3, kCornerTremor = 50e-6;
constexpr int kCornerTicks = 1000;

/// Two walls of 40 mm at a right angle: x = 0 and z = 0, facing the finger between them.
PolygonMesh inner_corner() {
  PolygonMesh mesh;
  mesh.name = "inner corner";
  constexpr double kSize = 0.040;
  for (const double y : {-0.5 * kSize, 0.5 * kSize})
    for (const Vec3& p : {Vec3(0.0, y, kSize), Vec3(0.0, y, 0.0), Vec3(kSize, y, 0.0)}) mesh.positions.push_back(p);
  mesh.add_face({0, 1, 4, 3});  // rows of three along y: the wall that faces x, then the floor
  mesh.add_face({1, 2, 5, 4});
  return mesh;
}

/// Pressed into both walls; a hand's tremor of 9 Hz across the corner and 11 Hz along the walls.
Vec3 finger_in_corner(double t) {
  const double across = kCornerTremor * std::sin(2.0 * std::numbers::pi * 9.0 * t);
  const double into = 0.5 * kCornerTremor * std::sin(2.0 * std::numbers::pi * 11.0 * t);
  return {kCornerRadius - kCornerPress + across + into, 0.001, kCornerRadius - kCornerPress - across + into};
}

}  // namespace

Figure inner_corner_figure() {
  Figure figure{.name = "inner-corner",
                .title = "force of one wall on a finger of 5 mm that trembles by 50 um in an inner corner",
                .width_px = 1180,
                .height_px = 460};
  const auto scene = *ContactScene::build(*ContactMesh::build(inner_corner()));
  Preset before;
  before.finger.radius_m = kCornerRadius;
  before.force.contacts = ForceContacts::deepest;
  before.force.blend = ForceBlend::off;
  Preset faded = before, all = before;
  faded.force.blend = all.force.blend = ForceBlend::events;
  all.force.contacts = ForceContacts::all;
  Stepper steppers[3] = {Stepper(scene), Stepper(scene), Stepper(scene)};
  TickState states[3];
  const Preset* presets[3] = {&before, &faded, &all};
  GodObject god(scene->mesh(), kCornerRadius, {0.020, 0.001, 0.020});
  FigureTable table{{"t_s", "deepest_n", "deepest_faded_n", "all_n", "god_object_n"}, {}};
  for (int i = -100; i < kCornerTicks; ++i) {  // a tenth of a second to come to rest
    const double t = 1e-3 * i;
    const TickInput input{t, {finger_in_corner(t), Quat(1.0, 0.0, 0.0, 0.0)}};
    std::vector<double> row{t};
    for (int k = 0; k < 3; ++k) row.push_back(steppers[k].step(*presets[k], input, states[k]).force_n.x);
    row.push_back(before.force.stiffness_n_per_m * (god.follow(input.finger.position).x - input.finger.position.x));
    if (i >= 0) table.rows.push_back(std::move(row));
  }
  figure.data.push_back({"", std::move(table)});
  figure.script = R"(set xrange [0:1]
set yrange [-0.05:1]
set xlabel 'time (s)'
set ylabel 'force along x (N)'
set key outside right top
F = DIR.'/inner-corner.csv'
plot F using 't_s':'deepest_n' with lines ls 9 title 'deepest place, at once', \
     F using 't_s':'deepest_faded_n' with lines ls 2 title 'deepest place, faded', \
     F using 't_s':'all_n' with lines ls 1 lw 4 title 'all places', \
     F using 't_s':'god_object_n' with lines ls 8 dt 2 title 'god-object'
)";
  return figure;
}

}  // namespace tangent
