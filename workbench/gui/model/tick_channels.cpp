#include "workbench/gui/model/tick_channels.h"

#include <cmath>
#include <string_view>

namespace tangent {

namespace {

float event_of(const ServoRecord& r) {
  const int rank = event_rank(r);
  return rank > 0 ? static_cast<float>(rank) : std::nanf("");
}

/// The channel of a recording's pyramid. Scale: channel_row's value is it times that.
struct InOverview {
  std::string_view name;
  float scale = 1.0f;
  bool zero_is_gap = false;
};
constexpr std::array<InOverview, kChannelCount> kInOverview{{{"force_x_n"},
                                                             {"force_y_n"},
                                                             {"force_z_n"},
                                                             {"force_n"},
                                                             {"command_force_n"},
                                                             {"command_cld_m"},
                                                             {"device_cld_m"},
                                                             {"error_m"},
                                                             {"iterations"},
                                                             {"tick_ns", 1e-9f, true},
                                                             {"energy_j"},
                                                             {"event_rank", 1.0f, true}}};

}  // namespace

std::array<float, kChannelCount> channel_row(const ServoRecord& r) {
  const Vec3& f = r.tick.output.force_n;
  // Not measured in simulated time: a gap, not a zero.
  const float tick_time = r.tick_ns > 0.0 ? static_cast<float>(r.tick_ns * 1e-9) : std::nanf("");
  return {static_cast<float>(f.x),
          static_cast<float>(f.y),
          static_cast<float>(f.z),
          static_cast<float>(glm::length(f)),
          static_cast<float>(glm::length(r.device.force_command_n)),
          static_cast<float>(r.device.cld_command_m),
          static_cast<float>(r.device.cld_measured_m),
          static_cast<float>(r.tick.output.error_m),
          static_cast<float>(r.tick.output.iterations),
          tick_time,
          static_cast<float>(r.device.energy_j),
          event_of(r)};
}

std::array<float, 2 * kChannelCount> channel_ranges(const OverviewRow& row) {
  static const auto places = [] {
    std::array<std::size_t, kChannelCount> found{};
    for (std::size_t i = 0; i < kChannelCount; ++i) found[i] = overview_channel(kInOverview[i].name);
    return found;
  }();
  std::array<float, 2 * kChannelCount> out;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    float least = static_cast<float>(row.least[places[i]]), most = static_cast<float>(row.most[places[i]]);
    const bool gap = !(least <= most) || (kInOverview[i].zero_is_gap && !(most > 0.0f));
    out[2 * i] = gap ? std::nanf("") : least * kInOverview[i].scale;
    out[2 * i + 1] = gap ? std::nanf("") : most * kInOverview[i].scale;
  }
  return out;
}

}  // namespace tangent
