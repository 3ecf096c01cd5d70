// The plots' channels by key, as a person writes and reads them: name, unit, colour; and what one that is computed from
// others (plots/channel_expression.h) is called, and its unit.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/plots/channel_expression.h"
#include "workbench/gui/theme/palette.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tangent {

/// A channel that is recorded.
struct PlotChannel {
  std::string_view key;         ///< "force_x"
  std::string_view name;        ///< "Force x"
  std::string_view short_name;  ///< "x": beside others of its own plot
  std::string_view unit;        ///< displayed; "": a count
  double scale = 1.0;           ///< displayed = channel value * scale
  const char* format = "%7.3f";
  Rgba Palette::*colour = nullptr;
  std::size_t channel = 0;
  std::optional<std::size_t> ghost = std::nullopt;  ///< of the ticks solved again
  const char* doc = "";
};
std::span<const PlotChannel> plot_channels();
const PlotChannel* find_channel(std::string_view key);

/// One of them, or one computed from them, as text. Fails like parse_channel, and where curves of different units are
/// subtracted or make one magnitude.
struct NamedChannel {
  ChannelExpression of;
  std::string key;   ///< as it is written
  std::string name;  ///< "Force x", "d/dt Force x"
  std::string unit;  ///< "N", "N/s"
  double scale = 1.0;
};
Result<NamedChannel> named_channel(std::string_view text);
/// The same of the ticks solved again; empty: not all of it is there.
std::optional<ChannelExpression> ghost_of(const ChannelExpression& expression);

}  // namespace tangent
