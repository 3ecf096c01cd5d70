#include "workbench/cli/tune_report.h"

#include "core/lab/audit/finger_size.h"
#include "workbench/cli/mesh_text.h"
#include "workbench/cli/text_format.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tangent {
namespace {

std::string today() {
  const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day date(days);
  return format("%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
}

/// Rounds a measured number for the preset: means to four decimals, times to the nanosecond.
double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

std::string trial_line(const char* name, const GainTrial& trial) {
  const RunScore& s = trial.score;
  return format("%8s %6.2f %9.5f %8g %12llu %9llu %8.3f %5d %5d\n", name, trial.gains.overall, trial.gains.curvature_m,
                trial.gains.distance_per_m, static_cast<unsigned long long>(s.unconverged),
                static_cast<unsigned long long>(s.reseeded), s.mean_iterations(), s.p99_iterations, s.max_iterations);
}

std::string run_line(const MethodRun& run) {
  const RunScore& s = run.score;
  return format(
      "%-8s mean %.3f  p99 %d  max %d iterations, %llu unconverged, %llu reseeded, error at most %.6g um, "
      "median %.2f us a tick\n",
      to_string(run.method), s.mean_iterations(), s.p99_iterations, s.max_iterations,
      static_cast<unsigned long long>(s.unconverged), static_cast<unsigned long long>(s.reseeded), s.max_error_m * 1e6,
      run.median_ns * 1e-3);
}

std::string ground_lines(const MethodRun& run) {
  std::string text;
  for (const Ground ground : kGrounds) {
    if (run.grounds.share(ground) == 0.0) continue;
    text += format("  %-8s %5.1f %% of the ticks, mean %.3f\n", to_string(ground), 100.0 * run.grounds.share(ground),
                   run.grounds.mean_iterations(ground));
  }
  return text;
}

double as_double(auto n) { return static_cast<double>(n); }

/// Where there is no evidence to hold them.
void add_own_numbers(const TuneReport& report, PresetAbout& about) {
  const RunScore& own = report.own.score;
  about.also_measured.insert(about.also_measured.end(), {{"command", report.command},
                                                         {"ticks", as_double(own.ticks)},
                                                         {"mean_iterations", rounded(own.mean_iterations(), 1e4)},
                                                         {"p99_iterations", as_double(own.p99_iterations)},
                                                         {"max_iterations", as_double(own.max_iterations)},
                                                         {"unconverged_ticks", as_double(own.unconverged)},
                                                         {"reseeded_ticks", as_double(own.reseeded)},
                                                         {"max_error_um", rounded(own.max_error_m * 1e6, 1e9)},
                                                         {"median_solve_ns", rounded(report.own.median_ns, 1.0)}});
}

}  // namespace

void describe_measurement(TuneReport& report) {
  PresetAbout& about = report.preset.about;
  about.date = today();
  about.program_version = TANGENT_VERSION;
  about.mesh_name = report.mesh->name();
  about.mesh_hash = hash_text(report.mesh->content_hash());
  about.device = "none";
  about.note = report.tuning.stopped ? "Gains of the paper's iteration, the best of an interrupted tuning."
                                     : "Gains of the paper's iteration, tuned by measuring.";
  about.also_measured = {{"poses", report.poses}};
  if (!about.measured) add_own_numbers(report, about);
  for (const Ground ground : kGrounds) {
    if (report.own.grounds.share(ground) == 0.0) continue;
    const std::string name = to_string(ground);
    about.also_measured.emplace_back(name + "_ground_share", rounded(report.own.grounds.share(ground), 1e4));
    about.also_measured.emplace_back(name + "_ground_mean_iterations",
                                     rounded(report.own.grounds.mean_iterations(ground), 1e4));
  }
  for (const MethodRun& run : report.others) {
    const std::string name = to_string(run.method);
    about.also_measured.insert(about.also_measured.end(),
                               {{name + "_mean_iterations", rounded(run.score.mean_iterations(), 1e4)},
                                {name + "_p99_iterations", as_double(run.score.p99_iterations)},
                                {name + "_unconverged_ticks", as_double(run.score.unconverged)},
                                {name + "_median_solve_ns", rounded(run.median_ns, 1.0)}});
  }
  if (report.tuning.untuned.score.ticks == 0) return;
  about.also_measured.insert(about.also_measured.end(),
                             {{"untuned_mean_iterations", rounded(report.tuning.untuned.score.mean_iterations(), 1e4)},
                              {"untuned_unconverged_ticks", as_double(report.tuning.untuned.score.unconverged)}});
}

std::string tune_text(const TuneReport& report) {
  const GainTuning& tuning = report.tuning;
  std::string text = format("%s (%u triangles): %zu gains tried on %llu ticks, %s\n", report.mesh->name().c_str(),
                            report.mesh->usable_triangle_count(), tuning.tried,
                            static_cast<unsigned long long>(report.own.score.ticks), report.poses.c_str());
  text += "              G_o     G_k m  G_d 1/m  unconverged  reseeded     mean   p99   max\n";
  for (std::size_t i = 0; i < tuning.best.size(); ++i)
    text += trial_line(std::to_string(i + 1).c_str(), tuning.best[i]);
  if (tuning.untuned.score.ticks != 0) text += trial_line("untuned", tuning.untuned);
  text += run_line(report.own) + ground_lines(report.own);
  for (const MethodRun& run : report.others) text += run_line(run);
  if (const auto left = tuning.best.front().score.unconverged; left != 0)
    text += format("note: %llu ticks of the paper's iteration did not converge with any gains tried\n",
                   static_cast<unsigned long long>(left));
  if (const std::string note = finger_size_note(longest_side_m(*report.mesh), report.preset.preset.finger);
      !note.empty())
    text += "note: " + note + "\n";
  return text;
}

}  // namespace tangent
