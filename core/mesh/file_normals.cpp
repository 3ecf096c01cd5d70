#include "core/mesh/file_normals.h"

#include "core/mesh/weld.h"

#include <algorithm>
#include <optional>

namespace tangent {
namespace {

constexpr double kAnyFinite = std::numeric_limits<double>::max();

/// Scaled by the largest component first: a normal of length 1e-200 has a direction too.
std::optional<Vec3> direction(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const double largest = std::max({a.x, a.y, a.z});
  if (!is_finite(n) || !(largest > 0.0)) return std::nullopt;
  return unit(n / largest);
}

/// Collects the normals that corners ask for, each stored once.
class NormalPool {
 public:
  NormalPool(const PolygonMesh& source, const std::function<CornerNormals()>& computed)
      : source_(source),
        compute_(computed),
        weld_(weld_exact(source.normals, kAnyFinite)),
        from_file_(weld_.count(), kNone),
        bad_(source.normals.size(), false) {}

  std::uint32_t pick(std::uint32_t source_normal, Corner corner, FileNormals& out) {
    if (source_normal == kNone) {
      ++out.missing;
      return fall_back(corner, out);
    }
    const std::uint32_t group = weld_.id[source_normal];
    if (group != kNone && from_file_[group] == kNone) {
      if (const auto n = direction(source_.normals[source_normal])) from_file_[group] = store(*n, out);
    }
    if (group == kNone || from_file_[group] == kNone) {
      if (!bad_[source_normal]) out.bad.add(source_normal);
      bad_[source_normal] = true;
      return fall_back(corner, out);
    }
    ++out.from_file;
    return from_file_[group];
  }

 private:
  static std::uint32_t store(const Vec3& n, FileNormals& out) {
    out.corners.normals.push_back(n);
    return static_cast<std::uint32_t>(out.corners.normals.size() - 1);
  }

  std::uint32_t fall_back(Corner c, FileNormals& out) {
    if (!computed_) {
      computed_ = compute_();
      from_computed_.assign(computed_->normals.size(), kNone);
    }
    const std::uint32_t i = computed_->index[c.triangle][c.corner];
    if (from_computed_[i] == kNone) from_computed_[i] = store(computed_->normals[i], out);
    return from_computed_[i];
  }

  const PolygonMesh& source_;
  const std::function<CornerNormals()>& compute_;
  Weld weld_;  // files repeat a normal per corner; stored once per value they take a third of the memory
  std::vector<std::uint32_t> from_file_, from_computed_;
  std::vector<bool> bad_;
  std::optional<CornerNormals> computed_;
};

}  // namespace

bool every_corner_has_normal(const PolygonMesh& source) {
  if (source.normals.empty() || source.corner_normal.empty()) return false;
  for (std::size_t f = 0; f < source.face_count(); ++f) {
    const auto begin = source.corner_normal.begin() + source.face_offsets[f];
    const auto end = source.corner_normal.begin() + source.face_offsets[f + 1];
    if (end - begin >= 3 && std::find(begin, end, kNone) != end) return false;
  }
  return true;
}

FileNormals file_normals(const PolygonMesh& source, const SurfaceView& surface,
                         const std::function<CornerNormals()>& computed) {
  FileNormals out;
  out.corners.index.assign(surface.triangles.size(), {kNone, kNone, kNone});
  NormalPool pool(source, computed);
  std::uint32_t t = 0;
  for (std::size_t f = 0; f < source.face_count(); ++f) {
    const std::uint32_t begin = source.face_offsets[f], end = source.face_offsets[f + 1];
    for (std::uint32_t k = begin + 2; k < end; ++k, ++t) {
      if (!surface.used(t)) continue;
      const Index3 slot{begin, k - 1, k};
      for (std::uint32_t c = 0; c < 3; ++c)
        out.corners.index[t][c] = pool.pick(source.corner_normal[slot[c]], {t, c}, out);
    }
  }
  std::sort(out.bad.first.begin(), out.bad.first.end());
  return out;
}

}  // namespace tangent
