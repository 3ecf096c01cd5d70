#include "core/io/mesh_io.h"

#include "core/base/float_state.h"
#include "core/io/readers.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <new>

namespace tangent {
namespace {

using Reader = std::function<Result<PolygonMesh>(const FileBytes&, const std::string&)>;

Reader reader_for(const std::filesystem::path& path, const RunBoth& run_both) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return read_obj;
  if (extension == ".ply")
    return [&run_both](const FileBytes& file, const std::string& name) { return read_ply(file, name, run_both); };
  if (extension == ".stl") return read_stl;
  if (extension == ".off") return read_off;
  return nullptr;
}

}  // namespace

Result<PolygonMesh> read_mesh(const std::filesystem::path& path, double metres_per_unit, const RunBoth& run_both) {
  const FloatState as_tested;
  const Reader reader = reader_for(path, run_both);
  if (reader == nullptr) {
    return fail("unknown mesh format " + (path.has_extension() ? path.extension().string() : "(no extension)"),
                path.string(), "use a file ending in .obj, .ply, .stl or .off");
  }
  try {
    const Result<FileBytes> file = read_file_bytes(path, run_both);
    if (!file) return tl::unexpected<Error>(file.error());
    Result<PolygonMesh> mesh = reader(*file, path.string());
    if (!mesh) return mesh;
    if (mesh->face_count() == 0) {
      return fail("the file has no faces (" + std::to_string(mesh->positions.size()) +
                      (mesh->positions.size() == 1 ? " vertex)" : " vertices)"),
                  path.string(), "export the mesh with its faces");
    }
    mesh->name = path.filename().string();
    run_halves(run_both, mesh->positions.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) mesh->positions[i] *= metres_per_unit;
    });
    return mesh;
  } catch (const std::bad_alloc&) {
    return fail("not enough memory for this mesh", path.string(), "use a smaller mesh");
  }
}

}  // namespace tangent
