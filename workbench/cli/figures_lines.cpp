// Figures of the 2D geometry: a tick's tangent lines, polygon and curve, the local centre.
#include "core/tick/step.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/text_format.h"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace tangent {
namespace {

std::vector<double> mm(const Vec2& v) { return {1e3 * v.x, 1e3 * v.y}; }
Vec2 flat(const Vec3& v) { return {v.x, v.y}; }

FigureTable points() { return {{"x_mm", "y_mm"}, {}}; }

FigureTable polygon_table(const PlanarPolygon& polygon) {
  FigureTable table = points();
  for (const Vec2& v : polygon.vertices) table.rows.push_back(mm(v));
  if (polygon.closed) table.rows.push_back(mm(polygon.vertices.front()));
  return table;
}

FigureTable circle_table(const Vec2& centre, double radius) {
  FigureTable table = points();
  for (int i = 0; i <= 180; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 180.0;
    table.rows.push_back(mm(centre + radius * Vec2(std::cos(a), std::sin(a))));
  }
  return table;
}

/// The rendered curve, patch by patch.
FigureTable curve_table(const PlanarCurve& curve) {
  FigureTable table = points();
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i)
    for (int k = 0; k <= 40; ++k)
      table.rows.push_back(mm(curve.origin() + curve.sample(i, LocalCentre::bisectors, k / 40.0).place));
  return table;
}

/// A patch's region: its control polygon and the curve back.
void add_patch_region(const PlanarCurve& curve, std::uint32_t i, FigureTable& table) {
  const CurvePatch& p = curve.patch(i);
  for (const Vec2& v : {p.first, p.vertex, p.last}) table.rows.push_back(mm(curve.origin() + v));
  for (int k = 40; k >= 0; --k)
    table.rows.push_back(mm(curve.origin() + curve.sample(i, LocalCentre::bisectors, k / 40.0).place));
  table.part();
}

constexpr const char* kPicture = "set size ratio -1\nset grid\nset xlabel 'x (mm)'\nset ylabel 'y (mm)'\n";

}  // namespace

Figure iterations_figure() {
  Figure figure{.name = "fig06-iterations",
                .title = "the tangent lines of one tick, in cross-section",
                .width_px = 960,
                .height_px = 480};
  const PlanarCurve curve = curve_of(make_paper_arc(3));
  // The finger has jumped by 27 mm since the last tick, so that several iterations are visible.
  Preset preset;
  preset.solver.method = Method::paper;
  const double depth = 0.003, distance = kPaperArcRadius + preset.finger.radius_m - depth;
  const auto at = [&](double a) {
    return TickInput{a, {{distance * std::sin(a), distance * std::cos(a), 0.0}, Quat(1.0, 0.0, 0.0, 0.0)}};
  };
  TickState state;
  auto trace = std::make_unique<IterationTrace>();
  step_planar(curve, preset, at(-0.10), state, nullptr);
  const TickInput now = at(0.14);
  step_planar(curve, preset, now, state, trace.get());

  FigureTable lines{{"iteration", "x_mm", "y_mm"}, {}};
  FigureTable contacts{{"iteration", "place_x_mm", "place_y_mm", "contact_x_mm", "contact_y_mm", "error_um"}, {}};
  for (std::size_t i = 0; i < trace->size; ++i) {
    const IterationRecord& r = trace->records[i];
    const Vec2 along(r.normal.y, -r.normal.x);
    for (const double s : {-0.034, 0.034})
      lines.rows.push_back({static_cast<double>(i), 1e3 * (r.point.x + s * along.x), 1e3 * (r.point.y + s * along.y)});
    lines.part();
    contacts.rows.push_back({static_cast<double>(i), 1e3 * r.point.x, 1e3 * r.point.y, 1e3 * r.contact.x,
                             1e3 * r.contact.y, 1e6 * r.error_m});
  }
  figure.data = {{"", contacts},
                 {"-lines", lines},
                 {"-polygon", polygon_table(curve.polygon())},
                 {"-curve", curve_table(curve)},
                 {"-finger", circle_table(flat(now.finger.position), preset.finger.radius_m)}};
  figure.script = std::string(kPicture) + R"(set xrange [-48:56]
set yrange [88:150]
N = DIR.'/fig06-iterations'
set key outside right top
plot N.'-finger.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#f3e3d8' notitle, \
     N.'-finger.csv' using 'x_mm':'y_mm' with lines lc rgb '#c9a48e' lw 1 title 'finger', \
     N.'-polygon.csv' using 'x_mm':'y_mm' with lines ls 9 title 'polygon', \
     N.'-curve.csv' using 'x_mm':'y_mm' with lines ls 8 lw 2 title 'smooth curve', \
     N.'-lines.csv' every :::0::0 using 'x_mm':'y_mm' with lines ls 2 title 'kept tangent line', \
     N.'-lines.csv' every :::1::1 using 'x_mm':'y_mm' with lines ls 5 title 'iteration 1', \
     N.'-lines.csv' every :::2::2 using 'x_mm':'y_mm' with lines ls 1 title 'iteration 2', \
     N.'-lines.csv' every :::3 using 'x_mm':'y_mm' with lines ls 3 lw 1 title 'later', \
     N.'.csv' using 'contact_x_mm':'contact_y_mm' with points pt 6 ps 0.9 lc rgb '#222222' title 'contact on the line', \
     N.'.csv' using 'place_x_mm':'place_y_mm' with points pt 7 ps 0.5 lc rgb '#222222' title 'place on the curve'
)";
  return figure;
}

Figure patches_figure() {
  Figure figure{.name = "fig15-patches",
                .title = "polygon, smooth curve and patches; one vertex given twice",
                .width_px = 820,
                .height_px = 480};
  const PlanarCurve curve = curve_of({"outline",
                                      {{-0.060, 0.0},
                                       {-0.045, 0.030},
                                       {-0.015, 0.042},
                                       {0.008, 0.018},
                                       {0.030, 0.022},
                                       {0.042, 0.046},
                                       {0.042, 0.046},
                                       {0.066, 0.008}},
                                      false});
  FigureTable even = points(), odd = points(), ends = points(), vertices = points();
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    if (!curve.patch(i).straight) add_patch_region(curve, i, i % 2 ? odd : even);
    ends.rows.push_back(mm(curve.origin() + curve.patch(i).first));
    ends.rows.push_back(mm(curve.origin() + curve.patch(i).last));
    vertices.rows.push_back(mm(curve.origin() + curve.patch(i).vertex));
  }
  figure.data = {{"", curve_table(curve)},
                 {"-polygon", polygon_table(curve.polygon())},
                 {"-patches-even", even},
                 {"-patches-odd", odd},
                 {"-midpoints", ends}};
  figure.script = std::string(kPicture) + R"(set xrange [-66:72]
set yrange [-4:62]
N = DIR.'/fig15-patches'
set label 'vertex given twice:' at 45,51 textcolor rgb '#444444'
set label 'a sharp corner' at 45,47.5 textcolor rgb '#444444'
plot N.'-patches-even.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#cfe4f3' title 'patches', \
     N.'-patches-odd.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#f7dcc9' notitle, \
     N.'-polygon.csv' using 'x_mm':'y_mm' with linespoints lc rgb '#888888' lw 1.2 pt 7 ps 0.5 title 'polygon', \
     N.'.csv' using 'x_mm':'y_mm' with lines ls 8 lw 2.4 title 'smooth curve', \
     N.'-midpoints.csv' using 'x_mm':'y_mm' with points pt 6 ps 0.7 lc rgb '#D55E00' title 'midpoints: patches meet'
)";
  return figure;
}

Figure local_centre_figure() {
  Figure figure{.name = "fig17-local-centre",
                .title = "one patch: its local centre, and the tangent line at the contact's angle",
                .width_px = 720,
                .height_px = 580};
  const PlanarCurve curve = curve_of({"patch", {{-0.040, 0.0}, {-0.004, 0.030}, {0.046, 0.010}}, false});
  const CurvePatch& p = curve.patch(1);
  const double t = 0.62;
  const LineSample s = curve.sample(1, LocalCentre::bisectors, t);
  const auto world = [&](const Vec2& v) { return mm(curve.origin() + v); };
  FigureTable region = points(), rays = points(), line = points(), named = points(), bezier = points();
  add_patch_region(curve, 1, region);
  for (const Vec2& v : {p.first, s.place, p.last}) {
    rays.rows.push_back(world(p.centre[0]));
    rays.rows.push_back(world(v));
    rays.part();
  }
  for (const double way : {-0.022, 0.022}) line.rows.push_back(world(s.place + way * s.direction));
  for (const Vec2& v : {p.first, p.vertex, p.last, s.foot, p.vertex + t * (p.last - p.vertex), s.place, p.centre[0]})
    named.rows.push_back(world(v));
  figure.data = {{"", named},
                 {"-polygon", polygon_table(curve.polygon())},
                 {"-curve", curve_table(curve)},
                 {"-patch", region},
                 {"-rays", rays},
                 {"-line", line}};
  const auto label = [&](const char* text, const Vec2& at, const char* how) {
    const auto v = world(at);
    return format("set label '%s' at %.6g,%.6g %s\n", text, v[0], v[1], how);
  };
  figure.script = std::string(kPicture) + label("P_1", p.first, "right offset -0.8,0.6") +
                  label("P_2", p.vertex, "center offset 0,0.9") + label("P_3", p.last, "left offset 0.8,0.6") +
                  label("P_{12}", s.foot, "right offset -0.2,0.9") +
                  label("P_{23}", p.vertex + t * (p.last - p.vertex), "left offset 0.5,0.9") +
                  label("contact", s.place, "left offset 0.4,-1.0") +
                  label("local centre", p.centre[0], "left offset 1,0") + R"(set xrange [-46:52]
set key left bottom
set yrange [-36:40]
N = DIR.'/fig17-local-centre'
plot N.'-patch.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#cfe4f3' title 'patch', \
     N.'-polygon.csv' using 'x_mm':'y_mm' with lines lc rgb '#888888' lw 1.2 title 'polygon', \
     N.'-curve.csv' using 'x_mm':'y_mm' with lines ls 8 lw 2.4 title 'smooth curve', \
     N.'-rays.csv' using 'x_mm':'y_mm' with lines ls 9 title 'angles from the local centre', \
     N.'-line.csv' using 'x_mm':'y_mm' with lines ls 2 title 'tangent line at t = 0.62', \
     N.'.csv' using 'x_mm':'y_mm' with points pt 7 ps 0.6 lc rgb '#222222' notitle
)";
  return figure;
}

}  // namespace tangent
