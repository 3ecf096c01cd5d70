#include "core/mesh/corner_normals.h"

#include "core/base/tolerances.h"
#include "core/mesh/triangle_shape.h"

#include <numbers>

namespace tangent {
namespace {

constexpr std::uint32_t bit(std::uint32_t k) { return 1u << k; }

void set_bit(std::uint8_t& bits, std::uint32_t k) { bits = static_cast<std::uint8_t>(bits | bit(k)); }

/// Interior angles of a triangle, radians.
Vec3 angles(const SurfaceView& s, std::uint32_t t) {
  const Vec3 &a = s.position({t, 0}), &b = s.position({t, 1}), &c = s.position({t, 2});
  const Vec3 n = area_vector(a, b, c);  // the cross product at every corner has this length
  const double twice_area = std::sqrt(glm::dot(n, n));
  return {std::atan2(twice_area, glm::dot(b - a, c - a)), std::atan2(twice_area, glm::dot(c - b, a - b)),
          std::atan2(twice_area, glm::dot(a - c, b - c))};
}

/// A sum of face normals, weighted by angle.
struct WeightedNormal {
  Vec3 sum{0.0};
  double weights = 0.0;

  void add(double angle, const Vec3& face) {
    sum += angle * face;
    weights += angle;
  }
  bool cancelled() const { return !(glm::dot(sum, sum) > kCancelledNormal * kCancelledNormal * weights * weights); }
};

/// Vertices where no sharp edge ends have one normal: summed triangle by triangle, in file order. A walk about
/// every vertex instead misses the caches at each step when triangles come in random order.
void normals_at_plain_vertices(const SurfaceView& s, std::span<const Vec3> faces, std::span<const std::uint8_t> sharp,
                               const RunBoth& run_both, CornerNormals& out) {
  std::vector<WeightedNormal> sums(s.positions.size());
  std::vector<bool> cut(s.positions.size(), false);
  // The angles of many triangles at once, their sums in order.
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  std::vector<Vec3> block(std::min(kBlock, s.triangles.size()));
  for (std::size_t begin = 0; begin < s.triangles.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, s.triangles.size() - begin);
    run_halves(run_both, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto t = static_cast<std::uint32_t>(begin + i);
        if (s.used(t)) block[i] = angles(s, t);
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto t = static_cast<std::uint32_t>(begin + i);
      if (!s.used(t)) continue;
      const Index3& v = s.triangles[t];
      for (std::uint32_t k = 0; k < 3; ++k) {
        sums[v[k]].add(block[i][static_cast<int>(k)], faces[t]);
        if (sharp[t] & bit(k)) cut[v[k]] = cut[v[next3(k)]] = true;
      }
    }
  }
  std::vector<std::uint32_t> slot(s.positions.size(), kNone);
  for (std::size_t v = 0; v < slot.size(); ++v) {
    if (cut[v] || sums[v].cancelled()) continue;
    slot[v] = static_cast<std::uint32_t>(out.normals.size());
    out.normals.push_back(unit(sums[v].sum));
  }
  run_halves(run_both, s.triangles.size(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!s.used(t)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) out.index[t][k] = slot[s.triangles[t][k]];
    }
  });
}

/// The corners of one smooth fan, counter-clockwise, without crossing a sharp edge.
void collect_fan(const SurfaceView& s, std::span<const std::uint8_t> sharp, Corner start, std::vector<Corner>& fan) {
  const auto left = [&](Corner c) { return sharp[c.triangle] & bit(edge_left(c)) ? Corner{} : turn_left(s.links, c); };
  const auto right = [&](Corner c) {
    return sharp[c.triangle] & bit(edge_right(c)) ? Corner{} : turn_right(s.links, c);
  };
  // Beginning at the fan's right end makes the order of summation the fan's own, not that of the triangles.
  Corner first = start;
  for (Corner c = right(start); !c.none(); c = right(c)) {
    if (c == start) {
      first = start;
      break;
    }
    first = c;
  }
  fan.clear();
  fan.push_back(first);
  for (Corner c = left(first); !c.none() && c != first; c = left(c)) fan.push_back(c);
}

}  // namespace

std::vector<Vec3> face_normals(const SurfaceView& s) {
  std::vector<Vec3> faces(s.triangles.size(), Vec3(0.0));
  for (std::uint32_t t = 0; t < faces.size(); ++t) {
    if (!s.used(t)) continue;
    faces[t] = face_normal(s.position({t, 0}), s.position({t, 1}), s.position({t, 2}));
  }
  return faces;
}

std::vector<std::uint8_t> sharp_edges(const SurfaceView& s, std::span<const Vec3> faces, double crease_rad) {
  std::vector<std::uint8_t> sharp(s.triangles.size(), 0);
  // angle > limit <=> sin(angle - limit) > 0, since the difference lies within (-pi, pi): no arc functions, and exact
  // for small and large limits alike. At pi nothing exceeds the limit.
  const double limit = crease_rad + kCreaseSlack;
  if (limit >= std::numbers::pi) return sharp;
  const double cos_limit = std::cos(limit), sin_limit = std::sin(limit);
  for (std::uint32_t t = 0; t < sharp.size(); ++t) {
    if (!s.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t across = s.links[t][k];
      if (across == kNone || across >> 2 < t) continue;
      const Vec3 x = glm::cross(faces[t], faces[across >> 2]);
      const double cos_angle = glm::dot(faces[t], faces[across >> 2]), sin_angle = std::sqrt(glm::dot(x, x));
      if (sin_angle * cos_limit - cos_angle * sin_limit <= 0.0) continue;
      set_bit(sharp[t], k);
      set_bit(sharp[across >> 2], across & 3u);
    }
  }
  return sharp;
}

CornerNormals computed_normals(const SurfaceView& s, std::span<const Vec3> faces, std::span<const std::uint8_t> sharp,
                               const RunBoth& run_both) {
  CornerNormals out;
  out.normals.reserve(s.positions.size());
  out.index.assign(s.triangles.size(), {kNone, kNone, kNone});
  normals_at_plain_vertices(s, faces, sharp, run_both, out);
  std::vector<Corner> fan;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    if (!s.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (out.index[t][k] != kNone) continue;
      collect_fan(s, sharp, {t, k}, fan);
      WeightedNormal normal;
      for (const Corner& c : fan) normal.add(angles(s, c.triangle)[static_cast<int>(c.corner)], faces[c.triangle]);
      const bool cancelled = normal.cancelled();
      if (!cancelled) out.normals.push_back(unit(normal.sum));
      for (const Corner& c : fan) {
        if (cancelled) out.normals.push_back(faces[c.triangle]);
        out.index[c.triangle][c.corner] = static_cast<std::uint32_t>(out.normals.size() - 1);
      }
    }
  }
  return out;
}

std::vector<std::uint8_t> feature_bits(const SurfaceView& s, const CornerNormalsView& normals) {
  std::vector<std::uint8_t> bits(s.triangles.size(), 0);
  std::vector<bool> feature(s.positions.size(), false);
  const auto differ = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b) return false;
    const Vec3 d = normals.normals[a] - normals.normals[b];
    return glm::dot(d, d) > kSameNormal * kSameNormal;
  };
  for (std::uint32_t t = 0; t < bits.size(); ++t) {
    if (!s.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t across = s.links[t][k], k1 = next3(k);
      if (across != kNone) {  // the neighbour runs the edge the other way: its corners are swapped
        const Index3 &mine = normals.index[t], &other = normals.index[across >> 2];
        const std::uint32_t f = across & 3u;
        if (!differ(mine[k], other[next3(f)]) && !differ(mine[k1], other[f])) continue;
        set_bit(bits[t], k);
      }
      feature[s.triangles[t][k]] = true;
      feature[s.triangles[t][k1]] = true;
    }
  }
  for (std::uint32_t t = 0; t < bits.size(); ++t) {
    if (!s.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      if (feature[s.triangles[t][k]]) set_bit(bits[t], 3 + k);
  }
  return bits;
}

}  // namespace tangent
