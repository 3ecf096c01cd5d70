#include "workbench/cli/bench_plot.h"

#include "core/base/units.h"
#include "core/shading/render.h"
#include "workbench/cli/text_format.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent::bench {
namespace {

constexpr double kPanelWidth = 300, kPanelHeight = 270, kLeft = 74, kGap = 30, kTop = 62, kBottom = 62, kRight = 18;
constexpr double kFloorUm = 1e-9;          // smaller errors are drawn here
constexpr double kMostUnconverged = 0.01;  // points with a larger share are not drawn

struct MethodStyle {
  Method method;
  const char* colour;
  const char* label;
};
constexpr std::array kStyles{MethodStyle{Method::paper, "#D55E00", "paper, best G_k"},
                             MethodStyle{Method::newton, "#0072B2", "newton"},
                             MethodStyle{Method::robust, "#009E73", "robust"},
                             MethodStyle{Method::facet, "#E69F00", "facet"},
                             MethodStyle{Method::force_shading, "#CC79A7", "force shading"},
                             MethodStyle{Method::two_pass, "#56B4E9", "two-pass"}};

const MethodStyle& style_of(Method method) {
  for (const MethodStyle& style : kStyles)
    if (style.method == method) return style;
  return kStyles.back();
}

/// Range of powers of ten that contains all values.
struct Decades {
  int low = 0, high = 1;
  double place(double value) const { return (std::log10(value) - low) / (high - low); }
};

double error_um(const WorkPrecisionPoint& p) { return std::max(kFloorUm, p.error_p99_m / kMicrometre); }
bool drawn(const WorkPrecisionPoint& p) { return p.unconverged_share <= kMostUnconverged && p.mean_ns > 0.0; }

template <class Value>
Decades decades_of(std::span<const WorkPrecisionReport> panels, Value value) {
  double low = 1e300, high = 0.0;
  for (const WorkPrecisionReport& panel : panels)
    for (const WorkPrecisionCurve& curve : panel.curves)
      for (const WorkPrecisionPoint& p : curve.points)
        if (drawn(p)) low = std::min(low, value(p)), high = std::max(high, value(p));
  if (high == 0.0) return {};
  Decades d{static_cast<int>(std::floor(std::log10(low) + 1e-9)), static_cast<int>(std::ceil(std::log10(high) - 1e-9))};
  if (d.high <= d.low) d.high = d.low + 1;
  return d;
}

struct Frame {
  double x, y;
  Decades errors, times;
  double at_x(double um) const { return x + kPanelWidth * errors.place(um); }
  double at_y(double ns) const { return y + kPanelHeight * (1.0 - times.place(ns)); }
};

std::string text_at(double x, double y, const char* anchor, const std::string& content, const char* extra = "") {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>%s</text>\n", x, y, anchor, extra, content.c_str());
}

std::string power(int exponent) { return format("10<tspan dy=\"-5\" font-size=\"9\">%d</tspan>", exponent); }

std::string axes(const Frame& f, const WorkPrecisionReport& panel, bool first) {
  std::string svg;
  const double right = f.x + kPanelWidth, bottom = f.y + kPanelHeight;
  for (int e = f.errors.low; e <= f.errors.high; ++e) {
    const double x = f.at_x(std::pow(10.0, e));
    svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"grid\"/>\n", x, f.y, x, bottom);
    if ((e - f.errors.low) % 3 == 0) svg += text_at(x, bottom + 18, "middle", power(e));
  }
  for (int e = f.times.low; e <= f.times.high; ++e) {
    const double y = f.at_y(std::pow(10.0, e));
    svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"grid\"/>\n", f.x, y, right, y);
    if (first) svg += text_at(f.x - 8, y + 4, "end", power(e));
    for (int k = 2; k < 10 && e < f.times.high; ++k) {
      const double minor = f.at_y(k * std::pow(10.0, e));
      svg += format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" class=\"axis\"/>\n", f.x, minor, f.x + 3.0,
                    minor);
    }
  }
  svg += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" class=\"frame\"/>\n", f.x, f.y, kPanelWidth,
                kPanelHeight);
  svg += text_at(f.x, f.y - 8, "start", format("%s, %u triangles", panel.scene.c_str(), panel.triangles),
                 " class=\"title\"");
  svg += text_at(f.x + 0.5 * kPanelWidth, bottom + 40, "middle", "contact error, 99th percentile (\xC2\xB5m)");
  return svg;
}

/// Markers differ in size, so that all are visible where they coincide.
std::string marker(double x, double y, const MethodStyle& style) {
  if (!is_smooth(style.method)) {
    const double half = style.method == Method::facet ? 6.5 : style.method == Method::force_shading ? 4.5 : 2.5;
    return format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", x - half, y - half,
                  2 * half, 2 * half, style.colour);
  }
  return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", x, y,
                style.method == Method::newton ? 5.2 : 3.2, style.colour);
}

std::string curve_svg(const Frame& f, const WorkPrecisionCurve& curve) {
  const MethodStyle& style = style_of(curve.method);
  std::string line, markers;
  for (const WorkPrecisionPoint& p : curve.points) {
    if (!drawn(p)) continue;
    const double x = f.at_x(error_um(p)), y = f.at_y(p.mean_ns);
    line += format("%.1f,%.1f ", x, y);
    markers += marker(x, y, style);
  }
  return format("<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.8\"/>\n", line.c_str(),
                style.colour) +
         markers;
}

std::string legend() {
  std::string svg;
  double x = kLeft;
  for (const MethodStyle& style : kStyles) {
    svg += marker(x + 4, 21, style) + text_at(x + 14, 25, "start", style.label);
    x += 30.0 + 6.6 * static_cast<double>(std::string(style.label).size());
  }
  return svg;
}

}  // namespace

std::string work_precision_svg(std::span<const WorkPrecisionReport> panels) {
  const auto count = static_cast<double>(panels.size());
  const double width = kLeft + count * kPanelWidth + (count - 1) * kGap + kRight,
               height = kTop + kPanelHeight + kBottom;
  std::string svg = format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
      "font-family=\"Inter, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222\">\n"
      "<style>.grid{stroke:#e4e4e4;stroke-width:1}.axis{stroke:#555;stroke-width:1}"
      ".frame{fill:none;stroke:#555;stroke-width:1}.title{font-weight:600}</style>\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
      width, height, width, height);
  const Decades errors = decades_of(panels, error_um);
  const Decades times = decades_of(panels, [](const WorkPrecisionPoint& p) { return p.mean_ns; });
  svg += legend();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Frame frame{kLeft + static_cast<double>(i) * (kPanelWidth + kGap), kTop, errors, times};
    svg += axes(frame, panels[i], i == 0);
    for (const WorkPrecisionCurve& curve : panels[i].curves) svg += curve_svg(frame, curve);
  }
  const double middle = kTop + 0.5 * kPanelHeight;
  svg += text_at(20, middle, "middle", "time per tick, mean (ns)",
                 format(" transform=\"rotate(-90 20 %.1f)\"", middle).c_str());
  return svg + "</svg>\n";
}

}  // namespace tangent::bench
