#include "core/lab/explain/mended_mesh.h"

#include "core/base/angle.h"
#include "core/base/tolerances.h"
#include "core/contact/nearest_triangles.h"
#include "core/mesh/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tangent {
namespace {

constexpr int kRings = 6;
constexpr std::size_t kMostTriangles = 400;
constexpr double kShortSide = 0.05;  // of the longest: a sliver with a shorter one is a needle, else a low cap

std::vector<std::uint32_t> rings_around(const ContactMesh& mesh, std::span<const std::uint32_t> around) {
  std::vector<std::uint32_t> found(around.begin(), around.end());
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::size_t ring_begin = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const std::size_t ring_end = found.size();
    for (std::size_t i = ring_begin; i < ring_end && found.size() < kMostTriangles; ++i) {
      for (std::uint32_t e = 0; e < 3; ++e) {
        const std::uint32_t next = mesh.across(found[i], e).triangle;
        if (next != kNone && std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
      }
    }
    ring_begin = ring_end;
  }
  return found;
}

/// A triangle of the copy, with what its corners had in the mesh.
struct CopiedTriangle {
  std::uint32_t source = kNone;
  std::array<std::uint32_t, 3> vertex{};
  std::array<Vec3, 3> normal;
};

class Copy {
 public:
  Copy(const ContactMesh& mesh, std::span<const std::uint32_t> around) : mesh_(mesh) {
    for (const std::uint32_t t : rings_around(mesh, around))
      if (mesh.usable(t))
        triangles_.push_back({t, {mesh.vertex(t, 0), mesh.vertex(t, 1), mesh.vertex(t, 2)}, mesh.normals(t)});
  }

  bool mend_wild_normals() {
    bool any = false;
    std::vector<std::uint32_t> seen;
    for (const CopiedTriangle& t : triangles_) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (corner_to_face_deg(mesh_, t.source, k) <= kWildNormalDeg) continue;
        if (std::find(seen.begin(), seen.end(), t.vertex[k]) != seen.end()) continue;
        seen.push_back(t.vertex[k]);
        mend_normals_at(t.vertex[k]);
        any = true;
      }
    }
    return any;
  }

  bool mend_slivers() {
    bool any = false;
    for (std::size_t i = 0; i < triangles_.size(); ++i) any |= triangles_[i].source != kNone && mend_sliver(i);
    for (const std::uint32_t vertex : closed_) smooth_normals_at(vertex);
    std::erase_if(triangles_, [](const CopiedTriangle& t) { return t.source == kNone; });
    return any;
  }

  MendedScene build() const {
    MendedScene out;
    PolygonMesh mesh;
    std::unordered_map<std::uint32_t, std::uint32_t> index_of;
    for (const CopiedTriangle& t : triangles_) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [at, added] = index_of.try_emplace(t.vertex[k], static_cast<std::uint32_t>(mesh.positions.size()));
        if (added) mesh.positions.push_back(mesh_.origin() + mesh_.vertex_position(t.vertex[k]));
        mesh.corner_normal.push_back(static_cast<std::uint32_t>(mesh.normals.size()));
        mesh.normals.push_back(t.normal[k]);
        mesh.corner_position.push_back(at->second);
      }
      mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
      out.triangle_of.push_back(t.source);
    }
    ContactMeshOptions options;
    options.normals = NormalSource::file;
    auto built = ContactMesh::build(mesh, options);
    if (!built) return out;
    if (auto scene = ContactScene::build(std::move(*built))) out.scene = *scene;
    return out;
  }

 private:
  Vec3 position(std::uint32_t vertex) const { return mesh_.vertex_position(vertex); }

  /// All that point away from one of the faces that use them become the vertex' other normal or, where it has none,
  /// the mean of its faces.
  void mend_normals_at(std::uint32_t vertex) {
    std::vector<Vec3> wild;
    Vec3 mean(0.0), other(0.0);
    const auto each = [&](auto visit) {
      for (CopiedTriangle& t : triangles_)
        for (std::uint32_t k = 0; k < 3; ++k)
          if (t.vertex[k] == vertex) visit(t, k);
    };
    const auto is_wild = [&](const Vec3& n) {
      return std::any_of(wild.begin(), wild.end(), [&](const Vec3& w) { return glm::distance(n, w) <= kSameNormal; });
    };
    each([&](CopiedTriangle& t, std::uint32_t k) {
      const auto [a, b, c] = mesh_.positions(t.source);
      mean += face_normal(a, b, c);
      if (corner_to_face_deg(mesh_, t.source, k) > kWildNormalDeg) wild.push_back(t.normal[k]);
    });
    each([&](CopiedTriangle& t, std::uint32_t k) {
      if (!is_wild(t.normal[k])) other = t.normal[k];
    });
    const Vec3 mended = other != Vec3(0.0) ? other : mean;
    if (!(glm::dot(mended, mended) > 1e-12)) return;
    each([&](CopiedTriangle& t, std::uint32_t k) {
      if (is_wild(t.normal[k])) t.normal[k] = unit(mended);
    });
  }

  bool mend_sliver(std::size_t i) {
    CopiedTriangle& t = triangles_[i];
    std::array<double, 3> side{};
    for (std::uint32_t k = 0; k < 3; ++k)
      side[k] = glm::distance(position(t.vertex[k]), position(t.vertex[(k + 1) % 3]));
    const auto k_long = static_cast<std::uint32_t>(std::max_element(side.begin(), side.end()) - side.begin());
    const auto k_short = static_cast<std::uint32_t>(std::min_element(side.begin(), side.end()) - side.begin());
    const Vec3 a = position(t.vertex[0]), b = position(t.vertex[1]), c = position(t.vertex[2]);
    const double twice = glm::length(area_vector(a, b, c));
    if (twice * 1.0 > kSliverAspect * side[k_long] * side[k_long]) return false;
    if (side[k_short] < kShortSide * side[k_long]) {
      const std::uint32_t into = t.vertex[k_short];
      close_side(into, t.vertex[(k_short + 1) % 3]);
      closed_.push_back(into);
    } else {
      merge_cap(t, k_long);
    }
    return true;
  }

  void close_side(std::uint32_t into, std::uint32_t gone) {
    for (CopiedTriangle& t : triangles_) {
      for (std::uint32_t& v : t.vertex)
        if (v == gone) v = into;
      if (t.vertex[0] == t.vertex[1] || t.vertex[1] == t.vertex[2] || t.vertex[2] == t.vertex[0]) t.source = kNone;
    }
  }

  /// All corners there take the mean of the faces, each weighted by its angle: a sliver's share is gone from it.
  void smooth_normals_at(std::uint32_t vertex) {
    Vec3 mean(0.0);
    const auto each = [&](auto visit) {
      for (CopiedTriangle& t : triangles_)
        for (std::uint32_t k = 0; t.source != kNone && k < 3; ++k)
          if (t.vertex[k] == vertex) visit(t, k);
    };
    each([&](CopiedTriangle& t, std::uint32_t k) {
      const Vec3 a = position(t.vertex[k]), b = position(t.vertex[(k + 1) % 3]), c = position(t.vertex[(k + 2) % 3]);
      if (!is_degenerate(a, b, c)) mean += angle_between_deg(b - a, c - a) * face_normal(a, b, c);
    });
    if (!(glm::dot(mean, mean) > 1e-12)) return;
    each([&](CopiedTriangle& t, std::uint32_t k) { t.normal[k] = unit(mean); });
  }

  /// The cap's tip divides the triangle over its longest side, `k`, instead.
  void merge_cap(CopiedTriangle& cap, std::uint32_t k) {
    const std::uint32_t a = cap.vertex[k], b = cap.vertex[(k + 1) % 3];
    for (CopiedTriangle& other : triangles_) {
      if (other.source == kNone) continue;
      for (std::uint32_t m = 0; m < 3; ++m) {
        if (other.vertex[m] != b || other.vertex[(m + 1) % 3] != a) continue;
        const std::uint32_t tip = (k + 2) % 3, far = (m + 2) % 3, m_a = (m + 1) % 3;
        const CopiedTriangle first{cap.source,
                                   {a, other.vertex[far], cap.vertex[tip]},
                                   {other.normal[m_a], other.normal[far], cap.normal[tip]}};
        const CopiedTriangle second{other.source,
                                    {other.vertex[far], b, cap.vertex[tip]},
                                    {other.normal[far], other.normal[m], cap.normal[tip]}};
        cap = first;
        other = second;
        return;
      }
    }
    cap.source = kNone;
  }

  const ContactMesh& mesh_;
  std::vector<CopiedTriangle> triangles_;
  std::vector<std::uint32_t> closed_;  ///< vertices that short sides were closed to
};

/// The place of the copy that is nearest to the kept one.
void move_kept_plane(const ContactMesh& copy, TrackedPlane& plane) {
  double least = 1e300;
  for (std::uint32_t t = 0; t < copy.triangle_count(); ++t) {
    if (!copy.usable(t)) continue;
    const NearestHit hit = closest_on_triangle(copy, t, plane.point);
    if (hit.distance_m >= least) continue;
    least = hit.distance_m;
    plane.move_to(place_on_face(t, hit.u, std::min(hit.v, 1.0 - hit.u)));
  }
}

}  // namespace

double triangle_aspect(const ContactMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.positions(t);
  return longest_side2(a, b, c) / glm::length(area_vector(a, b, c));
}

double corner_to_face_deg(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner) {
  const auto [a, b, c] = mesh.positions(t);
  return angle_between_deg(mesh.normal(t, corner), face_normal(a, b, c));
}

MendedScene mend_around(const ContactMesh& mesh, std::span<const std::uint32_t> around, Mend mend) {
  Copy copy(mesh, around);
  const bool mended =
      mend == Mend::none || (mend == Mend::wild_normals ? copy.mend_wild_normals() : copy.mend_slivers());
  return mended ? copy.build() : MendedScene{};
}

std::optional<TickOutput> solve_on_copy(TickTrials& trials, const MendedScene& copy, const CopyTick& how) {
  if (!copy.scene) return std::nullopt;
  const ContactMesh& mesh = copy.scene->mesh();
  TickState state = trials.before;
  const Vec3 shift = trials.mesh().origin() - mesh.origin();
  state.plane.point += shift;
  state.last_converged.point += shift;
  state.proxy += shift;
  state.touched.count = 0;
  state.clearance = how.search ? Clearance{} : Clearance::unlimited();
  if (state.plane.feature != Feature::none) {
    const auto same = std::find(copy.triangle_of.begin(), copy.triangle_of.end(), state.plane.triangle);
    if (!how.settle && same != copy.triangle_of.end())
      state.plane.triangle = static_cast<std::uint32_t>(same - copy.triangle_of.begin());
    else
      move_kept_plane(mesh, state.plane);
  }
  Preset preset = trials.preset;
  preset.force.contacts = ForceContacts::deepest;
  Stepper stepper(copy.scene);
  if (how.settle && state.has_previous) {
    ++trials.solves;
    stepper.step(preset, {state.last_t_s, {state.last_position, state.last_orientation}}, state);
    if (!how.search) state.clearance = Clearance::unlimited();
  }
  ++trials.solves;
  return stepper.step(preset, trials.input, state);
}

}  // namespace tangent
