// Commands of the mesh and of the maps over it.
#include "core/base/units.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/wish.h"
#include "workbench/gui/widgets/widgets.h"
#include "workbench/session/file_units.h"

#include <cmath>

namespace tangent {

namespace {

void add_mesh_files(CommandList& out, AppModel& model, MenuBar& menu) {
  SceneModel& scene = model.scene();
  out.plain({"open mesh", "Mesh: open a file", "Ctrl+O", "load read path"},
            [&menu] { menu.path.open = menu.path.focus = true; });
  out.text({"open", "Mesh, preset or recording: open the file", "", "load read path sqlite"}, "FILE",
           [&model](const std::string& file) -> Status {
             model.open(file);
             return {};
           });
  out.plain({"reload mesh", "Mesh: load again", "", "open read refresh"}, [&scene] {
    if (!scene.path().empty()) scene.open(std::string(scene.path()));
  });
  out.choice_of({"recent", "Mesh: open again", "", "load last"}, "FILE", model.window().settings().recent_meshes,
                [&model](std::size_t i) {
                  const std::string mesh = model.window().settings().recent_meshes[i];
                  model.open(mesh);
                });
  std::vector<std::string> objects = generator_names();
  objects.insert(objects.end(), hard_mesh_names().begin(), hard_mesh_names().end());
  out.choice({"mesh", "Mesh: make", "", "object generate"}, objects,
             [&scene, objects](std::size_t i) { scene.open(objects[i]); });
}

void add_import(CommandList& out, AppModel& model) {
  SceneModel& scene = model.scene();
  out.choice({"mesh unit", "Mesh: unit of the file", "", "millimetre metre inch"},
             {kFileUnitNames.begin(), kFileUnitNames.end()},
             [&scene](std::size_t i) { scene.set_unit(kFileUnits[i].metres); });
  out.number({"longest side", "Mesh: longest side, 0 as in the file", "", "size fit scale"}, "mm", 0.0, 1e6,
             [&scene](double mm) { scene.set_fit(mm > 0.0 ? std::optional(mm * 1e-3) : std::nullopt); });
  out.number({"crease angle", "Mesh: creases above", "", "edges normals sharp"}, "deg", 0.0, 180.0,
             [&scene](double degrees) { scene.set_crease_angle(degrees * kDegree); });
}

void add_map(CommandList& out, AppModel& model) {
  MapView& map = model.map();
  std::vector<std::string> quantities{"none"};
  for (std::size_t q = 0; q < kMapQuantityCount; ++q) quantities.emplace_back(info_of(static_cast<MapQuantity>(q)).key);
  out.choice(
      {"map", "Map:", "", "heat colour surface quantity"}, quantities,
      [&map](std::size_t i) {
        map.on = i > 0;
        if (i > 0) map.set_quantity(static_cast<MapQuantity>(i - 1));
      },
      map.on ? static_cast<int>(map.quantity) + 1 : 0);
  out.plain({"worst place", "Map: solve at the worst place", "W", "maximum next go"},
            [&model] { model.solve_at_worst(); });
  out.plain({"solve here", "Map: solve at the picked triangle, or at the contact", "H", "place tick direction"},
            [&model] { model.solve_here(); });
  out.plain({"compute map", "Map: compute again", "", "refresh"}, [&map] { map.compute_again(); });
  out.plain({"cancel map", "Map: cancel the computation", "", "stop"},
            when(
                model, [&map] { return map.running(); }, "no map is being computed", [&map] { map.cancel(); }));
  const double scale = unit_of(map.quantity).in_si;
  const char* unit = unit_of(map.quantity).name.data();
  out.number({"map low", "Map: value of the first colour", "", "range minimum"}, unit, -1e12, 1e12,
             [&map, scale](double low) { map.set_range(low * scale, map.high()); });
  out.number({"map high", "Map: value of the last colour", "", "range maximum"}, unit, -1e12, 1e12,
             [&map, scale](double high) { map.set_range(map.low(), high * scale); });
  out.on_off(
      {"map range automatic", "Map: range of nearly all values"}, [&map] { return map.automatic_range(); },
      [&map](bool on) { on ? map.set_automatic_range() : map.set_range(map.low(), map.high()); });
  out.on_off(
      {"map logarithmic", "Map: logarithmic colours"}, [&map] { return map.logarithmic(); },
      [&map](bool on) { map.set_logarithmic(on); });
  const auto names = colour_map_names();
  out.choice(
      {"map colours", "Map: colours", "", "colour palette"}, {names.begin(), names.end()},
      [&map](std::size_t i) { map.colours = static_cast<ColourMap>(i); }, static_cast<int>(map.colours));
  out.flag({"map follows preset", "Map: computed again when the preset changes"}, map.follow_changes);
  out.number({"map directions", "Map: directions of motion tried"}, "", 1.0, 32.0,
             [&map](double n) { map.options.directions = static_cast<unsigned>(n); });
  out.number({"map move", "Map: how far the finger moves per tick"}, "mm", 1e-4, 10.0,
             [&map](double mm) { map.options.move_m = mm * 1e-3; });
  out.number({"map press", "Map: how deep the finger rests"}, "mm", 0.0, 20.0,
             [&map](double mm) { map.options.press_m = mm * 1e-3; });
}

}  // namespace

void add_mesh_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_mesh_files(out, model, menu);
  add_import(out, model);
  add_map(out, model);
}

}  // namespace tangent
