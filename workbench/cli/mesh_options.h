// Options of the mesh and how to read it, the same in every subcommand that takes one.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/mesh/polygon_mesh.h"
#include "core/tick/step.h"

#include <filesystem>

namespace CLI {
class App;
}

namespace tangent {

struct MeshOptions {
  std::filesystem::path file;
  double metres_per_unit = kMillimetre;
  ContactMeshOptions build;
};

/// MESH (a positional argument), --unit, --fit-mm, --normals, --crease-deg, --turn-over. `options` must outlive the
/// parser.
void add_mesh_options(CLI::App& app, MeshOptions& options, bool mesh_required = true);

/// The same with the mesh as an option, `--mesh F`, in place of a recorded one.
void add_replaced_mesh_options(
    CLI::App& app, MeshOptions& options,
    const std::string& doc = "Another mesh, or the recorded one where it was recorded without it");

/// How a mesh is read, without the mesh itself: --unit, --fit-mm, --normals, --crease-deg, --turn-over.
void add_reading_options(CLI::App& app, MeshOptions& options);

/// Option `--unit mm|cm|m|in` alone.
void add_unit_option(CLI::App& app, double& metres_per_unit, const std::string& doc);

struct LoadedMesh {
  PolygonMesh source;  ///< as the file holds it
  ContactMesh mesh;
};

/// Reads the file and builds the mesh. Fails with the reader's or the builder's message.
Result<LoadedMesh> load_mesh(const MeshOptions& options);

/// The scene for contacts: a mesh, or a 2D scene where the file holds a polygon (planar/polygon_io.h), with `parts`.
Result<std::shared_ptr<const ContactScene>> load_contact_scene(const MeshOptions& options, const SceneParts& parts);

}  // namespace tangent
