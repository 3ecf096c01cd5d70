#include "core/lab/objects/generate_hard.h"

#include "core/base/units.h"
#include "core/lab/objects/generators_hard.h"

#include <algorithm>
#include <array>

namespace tangent {
namespace {

struct HardMesh {
  std::string_view name, description;
  PolygonMesh (*make)();
};

constexpr std::array kHardMeshes{
    HardMesh{"trough", "concave ground barely wider than a 20 mm finger", make_trough},
    HardMesh{"exact_pipe", "half pipe of exactly the finger's radius: where it just touches, it touches everywhere",
             make_exact_pipe},
    HardMesh{"dimple", "a pit of 7 mm radius of curvature in a plate", make_dimple},
    HardMesh{"two_plates", "two plates that face each other closer than the finger is thick", make_two_plates},
    HardMesh{"thin_fin", "a sharp plate 0.1 mm thick", make_thin_fin},
    HardMesh{"needle_arch", "triangles of aspect 1e5 between ordinary ones", make_needle_arch},
    HardMesh{"sliver_pole_sphere", "512 slivers around either pole", make_sliver_pole_sphere},
    HardMesh{"open_bowl", "a half sphere with an open rim", make_open_bowl},
    HardMesh{"narrow_cup", "the inside of a half sphere of 15 mm: the finger rests on the rim", make_narrow_cup},
    HardMesh{"moebius", "a band with one side only", make_moebius},
    HardMesh{"crease_dart", "a crease that ends inside the surface", make_crease_dart},
    HardMesh{"notched_cube", "corners where convex and concave creases meet", make_notched_cube},
    HardMesh{"staircase", "convex and concave creases in turn, 4 mm apart", make_staircase},
    HardMesh{"zero_normals", "a sphere whose file normals are zero or not finite at every third vertex",
             make_zero_normals},
    HardMesh{"flipped_normals", "a sphere whose file normals point inwards", make_flipped_normals},
    HardMesh{"mixed_orientation", "a sphere with every third face turned round", make_mixed_orientation},
    HardMesh{"triangle_soup", "a sphere whose triangles share no vertex in the file", make_triangle_soup},
    HardMesh{"duplicate_faces", "a sphere with every fifth face listed twice, in either turn", make_duplicate_faces},
    HardMesh{"degenerate_faces", "a sphere with faces of no area between the others", make_degenerate_faces},
    HardMesh{"fin_on_plate", "edges with three faces", make_fin_on_plate},
    HardMesh{"noisy_sphere", "a sphere with 0.3 mm of noise on edges of 3 mm", make_noisy_sphere},
};

const HardMesh* find(std::string_view name) {
  const auto found =
      std::find_if(kHardMeshes.begin(), kHardMeshes.end(), [&](const HardMesh& m) { return m.name == name; });
  return found == kHardMeshes.end() ? nullptr : &*found;
}

}  // namespace

const std::vector<std::string>& hard_mesh_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const HardMesh& mesh : kHardMeshes) list.emplace_back(mesh.name);
    return list;
  }();
  return names;
}

std::string_view hard_mesh_description(std::string_view name) {
  const HardMesh* found = find(name);
  return found ? found->description : std::string_view();
}

Result<PolygonMesh> generate_hard_mesh(std::string_view name) {
  const HardMesh* found = find(name);
  if (!found) return fail("there is no hard mesh called \"" + std::string(name) + "\"");
  PolygonMesh mesh = found->make();
  mesh.name = name;
  return mesh;
}

}  // namespace tangent
