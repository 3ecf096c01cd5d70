// Figures of the 3D algorithm: one patch and its base triangle, seen from the side and a little above.
#include "core/surface/mesh_patch.h"
#include "core/tick/step.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/text_format.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace tangent {
namespace {

/// Orthographic, on the picture's plane; mm.
std::vector<double> seen(const Vec3& v) {
  constexpr double kTurn = 0.35, kRise = 0.30;
  const double across = std::cos(kTurn) * v.x + std::sin(kTurn) * v.y;
  const double depth = -std::sin(kTurn) * v.x + std::cos(kTurn) * v.y;
  return {1e3 * across, 1e3 * (std::cos(kRise) * v.z + std::sin(kRise) * depth)};
}
FigureTable seen_points() { return {{"x_mm", "y_mm"}, {}}; }
void add_line(FigureTable& table, std::initializer_list<Vec3> line) {
  for (const Vec3& v : line) table.rows.push_back(seen(v));
  table.part();
}

/// A bulging triangle of 70 mm.
PolygonMesh bulging_triangle() {
  PolygonMesh mesh;
  mesh.name = "patch";
  mesh.positions = {{-0.035, -0.020, 0.0}, {0.035, -0.020, 0.0}, {0.0, 0.040, 0.0}};
  for (const Vec3& p : mesh.positions) mesh.normals.push_back(unit(p + Vec3(0.0, 0.0, 0.055)));
  mesh.add_face({0, 1, 2});
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

/// One tick of the paper's iteration after the finger has jumped along the patch.
struct PatchTick {
  std::shared_ptr<const ContactScene> scene = *ContactScene::build(*ContactMesh::build(bulging_triangle()));
  Preset preset;
  Vec3 finger{0.015, 0.008, 0.0};
  std::unique_ptr<IterationTrace> trace = std::make_unique<IterationTrace>();

  PatchTick() {
    preset.solver.method = Method::paper;
    preset.solver.gain_curvature_m = preset.finger.radius_m;
    Stepper stepper(scene);
    TickState state;
    stepper.step(preset, at(0.0, {-0.014, -0.008, 0.028}), state);
    finger.z = 0.027;
    stepper.step(preset, at(1e-3, finger), state, trace.get());
  }
  static TickInput at(double t_s, const Vec3& position) { return {t_s, {position, Quat(1.0, 0.0, 0.0, 0.0)}}; }
  PnPatch patch() const { return make_patch(scene->mesh(), 0); }
  Vec3 world(const Vec3& local) const { return scene->mesh().origin() + local; }
  Vec3 base(double u, double v) const {
    const PnPatch p = patch();
    return world((1.0 - u - v) * p.control_point(b300) + u * p.control_point(b030) + v * p.control_point(b003));
  }

  FigureTable triangle() const {
    FigureTable table = seen_points();
    add_line(table, {base(0, 0), base(1, 0), base(0, 1), base(0, 0)});
    return table;
  }
  /// Lines of constant u, v and w on the patch.
  FigureTable grid() const {
    constexpr int kLines = 8, kParts = 24;
    const PnPatch p = patch();
    FigureTable table = seen_points();
    for (int line = 0; line < kLines; ++line) {
      const double fixed = static_cast<double>(line) / kLines;
      for (int way = 0; way < 3; ++way) {
        for (int k = 0; k <= kParts; ++k) {
          const double along = (1.0 - fixed) * k / kParts, rest = 1.0 - fixed - along;
          const Vec2 uv = way == 0 ? Vec2(fixed, along) : way == 1 ? Vec2(along, fixed) : Vec2(along, rest);
          table.rows.push_back(seen(world(evaluate_point(p, uv.x, uv.y))));
        }
        table.part();
      }
    }
    return table;
  }
};

/// A square of a tangent plane about its place.
void add_plane(const IterationRecord& r, double half, FigureTable& table) {
  const Vec3 x = unit(glm::cross(Vec3(0.0, 1.0, 0.0), r.normal)), y = glm::cross(r.normal, x);
  const auto at = [&](double i, double j) { return r.point + half * (i * x + j * y); };
  add_line(table, {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1), at(-1, -1)});
}

constexpr const char* kSpacePicture =
    "set size ratio -1\nunset border\nunset tics\nunset xlabel\nunset ylabel\nset key outside right top\n";

}  // namespace

Figure iterations_figure() {
  Figure figure{.name = "fig06-iterations",
                .title = "the tangent planes of one tick on a patch",
                .width_px = 900,
                .height_px = 520};
  const PatchTick tick;
  FigureTable planes = seen_points(), places = seen_points(), contacts = seen_points(), finger = seen_points();
  for (const IterationRecord& r : tick.trace->view()) {
    add_plane(r, 0.017, planes);
    places.rows.push_back(seen(r.point));
    contacts.rows.push_back(seen(r.contact));
  }
  for (int i = 0; i <= 90; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 90;
    const auto centre = seen(tick.finger);
    const double radius_mm = 1e3 * tick.preset.finger.radius_m;
    finger.rows.push_back({centre[0] + radius_mm * std::cos(a), centre[1] + radius_mm * std::sin(a)});
  }
  figure.data = {{"", places},        {"-planes", planes},    {"-contacts", contacts},
                 {"-finger", finger}, {"-grid", tick.grid()}, {"-triangle", tick.triangle()}};
  figure.script = std::string(kSpacePicture) + R"(N = DIR.'/fig06-iterations'
plot N.'-finger.csv' using 'x_mm':'y_mm' \
       with filledcurves fs solid noborder lc rgb '#f7ece3' title 'finger', \
     N.'-finger.csv' using 'x_mm':'y_mm' with lines lc rgb '#c9a48e' lw 1.2 notitle, \
     N.'-triangle.csv' using 'x_mm':'y_mm' with lines lc rgb '#888888' lw 1.6 title 'base triangle', \
     N.'-grid.csv' using 'x_mm':'y_mm' with lines lc rgb '#86a9c6' lw 0.9 title 'patch', \
     N.'-planes.csv' every :::3 using 'x_mm':'y_mm' with lines lc rgb '#cdb0df' lw 5 title 'iterations 3 to 5', \
     N.'-planes.csv' every :::0::0 using 'x_mm':'y_mm' with lines ls 2 title 'kept plane', \
     N.'-planes.csv' every :::1::1 using 'x_mm':'y_mm' with lines ls 5 title 'iteration 1', \
     N.'-planes.csv' every :::2::2 using 'x_mm':'y_mm' with lines ls 1 title 'iteration 2', \
     N.'-contacts.csv' using 'x_mm':'y_mm' with points pt 6 ps 0.9 lc rgb '#222222' title 'contact on the plane', \
     N.'.csv' using 'x_mm':'y_mm' with points pt 7 ps 0.5 lc rgb '#222222' title 'place on the patch'
)";
  return figure;
}

Figure travel_figure() {
  Figure figure{.name = "fig07-travel",
                .title = "the travel on a tangent plane, projected on the base triangle, and the place it leads to",
                .width_px = 900,
                .height_px = 430};
  const PatchTick tick;
  const IterationRecord &now = tick.trace->records[0], &next = tick.trace->records[1];
  const Vec3 from = tick.base(now.u, now.v), to = tick.base(next.u, next.v);
  FigureTable plane = seen_points(), links = seen_points(), places = seen_points();
  FigureTable travel{{"x_mm", "y_mm", "way_x_mm", "way_y_mm"}, {}}, projected = travel;
  const auto arrow = [](FigureTable& table, const Vec3& a, const Vec3& b) {
    const auto p = seen(a), q = seen(b);
    table.rows.push_back({p[0], p[1], q[0] - p[0], q[1] - p[1]});
  };
  add_plane(now, 0.026, plane);
  add_line(links, {from, now.point});
  add_line(links, {to, next.point});
  arrow(travel, now.point, now.contact);
  arrow(projected, from, to);
  for (const Vec3& v : {from, to, now.point, next.point}) places.rows.push_back(seen(v));
  figure.data = {{"", places},
                 {"-plane", plane},
                 {"-links", links},
                 {"-travel", travel},
                 {"-projected", projected},
                 {"-grid", tick.grid()},
                 {"-triangle", tick.triangle()}};
  const auto label = [](const char* text, const Vec3& at, const char* how) {
    const auto v = seen(at);
    return format("set label '%s' at %.6g,%.6g %s\n", text, v[0], v[1], how);
  };
  figure.script = std::string(kSpacePicture) + label("place", now.point, "right offset -0.8,0.5") +
                  label("next place", next.point, "left offset 0.8,0.6") + R"(N = DIR.'/fig07-travel'
plot N.'-triangle.csv' using 'x_mm':'y_mm' with lines lc rgb '#888888' lw 1.6 title 'base triangle', \
     N.'-grid.csv' using 'x_mm':'y_mm' with lines lc rgb '#86a9c6' lw 0.9 title 'patch', \
     N.'-plane.csv' using 'x_mm':'y_mm' with lines ls 2 title 'tangent plane', \
     N.'-links.csv' using 'x_mm':'y_mm' with lines lc rgb '#222222' dt 2 lw 1 title 'same parameters', \
     N.'-travel.csv' using 'x_mm':'y_mm':'way_x_mm':'way_y_mm' with vectors head filled ls 1 lw 2 title 'travel', \
     N.'-projected.csv' using 'x_mm':'y_mm':'way_x_mm':'way_y_mm' \
       with vectors head filled ls 3 lw 2 title 'step on the triangle', \
     N.'.csv' using 'x_mm':'y_mm' with points pt 7 ps 0.6 lc rgb '#222222' notitle
)";
  return figure;
}

}  // namespace tangent
