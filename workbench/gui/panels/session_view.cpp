#include "workbench/gui/panels/session_view.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tangent {

namespace {

struct SavedLayer {
  const char* name;
  bool SceneToggles::*on;
};
constexpr std::array kSavedLayers{SavedLayer{"facets", &SceneToggles::shaded},
                                  SavedLayer{"edges", &SceneToggles::wireframe},
                                  SavedLayer{"creases", &SceneToggles::creases},
                                  SavedLayer{"vertex_normals", &SceneToggles::vertex_normals},
                                  SavedLayer{"smooth_surface", &SceneToggles::smooth_surface},
                                  SavedLayer{"control_net", &SceneToggles::control_net},
                                  SavedLayer{"control_normals", &SceneToggles::control_normals},
                                  SavedLayer{"neighbours", &SceneToggles::control_net_neighbours},
                                  SavedLayer{"labels", &SceneToggles::control_point_labels},
                                  SavedLayer{"finger", &SceneToggles::finger},
                                  SavedLayer{"penetration", &SceneToggles::penetration},
                                  SavedLayer{"force", &SceneToggles::force},
                                  SavedLayer{"contact", &SceneToggles::contact},
                                  SavedLayer{"tracked_plane", &SceneToggles::tracked_plane},
                                  SavedLayer{"planes", &SceneToggles::planes},
                                  SavedLayer{"trail", &SceneToggles::trail},
                                  SavedLayer{"cld_inset", &SceneToggles::cld_inset},
                                  SavedLayer{"colour_bar", &SceneToggles::colour_bar},
                                  SavedLayer{"axes", &SceneToggles::axes}};

std::string text_of(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

/// Takes values by their names.
class SavedValues {
 public:
  explicit SavedValues(const ViewValues& values) : values_(values) {}
  const std::string* text(const std::string& name) const {
    const auto found = values_.find(name);
    return found != values_.end() ? &found->second : nullptr;
  }
  std::optional<double> number(const std::string& name) const {
    const std::string* given = text(name);
    double value = 0.0;
    if (given == nullptr) return std::nullopt;
    const char* end = given->data() + given->size();
    const auto read = std::from_chars(given->data(), end, value);
    return read.ec == std::errc() && read.ptr == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  std::optional<std::uint64_t> tick(const std::string& name) const {
    const std::optional<double> value = number(name);
    return value && *value >= 0.0 && *value < 1e15 ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
  }
  void take(const std::string& name, bool& on) const {
    if (const std::string* given = text(name)) on = *given == "on";
  }
  void take(const std::string& name, int& value, int most) const {
    if (const auto given = number(name)) value = std::clamp(static_cast<int>(*given), 0, most);
  }

 private:
  const ViewValues& values_;
};

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
  for (const PlotView& plot : plots.plots)
    for (const PlotSeries& series : plot.spec().series) flag(curve_name(plot.spec(), series), series.visible);
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
  for (PlotView& plot : plots.plots)
    for (PlotSeries& series : plot.spec().series) values.take(curve_name(plot.spec(), series), series.visible);
}

void show_time(TimeModel& time, const SavedValues& values) {
  if (const auto tick = values.tick("tick")) time.select_tick(*tick);
  const auto from = values.number("time_from"), to = values.number("time_to");
  if (from && to && *to > *from) time.axis().show(*from, *to);
  if (const auto iteration = values.tick("iteration")) time.tick().select(static_cast<std::size_t>(*iteration));
  values.take("other_slot_beside", time.other_slot_beside);
}

void show_map(MapView& map, const SavedValues& values) {
  const std::string* name = values.text("map");
  map.on = name != nullptr && *name != "none";
  for (std::size_t q = 0; map.on && q < kMapQuantityCount; ++q)
    if (info_of(static_cast<MapQuantity>(q)).key == *name) map.set_quantity(static_cast<MapQuantity>(q));
}

}  // namespace

ViewValues view_values(const AppModel& model, const PlotsPanel& plots) {
  ViewValues out;
  const auto flag = [&out](const std::string& name, bool on) { out[name] = on ? "on" : "off"; };
  const TimeModel& time = model.time();
  if (const ServoRecord* record = time.tick().record()) out["tick"] = std::to_string(record->tick.tick);
  if (time.tick().selected()) out["iteration"] = std::to_string(*time.tick().selected());
  out["time_from"] = text_of(time.axis().from());
  out["time_to"] = text_of(time.axis().to());
  flag("other_slot_beside", time.other_slot_beside);
  const ViewModel& view = model.view();
  out["camera"] = camera_text(view.camera);
  flag("follow_contact", view.follow_contact);
  flag("net_of_picked", view.net_of_picked);
  flag("device_monitor", view.device_monitor);
  if (view.picked_triangle != kNone) out["picked_triangle"] = std::to_string(view.picked_triangle);
  for (const SavedLayer& layer : kSavedLayers) flag(std::string("layer/") + layer.name, view.toggles.*layer.on);
  out["map"] = model.map().on ? std::string(info_of(model.map().quantity).key) : "none";
  put_plots(plots, model.window().plots(), out);
  return out;
}

void show_camera(AppModel& model, const ViewValues& values) {
  const std::string* text = SavedValues(values).text("camera");
  if (const auto camera = text != nullptr ? parse_camera(*text, model.view().camera) : std::nullopt)
    model.view().camera = *camera;
}

void show_view(AppModel& model, PlotsPanel& plots, const ViewValues& given) {
  const SavedValues values(given);
  show_lists(model.window().plots(), given);
  follow_lists(plots, model.window().plots());
  show_plots(plots, values);
  show_time(model.time(), values);
  show_map(model.map(), values);
  ViewModel& view = model.view();
  values.take("follow_contact", view.follow_contact);
  values.take("net_of_picked", view.net_of_picked);
  values.take("device_monitor", view.device_monitor);
  const auto picked = values.tick("picked_triangle");
  const ContactMesh* mesh = model.mesh();
  view.picked_triangle =
      picked && mesh != nullptr && *picked < mesh->triangle_count() ? static_cast<std::uint32_t>(*picked) : kNone;
  for (const SavedLayer& layer : kSavedLayers) values.take(std::string("layer/") + layer.name, view.toggles.*layer.on);
  show_camera(model, given);
}

Status save_session(AppModel& model, const PlotsPanel& plots, const std::filesystem::path& file) {
  Result<SavedSession> session = model.session_to_save(file);
  if (!session) return tl::unexpected(session.error());
  session->view = view_values(model, plots);
  return write_session(*session, file);
}

}  // namespace tangent
