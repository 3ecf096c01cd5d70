// The figure of a tick of the 2D algorithm.
#include "core/tick/step.h"
#include "workbench/cli/figure_shapes.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/text_format.h"

#include <memory>

namespace tangent {

using namespace drawn;

Figure lines_figure() {
  Figure figure{.name = "iterations-2d",
                .title = "the tangent lines of one tick of the 2D algorithm",
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
  figure.script = std::string(kPicture) + format("R = %g\n", 1e3 * kPaperArcRadius) +
                  R"(set xrange [-0.48*R:0.56*R]
set yrange [R-12:R+50]
N = DIR.'/iterations-2d'
set key outside right top
plot N.'-finger.csv' using 'x_mm':'y_mm' with filledcurves lc rgb '#f3e3d8' notitle, \
     N.'-finger.csv' using 'x_mm':'y_mm' with lines lc rgb '#c9a48e' lw 1 title 'finger', \
     N.'-polygon.csv' using 'x_mm':'y_mm' with lines ls 9 title 'polygon', \
     N.'-curve.csv' using 'x_mm':'y_mm' with lines ls 8 lw 2 title 'smooth curve', \
     N.'-lines.csv' every :::3 using 'x_mm':'y_mm' with lines lc rgb '#d9c2e6' lw 5 title 'later', \
     N.'-lines.csv' every :::0::0 using 'x_mm':'y_mm' with lines ls 2 title 'kept tangent line', \
     N.'-lines.csv' every :::1::1 using 'x_mm':'y_mm' with lines ls 5 title 'iteration 1', \
     N.'-lines.csv' every :::2::2 using 'x_mm':'y_mm' with lines ls 1 title 'iteration 2', \
     N.'.csv' using 'contact_x_mm':'contact_y_mm' with points pt 6 ps 0.9 lc rgb '#222222' \
       title 'contact on the line', \
     N.'.csv' using 'place_x_mm':'place_y_mm' with points pt 7 ps 0.5 lc rgb '#222222' title 'place on the curve'
)";
  return figure;
}

}  // namespace tangent
