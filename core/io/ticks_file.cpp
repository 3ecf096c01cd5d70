#include "core/io/ticks_file.h"

#include "core/base/text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace tangent {
namespace {

void append_integer(std::string& text, std::int64_t value) {
  std::array<char, 24> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

void append_field(std::string& text, std::int64_t value) {
  append_integer(text, value);
  text += ',';
}

void append_field(std::string& text, double value) {
  append_double(text, value);
  text += ',';
}

void append_field(std::string& text, const Vec3& value) {
  append_field(text, value.x);
  append_field(text, value.y);
  append_field(text, value.z);
}

void append_field(std::string& text, const char* value) {
  text += value;
  text += ',';
}

void append_triangle(std::string& text, std::uint32_t triangle) {
  append_field(text, triangle == kNone ? std::int64_t{-1} : std::int64_t{triangle});
}

void append_finite(std::string& text, double value) {
  if (std::isfinite(value)) append_double(text, value);
  text += ',';
}

void append_finite(std::string& text, const Vec3& value) {
  append_finite(text, value.x);
  append_finite(text, value.y);
  append_finite(text, value.z);
}

/// Column of the first value that is not finite; empty: all are finite.
std::string_view not_finite(const TickRow& row) {
  const TickOutput& o = row.output;
  if (!std::isfinite(row.t_s)) return "t_s";
  if (!std::isfinite(o.u) || !std::isfinite(o.v)) return "u, v";
  if (!is_finite(o.contact)) return "contact_m";
  if (!is_finite(o.normal)) return "normal";
  if (!std::isfinite(o.penetration_m)) return "penetration_m";
  if (!is_finite(o.force_n)) return "force_n";
  if (!std::isfinite(o.cld_m)) return "cld_m";
  if (!is_finite(o.decided_force_n)) return "decided_force_n";
  if (!std::isfinite(o.decided_cld_m)) return "decided_cld_m";
  if (!std::isfinite(o.error_m)) return "error_m";
  if (!std::isfinite(row.solve_ns)) return "solve_ns";
  return {};
}

}  // namespace

Status append_tick_row(std::string& text, const TickRow& row) {
  if (const std::string_view column = not_finite(row); !column.empty()) {
    return fail(std::string(column) + " is not finite", "tick " + std::to_string(row.tick),
                "this is a bug in the solver: please report it with mesh, poses and preset");
  }
  const TickOutput& o = row.output;
  append_field(text, static_cast<std::int64_t>(row.tick));
  append_field(text, row.t_s);
  append_field(text, to_string(o.status));
  append_triangle(text, o.triangle);
  append_field(text, o.u);
  append_field(text, o.v);
  append_field(text, o.contact);
  append_field(text, o.normal);
  append_field(text, o.penetration_m);
  append_field(text, o.force_n);
  append_field(text, o.cld_m);
  append_field(text, o.error_m);
  append_field(text, std::int64_t{o.iterations});
  append_field(text, std::int64_t{o.triangle_changes});
  append_field(text, to_string(o.event));
  append_field(text, row.solve_ns);
  append_field(text, o.decided_force_n);
  append_field(text, o.decided_cld_m);
  text += o.searching ? "1\n" : "0\n";
  return {};
}

void append_iteration_row(std::string& text, std::uint64_t tick, std::size_t iteration, const IterationRecord& r) {
  append_field(text, static_cast<std::int64_t>(tick));
  append_field(text, static_cast<std::int64_t>(iteration));
  append_field(text, std::int64_t{r.seed});
  append_field(text, to_string(r.stop));
  append_field(text, to_string(r.feature));
  append_triangle(text, r.triangle);
  append_finite(text, r.u);
  append_finite(text, r.v);
  append_finite(text, r.point);
  append_finite(text, r.normal);
  append_finite(text, r.contact);
  append_finite(text, r.travel);
  append_finite(text, r.error_m);
  append_finite(text, r.gain);
  append_finite(text, r.curvature_per_m);
  append_finite(text, r.distance_m);
  append_finite(text, r.step_m);
  append_finite(text, r.det_m);
  append_finite(text, r.trace_m);
  text.back() = '\n';
}

Result<TicksFile> TicksFile::create(const std::filesystem::path& path) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  TicksFile ticks(std::move(*file));
  if (Status status = ticks.file_.write(std::string(kTicksHeader) + "\n"); !status) {
    return tl::unexpected(status.error());
  }
  return ticks;
}

Status TicksFile::append(const TickRow& row) {
  line_.clear();
  if (Status status = append_tick_row(line_, row); !status) return status;
  return file_.write(line_);
}

Result<IterationsFile> IterationsFile::create(const std::filesystem::path& path, std::string_view comment) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  IterationsFile iterations(std::move(*file));
  if (Status status = iterations.file_.write(std::string(comment) + std::string(kIterationsHeader) + "\n"); !status) {
    return tl::unexpected(status.error());
  }
  return iterations;
}

Status IterationsFile::append(std::uint64_t tick, const IterationTrace& trace) {
  line_.clear();
  std::size_t iteration = 0;
  for (const IterationRecord& record : trace.view()) append_iteration_row(line_, tick, iteration++, record);
  return file_.write(line_);
}

}  // namespace tangent
