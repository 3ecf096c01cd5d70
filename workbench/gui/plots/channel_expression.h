// A channel of the plots, or one computed from others tick by tick, as text: "force_x", "difference(force_x, force_z)",
// "derivative(low_pass(error, 20 Hz))".
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

enum class Derivation : std::uint8_t {
  none,        ///< the channel itself
  difference,  ///< a - b
  derivative,  ///< (a - a of the tick before) / period, per second
  low_pass,    ///< of a: y += (1 - exp(-2 pi cutoff period)) (a - y), from a after a gap on
  magnitude,   ///< sqrt(a^2 + b^2 [+ c^2])
};

struct ChannelExpression {
  Derivation how = Derivation::none;
  std::size_t channel = 0;                 ///< of none
  double cutoff_hz = 0.0;                  ///< of low_pass
  std::vector<ChannelExpression> of = {};  ///< a, b, c
  bool operator==(const ChannelExpression&) const = default;
};

/// By its key; empty: there is none.
using ChannelOfKey = std::function<std::optional<std::size_t>(std::string_view key)>;
/// Fails on what is no channel or operation, on a wrong number of operands, on a cut-off outside 0.01 to 10,000 Hz and
/// below kDeepest operations inside each other.
Result<ChannelExpression> parse_channel(std::string_view text, const ChannelOfKey& channel_of);
inline constexpr int kDeepest = 4;

/// As one writes it: parse_channel gives the same again.
std::string written(const ChannelExpression& expression, const std::function<std::string(std::size_t)>& key_of);

/// The same over other channels; empty where one has none.
std::optional<ChannelExpression> over_channels(ChannelExpression expression,
                                               const std::function<std::optional<std::size_t>(std::size_t)>& other_of);

}  // namespace tangent
