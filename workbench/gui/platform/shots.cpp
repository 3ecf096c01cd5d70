#include "workbench/gui/platform/shots.h"

#include "workbench/gui/platform/scene_shots.h"
#include "workbench/gui/platform/window_shots.h"

#include <algorithm>

namespace tangent {

const std::vector<ShotView>& shot_views() {
  static const std::vector<ShotView> kViews = [] {
    std::vector<ShotView> views = window_shot_views();
    const std::vector<ShotView>& scenes = scene_shot_views();
    views.insert(views.end(), scenes.begin(), scenes.end());
    return views;
  }();
  return kViews;
}

std::string shot_view_names() {
  std::string names;
  for (const ShotView& view : shot_views()) names += (names.empty() ? "" : " ") + view.name;
  return names;
}

namespace {

bool has(const std::vector<ShotView>& views, const std::string& name) {
  return std::any_of(views.begin(), views.end(), [&](const ShotView& v) { return v.name == name; });
}

}  // namespace

bool is_scene_view(const std::string& name) { return has(scene_shot_views(), name); }

Result<Image> take_shot(const ShotRequest& request) {
  if (request.view.empty() || has(window_shot_views(), request.view)) return take_window_shot(request);
  if (is_scene_view(request.view)) return take_scene_shot(request);
  return fail("there is no view \"" + request.view + "\"", "--view", "choose one of: " + shot_view_names());
}

}  // namespace tangent
