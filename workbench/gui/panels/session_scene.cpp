#include "workbench/gui/panels/session_scene.h"

#include "workbench/gui/model/app_model.h"

#include <algorithm>
#include <array>
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

void put_map(const MapView& map, ViewValues& out) {
  out["map"] = map.on ? std::string(info_of(map.quantity).key) : "none";
  if (!map.on) return;
  out["map/logarithmic"] = map.logarithmic() ? "on" : "off";
  if (!map.automatic_range()) out["map/range"] = text_of_numbers({map.low(), map.high()});
  out["map/moves"] =
      text_of_numbers({static_cast<double>(map.options.directions), map.options.press_m, map.options.move_m});
}

void show_map(MapView& map, const SavedValues& values) {
  const std::string* name = values.text("map");
  map.on = name != nullptr && *name != "none";
  for (std::size_t q = 0; map.on && q < kMapQuantityCount; ++q)
    if (info_of(static_cast<MapQuantity>(q)).key == *name) map.set_quantity(static_cast<MapQuantity>(q));
  bool logarithmic = map.logarithmic();
  values.take("map/logarithmic", logarithmic);
  map.set_logarithmic(logarithmic);
  map.set_automatic_range();
  if (const auto range = values.numbers("map/range", 2)) map.set_range((*range)[0], (*range)[1]);
  if (const auto moves = values.numbers("map/moves", 3)) {
    map.options.directions = static_cast<unsigned>(std::clamp((*moves)[0], 1.0, 32.0));
    map.options.press_m = std::clamp((*moves)[1], 0.0, 0.02);
    map.options.move_m = std::clamp((*moves)[2], 1e-7, 0.01);
  }
}

void put_triangles(const ViewModel& view, ViewValues& out) {
  if (view.picked_triangle != kNone) out["picked_triangle"] = std::to_string(view.picked_triangle);
  if (!view.inspection().marked.empty()) {
    std::vector<std::uint32_t> marked = view.inspection().marked;
    std::sort(marked.begin(), marked.end());
    out["marked"] = text_of_ranges(marked);
  }
  if (view.isolation == nullptr) return;
  std::vector<std::uint32_t> isolated;
  for (std::size_t t = 0; t < view.isolation->kept.size(); ++t)
    if (view.isolation->kept[t] != 0) isolated.push_back(static_cast<std::uint32_t>(t));
  out["isolated"] = text_of_ranges(isolated);
}

void show_triangles(ViewModel& view, const ContactMesh* mesh, const SavedValues& values) {
  const std::uint32_t count = mesh != nullptr ? mesh->triangle_count() : 0;
  view.take_up(values.ranges("isolated", count), values.ranges("marked", count));
  const auto picked = values.tick("picked_triangle");
  view.picked_triangle = picked && *picked < count ? static_cast<std::uint32_t>(*picked) : kNone;
}

void show_slice(ViewModel& view, const SavedValues& values) {
  view.slice.reset();
  const auto plane = values.numbers("slice", 4);
  if (!plane) return;
  const Vec3 normal((*plane)[0], (*plane)[1], (*plane)[2]);
  if (std::abs(glm::length(normal) - 1.0) < 1e-6) view.slice = SlicePlane{normal, (*plane)[3]};
}

}  // namespace

void put_scene_view(const AppModel& model, ViewValues& out) {
  const auto flag = [&out](const std::string& name, bool on) { out[name] = on ? "on" : "off"; };
  const ViewModel& view = model.view();
  out["camera"] = camera_text(view.camera);
  flag("follow_contact", view.follow_contact);
  flag("net_of_picked", view.net_of_picked);
  flag("device_monitor", view.device_monitor);
  for (const SavedLayer& layer : kSavedLayers) flag(std::string("layer/") + layer.name, view.toggles.*layer.on);
  if (const auto& slice = view.slice)
    out["slice"] = text_of_numbers({slice->normal.x, slice->normal.y, slice->normal.z, slice->offset_m});
  put_triangles(view, out);
  put_map(model.map(), out);
}

void show_scene_view(AppModel& model, const SavedValues& values) {
  show_map(model.map(), values);
  ViewModel& view = model.view();
  values.take("follow_contact", view.follow_contact);
  values.take("net_of_picked", view.net_of_picked);
  values.take("device_monitor", view.device_monitor);
  for (const SavedLayer& layer : kSavedLayers) values.take(std::string("layer/") + layer.name, view.toggles.*layer.on);
  show_slice(view, values);
  show_triangles(view, model.mesh(), values);
}

void show_camera(AppModel& model, const ViewValues& values) {
  const std::string* text = SavedValues(values).text("camera");
  if (const auto camera = text != nullptr ? parse_camera(*text, model.view().camera) : std::nullopt)
    model.view().camera = *camera;
}

}  // namespace tangent
