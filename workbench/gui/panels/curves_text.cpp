#include "workbench/gui/panels/curves_text.h"

#include "workbench/gui/widgets/widgets.h"

#include <array>
#include <span>

namespace tangent {

namespace {

/// In the unit that leaves few digits.
std::string in_unit(double value, std::span<const char* const> units, double first) {
  std::size_t k = 0;
  double scaled = value / first;
  for (; k + 1 < units.size() && scaled >= 999.5; ++k) scaled /= 1e3;
  return printed(scaled < 10.0 ? "%.2g %s" : "%.3g %s", scaled, units[k]);
}

std::string interval_text(const char* name, const MedianInterval& t) {
  return printed("\n%s %s (%s to %s)", name, time_in_unit(t.median).c_str(), time_in_unit(t.low).c_str(),
                 time_in_unit(t.high).c_str());
}
std::string times_text(const bench::TickTimes& t) {
  return interval_text("time: median", t.p50_ns) + interval_text("mean", t.mean_ns) + interval_text("99 %", t.p99_ns);
}
std::string errors_text(const Distribution& d) {
  return printed("\nerror: median %s, 99 %% %s, worst %s", length_in_unit(d.p50).c_str(), length_in_unit(d.p99).c_str(),
                 length_in_unit(d.max).c_str());
}

}  // namespace

std::string length_in_unit(double m) {
  constexpr std::array kUnits{"fm", "pm", "nm", "\u00b5m", "mm", "m"};
  return in_unit(m, kUnits, 1e-15);
}
std::string time_in_unit(double ns) {
  constexpr std::array kUnits{"ns", "\u00b5s", "ms", "s"};
  return in_unit(ns, kUnits, 1.0);
}

std::string curve_point_text(const bench::CurvePoint& p) {
  std::string text = printed("%s, tolerance %s, limit %d", to_string(p.setting.method),
                             length_in_unit(p.setting.tolerance_m).c_str(), p.setting.max_iterations);
  if (p.setting.swept == bench::Swept::nothing) text += " (as the preset has it)";
  text += errors_text(p.errors.error_m) + times_text(p.times);
  text += printed("\niterations: mean %.2f, 99 %% %.0f", p.errors.iterations.mean, p.errors.iterations.p99);
  return text + printed("\n%llu of %llu ticks not converged", static_cast<unsigned long long>(p.errors.unconverged),
                        static_cast<unsigned long long>(p.errors.ticks));
}

std::string curve_peer_text(const bench::CurvePeer& p) {
  return p.peer.name + errors_text(*p.error_m) + times_text(p.times) + "\ncomputes: " + p.peer.computes +
         "\nnot: " + p.peer.lacks;
}

}  // namespace tangent
