// Commands of the view: camera, layers, slice, inspection.
#include "core/base/units.h"
#include "core/io/csv_table.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/wish.h"
#include "workbench/gui/render/camera_text.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

void add_camera(CommandList& out, AppModel& model) {
  ViewModel& view = model.view();
  out.plain({"frame", "View: frame the mesh", "F", "fit zoom all centre"}, [&view] { view.frame_scene(); });
  out.plain({"look at contact", "View: look at the contact", "G", "camera find centre"},
            [&model] { model.view().look_at_contact(model.tick_in_view()); });
  out.flag({"follow contact", "View: follow the contact with the camera", "Shift+G", "track camera"},
           view.follow_contact);
  for (const NamedView& v : kStandardViews)
    out.plain({std::string("view ") + v.name, std::string("View: from the ") + v.name, v.key, "look camera"},
              [&view, from = v.view] { view.look_from_standard(from); });
  out.number({"orbit", "View: orbit to the right", "", "turn rotate camera"}, "deg", -360.0, 360.0,
             [&view](double by) { view.camera.orbit(by * kDegree, 0.0); });
  out.number({"tilt", "View: orbit upwards", "", "turn rotate camera"}, "deg", -180.0, 180.0,
             [&view](double by) { view.camera.orbit(0.0, by * kDegree); });
  out.number({"zoom", "View: zoom in by a factor", "", "nearer larger magnify"}, "", 1e-3, 1e3,
             [&view](double by) { view.camera.zoom(1.0 / by); });
  out.on_off(
      {"y up", "View: y axis up, or z axis", "U"}, [&view] { return view.camera.y_up; },
      [&view](bool on) { view.set_y_up(on); });
  out.plain({"copy camera", "View: copy the camera", "Ctrl+Shift+C", "clipboard"}, [&view] { view.copy_camera(); });
  out.plain({"paste camera", "View: paste the camera", "Ctrl+Shift+V", "clipboard"}, [&view] { view.paste_camera(); });
  out.text({"camera", "View: camera as it was copied"}, "TEXT", [&view](const std::string& text) -> Status {
    const auto camera = parse_camera("camera " + text, view.camera);
    if (!camera) return fail(show_text(text) + " is not a camera", {}, "copy one with Ctrl+Shift+C and paste it here");
    view.camera = *camera;
    return {};
  });
}

void add_layers(CommandList& out, SceneToggles& toggles) {
  struct Layer {
    const char* name;
    bool SceneToggles::*on;
  };
  for (const Layer& layer :
       {Layer{"facets", &SceneToggles::shaded}, Layer{"edges", &SceneToggles::wireframe},
        Layer{"smooth surface", &SceneToggles::smooth_surface}, Layer{"control net", &SceneToggles::control_net},
        Layer{"neighbours' control nets", &SceneToggles::control_net_neighbours},
        Layer{"labels", &SceneToggles::control_point_labels}, Layer{"vertex normals", &SceneToggles::vertex_normals},
        Layer{"control normals", &SceneToggles::control_normals},
        Layer{"creases and boundaries", &SceneToggles::creases}, Layer{"planes", &SceneToggles::planes},
        Layer{"plane after the tick", &SceneToggles::tracked_plane}, Layer{"finger", &SceneToggles::finger},
        Layer{"force", &SceneToggles::force}, Layer{"display inset", &SceneToggles::cld_inset},
        Layer{"axes and scale", &SceneToggles::axes}})
    out.flag({std::string("show ") + layer.name, std::string("Show: ") + layer.name, "", "layer hide draw"},
             toggles.*layer.on);
}

void add_inspection(CommandList& out, AppModel& model, MenuBar& menu) {
  ViewModel& view = model.view();
  out.number({"pick", "Inspect: pick the triangle", "", "select"}, "", 0.0, 4e9, [&model](double triangle) {
    const ContactMesh* mesh = model.mesh();
    if (mesh != nullptr && triangle < mesh->triangle_count())
      model.view().picked_triangle = static_cast<std::uint32_t>(triangle);
  });
  out.plain({"unpick", "Inspect: pick nothing", "", "deselect"}, [&view] { view.picked_triangle = kNone; });
  out.plain({"isolate", "Inspect: isolate", "I", "only hide rest"}, [&view] { view.isolate_marked(); });
  out.plain({"isolate part", "Inspect: isolate part", "", "connected component"}, [&view] { view.isolate_part(); });
  out.plain({"show all", "Inspect: show all", "Shift+I", "unhide"}, [&view] { view.show_all(); });
  out.flag({"net of picked", "Inspect: control net of the picked triangle"}, view.net_of_picked);
  out.plain({"copy net", "Inspect: copy the numbers of the picked control net", "", "clipboard points"},
            [&model, &menu] { wish(model, menu, "mesh/copy_net"); });
  out.choice({"slice", "Inspect: slice", "", "cut plane section"},
             {"no slice", "across x", "across y", "across z", "across the view"}, [&model, &menu](std::size_t i) {
               constexpr const char* kNames[]{"no slice", "across x", "across y", "across z", "across the view"};
               wish(model, menu, "inspect/slice", kNames[i]);
             });
  out.number({"slice at", "Inspect: where the slice is", "", "cut plane"}, "mm", -1e6, 1e6,
             [&model, &menu](double at) { wish(model, menu, "inspect/slice_at", printed("%.15g", at)); });
  out.plain({"flip slice", "Inspect: the other side of the slice", "", "cut plane"},
            [&model, &menu] { wish(model, menu, "inspect/slice_flip"); });
}

}  // namespace

void add_view_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_camera(out, model);
  out.plain({"screenshot", "View: screenshot", "F12", "save picture image png export write"},
            [&model] { model.exports().ask_for_screenshot(); });
  out.flag({"device monitor", "View: device monitor", "", "rates faults histogram limits"},
           model.view().device_monitor);
  add_layers(out, model.view().toggles);
  add_inspection(out, model, menu);
}

}  // namespace tangent
