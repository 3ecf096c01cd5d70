// ticks.csv: one line per tick; and a second file with every tangent plane of every tick. The columns are documented
// and stable (workbench/README.md, "Files"). Numbers are printed so that a double reads back exactly; NaN is never
// written.
#pragma once

#include "core/io/atomic_file.h"
#include "core/tick/step.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace tangent {

inline constexpr std::string_view kTicksHeader =
    "tick,t_s,status,triangle,u,v,contact_x_m,contact_y_m,contact_z_m,normal_x,normal_y,normal_z,penetration_m,"
    "force_x_n,force_y_n,force_z_n,cld_m,error_m,iterations,triangle_changes,event,solve_ns,"
    "decided_force_x_n,decided_force_y_n,decided_force_z_n,decided_cld_m,searching";

inline constexpr std::string_view kIterationsHeader =
    "tick,iteration,seed,stop,feature,triangle,u,v,point_x_m,point_y_m,point_z_m,normal_x,normal_y,normal_z,"
    "contact_x_m,contact_y_m,contact_z_m,travel_x_m,travel_y_m,travel_z_m,error_m,gain,curvature_per_m,distance_m,"
    "step_m,det_m,trace_m";

struct TickRow {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  TickOutput output;
  double solve_ns = 0.0;  ///< wall-clock time of the step
};

/// Appends one line with its line end. A triangle of kNone (nothing tracked) prints as -1. Fails on a value that is not
/// finite, naming tick and column: that would be an error of the solver, not of the data.
Status append_tick_row(std::string& text, const TickRow& row);

/// Appends one line with its line end. `iteration` counts from 0, the kept plane. A quantity that is not finite
/// (curvature on a singular patch) is written as an empty field.
void append_iteration_row(std::string& text, std::uint64_t tick, std::size_t iteration, const IterationRecord& record);

/// Writes ticks.csv; the file appears under its name with commit().
class TicksFile {
 public:
  static Result<TicksFile> create(const std::filesystem::path& path);
  Status append(const TickRow& row);
  Status commit() { return file_.commit(); }

 private:
  explicit TicksFile(AtomicFile file) : file_(std::move(file)) {}
  AtomicFile file_;
  std::string line_;
};

/// Writes the trace of traced ticks; the file appears under its name with commit().
class IterationsFile {
 public:
  /// `comment`: whole lines before the header.
  static Result<IterationsFile> create(const std::filesystem::path& path, std::string_view comment = {});
  Status append(std::uint64_t tick, const IterationTrace& trace);
  Status commit() { return file_.commit(); }

 private:
  explicit IterationsFile(AtomicFile file) : file_(std::move(file)) {}
  AtomicFile file_;
  std::string line_;
};

}  // namespace tangent
