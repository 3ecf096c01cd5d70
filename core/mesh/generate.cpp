#include "core/mesh/generate.h"

namespace tangent {
namespace {

constexpr double kRadius = 0.040;  // m, of the paper's objects

}  // namespace

const std::vector<std::string>& generator_names() {
  static const std::vector<std::string> names = {"sphere", "icosphere", "torus"};
  return names;
}

Result<PolygonMesh> generate_mesh(std::string_view name, const GenerateOptions& options) {
  PolygonMesh mesh;
  if (name == "sphere" || name == "icosphere") {
    mesh = make_icosphere(kRadius, options.segments == 0 ? 2 : options.segments);
  } else if (name == "torus") {
    const int ring = options.segments == 0 ? 48 : options.segments;
    mesh = make_torus(kRadius, 0.015, ring, ring / 2);
  } else {
    return fail("no generator called \"" + std::string(name) + "\"", "", "choose one of sphere, icosphere, torus");
  }
  mesh.name = name;
  return mesh;
}

}  // namespace tangent
