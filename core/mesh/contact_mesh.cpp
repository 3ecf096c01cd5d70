// Builds the contact mesh in stages: check, weld, triangulate, place, connect, shade, turn.
#include "core/mesh/contact_mesh.h"

#include "core/base/float_state.h"
#include "core/base/tolerances.h"
#include "core/mesh/body.h"
#include "core/mesh/content_hash.h"
#include "core/mesh/corner_normals.h"
#include "core/mesh/edge_table.h"
#include "core/mesh/file_normals.h"
#include "core/mesh/inside_out.h"
#include "core/mesh/topology.h"
#include "core/mesh/triangle_shape.h"
#include "core/mesh/weld.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace tangent {

class ContactMeshBuilder {
 public:
  ContactMeshBuilder(const PolygonMesh& source, const ContactMeshOptions& options, const RunBoth& run_both)
      : source_(source), options_(options), run_both_(run_both) {}

  Result<ContactMesh> build(const ContactMesh::OnContent& on_content) {
    if (Status ok = check_options(); !ok) return tl::unexpected(ok.error());
    Status indices;
    run_both_([&] { indices = check_indices(); }, [&] { weld_positions(); });
    if (!indices) return tl::unexpected(indices.error());
    triangulate();
    if (mesh_.usable_count_ > 0) place();
    if (mesh_.usable_count_ == 0) return nothing_usable();
    connect();
    const InsideOut inside_out = find_inside_out(surface(), run_both_);
    const FacesAndCreases faces = faces_and_creases();
    if (Status ok = shade(faces); !ok) return tl::unexpected(ok.error());
    turn_inside_out(inside_out);
    if (on_content) on_content(mesh_.content());
    finish();
    return std::move(mesh_);
  }

 private:
  Status check_options() const;
  Status check_indices();
  void weld_positions();
  void triangulate();
  bool drop_degenerate(double reach_m);
  bool all_used();
  void drop_unused_vertices();
  template <class Move>
  Box box_about(const Move& move);
  void place();
  void connect();
  struct FacesAndCreases {
    Unfilled<Vec3> normals;
    std::vector<std::uint8_t> sharp;  ///< empty: not known, all normals may come from the file
  };
  FacesAndCreases faces_and_creases() const;
  bool wants_file_normals() const {
    return options_.normals == NormalSource::file ||
           (options_.normals == NormalSource::automatic && every_corner_has_normal(source_));
  }
  Status shade(const FacesAndCreases& faces);
  void take_file_normals(const SurfaceView& surface, std::span<const Vec3> faces);
  void turn_inside_out(const InsideOut& inside_out);
  bool finds_concave_crease() const;
  void finish();
  tl::unexpected<Error> nothing_usable() const;

  MeshDefectList& defects(MeshDefect kind) { return mesh_.defects_[static_cast<std::size_t>(kind)]; }
  std::array<Vec3, 3> corners(const std::array<std::uint32_t, 3>& v) const {
    return {mesh_.positions_[v[0]], mesh_.positions_[v[1]], mesh_.positions_[v[2]]};
  }
  SurfaceView surface() const { return {mesh_.positions_, mesh_.vertices_, mesh_.links_}; }
  bool crease_was_chosen() const { return options_.crease_rad != ContactMeshOptions{}.crease_rad; }

  const PolygonMesh& source_;
  const ContactMeshOptions& options_;
  const RunBoth& run_both_;
  ContactMesh mesh_;
  std::uint32_t triangle_count_ = 0;
  std::vector<std::uint32_t> welded_;  ///< per source vertex, its welded vertex or kNone
  bool stays_sound_ = false;           ///< no triangle can collapse when the mesh is placed
};

Status ContactMeshBuilder::check_options() const {
  if (options_.fit_m && !(*options_.fit_m > 0.0 && *options_.fit_m <= kLargestCoordinate))
    return fail("the size to fit the mesh to must be a positive length", source_.name, "use a length above zero");
  if (!(options_.crease_rad >= 0.0 && options_.crease_rad <= std::numbers::pi + kCreaseSlack))
    return fail("the crease angle is out of range", source_.name, "use an angle from 0 to 180 degrees");
  return {};
}

Status ContactMeshBuilder::check_indices() {
  const auto& offsets = source_.face_offsets;
  const bool normals = !source_.corner_normal.empty();
  if (offsets.empty() || offsets.front() != 0 || offsets.back() != source_.corner_position.size() ||
      !std::is_sorted(offsets.begin(), offsets.end()) ||
      (normals && source_.corner_normal.size() != source_.corner_position.size()))
    return fail("the face table does not fit the corner table", source_.name, "this is a slip of the reader");

  std::uint64_t triangles = 0;
  std::vector<bool> referenced(source_.positions.size(), false);
  for (std::size_t f = 0; f < source_.face_count(); ++f) {
    const auto face = source_.face(f);
    if (face.size() < 3) {
      defects(MeshDefect::face_under_three_corners).add(f);
    } else {
      triangles += face.size() - 2;
    }
    for (const std::uint32_t v : face) {
      if (v >= referenced.size())
        return fail("face " + std::to_string(f) + " uses vertex " + std::to_string(v) + ", but there are only " +
                        std::to_string(referenced.size()),
                    source_.name, "vertices count from 0 here");
      referenced[v] = true;
    }
  }
  for (std::size_t i = 0; i < source_.corner_normal.size(); ++i)
    if (source_.corner_normal[i] != kNone && source_.corner_normal[i] >= source_.normals.size())
      return fail("corner " + std::to_string(i) + " uses normal " + std::to_string(source_.corner_normal[i]) +
                      ", but there are only " + std::to_string(source_.normals.size()),
                  source_.name, "normals count from 0 here");
  for (std::size_t v = 0; v < referenced.size(); ++v)
    if (!referenced[v]) defects(MeshDefect::unreferenced_vertex).add(v);
  if (triangles > kMaxTriangles)
    return fail("the mesh has " + std::to_string(triangles) + " triangles", source_.name,
                "reduce it to at most " + std::to_string(kMaxTriangles));
  triangle_count_ = static_cast<std::uint32_t>(triangles);
  mesh_.vertices_.resize(triangle_count_);
  return {};
}

void ContactMeshBuilder::weld_positions() {
  Weld weld = weld_exact(source_.positions, kLargestCoordinate, run_both_);
  welded_ = std::move(weld.id);
  for (std::size_t v = 0; v < welded_.size(); ++v)
    if (welded_[v] == kNone) defects(MeshDefect::non_finite_vertex).add(v);
  mesh_.positions_.resize(weld.first.size());
  run_halves(run_both_, weld.first.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) mesh_.positions_[v] = source_.positions[weld.first[v]];
  });
}

/// Fills vertices_ with welded vertices, still at their world positions: differences of those are as exact as
/// the file, so this is where degenerate triangles are told.
void ContactMeshBuilder::triangulate() {
  run_halves(run_both_, source_.face_count(), [&](std::size_t first, std::size_t last) {
    std::size_t t = 0;
    for (std::size_t f = 0; f < first; ++f) t += std::max<std::size_t>(source_.face(f).size(), 2) - 2;
    for (std::size_t f = first; f < last; ++f) {
      const auto face = source_.face(f);
      for (std::size_t k = 2; k < face.size(); ++k, ++t) {
        const std::array<std::uint32_t, 3> v{welded_[face[0]], welded_[face[k - 1]], welded_[face[k]]};
        const bool all = v[0] != kNone && v[1] != kNone && v[2] != kNone;
        mesh_.vertices_[t] = all ? v : std::array{kNone, kNone, kNone};
      }
    }
  });
  welded_ = {};
  const Box box = box_about([](Vec3&) {});
  const Vec3 size = box.size();
  stays_sound_ = drop_degenerate(std::max({size.x, size.y, size.z}));
}

/// Of the triangles that are left, and counts the rest. Whether that would find none after the mesh is placed, with no
/// coordinate beyond `reach_m`.
bool ContactMeshBuilder::drop_degenerate(double reach_m) {
  std::array<bool, 2> far_from_it{};
  std::array<MeshDefectList, 2> found;
  std::array<std::uint32_t, 2> usable{};
  run_halves(run_both_, triangle_count_, [&](std::size_t first, std::size_t last) {
    const std::size_t half = first == 0 ? 0 : 1;
    std::uint32_t count = 0, sound = 0;
    for (std::size_t t = first; t < last; ++t) {
      auto& v = mesh_.vertices_[t];
      if (v[0] == kNone) continue;
      const auto [a, b, c] = corners(v);
      if (is_far_from_degenerate(a, b, c, reach_m)) {
        ++sound;
      } else if (is_degenerate(a, b, c)) {
        v = {kNone, kNone, kNone};
        found[half].add(t);
        continue;
      }
      ++count;
    }
    usable[half] = count;
    far_from_it[half] = sound == count;
  });
  mesh_.usable_count_ = usable[0] + usable[1];
  MeshDefectList& all = defects(MeshDefect::degenerate_triangle);
  for (const MeshDefectList& part : found) {
    all.count += part.count;
    all.first.insert(all.first.end(), part.first.begin(), part.first.end());
  }
  std::sort(all.first.begin(), all.first.end());
  if (all.first.size() > MeshDefectList::kNamed) all.first.resize(MeshDefectList::kNamed);
  return far_from_it[0] && far_from_it[1];
}

/// Whether every welded vertex is known to be of a usable triangle.
bool ContactMeshBuilder::all_used() {
  return mesh_.usable_count_ == triangle_count_ && defects(MeshDefect::unreferenced_vertex).count == 0 &&
         defects(MeshDefect::face_under_three_corners).count == 0;
}

void ContactMeshBuilder::drop_unused_vertices() {
  std::vector<std::uint32_t> renumbered(mesh_.positions_.size(), kNone);
  for (const auto& v : mesh_.vertices_) {
    if (v[0] == kNone) continue;
    for (const std::uint32_t i : v) renumbered[i] = 0;
  }
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] == kNone) continue;
    mesh_.positions_[count] = mesh_.positions_[i];
    renumbered[i] = count++;
  }
  mesh_.positions_.resize(count);
  for (auto& v : mesh_.vertices_) {
    if (v[0] == kNone) continue;
    for (std::uint32_t& i : v) i = renumbered[i];
  }
}

/// Of all vertices, each moved before.
template <class Move>
Box ContactMeshBuilder::box_about(const Move& move) {
  std::array<Box, 2> boxes;
  run_halves(run_both_, mesh_.positions_.size(), [&](std::size_t first, std::size_t last) {
    Box& box = boxes[first == 0 ? 0 : 1];
    for (std::size_t i = first; i < last; ++i) {
      move(mesh_.positions_[i]);
      box.include(mesh_.positions_[i]);
    }
  });
  if (boxes[1].empty()) return boxes[0];
  boxes[0].include(boxes[1].min);
  boxes[0].include(boxes[1].max);
  return boxes[0];
}

/// Drops vertices that no usable triangle has, and moves (and fits) the rest to the centre of their box.
void ContactMeshBuilder::place() {
  if (!all_used()) drop_unused_vertices();
  const Box box = box_about([](Vec3&) {});
  const Vec3 size = box.size(), centre = box.centre();
  mesh_.scale_ = options_.fit_m ? *options_.fit_m / std::max({size.x, size.y, size.z}) : 1.0;
  mesh_.origin_ = options_.fit_m ? Vec3(0.0) : centre;
  mesh_.bounds_ = box_about([&](Vec3& p) {
    p = (p - centre) * mesh_.scale_ + 0.0;  // + 0.0: no -0.0, so that equal meshes hash equal
  });
  // A triangle finer than the rounding of coordinates about the centre can collapse in the move.
  if (!stays_sound_) drop_degenerate(0.0);
}

void ContactMeshBuilder::connect() {
  Topology topology = build_topology(mesh_.vertices_, mesh_.vertex_count(), run_both_);
  mesh_.links_ = std::move(topology.links);
  mesh_.positions_.reserve(mesh_.positions_.size() + topology.copy_of.size());
  for (const std::uint32_t original : topology.copy_of) mesh_.positions_.push_back(mesh_.positions_[original]);
  mesh_.positions_.shrink_to_fit();
  for (const std::uint32_t t : topology.duplicates) defects(MeshDefect::duplicate_triangle).add(t);
  for (const std::uint32_t t : topology.detached) defects(MeshDefect::non_manifold_triangle).add(t);
  mesh_.usable_count_ -= static_cast<std::uint32_t>(topology.duplicates.size());
}

ContactMeshBuilder::FacesAndCreases ContactMeshBuilder::faces_and_creases() const {
  FacesAndCreases faces{face_normals(surface(), run_both_), {}};
  if (!wants_file_normals()) faces.sharp = sharp_edges(surface(), faces.normals, options_.crease_rad, run_both_);
  return faces;
}

Status ContactMeshBuilder::shade(const FacesAndCreases& faces) {
  const bool some_in_file =
      !source_.normals.empty() && std::any_of(source_.corner_normal.begin(), source_.corner_normal.end(),
                                              [](std::uint32_t n) { return n != kNone; });
  if (options_.normals == NormalSource::file && !some_in_file)
    return fail("normals from the file were asked for, but it has none", source_.name,
                "use --normals computed, or auto");
  if (wants_file_normals()) {
    take_file_normals(surface(), faces.normals);
  } else {
    CornerNormals computed = computed_normals(surface(), faces.normals, faces.sharp, run_both_);
    mesh_.normals_ = std::move(computed.normals);
    mesh_.normal_index_ = std::move(computed.index);
  }
  mesh_.normals_.shrink_to_fit();
  return {};
}

void ContactMeshBuilder::take_file_normals(const SurfaceView& surface, std::span<const Vec3> faces) {
  FileNormals file = file_normals(source_, surface, [&] {
    return computed_normals(surface, faces, sharp_edges(surface, faces, options_.crease_rad, run_both_), run_both_);
  });
  defects(MeshDefect::bad_normal) = file.bad;
  mesh_.normals_ = std::move(file.corners.normals);
  mesh_.normal_index_ = std::move(file.corners.index);
  if (file.from_file == 0) {
    mesh_.notes_.push_back("the file's normals are zero or not finite: computed ones are used everywhere");
    return;
  }
  mesh_.normals_used_ = NormalSource::file;
  if (file.missing > 0)
    mesh_.notes_.push_back(std::to_string(file.missing) +
                           " corners have no normal in the file: computed ones are used there");
  if (crease_was_chosen()) {
    const bool some_computed = file.missing > 0 || file.bad.count > 0;
    mesh_.notes_.push_back(some_computed ? "--crease-deg applies only where the file gives no usable normal"
                                         : "--crease-deg is ignored with normals from the file");
  }
}

/// Says which closed parts look inwards, and turns them over where that is asked for.
void ContactMeshBuilder::turn_inside_out(const InsideOut& inside_out) {
  if (!inside_out.any()) {
    if (options_.turn_over) mesh_.notes_.push_back("nothing is inside out: nothing was turned over");
    return;
  }
  mesh_.inside_out_ = inside_out.triangles;
  mesh_.turned_over_ = options_.turn_over;
  std::string note = inside_out.triangles == mesh_.usable_count_
                         ? "the mesh is inside out"
                         : std::to_string(inside_out.parts) + (inside_out.parts == 1 ? " part" : " parts") + " of " +
                               std::to_string(inside_out.triangles) + " triangles inside out";
  char volume[32];
  std::snprintf(volume, sizeof volume, "%.4g", inside_out.volume_m3 * 1e9);
  note += std::string(" (closed, with a volume of ") + volume + " mm3)";
  if (!options_.turn_over) {
    mesh_.notes_.push_back(note + ": a finger would feel it from within; --turn-over turns it over");
    return;
  }
  mesh_.notes_.push_back(note + ": turned over");
  turn_over(inside_out.found, mesh_.vertices_, mesh_.links_);
  CornerNormals normals{std::move(mesh_.normals_), std::move(mesh_.normal_index_)};
  turn_normals_over(inside_out.found, surface(), normals);
  mesh_.normals_ = std::move(normals.normals);
  mesh_.normal_index_ = std::move(normals.index);
}

bool ContactMeshBuilder::finds_concave_crease() const {
  for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if ((mesh_.crease_bits_[t] >> k & 1u) && mesh_.concave_crease(t, k)) return true;
  return false;
}

void ContactMeshBuilder::finish() {
  mesh_.crease_bits_ = feature_bits(surface(), CornerNormalsView{mesh_.normals_, mesh_.normal_index_}, run_both_);
  mesh_.has_concave_crease_ = finds_concave_crease();
  mesh_.is_body_ = is_body(surface());
  mesh_.flat_regions_ = FlatRegions::build(mesh_, run_both_);
  mesh_.crowded_ = crowded_vertices(mesh_);
  mesh_.name_ = source_.name;
}

tl::unexpected<Error> ContactMeshBuilder::nothing_usable() const {
  std::string what = "the mesh has no usable triangle";
  for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
    const MeshDefectList& list = mesh_.defects_[i];
    if (list.count == 0) continue;
    what += std::string(i == 0 || what.find(':') == std::string::npos ? ": " : ", ") + std::to_string(list.count) +
            " x " + to_string(static_cast<MeshDefect>(i)) + " (first: " + std::to_string(list.first[0]) + ")";
  }
  return fail(what, source_.name, "check that the file holds the surface and was exported whole");
}

Result<ContactMesh> ContactMesh::build(const PolygonMesh& source, const ContactMeshOptions& options,
                                       const RunBoth& run_both) {
  return build(source, options, run_both, {});
}

Result<ContactMesh> ContactMesh::build(const PolygonMesh& source, const ContactMeshOptions& options,
                                       const RunBoth& run_both, const OnContent& on_content) {
  const FloatState as_tested;
  return ContactMeshBuilder(source, options, run_both).build(on_content);
}

std::uint64_t MeshContent::hash() const {
  ContentHash hash;
  hash.add(std::span<const Vec3>(&origin, 1));
  hash.add(positions);
  hash.add(normals);
  hash.add(vertices);
  hash.add(normal_index);
  return hash.value();
}

const char* to_string(MeshDefect defect) {
  switch (defect) {
    case MeshDefect::face_under_three_corners:
      return "face under three corners";
    case MeshDefect::non_finite_vertex:
      return "vertex that is not finite";
    case MeshDefect::degenerate_triangle:
      return "degenerate triangle";
    case MeshDefect::duplicate_triangle:
      return "duplicate triangle";
    case MeshDefect::non_manifold_triangle:
      return "non-manifold triangle";
    case MeshDefect::bad_normal:
      return "bad normal";
    case MeshDefect::unreferenced_vertex:
      return "unreferenced vertex";
    case MeshDefect::count_:
      break;
  }
  return "unknown defect";
}

const CrowdedVertex* ContactMesh::crowded_vertex(std::uint32_t vertex) const {
  if (crowded_.empty()) return nullptr;
  const auto found = std::lower_bound(crowded_.begin(), crowded_.end(), vertex,
                                      [](const CrowdedVertex& c, std::uint32_t v) { return c.vertex < v; });
  return found != crowded_.end() && found->vertex == vertex ? &*found : nullptr;
}

bool ContactMesh::concave_crease(std::uint32_t t, std::uint32_t edge) const {
  const EdgeLink other = across(t, edge);
  if (other.triangle == kNone) return false;
  const Vec3& far_corner = position(other.triangle, (other.edge + 2) % 3);
  const Vec3& near_corner = position(t, (edge + 2) % 3);
  const Vec3 middle = 0.5 * (position(t, edge) + position(t, (edge + 1) % 3));
  const Vec3 near_normal = normal(t, edge) + normal(t, (edge + 1) % 3);
  const Vec3 far_normal = normal(other.triangle, other.edge) + normal(other.triangle, (other.edge + 1) % 3);
  return glm::dot(far_corner - middle, near_normal) + glm::dot(near_corner - middle, far_normal) > 0.0;
}

std::size_t ContactMesh::memory_bytes() const {
  const auto held = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t crowded = held(crowded_);
  for (const CrowdedVertex& c : crowded_) crowded += held(c.ring) + held(c.angles) + held(c.runs);
  return crowded + sizeof(*this) + held(positions_) + held(normals_) + held(vertices_) + held(normal_index_) +
         held(links_) + held(crease_bits_) + flat_regions_.memory_bytes();
}

}  // namespace tangent
