#include "workbench/gui/panels/iteration_columns.h"

#include "workbench/gui/widgets/widgets.h"

#include <cmath>
#include <limits>

namespace tangent {

namespace {

constexpr std::array<IterationColumnInfo, kIterationColumnCount> kInfo{{
    {"#", "", 4.5f, "Order of the tangent planes; 0 is the plane kept from the last tick"},
    {"error", "\u00b5m", 8, "Distance between the surface point and the finger's contact on the plane there"},
    {"ratio", "", 5.5f, "Error over that of the plane before, as measured: below 1 it shrinks; empty at a new seed"},
    {"step", "\u00b5m", 7, "Length of the step on the base triangle that followed"},
    {"gain", "", 5.5f, "Gain of Eq. 1 for that step; 0 where none was taken"},
    {"triangle", "", 7,
     "Triangle the plane touches, in file order; in a 2D scene the vertex whose patch the line touches"},
    {"stop", "", 15, "Why the iteration ended here"},
    {"u", "", 6, "Weight of the triangle's second corner"},
    {"v", "", 6, "Weight of the triangle's third corner"},
    {"w", "", 6, "Weight of the triangle's first corner"},
    {"curvature", "1/m", 9, "|dN/ds| along the step (Eq. 2)"},
    {"d", "mm", 7, "Distance d of Eq. 1"},
    {"seed", "", 4, "0: tracking from the kept plane; n: the n-th seed after tracking was lost"},
}};

std::string ratio_text(double ratio) {
  if (!std::isfinite(ratio)) return {};
  return ratio < 1e-3 || ratio >= 1e3 ? printed("%.0e", ratio) : printed("%.3f", ratio);
}

}  // namespace

const IterationColumnInfo& info_of(IterationColumn column) { return kInfo[static_cast<std::size_t>(column)]; }

double error_ratio(std::span<const IterationRecord> iterations, std::size_t i) {
  if (i == 0 || i >= iterations.size() || iterations[i].seed != iterations[i - 1].seed ||
      !(iterations[i - 1].error_m > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  return iterations[i].error_m / iterations[i - 1].error_m;
}

std::string last_stop(std::span<const IterationRecord> iterations) {
  return iterations.empty() ? "-" : to_string(iterations.back().stop);
}

std::string iteration_cell(std::span<const IterationRecord> iterations, std::size_t i, IterationColumn column) {
  if (i >= iterations.size()) return {};
  const IterationRecord& r = iterations[i];
  switch (column) {
    case IterationColumn::number:
      return printed("%zu", i);
    case IterationColumn::error:
      return r.error_m < 1e-3 ? printed("%.4f", r.error_m * 1e6) : printed("%.2e", r.error_m * 1e6);
    case IterationColumn::ratio:
      return ratio_text(error_ratio(iterations, i));
    case IterationColumn::step:
      return printed("%.2f", r.step_m * 1e6);
    case IterationColumn::gain:
      return printed("%.3f", r.gain);
    case IterationColumn::triangle:
      return r.triangle == kNone ? std::string("-") : printed("%u", r.triangle);
    case IterationColumn::stop:
      return r.stop == StopReason::going_on ? std::string() : std::string(to_string(r.stop));
    case IterationColumn::u:
      return printed("%.4f", r.u);
    case IterationColumn::v:
      return printed("%.4f", r.v);
    case IterationColumn::w:
      return printed("%.4f", 1.0 - r.u - r.v);
    case IterationColumn::curvature:
      return printed("%.2f", r.curvature_per_m);
    case IterationColumn::distance:
      return printed("%.4f", r.distance_m * 1e3);
    case IterationColumn::seed:
      return printed("%d", static_cast<int>(r.seed));
    default:
      return {};
  }
}

}  // namespace tangent
