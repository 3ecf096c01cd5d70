#include "workbench/gui/panels/session_view.h"

#include "workbench/gui/panels/session_scene.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>

namespace tangent {

namespace {

std::string curve_name(const PlotSpec& plot, const PlotSeries& series) {
  return "curve/" + plot.id + "/" + series.name;
}

/// Between the channels of a list, in none of which it can be.
constexpr std::string_view kBetween = "; ";
constexpr std::string_view kListOf = "plots/list/";

std::string joined(const PlotLists::Texts& channels) {
  std::string out;
  for (const std::string& channel : channels) out += (out.empty() ? "" : std::string(kBetween)) + channel;
  return out;
}

PlotLists::Texts parted(std::string_view text) {
  PlotLists::Texts out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(kBetween), text.size());
    out.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + kBetween.size(), text.size()));
  }
  return out;
}

void put_plots(const PlotsPanel& plots, const PlotLists& lists, ViewValues& out) {
  const auto flag = [&out](const std::string& name, bool on) { out[name] = on ? "on" : "off"; };
  if (plots.link.a) out["cursor_a"] = std::to_string(*plots.link.a);
  if (plots.link.b) out["cursor_b"] = std::to_string(*plots.link.b);
  out["plots/mode"] = std::to_string(static_cast<int>(plots.mode));
  flag("plots/values", plots.values);
  flag("plots/legend", plots.legend);
  flag("plots/channels", plots.channels.open);
  out["plots/x"] = plots.x;
  out["plots/y"] = plots.y;
  for (const auto& [plot, channels] : lists.changed()) out[std::string(kListOf) + plot] = joined(channels);
  out["plots/made"] = joined(lists.made());
  for (const PlotView& plot : plots.plots) {
    for (const PlotSeries& series : plot.spec().series) flag(curve_name(plot.spec(), series), series.visible);
    const ValueAxis& axis = plot.values();
    if (!axis.fitted()) continue;  // not drawn yet
    out["axis/" + plot.spec().id] =
        text_of_numbers({axis.low(), axis.high()}) + (axis.automatic() ? " automatic" : " by hand");
  }
}

/// The lists of channels, as they were saved; where there are none, as at first.
void show_lists(PlotLists& lists, const ViewValues& given) {
  std::map<std::string, PlotLists::Texts> changed;
  for (const auto& [name, value] : given)
    if (name.starts_with(kListOf)) changed[name.substr(kListOf.size())] = parted(value);
  const auto made = given.find("plots/made");
  lists.reset();
  lists.take(changed, made != given.end() ? parted(made->second) : PlotLists::Texts{});
}

void show_plots(PlotsPanel& plots, const SavedValues& values) {
  plots.link.a = values.tick("cursor_a");
  plots.link.b = values.tick("cursor_b");
  int mode = static_cast<int>(plots.mode);
  values.take("plots/mode", mode, static_cast<int>(PlotsMode::histogram));
  plots.mode = static_cast<PlotsMode>(mode);
  values.take("plots/values", plots.values);
  values.take("plots/legend", plots.legend);
  values.take("plots/channels", plots.channels.open);
  if (const std::string* x = values.text("plots/x")) plots.x = *x;
  if (const std::string* y = values.text("plots/y")) plots.y = *y;
  for (PlotView& plot : plots.plots) {
    for (PlotSeries& series : plot.spec().series) values.take(curve_name(plot.spec(), series), series.visible);
    const std::string name = "axis/" + plot.spec().id;
    if (const auto ends = values.numbers(name, 2))
      plot.values().take_up((*ends)[0], (*ends)[1], values.text(name)->ends_with(" automatic"));
  }
}

void show_time(TimeModel& time, const SavedValues& values) {
  if (const auto tick = values.tick("tick")) time.select_tick(*tick);
  const auto from = values.number("time_from"), to = values.number("time_to");
  if (from && to && *to > *from) time.axis().show(*from, *to);
  if (const auto iteration = values.tick("iteration")) time.tick().select(static_cast<std::size_t>(*iteration));
  values.take("other_slot_beside", time.other_slot_beside);
}

struct SavedScroll {
  const char* name;
  const char* window;  ///< of ImGui
};
constexpr std::array kSavedScrolls{SavedScroll{"scroll/left", "##left"}, SavedScroll{"scroll/right", "##right"}};

}  // namespace

void show_scroll(const ViewValues& given) {
  for (const SavedScroll& saved : kSavedScrolls) {
    ImGuiWindow* window = ImGui::FindWindowByName(saved.window);
    const auto at = SavedValues(given).number(saved.name);
    if (window != nullptr && at) ImGui::SetScrollY(window, static_cast<float>(std::clamp(*at, 0.0, 1e6)));
  }
}

ViewValues view_values(const AppModel& model, const PlotsPanel& plots) {
  ViewValues out;
  const auto flag = [&out](const std::string& name, bool on) { out[name] = on ? "on" : "off"; };
  const TimeModel& time = model.time();
  if (const ServoRecord* record = time.tick().record()) out["tick"] = std::to_string(record->tick.tick);
  if (time.tick().selected()) out["iteration"] = std::to_string(*time.tick().selected());
  out["time_from"] = text_of_number(time.axis().from());
  out["time_to"] = text_of_number(time.axis().to());
  flag("other_slot_beside", time.other_slot_beside);
  for (const SavedScroll& saved : kSavedScrolls)
    if (const ImGuiWindow* window = ImGui::FindWindowByName(saved.window))
      out[saved.name] = text_of_number(static_cast<double>(window->Scroll.y));
  put_scene_view(model, out);
  put_plots(plots, model.window().plots(), out);
  return out;
}

void show_view(AppModel& model, PlotsPanel& plots, const ViewValues& given) {
  const SavedValues values(given);
  show_lists(model.window().plots(), given);
  follow_lists(plots, model.window().plots());
  show_plots(plots, values);
  show_time(model.time(), values);
  model.see_mesh_of_tick();
  show_scene_view(model, values);
  show_camera(model, given);
}

Status save_session(AppModel& model, const PlotsPanel& plots, const std::filesystem::path& file) {
  Result<SavedSession> session = model.session_to_save(file);
  if (!session) return tl::unexpected(session.error());
  session->view = view_values(model, plots);
  return write_session(*session, file);
}

}  // namespace tangent
