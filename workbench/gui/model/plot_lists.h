// Which channels each plot shows, and the derived ones that were made: changed by the window and by commands, kept
// between runs. Channels as text (plot_channels.h), each once in a plot.
#pragma once

#include "core/base/result.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// The plots by the names that commands and the item map have for them.
inline constexpr std::array<std::string_view, 6> kPlotIds{"force", "cld", "error", "iterations", "tick_time", "energy"};

class PlotLists {
 public:
  static constexpr std::size_t kMostInPlot = 12, kMostMade = 24;
  using Texts = std::vector<std::string>;

  PlotLists();

  const Texts& of(std::size_t plot) const { return lists_[plot]; }  ///< by its place in kPlotIds
  const Texts& made() const { return made_; }                       ///< derived channels, in a plot or not
  /// Increases with every change.
  std::uint64_t version() const { return version_; }

  /// At the end of the plot. One that is there stays where it is. A derived one is then among made(). Fails on an
  /// unknown plot, on what is no channel, and in a plot that has kMostInPlot.
  Status add(std::string_view plot, std::string_view channel);
  Status remove(std::string_view plot, std::string_view channel);
  /// A derived channel to choose from. Fails like add.
  Status make(std::string_view channel);
  /// Out of made() and out of every plot.
  Status forget(std::string_view channel);
  /// Every plot as it was at first; derived channels stay to choose from.
  void reset();

  /// Plots that are not as at first, by name.
  std::map<std::string, Texts> changed() const;
  /// As changed() and made() were; what is no plot or no channel is left out.
  void take(const std::map<std::string, Texts>& lists, const Texts& made);

 private:
  std::array<Texts, kPlotIds.size()> lists_;
  Texts made_;
  std::uint64_t version_ = 1;
};

}  // namespace tangent
