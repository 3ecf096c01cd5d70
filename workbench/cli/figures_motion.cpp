// Figures of a finger that moves over the paper's arc.
#include "core/io/rendering_condition.h"
#include "core/lab/measure/perception_thresholds.h"
#include "core/tick/step.h"
#include "workbench/cli/figures.h"
#include "workbench/cli/text_format.h"

#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr double kRadius = 0.020, kPress = 1e-3;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kSteps = 2000;

/// No display travel limit, so that the whole path of the contact is visible.
Preset figure_preset() {
  Preset preset;
  preset.finger.radius_m = kRadius;
  preset.display.finger_arc_m = preset.display.travel_m = 0.2;
  return preset;
}

struct Sample {
  double travel_m, angle_rad;  ///< along the arc, from its middle
  TickOutput output;
};

/// The upright finger slides over the arc at constant depth below the true circle.
std::vector<Sample> slide(const PlanarCurve& curve, const Preset& preset) {
  std::vector<Sample> samples;
  TickState state;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = kPaperArcRad * (static_cast<double>(i) / kSteps - 0.5),
                 distance = kPaperArcRadius + kRadius - kPress;
    const TickInput input{1e-3 * i, {{distance * std::sin(a), distance * std::cos(a), 0.0}, Quat(1.0, 0.0, 0.0, 0.0)}};
    samples.push_back({kPaperArcRadius * a, a, step_planar(curve, preset, input, state, nullptr)});
  }
  return samples;
}

/// Ranges of the arc's pictures, mm: X of the travel, Y of the contact on the finger. They follow the arc's radius.
std::string arc_ranges() {
  const auto round_up = [](double value, double step) { return step * std::ceil(value / step); };
  const double half = 0.5 * kPaperArcRad;
  return format("X = %g\nY = %g\nset xrange [-X:X]\n", round_up(1.05e3 * half * kPaperArcRadius, 5.0),
                round_up(1.2e3 * half * kRadius, 2.0));
}

/// Angle of a force from upright, positive to the right.
double direction_deg(const Vec3& force) { return force == Vec3(0.0) ? kNaN : std::atan2(force.x, force.y) / kDegree; }

}  // namespace

int threshold_segments(std::string_view condition) {
  if (condition == "C1") return 104;
  if (condition == "C2" || condition == "C4") return 16;
  if (condition == "C3" || condition == "P2") return 257;
  return 5;  // P1: facets of 14.8 degrees are 4.5 segments
}

Figure contact_location_figure() {
  Figure figure{.name = "fig04-contact-location",
                .title = "contact location on the finger over a smooth curve, two and three facets"};
  FigureTable table{{"finger_travel_mm", "smooth_curve_mm", "two_facets_mm", "three_facets_mm"}, {}};
  Preset facet = figure_preset();
  facet.solver.method = Method::facet;
  // The facets' own arc is as long as the curve's: tangent to it at their midpoints.
  const auto two = slide(curve_of(make_paper_arc(2, ArcPlacement::tangent, 1)), facet);
  const auto three = slide(curve_of(make_paper_arc(3, ArcPlacement::tangent, 1)), facet);
  for (std::size_t i = 0; i < two.size(); ++i)
    table.rows.push_back({1e3 * two[i].travel_m, -1e3 * kRadius * two[i].angle_rad, 1e3 * two[i].output.cld_m,
                          1e3 * three[i].output.cld_m});
  figure.data.push_back({"", std::move(table)});
  figure.script = arc_ranges() + R"(set xlabel 'finger travel along the arc (mm)'
set ylabel 'contact location on the finger (mm, distal positive)'
set key right top
F = DIR.'/fig04-contact-location.csv'
plot F using 'finger_travel_mm':'smooth_curve_mm' with lines ls 8 title 'smooth curve (circle)', \
     F using 'finger_travel_mm':'two_facets_mm' with lines ls 2 title 'two facets', \
     F using 'finger_travel_mm':'three_facets_mm' with lines ls 1 title 'three facets'
)";
  return figure;
}

/// The segments of a condition's arc: as many as its threshold, or five.
int segments_of(const RenderingCondition& condition, bool at_threshold) {
  return at_threshold ? threshold_segments(condition.name) : 5;
}

/// Two columns a condition, force direction and contact location, along the same travel.
FigureTable conditions_table(bool at_threshold) {
  FigureTable table{{"travel_mm", "circle_deg", "circle_mm"}, {}};
  std::vector<std::vector<Sample>> runs;
  for (const RenderingCondition& condition : arc_conditions()) {
    Preset preset = figure_preset();
    set_condition(preset, condition);
    runs.push_back(slide(curve_of(make_paper_arc(segments_of(condition, at_threshold))), preset));
    const std::string name(condition.name);
    table.columns.push_back(name + "_force_deg");
    table.columns.push_back(name + "_contact_mm");
  }
  for (std::size_t i = 0; i < runs.front().size(); ++i) {
    const double a = runs.front()[i].angle_rad;
    std::vector<double> row{1e3 * runs.front()[i].travel_m, a / kDegree, -1e3 * kRadius * a};
    for (const auto& run : runs) {
      row.push_back(direction_deg(run[i].output.force_n));
      row.push_back(1e3 * run[i].output.cld_m);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// gnuplot's arrays C, the names of the conditions, and T, the titles of their pictures.
std::string condition_arrays(bool at_threshold) {
  std::string names, titles;
  for (const RenderingCondition& condition : arc_conditions()) {
    const std::string name(condition.name), comma(names.empty() ? "" : ", ");
    names += comma + "'" + name + "'";
    titles += comma + format("'%s, %d segments'", name.c_str(), segments_of(condition, at_threshold));
  }
  const std::string count = "[" + std::to_string(kArcConditions) + "]";
  return "array C" + count + " = [" + names + "]\narray T" + count + " = [" + titles + "]\n";
}

// Six pictures side by side: force direction above, contact location below, the circle's own in grey.
constexpr const char* kConditionsScript = R"(set multiplot
set key off
set xtics 20
L = 0.062; W = 0.150; G = 0.0055
do for [i=1:6] {
  set lmargin at screen L+(i-1)*(W+G)
  set rmargin at screen L+(i-1)*(W+G)+W
  set tmargin at screen 0.93
  set bmargin at screen 0.55
  set yrange [-30:30]
  set ytics -30,15,30
  set format x ''
  unset xlabel
  if (i==1) { set ylabel 'force direction (deg)' offset 1,0; set format y '%g' } else { unset ylabel; set format y '' }
  set title T[i] font ',13' offset 0,-0.6
  plot F using 'travel_mm':'circle_deg' with lines ls 9, \
       F using 'travel_mm':(column(C[i].'_force_deg')) with lines ls 2
  set tmargin at screen 0.50
  set bmargin at screen 0.12
  set yrange [-Y:Y]
  set ytics Y/2
  set format x '%g'
  set xlabel 'travel (mm)'
  if (i==1) { set ylabel 'contact location (mm)' offset 1,0; set format y '%g' } else { unset ylabel; set format y '' }
  unset title
  plot F using 'travel_mm':'circle_mm' with lines ls 9, \
       F using 'travel_mm':(column(C[i].'_contact_mm')) with lines ls 1
}
unset multiplot
)";

Figure conditions_figure(bool at_threshold) {
  Figure figure{
      .name = at_threshold ? "conditions-at-threshold" : "conditions-five-segments",
      .title = at_threshold
                   ? "force direction and contact location of the six conditions, each at its threshold's segment count"
                   : "the same at five segments, where every condition can be told apart",
      .width_px = 1180,
      .height_px = 560};
  figure.data.push_back({"", conditions_table(at_threshold)});
  figure.script =
      "F = DIR.'/" + figure.name + ".csv'\n" + arc_ranges() + condition_arrays(at_threshold) + kConditionsScript;
  return figure;
}

Figure curvature_figure() {
  Figure figure{.name = "curvature-deviation",
                .title = "curvature of the rendered curve against the circle's, five segments; with the table"};
  FigureTable curve_table{{"t", "tangent_percent", "inscribed_percent"}, {}};
  const PlanarCurve tangent_arc = curve_of(make_paper_arc(5)),
                    inscribed = curve_of(make_paper_arc(5, ArcPlacement::inscribed));
  const auto percent = [](const PlanarCurve& curve, std::uint32_t patch, double t) {
    return 100.0 * (rendered_curvature(curve.sample(patch, LocalCentre::bisectors, t)) * kPaperArcRadius - 1.0);
  };
  for (int i = 0; i <= 300; ++i) {
    const double t = i / 100.0;
    const auto patch = static_cast<std::uint32_t>(std::min(2.0, t));
    curve_table.rows.push_back(
        {t, percent(tangent_arc, 2 + patch, t - patch), percent(inscribed, 2 + patch, t - patch)});
  }
  FigureTable table{{"segments", "placement_tangent", "centre_bisectors", "rms_percent", "largest_percent"}, {}};
  for (const DeviationRow& row : deviation_rows())
    table.rows.push_back({static_cast<double>(row.segments), row.placement == ArcPlacement::tangent ? 1.0 : 0.0,
                          row.centre == LocalCentre::bisectors ? 1.0 : 0.0, 100.0 * row.deviation.rms,
                          100.0 * row.deviation.largest});
  figure.data.push_back({"", std::move(curve_table)});
  figure.data.push_back({"-table", std::move(table)});
  figure.script = R"(set xlabel 'parameter t, over three patches'
set ylabel 'curvature less the circle''s (%)'
set yrange [-1:1.2]
set key right top
set arrow from graph 0, first 0 to graph 1, first 0 nohead ls 9
F = DIR.'/curvature-deviation.csv'
plot F using 't':'tangent_percent' with lines ls 1 title 'facets tangent to the circle', \
     F using 't':'inscribed_percent' with lines ls 2 title 'vertices on the circle'
)";
  return figure;
}

std::vector<DeviationRow> deviation_rows() {
  std::vector<DeviationRow> rows;
  for (const ArcPlacement placement : {ArcPlacement::tangent, ArcPlacement::inscribed})
    for (const LocalCentre centre : {LocalCentre::bisectors, LocalCentre::midpoint})
      for (const int segments : {3, 5, 9, 16})
        rows.push_back({segments, placement, centre, curvature_deviation(segments, placement, centre)});
  return rows;
}

}  // namespace tangent
