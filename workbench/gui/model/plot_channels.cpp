#include "workbench/gui/model/plot_channels.h"

#include "core/base/text.h"
#include "workbench/gui/model/ghost_channels.h"
#include "workbench/gui/model/tick_channels.h"

#include <algorithm>
#include <array>

namespace tangent {
namespace {

constexpr std::size_t place_of(Channel c) { return static_cast<std::size_t>(c); }
constexpr std::size_t place_of(GhostChannel c) { return static_cast<std::size_t>(c); }

constexpr const char* kComputedForce = "Of the computed force";

// clang-format off
constexpr std::array kChannels{
    PlotChannel{"force_computed", "Force computed", "computed", "N", 1.0, "%7.3f", &Palette::force_computed,
                place_of(Channel::force_computed), place_of(GhostChannel::force_computed),
                "By the solver, before the safety gate"},
    PlotChannel{"force_felt", "Force felt", "felt", "N", 1.0, "%7.3f", &Palette::force_magnitude,
                place_of(Channel::force_felt), std::nullopt, "What the safety gate lets through to the device"},
    PlotChannel{"force_x", "Force x", "x", "N", 1.0, "%7.3f", &Palette::force_x, place_of(Channel::force_x),
                place_of(GhostChannel::force_x), kComputedForce},
    PlotChannel{"force_y", "Force y", "y", "N", 1.0, "%7.3f", &Palette::force_y, place_of(Channel::force_y),
                place_of(GhostChannel::force_y), kComputedForce},
    PlotChannel{"force_z", "Force z", "z", "N", 1.0, "%7.3f", &Palette::force_z, place_of(Channel::force_z),
                place_of(GhostChannel::force_z), kComputedForce},
    PlotChannel{"cld_commanded", "Display commanded", "commanded", "mm", 1e3, "%7.3f", &Palette::cld_commanded,
                place_of(Channel::cld_commanded), place_of(GhostChannel::cld)},
    PlotChannel{"cld_measured", "Display measured", "measured", "mm", 1e3, "%7.3f", &Palette::cld_measured,
                place_of(Channel::cld_measured)},
    PlotChannel{"error", "Error", "error", "\u00b5m", 1e6, "%-8.3g", &Palette::error, place_of(Channel::error),
                place_of(GhostChannel::error)},
    PlotChannel{"iterations", "Iterations", "iterations", "", 1.0, "%-4.0f", &Palette::iterations,
                place_of(Channel::iterations), place_of(GhostChannel::iterations)},
    PlotChannel{"tick_time", "Tick time", "tick time", "\u00b5s", 1e6, "%-7.1f", &Palette::tick_time,
                place_of(Channel::tick_time)},
    PlotChannel{"energy", "Energy", "observed", "mJ", 1e3, "%7.3f", &Palette::energy, place_of(Channel::energy)}};
// clang-format on

const PlotChannel& at_place(std::size_t channel) {
  return *std::find_if(kChannels.begin(), kChannels.end(), [&](const PlotChannel& c) { return c.channel == channel; });
}

/// "N" to "N/s", "N/s" to "N/s2", a count to "1/s".
std::string per_second(const std::string& unit) {
  if (unit.empty()) return "1/s";
  if (unit.ends_with("/s")) return unit + "\u00b2";
  if (unit.ends_with("/s\u00b2")) return unit.substr(0, unit.size() - 2) + "\u00b3";
  return unit + "/s";
}

std::string grouped(const NamedChannel& operand) {
  return operand.of.how == Derivation::difference ? "(" + operand.name + ")" : operand.name;
}

Result<NamedChannel> named(const ChannelExpression& expression);

Result<NamedChannel> named_derived(const ChannelExpression& expression) {
  std::vector<NamedChannel> of;
  for (const ChannelExpression& operand : expression.of) {
    Result<NamedChannel> one = named(operand);
    if (!one) return one;
    if (!of.empty() && one->unit != of.front().unit)
      return fail(of.front().name + " and " + one->name + " have different units", {}, "choose curves of one unit");
    of.push_back(std::move(*one));
  }
  NamedChannel out{expression, {}, {}, of.front().unit, of.front().scale};
  switch (expression.how) {
    case Derivation::difference:
      out.name = of[0].name + " \u2212 " + grouped(of[1]);
      break;
    case Derivation::derivative:
      out.name = "d/dt " + grouped(of[0]);
      out.unit = per_second(out.unit);
      break;
    case Derivation::low_pass:
      out.name = grouped(of[0]) + " up to ";
      append_double(out.name, expression.cutoff_hz);
      out.name += " Hz";
      break;
    case Derivation::magnitude:
      for (const NamedChannel& operand : of) out.name += (out.name.empty() ? "|" : ", ") + operand.name;
      out.name += "|";
      break;
    case Derivation::none:
      break;
  }
  return out;
}

Result<NamedChannel> named(const ChannelExpression& expression) {
  if (expression.how != Derivation::none) return named_derived(expression);
  const PlotChannel& channel = at_place(expression.channel);
  return NamedChannel{expression, {}, std::string(channel.name), std::string(channel.unit), channel.scale};
}

}  // namespace

std::span<const PlotChannel> plot_channels() { return kChannels; }

const PlotChannel* find_channel(std::string_view key) {
  const auto found =
      std::find_if(kChannels.begin(), kChannels.end(), [&](const PlotChannel& c) { return c.key == key; });
  return found == kChannels.end() ? nullptr : &*found;
}

Result<NamedChannel> named_channel(std::string_view text) {
  const Result<ChannelExpression> parsed = parse_channel(text, [](std::string_view key) -> std::optional<std::size_t> {
    const PlotChannel* channel = find_channel(key);
    return channel != nullptr ? std::optional(channel->channel) : std::nullopt;
  });
  if (!parsed) return tl::unexpected(parsed.error());
  Result<NamedChannel> out = named(*parsed);
  if (out) out->key = written(*parsed, [](std::size_t channel) { return std::string(at_place(channel).key); });
  return out;
}

std::optional<ChannelExpression> ghost_of(const ChannelExpression& expression) {
  return over_channels(expression, [](std::size_t channel) { return at_place(channel).ghost; });
}

}  // namespace tangent
