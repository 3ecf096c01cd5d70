#include "workbench/gui/model/preset_origin.h"

#include "core/lab/audit/finger_size.h"
#include "workbench/gui/model/local_time.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {

namespace {

constexpr std::size_t kMostTicks = 60'000;  // a minute at 1 kHz

std::string hex16(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

struct Measured {
  double ticks = 0.0, planes = 0.0, most_planes = 0.0, unconverged = 0.0, largest_error_m = 0.0;

  void add(const TickOutput& tick) {
    if (tick.status == TickStatus::free) return;
    const double tick_planes = tick.iterations;
    ticks += 1.0;
    planes += tick_planes;
    most_planes = std::max(most_planes, tick_planes);
    if (is_converged(tick.status))
      largest_error_m = std::max(largest_error_m, tick.error_m);
    else
      unconverged += 1.0;
  }
};

/// To four digits: more than a run tells, and easy to read.
double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double scale = std::pow(10.0, 3.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

Measured measure(const History& history, std::uint32_t preset_id) {
  Measured measured;
  const std::size_t oldest = history.size() > kMostTicks ? history.size() - kMostTicks : 0;
  for (std::size_t i = history.size(); i > oldest && history[i - 1].tick.preset_id == preset_id; --i)
    measured.add(history[i - 1].tick.output);
  return measured;
}

std::string mm(double m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g mm", m * 1e3);
  return text;
}

}  // namespace

PresetAbout about_of(const PresetOrigin& origin) {
  PresetAbout about;
  about.date = local_time("%Y-%m-%d");
  about.program_version = TANGENT_VERSION;
  about.device = origin.devices;
  about.note = origin.note;
  if (origin.mesh != nullptr) {
    about.mesh_name = origin.mesh->name();
    about.mesh_hash = hex16(origin.mesh->content_hash());
    about.metres_per_unit = origin.metres_per_unit;
    about.longest_side_m = longest_side_m(*origin.mesh);
  }
  if (origin.history == nullptr) return about;
  const Measured measured = measure(*origin.history, origin.preset_id);
  if (measured.ticks == 0.0) return about;
  about.also_measured = {{"source", std::string("the newest ticks in the window")},
                         {"ticks", measured.ticks},
                         {"mean_iterations", rounded(measured.planes / measured.ticks)},
                         {"most_iterations", measured.most_planes},
                         {"unconverged", measured.unconverged},
                         {"max_error_um", rounded(measured.largest_error_m * 1e6)}};
  return about;
}

std::string other_mesh_text(const PresetAbout& about, const ContactMesh& mesh) {
  if (about.mesh_hash.empty() || about.mesh_hash == hex16(mesh.content_hash())) return {};
  const std::string on = about.mesh_name.empty() ? "another mesh" : about.mesh_name;
  const double side = longest_side_m(mesh);
  const bool sizes_differ = about.longest_side_m > 0.0 && std::abs(about.longest_side_m - side) > 0.01 * side;
  if (sizes_differ)
    return "it was saved on " + on + " of " + mm(about.longest_side_m) + ", this is " + mesh.name() + " of " + mm(side);
  return on == mesh.name() ? "it was saved on another state of " + on : "it was saved on " + on;
}

}  // namespace tangent
