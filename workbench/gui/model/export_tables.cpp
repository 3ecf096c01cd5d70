#include "workbench/gui/model/export_tables.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/io/ticks_file.h"
#include "core/surface/mesh_patch.h"
#include "workbench/gui/model/file_origin_of.h"

#include <algorithm>

namespace tangent {
namespace {

/// "iterations-worst" in "1": iterations_worst; "error" in "m": error_m.
std::string column_of(const MapQuantityInfo& info) {
  std::string name(info.key);
  std::replace(name.begin(), name.end(), '-', '_');
  if (info.unit == "1") return name;
  if (info.unit == "1/m") return name + "_per_m";
  if (info.unit == "R") return name + "_in_reaches";
  return name + "_" + std::string(info.unit);
}

void append_numbers(std::string& line, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    line += ',';
    append_double(line, number);
  }
}

}  // namespace

Status write_map_table(const AppModel& model, const std::filesystem::path& file) {
  const MapView& map = model.map();
  const auto paint = map.paint();
  const auto& scene = model.scene().current();
  if (!paint || map.statistics().values == 0 || scene == nullptr)
    return fail("no map is computed", "map", "choose a quantity under Map");
  const ContactMesh& mesh = scene->mesh();
  std::string text =
      csv_comment(file_origin(model)) + "triangle,part,u,v,x_m,y_m,z_m," + column_of(info_of(map.quantity)) + "\n";
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const PnPatch patch = make_patch(mesh, t);
    for (unsigned part = 0; part < paint->level * paint->level; ++part) {
      const Vec2 uv = map_part_centroid(paint->level, part);
      const std::optional<double> value = map.value_at(t, uv.x, uv.y);
      if (!value) continue;
      const Vec3 at = mesh.origin() + evaluate(patch, uv.x, uv.y).point;
      text += std::to_string(t) + "," + std::to_string(part);
      append_numbers(text, {uv.x, uv.y, at.x, at.y, at.z, *value});
      text += '\n';
    }
  }
  return write_file_atomic(file, text);
}

Status write_planes_table(const AppModel& model, const std::filesystem::path& file) {
  const TickView& tick = model.time().tick();
  if (tick.record() == nullptr || tick.iterations().empty())
    return fail("no tick with tangent planes is in view", "planes", "pause on a tick of a smooth method");
  const auto trace = std::make_unique<IterationTrace>();
  for (const IterationRecord& record : tick.iterations()) trace->push(record);
  Result<IterationsFile> table = IterationsFile::create(file, csv_comment(file_origin(model)));
  if (!table) return tl::unexpected(table.error());
  if (Status status = table->append(tick.record()->tick.tick, *trace); !status) return status;
  return table->commit();
}

}  // namespace tangent
