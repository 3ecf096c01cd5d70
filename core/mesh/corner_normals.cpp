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
  Vec3 sum;
  double weights;

  void add(double angle, const Vec3& face) {
    sum += angle * face;
    weights += angle;
  }
  bool cancelled() const { return !(glm::dot(sum, sum) > kCancelledNormal * kCancelledNormal * weights * weights); }
};

/// Normals of vertices where no sharp edge ends, all of which are one fan.
class PlainVertices {
 public:
  PlainVertices(const SurfaceView& s, std::span<const Vec3> faces, std::span<const std::uint8_t> sharp,
                const RunBoth& run_both)
      : s_(s), faces_(faces), sharp_(sharp), run_both_(run_both), sums_(s.positions.size()), cut_(s.positions.size()) {}

  /// Fills what it can of `out` and returns whether that was all.
  bool fill(CornerNormals& out) {
    add_up();
    run_halves(run_both_, sums_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        cut_[v] = cut_[v] || sums_[v].cancelled();
        if (!cut_[v]) sums_[v].sum = unit(sums_[v].sum);
      }
    });
    number(out.normals);
    out.index.resize(s_.triangles.size());
    std::array<bool, 2> complete{true, true};
    run_halves(run_both_, s_.triangles.size(), [&](std::size_t first, std::size_t last) {
      bool all = true;
      for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
        const bool used = s_.used(t);
        for (std::uint32_t k = 0; k < 3; ++k) {
          out.index[t][k] = used ? slot_[s_.triangles[t][k]] : kNone;
          all = all && (!used || out.index[t][k] != kNone);
        }
      }
      if (!all) complete[first == 0 ? 0 : 1] = false;
    });
    return complete[0] && complete[1];
  }

 private:
  /// Triangle by triangle, in file order: a walk about every vertex instead misses the caches at each step when
  /// triangles come in random order. The angles of many triangles at once, by halves of them, then the sums by halves
  /// of the vertices, each in order.
  void add_up() {
    run_halves(run_both_, sums_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v) {
        sums_[v] = {Vec3(0.0), 0.0};
        cut_[v] = 0;
      }
    });
    constexpr std::size_t kBlock = std::size_t{1} << 18;
    Unfilled<Vec3> block(std::min(kBlock, s_.triangles.size()));
    for (std::size_t begin = 0; begin < s_.triangles.size(); begin += kBlock) {
      const std::size_t count = std::min(kBlock, s_.triangles.size() - begin);
      run_halves(run_both_, count, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const auto t = static_cast<std::uint32_t>(begin + i);
          if (s_.used(t)) block[i] = angles(s_, t);
        }
      });
      run_halves(run_both_, sums_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = 0; i < count; ++i) add(static_cast<std::uint32_t>(begin + i), block[i], first, last);
      });
    }
  }

  /// A triangle, to those of its vertices that are in [first, last).
  void add(std::uint32_t t, const Vec3& angle, std::size_t first, std::size_t last) {
    if (!s_.used(t)) return;
    const Index3& v = s_.triangles[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (v[k] < first || v[k] >= last) continue;
      sums_[v[k]].add(angle[static_cast<int>(k)], faces_[t]);
      if (sharp_[t] & (bit(k) | bit(previous3(k)))) cut_[v[k]] = 1;
    }
  }

  void number(UnfilledVector<Vec3>& normals) {
    slot_.resize(sums_.size());
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < slot_.size(); ++v) slot_[v] = cut_[v] ? kNone : count++;
    normals.resize(count);
    run_halves(run_both_, slot_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v)
        if (!cut_[v]) normals[slot_[v]] = sums_[v].sum;
    });
  }

  const SurfaceView& s_;
  std::span<const Vec3> faces_;
  std::span<const std::uint8_t> sharp_;
  const RunBoth& run_both_;
  UnfilledVector<WeightedNormal> sums_;
  UnfilledVector<std::uint8_t> cut_;  ///< a sharp edge ends there, or the sum cancels
  UnfilledVector<std::uint32_t> slot_;
};

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

Unfilled<Vec3> face_normals(const SurfaceView& s, const RunBoth& run_both) {
  Unfilled<Vec3> faces(s.triangles.size());
  run_halves(run_both, faces.size(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
      faces[t] = s.used(t) ? face_normal(s.position({t, 0}), s.position({t, 1}), s.position({t, 2})) : Vec3(0.0);
  });
  return faces;
}

std::vector<std::uint8_t> sharp_edges(const SurfaceView& s, std::span<const Vec3> faces, double crease_rad,
                                      const RunBoth& run_both) {
  std::vector<std::uint8_t> sharp(s.triangles.size(), 0);
  // angle > limit <=> sin(angle - limit) > 0, since the difference lies within (-pi, pi): no arc functions, and exact
  // for small and large limits alike. At pi nothing exceeds the limit.
  const double limit = crease_rad + kCreaseSlack;
  if (limit >= std::numbers::pi) return sharp;
  const double cos_limit = std::cos(limit), sin_limit = std::sin(limit);
  const auto is_sharp = [&](const Vec3& a, const Vec3& b) {
    const Vec3 x = glm::cross(a, b);
    const double cos_angle = glm::dot(a, b), sin_angle = std::sqrt(glm::dot(x, x));
    return sin_angle * cos_limit - cos_angle * sin_limit > 0.0;
  };
  run_halves(run_both, sharp.size(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!s.used(t)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t across = s.links[t][k], other = across >> 2;
        const bool here = other >= first && other < last;  // else the other half sees to its own side
        if (across == kNone || (here && other < t) || !is_sharp(faces[t], faces[other])) continue;
        set_bit(sharp[t], k);
        if (here) set_bit(sharp[other], across & 3u);
      }
    }
  });
  return sharp;
}

CornerNormals computed_normals(const SurfaceView& s, std::span<const Vec3> faces, std::span<const std::uint8_t> sharp,
                               const RunBoth& run_both) {
  CornerNormals out;
  if (PlainVertices(s, faces, sharp, run_both).fill(out)) return out;
  std::vector<Corner> fan;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    if (!s.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (out.index[t][k] != kNone) continue;
      collect_fan(s, sharp, {t, k}, fan);
      WeightedNormal normal{Vec3(0.0), 0.0};
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

std::vector<std::uint8_t> feature_bits(const SurfaceView& s, const CornerNormalsView& normals,
                                       const RunBoth& run_both) {
  std::vector<std::uint8_t> bits(s.triangles.size(), 0);
  std::array<std::vector<bool>, 2> feature;  // by vertex, as met in either half
  for (std::vector<bool>& half : feature) half.assign(s.positions.size(), false);
  const auto differ = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b) return false;
    const Vec3 d = normals.normals[a] - normals.normals[b];
    return glm::dot(d, d) > kSameNormal * kSameNormal;
  };
  // The neighbour runs the edge the other way: its corners are swapped.
  const auto is_crease = [&](std::uint32_t t, std::uint32_t k, std::uint32_t across) {
    const Index3 &mine = normals.index[t], &other = normals.index[across >> 2];
    const std::uint32_t f = across & 3u;
    return differ(mine[k], other[next3(f)]) || differ(mine[next3(k)], other[f]);
  };
  run_halves(run_both, bits.size(), [&](std::size_t first, std::size_t last) {
    std::vector<bool>& met = feature[first == 0 ? 0 : 1];
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!s.used(t)) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t across = s.links[t][k];
        if (across != kNone && !is_crease(t, k, across)) continue;
        if (across != kNone) set_bit(bits[t], k);
        met[s.triangles[t][k]] = met[s.triangles[t][next3(k)]] = true;
      }
    }
  });
  run_halves(run_both, bits.size(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!s.used(t)) continue;
      for (std::uint32_t k = 0; k < 3; ++k)
        if (feature[0][s.triangles[t][k]] || feature[1][s.triangles[t][k]]) set_bit(bits[t], 3 + k);
    }
  });
  return bits;
}

}  // namespace tangent
