#include "workbench/gui/model/plot_lists.h"

#include "workbench/gui/model/plot_channels.h"

#include <algorithm>
#include <optional>

namespace tangent {
namespace {

std::array<PlotLists::Texts, kPlotIds.size()> lists_at_first() {
  return {PlotLists::Texts{"force_computed", "force_felt", "force_x", "force_y", "force_z"},
          PlotLists::Texts{"cld_commanded", "cld_measured"},
          PlotLists::Texts{"error"},
          PlotLists::Texts{"iterations"},
          PlotLists::Texts{"tick_time"},
          PlotLists::Texts{"energy"}};
}

bool has(const PlotLists::Texts& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

std::optional<std::size_t> place_of_plot(std::string_view name) {
  const auto found = std::find(kPlotIds.begin(), kPlotIds.end(), name);
  if (found == kPlotIds.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kPlotIds.begin());
}

tl::unexpected<Error> no_plot(std::string_view name) {
  std::string all;
  for (const std::string_view id : kPlotIds) all += (all.empty() ? "" : ", ") + std::string(id);
  return fail("there is no plot \"" + std::string(name) + "\"", {}, "choose one of: " + all);
}

}  // namespace

PlotLists::PlotLists() : lists_(lists_at_first()) {}

Status PlotLists::make(std::string_view channel) {
  const Result<NamedChannel> named = named_channel(channel);
  if (!named) return tl::unexpected(named.error());
  if (named->of.how == Derivation::none || has(made_, named->key)) return {};
  if (made_.size() >= kMostMade)
    return fail("there are " + std::to_string(kMostMade) + " derived channels", {}, "forget one of them first");
  made_.push_back(named->key);
  ++version_;
  return {};
}

Status PlotLists::add(std::string_view plot, std::string_view channel) {
  const std::optional<std::size_t> place = place_of_plot(plot);
  if (!place) return no_plot(plot);
  const Result<NamedChannel> named = named_channel(channel);
  if (!named) return tl::unexpected(named.error());
  Texts& list = lists_[*place];
  if (has(list, named->key)) return {};
  if (list.size() >= kMostInPlot)
    return fail("the plot has " + std::to_string(kMostInPlot) + " channels", {}, "remove one of them first");
  if (Status made = make(channel); !made) return made;
  list.push_back(named->key);
  ++version_;
  return {};
}

Status PlotLists::remove(std::string_view plot, std::string_view channel) {
  const std::optional<std::size_t> place = place_of_plot(plot);
  if (!place) return no_plot(plot);
  const Result<NamedChannel> named = named_channel(channel);
  if (!named) return tl::unexpected(named.error());
  if (std::erase(lists_[*place], named->key) == 0)
    return fail("it is not in the plot \"" + std::string(plot) + "\"", named->key);
  ++version_;
  return {};
}

Status PlotLists::forget(std::string_view channel) {
  const Result<NamedChannel> named = named_channel(channel);
  if (!named) return tl::unexpected(named.error());
  if (std::erase(made_, named->key) == 0)
    return fail("is no derived channel", named->key, "recorded ones are always there");
  for (Texts& list : lists_) std::erase(list, named->key);
  ++version_;
  return {};
}

void PlotLists::reset() {
  lists_ = lists_at_first();
  ++version_;
}

std::map<std::string, PlotLists::Texts> PlotLists::changed() const {
  std::map<std::string, Texts> out;
  const auto first = lists_at_first();
  for (std::size_t i = 0; i < kPlotIds.size(); ++i)
    if (lists_[i] != first[i]) out.emplace(kPlotIds[i], lists_[i]);
  return out;
}

void PlotLists::take(const std::map<std::string, Texts>& lists, const Texts& made) {
  reset();
  made_.clear();
  for (const std::string& channel : made) static_cast<void>(make(channel));
  for (const auto& [plot, channels] : lists) {
    if (const auto place = place_of_plot(plot)) lists_[*place].clear();
    for (const std::string& channel : channels) static_cast<void>(add(plot, channel));
  }
}

}  // namespace tangent
