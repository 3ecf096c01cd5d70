// Figures of the 2D algorithm's geometry: polygon and curve, a patch's labels, tangent lines, angles.
#include "workbench/cli/figure_shapes.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/text_format.h"

namespace tangent {

using namespace drawn;

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
  FigureTable even = points(), odd = points(), ends = points();
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    if (!curve.patch(i).straight) add_patch_region(curve, i, i % 2 ? odd : even);
    ends.rows.push_back(mm(curve.origin() + curve.patch(i).first));
    ends.rows.push_back(mm(curve.origin() + curve.patch(i).last));
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

namespace {

/// The patch of Figs. 16 and 18: its vertex, the midpoints of its two segments, and its local centre.
struct LabelledPatch {
  PlanarCurve curve = curve_of({"patch", {{-0.040, 0.0}, {-0.004, 0.030}, {0.046, 0.010}}, false});
  const CurvePatch& patch() const { return curve.patch(1); }
  std::vector<double> at(const Vec2& local) const { return mm(curve.origin() + local); }
  std::string label(const char* text, const Vec2& local, const char* how) const {
    const auto v = at(local);
    return format("set label '%s' at %.6g,%.6g %s\n", text, v[0], v[1], how);
  }
  /// An arc about the local centre from P1 over a part of the angle to P3.
  FigureTable arc(double radius, double share) const {
    const CurvePatch& p = patch();
    const Vec2 arm = p.first - p.centre[0];
    const double from = std::atan2(arm.y, arm.x);
    FigureTable table = points();
    for (int i = 0; i <= 60; ++i) {
      const double a = from + share * p.turn_rad[0] * i / 60.0;
      table.rows.push_back(at(p.centre[0] + radius * Vec2(std::cos(a), std::sin(a))));
    }
    return table;
  }
  /// Middle of such an arc.
  Vec2 on_arc(double radius, double share) const {
    const CurvePatch& p = patch();
    const Vec2 arm = p.first - p.centre[0];
    const double a = std::atan2(arm.y, arm.x) + share * p.turn_rad[0];
    return p.centre[0] + radius * Vec2(std::cos(a), std::sin(a));
  }
};

/// What Figs. 16 and 18 share; the tangent line is at t.
Figure labelled_figure(const LabelledPatch& drawing, double t) {
  const CurvePatch& p = drawing.patch();
  const LineSample s = drawing.curve.sample(1, LocalCentre::bisectors, t);
  const Vec2 p23 = p.vertex + t * (p.last - p.vertex);
  FigureTable region = points(), line = points(), named = points();
  add_patch_region(drawing.curve, 1, region);
  for (const double way : {-0.022, 0.022}) line.rows.push_back(drawing.at(s.place + way * s.direction));
  for (const Vec2& v : {p.first, p.vertex, p.last, s.foot, p23, s.place, p.centre[0]})
    named.rows.push_back(drawing.at(v));
  Figure figure{.name = "", .title = "", .width_px = 720, .height_px = 580};
  figure.data = {{"", named},
                 {"-polygon", polygon_table(drawing.curve.polygon())},
                 {"-curve", curve_table(drawing.curve)},
                 {"-patch", region},
                 {"-line", line}};
  figure.script = std::string(kPicture) + "set xrange [-46:52]\nset yrange [-36:40]\nset key left bottom\n" +
                  drawing.label("P_1", p.first, "right offset -0.8,0.6") +
                  drawing.label("P_3", p.last, "left offset -0.6,-1.1") +
                  drawing.label("local centre", p.centre[0], "left offset 1,0");
  return figure;
}

constexpr const char* kLabelledPlot =
    R"(plot N.'-patch.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#cfe4f3' title 'patch', \
     N.'-polygon.csv' using 'x_mm':'y_mm' with lines lc rgb '#888888' lw 1.2 title 'polygon', \
     N.'-curve.csv' using 'x_mm':'y_mm' with lines ls 8 lw 2.4 title 'smooth curve', \
)";
constexpr const char* kLabelledPoints =
    R"(     N.'.csv' using 'x_mm':'y_mm' with points pt 7 ps 0.6 lc rgb '#222222' notitle
)";

}  // namespace

Figure labels_figure() {
  constexpr double kT = 0.4;
  const LabelledPatch drawing;
  const CurvePatch& p = drawing.patch();
  Figure figure = labelled_figure(drawing, kT);
  figure.name = "fig16-labels";
  figure.title = "labels of one patch: its control polygon, segments, local centre, and the ends of a tangent line";
  const Vec2 l1 = p.vertex - p.first, l2 = p.last - p.vertex;
  const Vec2 p12 = p.first + kT * l1, p23 = p.vertex + kT * l2;
  // The ways of P12 and P23 as t grows.
  FigureTable arrows{{"x_mm", "y_mm", "way_x_mm", "way_y_mm"}, {}};
  for (const auto& [from, way] : {std::pair{p12, l1}, std::pair{p23, l2}}) {
    const auto at = drawing.at(from), along = mm(0.25 * way);
    arrows.rows.push_back({at[0], at[1], along[0], along[1]});
  }
  figure.data.push_back({"-arrows", arrows});
  figure.script += drawing.label("P_2", p.vertex, "center offset 0,0.9") +
                   drawing.label("P_{12}", p12, "right offset -0.8,0.4") +
                   drawing.label("P_{23}", p23, "left offset 0.2,0.9") +
                   drawing.label("L_1", p.first - 0.4 * l1, "right offset -0.8,0.4") +
                   drawing.label("L_2", p.last + 0.4 * l2, "left offset 0.6,0.7") + "N = DIR.'/fig16-labels'\n" +
                   kLabelledPlot + R"(     N.'-line.csv' using 'x_mm':'y_mm' with lines ls 2 title 'tangent line', \
     N.'-arrows.csv' using 'x_mm':'y_mm':'way_x_mm':'way_y_mm' \
       with vectors head filled lc rgb '#222222' lw 1.6 title 'as t grows', \
)" + kLabelledPoints;
  return figure;
}

Figure tangents_figure() {
  Figure figure{.name = "fig17-tangents",
                .title = "three tangent lines a patch, at t = 0.25, 0.50 and 0.75; midpoints as ticks",
                .width_px = 820,
                .height_px = 480};
  const PlanarCurve curve = curve_of({"shape",
                                      {{-0.060, 0.0},
                                       {-0.045, 0.030},
                                       {-0.015, 0.042},
                                       {0.008, 0.018},
                                       {0.030, 0.022},
                                       {0.050, 0.040},
                                       {0.066, 0.008}},
                                      false});
  FigureTable lines = points(), ticks = points(), centres = points();
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    const CurvePatch& p = curve.patch(i);
    const auto at = [&](const Vec2& v) { return mm(curve.origin() + v); };
    if (i + 1 < curve.patch_count()) {
      const Vec2 way = curve.vertex(i + 1) - p.vertex, middle = p.vertex + 0.5 * way;
      const Vec2 across = 0.0018 * Vec2(-way.y, way.x) / glm::length(way);
      for (const Vec2& v : {middle - across, middle + across}) ticks.rows.push_back(at(v));
      ticks.part();
    }
    if (p.straight) continue;
    centres.rows.push_back(at(p.centre[1]));
    for (const double t : {0.25, 0.5, 0.75}) {
      lines.rows.push_back(at(p.first + t * (p.vertex - p.first)));
      lines.rows.push_back(at(p.vertex + t * (p.last - p.vertex)));
      lines.part();
    }
  }
  figure.data = {{"", lines}, {"-polygon", polygon_table(curve.polygon())}, {"-ticks", ticks}, {"-centres", centres}};
  figure.script = std::string(kPicture) + R"(set xrange [-66:72]
set yrange [-4:62]
set key right top
N = DIR.'/fig17-tangents'
plot N.'-polygon.csv' using 'x_mm':'y_mm' with lines lc rgb '#888888' lw 1.2 title 'polygon', \
     N.'-ticks.csv' using 'x_mm':'y_mm' with lines lc rgb '#222222' lw 1.6 title 'midpoints', \
     N.'.csv' using 'x_mm':'y_mm' with lines ls 2 lw 1.6 title 'tangent lines', \
     N.'-centres.csv' using 'x_mm':'y_mm' with points pt 6 ps 0.8 lc rgb '#0072B2' title 'local centres, at midpoints'
)";
  return figure;
}

Figure angles_figure() {
  constexpr double kT = 0.7, kWide = 0.016, kNarrow = 0.010;
  const LabelledPatch drawing;
  const CurvePatch& p = drawing.patch();
  Figure figure = labelled_figure(drawing, kT);
  figure.name = "fig18-angles";
  figure.title = "the part of the angle that the contact has gone about the local centre: t = 0.7";
  FigureTable rays = points();
  const LineSample s = drawing.curve.sample(1, LocalCentre::bisectors, kT);
  for (const Vec2& v : {p.first, s.place, p.last}) {
    rays.rows.push_back(drawing.at(p.centre[0]));
    rays.rows.push_back(drawing.at(v));
    rays.part();
  }
  figure.data.push_back({"-rays", rays});
  figure.data.push_back({"-alpha", drawing.arc(kWide, kT)});
  figure.data.push_back({"-beta", drawing.arc(kNarrow, 1.0)});
  figure.script += drawing.label("P_2", p.vertex, "center offset 0,0.9") +
                   drawing.label("contact", s.place, "left offset 0.4,-1.0") +
                   drawing.label("α", drawing.on_arc(kWide, 0.5 * kT), "center offset 0,0.8") +
                   drawing.label("β", drawing.on_arc(kNarrow, 0.85), "center offset 0.4,-0.9") +
                   "N = DIR.'/fig18-angles'\n" + kLabelledPlot +
                   R"(     N.'-rays.csv' using 'x_mm':'y_mm' with lines ls 9 title 'rays from the local centre', \
     N.'-alpha.csv' using 'x_mm':'y_mm' with lines ls 1 lw 2 title 'α, to the contact', \
     N.'-beta.csv' using 'x_mm':'y_mm' with lines ls 3 lw 2 title 'β, to P_3', \
     N.'-line.csv' using 'x_mm':'y_mm' with lines ls 2 title 'tangent line at t = 0.7', \
)" + kLabelledPoints;
  return figure;
}

}  // namespace tangent
