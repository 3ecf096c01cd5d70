// Nearest-triangle and ray queries on a contact mesh: Embree's BVH for the culling, in float and rounded
// outwards; distances exact in double in its callback. Ties go to the lowest triangle number.
// Or boxes about the triangles, cluster by cluster, each built when a query first comes to it: the same answers bit for
// bit, sooner on a large mesh that is just being opened, slower later.
// Queries are const, allocate nothing but those boxes, and may run from any number of threads.
#pragma once

#include "core/contact/triangle_clusters.h"

#include <cstddef>
#include <memory>
#include <span>

namespace tangent {

/// Closest point of one triangle to a query point. Local mesh coordinates.
struct NearestHit {
  std::uint32_t triangle = kNone;
  double distance_m = 0.0;
  double u = 0.0, v = 0.0;  ///< barycentric weights of corners 1 and 2 at the closest point
  Vec3 point{0.0};          ///< closest point of the flat triangle
  explicit operator bool() const { return triangle != kNone; }
};

NearestHit closest_on_triangle(const ContactMesh& mesh, std::uint32_t t, const Vec3& query);

class NearestTriangles {
 public:
  static Result<NearestTriangles> build(const ContactMesh& mesh);  ///< `mesh` must outlive it
  /// Without Embree. Both must outlive it.
  static NearestTriangles late(const ContactMesh& mesh, const TriangleClusters& clusters);
  NearestTriangles(NearestTriangles&&) noexcept;
  NearestTriangles& operator=(NearestTriangles&&) noexcept;
  ~NearestTriangles();

  /// Nearest triangle within `radius_m` (infinity allowed), none if there is none.
  NearestHit nearest(const Vec3& query, double radius_m) const;

  /// The up to out.size() nearest triangles within `radius_m`, by distance, then number. Returns how many.
  /// Of a flat region of slivers one stands for all (mesh/flat_regions.h).
  std::size_t nearest_several(const Vec3& query, double radius_m, std::span<NearestHit> out) const;

  struct RayHit {
    std::uint32_t triangle = kNone;
    double distance_m = 0.0, u = 0.0, v = 0.0;
    explicit operator bool() const { return triangle != kNone; }
  };
  /// First flat triangle along a ray (both sides count); direction: unit.
  RayHit cast(const Vec3& origin, const Vec3& direction) const;

  std::size_t part_count() const;  ///< what is built late, 0: nothing
  void build_part(std::size_t part) const;
  bool has_part(std::size_t part) const;
  std::size_t memory_bytes() const;  ///< of what is built; Embree's as it reports it to its memory monitor

 private:
  struct Impl;
  explicit NearestTriangles(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
