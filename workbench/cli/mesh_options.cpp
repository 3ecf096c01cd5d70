#include "workbench/cli/mesh_options.h"

#include "core/io/mesh_io.h"
#include "core/io/scene_file.h"
#include "workbench/cli/option.h"
#include "workbench/session/file_units.h"
#include "workbench/session/two_threads.h"

#include <array>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 3> kNormals{"auto", "file", "computed"};  // order of NormalSource

}  // namespace

void add_unit_option(CLI::App& app, double& metres_per_unit, const std::string& doc) {
  add_choice_option(app, "--unit", kFileUnitNames, doc,
                    [&](int unit) { metres_per_unit = kFileUnits[static_cast<std::size_t>(unit)].metres; });
}

void add_reading_options(CLI::App& app, MeshOptions& options) {
  add_unit_option(app, options.metres_per_unit, "Unit of the file's coordinates (default mm)");
  add_number_option(app, "--fit-mm", {.min = 1e-3, .max = 1e9, .unit = "mm"},
                    "Bounding-box centre to the origin, longest side to this (default: as in the file)",
                    [&](double value) { options.build.fit_m = value / 1e3; });
  add_choice_option(app, "--normals", kNormals,
                    "Vertex normals: from the file, computed, or auto: from the file if every corner has one",
                    [&](int source) { options.build.normals = static_cast<NormalSource>(source); });
  add_number_option(app, "--crease-deg", {.min = 0.0, .max = 180.0, .unit = "deg"},
                    "Edges whose dihedral angle exceeds this are creases; 180: none (default 45)",
                    [&](double value) { options.build.crease_rad = value * kDegree; });
  add_flag(app, "--turn-over", options.build.turn_over, "Turn closed parts over that are inside out");
}

void add_mesh_options(CLI::App& app, MeshOptions& options, bool mesh_required) {
  add_text_option(
      app, "MESH", options.file,
      "Mesh file: .obj, .ply, .stl or .off; for solve and gui also a polygon: .csv (x_m,y_m) or .obj with a "
      "line element",
      "", mesh_required ? Needed::yes : Needed::no);
  add_reading_options(app, options);
}

void add_replaced_mesh_options(CLI::App& app, MeshOptions& options, const std::string& doc) {
  add_text_option(app, "--mesh", options.file, doc, "MESH");
  add_reading_options(app, options);
}

Result<LoadedMesh> load_mesh(const MeshOptions& options) {
  Result<PolygonMesh> source = read_mesh(options.file, options.metres_per_unit, run_on_two_threads);
  if (!source) return tl::unexpected(source.error());
  Result<ContactMesh> mesh = ContactMesh::build(*source, options.build, run_on_two_threads);
  if (!mesh) {
    Error error = mesh.error();
    if (error.where.empty()) error.where = options.file.string();
    return tl::unexpected(error);
  }
  return LoadedMesh{std::move(*source), std::move(*mesh)};
}

Result<std::shared_ptr<const ContactScene>> load_contact_scene(const MeshOptions& options, const SceneParts& parts) {
  return load_scene(options.file, {options.metres_per_unit, options.build, parts}, run_on_two_threads);
}

}  // namespace tangent
