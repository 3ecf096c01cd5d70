#include "core/lab/objects/generate.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/lab/objects/generate_hard.h"
#include "core/lab/objects/generators.h"

#include <algorithm>

namespace tangent {
namespace {

/// An object's use of the options, and the function that makes it from checked options.
struct Generator {
  const char* name;
  int default_segments;  ///< 0: only a rounded edge has segments, by default as many as fillet_steps
  int least_segments, most_segments;
  double largest_rounding_m;  ///< 0: no edge to round
  bool can_face;
  PolygonMesh (*make)(int segments, double rounding_m);
};

constexpr double kLeastRounding = 0.01 * kMillimetre;
// With a larger rounding the remaining faces would be slivers between the rounded edges.
constexpr double kLargestRoundedShare = 0.9;
constexpr double kCubeHalfEdge = kObjectRadius * std::numbers::sqrt2 / 2.0;  // square section inscribed in the circle

PolygonMesh polyhedron(const ConvexPolyhedron& body, int segments, double rounding_m) {
  if (rounding_m == 0.0) return sharp_polyhedron(body);
  if (segments == 0) {
    double widest = 0.0;
    for (const ConvexPolyhedron::Vertex& vertex : body.vertices) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& n = body.face_normals[vertex.faces[k]];
        const Vec3& next = body.face_normals[vertex.faces[(k + 1) % 3]];
        widest = std::max(widest, std::acos(glm::dot(n, next)));
      }
    }
    segments = fillet_steps(widest);
  }
  return rounded_polyhedron(body, rounding_m, segments);
}

// 50 % turns by half a side: with an even number of sides a flat side is on top.
ConvexPolyhedron cube() { return make_prism(4, 50, kCubeHalfEdge); }
ConvexPolyhedron octagon() { return make_prism(8, 50, kObjectHalfLength); }
ConvexPolyhedron triangle() { return make_prism(3, 75, kObjectHalfLength); }  // 75 % of 120 deg: a corner on top
ConvexPolyhedron hexagon() { return make_prism(6, 0, kObjectHalfLength); }

PolygonMesh sphere(int segments, double) { return make_icosphere(kObjectRadius, segments); }

const std::vector<Generator>& generators() {
  static const std::vector<Generator> table = [] {
    const auto share = [](double inradius) { return kLargestRoundedShare * inradius; };
    return std::vector<Generator>{
        {"cone", 32, 3, 4096, share(cone_inradius()), true,
         [](int n, double r) { return revolve(r == 0.0 ? sharp_cone() : rounded_cone(r), n); }},
        {"cylinder", 32, 3, 4096, share(cylinder_inradius()), false,
         [](int n, double r) { return revolve(r == 0.0 ? sharp_cylinder() : rounded_cylinder(r), n); }},
        {"cube", 0, 1, 64, share(cube().inradius), false, [](int n, double r) { return polyhedron(cube(), n, r); }},
        // Smooth everywhere: rounding has no effect.
        {"sphere", 2, 1, 9, share(kObjectRadius), false, sphere},
        {"tetrahedron", 0, 1, 64, share(make_tetrahedron().inradius), true,
         [](int n, double r) { return polyhedron(make_tetrahedron(), n, r); }},
        {"octagon", 0, 1, 64, share(octagon().inradius), false,
         [](int n, double r) { return polyhedron(octagon(), n, r); }},
        {"triangle", 0, 1, 64, share(triangle().inradius), false,
         [](int n, double r) { return polyhedron(triangle(), n, r); }},
        {"hexagon", 0, 1, 64, share(hexagon().inradius), false,
         [](int n, double r) { return polyhedron(hexagon(), n, r); }},
        {"icosphere", 2, 1, 9, 0.0, false, sphere},
        {"torus", 48, 6, 4096, 0.0, false, [](int n, double) { return make_torus(kObjectRadius, 0.015, n, n / 2); }},
        {"saddle", 32, 1, 2048, 0.0, false, [](int n, double) { return make_saddle(n); }},
        {"groove", 64, 8, 2048, 0.0, false, [](int n, double) { return make_groove(n); }},
    };
  }();
  return table;
}

std::string millimetres(double metres) {
  std::string text;
  append_double(text, std::floor(metres / kMillimetre * 100.0) / 100.0);
  return text + " mm";
}

Status check(const Generator& generator, const GenerateOptions& options) {
  const std::string name = generator.name;
  const double r = options.rounding_m;
  if (r != 0.0 && generator.largest_rounding_m == 0.0) {
    return fail(name + " has no edges to round", "rounding", "leave the rounding out");
  }
  // Written so that NaN fails.
  if (r != 0.0 && !(r >= kLeastRounding && r <= generator.largest_rounding_m)) {
    return fail("rounding of the " + name + " out of range", "rounding",
                "use 0 (sharp) or " + millimetres(kLeastRounding) + " to " + millimetres(generator.largest_rounding_m));
  }
  if (options.segments == 0) return {};
  if (generator.default_segments == 0 && r == 0.0) {
    return fail("a sharp " + name + " has no segments: they count the steps across a rounded edge", "segments",
                "give a rounding, or leave the segments out");
  }
  if (options.segments < generator.least_segments || options.segments > generator.most_segments) {
    return fail("segments of the " + name + " out of range", "segments",
                "use " + std::to_string(generator.least_segments) + " to " + std::to_string(generator.most_segments));
  }
  return {};
}

/// Moves every coordinate, by one ulp at most, to one that is a double in millimetres times 1e-3 (not all are), so that
/// a file by write_obj in millimetres reads back as exactly this mesh.
void make_exact_in_millimetres(PolygonMesh& mesh) {
  for (Vec3& p : mesh.positions) p = (p / kMillimetre) * kMillimetre;
}

}  // namespace

int fillet_steps(double angle_rad) {
  constexpr double kSlack = 1e-9;  // a right angle is six steps, however it was rounded
  return std::max(1, static_cast<int>(std::ceil(angle_rad / kFilletStep - kSlack)));
}

void mirror_x(PolygonMesh& mesh) {
  for (Vec3& p : mesh.positions) p.x = -p.x;
  for (Vec3& n : mesh.normals) n.x = -n.x;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    // The first corner stays: a polygon's fan of triangles keeps its apex.
    const auto reverse = [&](std::vector<std::uint32_t>& corners) {
      std::reverse(corners.begin() + mesh.face_offsets[f] + 1, corners.begin() + mesh.face_offsets[f + 1]);
    };
    reverse(mesh.corner_position);
    if (!mesh.corner_normal.empty()) reverse(mesh.corner_normal);
  }
}

const std::vector<std::string>& generator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Generator& generator : generators()) list.emplace_back(generator.name);
    return list;
  }();
  return names;
}

Result<PolygonMesh> generate_mesh(std::string_view name, const GenerateOptions& options) {
  const auto& table = generators();
  const auto found = std::find_if(table.begin(), table.end(), [&](const Generator& g) { return g.name == name; });
  if (found == table.end() && !hard_mesh_description(name).empty()) {
    if (options.segments != 0 || options.rounding_m != 0.0) {
      return fail("the hard mesh " + std::string(name) + " has neither segments nor rounding", "", "leave them out");
    }
    Result<PolygonMesh> hard = generate_hard_mesh(name);
    if (hard) make_exact_in_millimetres(*hard);
    return hard;
  }
  if (found == table.end()) {
    std::string choices;
    for (const auto* names : {&generator_names(), &hard_mesh_names()})
      for (const std::string& known : *names) choices += (choices.empty() ? "" : ", ") + known;
    return fail("there is no object called \"" + std::string(name) + "\"", "", "choose one of " + choices);
  }
  if (const Status good = check(*found, options); !good) return tl::unexpected<Error>(good.error());
  PolygonMesh mesh =
      found->make(options.segments == 0 ? found->default_segments : options.segments, options.rounding_m);
  if (found->can_face && options.facing == Facing::left) mirror_x(mesh);
  make_exact_in_millimetres(mesh);
  mesh.name = name;
  return mesh;
}

}  // namespace tangent
