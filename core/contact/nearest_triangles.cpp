#include "core/contact/nearest_triangles.h"

#include "core/base/built_once.h"
#include "core/base/triangle.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cfloat>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

float round_down(double x) {
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) {
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// Embree culls a box in float. This much more radius makes up for the rounding of the query point, of the
/// box distance and of the radius itself, so that no triangle within the true radius is culled.
float culling_radius(double radius, double coordinate_scale) {
  if (!(radius < 1e37)) return std::numeric_limits<float>::infinity();
  return round_up(radius * (1.0 + 8.0 * FLT_EPSILON) + 8.0 * FLT_EPSILON * coordinate_scale);
}

double largest_coordinate(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

bool nearer(const NearestHit& a, const NearestHit& b) {
  return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.triangle < b.triangle);
}

/// The k nearest so far, sorted; k is small, so insertion is enough.
struct Collector {
  const ContactMesh* mesh;
  Vec3 query;
  double radius;
  double coordinate_scale;
  std::span<NearestHit> out;
  std::size_t size = 0;

  bool offer(std::uint32_t t) {
    const NearestHit hit = closest_on_triangle(*mesh, t, query);
    if (hit.distance_m > radius) return false;
    if (size == out.size()) {
      if (!nearer(hit, out[size - 1])) return false;
    } else {
      ++size;
    }
    std::size_t i = size - 1;
    for (; i > 0 && nearer(hit, out[i - 1]); --i) out[i] = out[i - 1];
    out[i] = hit;
    if (size < out.size()) return false;
    radius = out[size - 1].distance_m;
    return true;
  }
};

/// A flat region of slivers is one primitive, its first triangle's: boxes around slivers overlap all over.
bool stands_for_region(const ContactMesh& mesh, std::uint32_t t) {
  const std::uint32_t region = mesh.flat_regions().of(t);
  return region != kNone && mesh.flat_regions().triangles(region).front() == t;
}

bool on_point_query(RTCPointQueryFunctionArguments* args) {
  auto& collector = *static_cast<Collector*>(args->userPtr);
  std::uint32_t t = args->primID;
  const ContactMesh& mesh = *collector.mesh;
  if (stands_for_region(mesh, t))
    t = mesh.flat_regions().foot(mesh, mesh.flat_regions().of(t), collector.query).triangle;
  if (!collector.offer(t)) return false;
  args->query->radius = culling_radius(collector.radius, collector.coordinate_scale);
  return true;
}

void on_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& mesh = *static_cast<const ContactMesh*>(args->geometryUserPtr);
  RTCBounds& b = *args->bounds_o;
  // An empty box: Embree leaves the primitive out.
  if (!mesh.usable(args->primID) ||
      (mesh.flat_regions().of(args->primID) != kNone && !stands_for_region(mesh, args->primID))) {
    b.lower_x = b.lower_y = b.lower_z = std::numeric_limits<float>::infinity();
    b.upper_x = b.upper_y = b.upper_z = -std::numeric_limits<float>::infinity();
    return;
  }
  Box box;
  const std::uint32_t t = args->primID, region = mesh.flat_regions().of(t);
  if (region == kNone) {
    for (const Vec3& p : mesh.positions(t)) box.include(p);
  } else {
    for (const std::uint32_t other : mesh.flat_regions().triangles(region))
      for (const Vec3& p : mesh.positions(other)) box.include(p);
  }
  b.lower_x = round_down(box.min.x);
  b.lower_y = round_down(box.min.y);
  b.lower_z = round_down(box.min.z);
  b.upper_x = round_up(box.max.x);
  b.upper_y = round_up(box.max.y);
  b.upper_z = round_up(box.max.z);
}

/// Ray against a flat triangle in double; both sides count. Returns the distance, or infinity.
double intersect(const ContactMesh& mesh, std::uint32_t t, const Vec3& origin, const Vec3& direction, double& u,
                 double& v) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Vec3& a = mesh.position(t, 0);
  const Vec3 ab = mesh.position(t, 1) - a, ac = mesh.position(t, 2) - a;
  const Vec3 p = glm::cross(direction, ac);
  const double det = glm::dot(ab, p);
  if (det == 0.0) return kMiss;
  const Vec3 s = origin - a;
  u = glm::dot(s, p) / det;
  const Vec3 q = glm::cross(s, ab);
  v = glm::dot(direction, q) / det;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return kMiss;
  const double distance = glm::dot(ac, q) / det;
  return distance >= 0.0 ? distance : kMiss;
}

struct RayContext {
  RTCIntersectContext context;  // first: Embree hands back a pointer to it
  Vec3 origin, direction;
  NearestTriangles::RayHit best;
};

/// The triangle of a primitive that a ray can cross: of a region, where it goes through its plane.
std::uint32_t crossed_triangle(const ContactMesh& mesh, std::uint32_t t, const Vec3& origin, const Vec3& direction) {
  if (!stands_for_region(mesh, t)) return t;
  const FlatRegions& flat = mesh.flat_regions();
  const std::uint32_t region = flat.of(t);
  const double speed = glm::dot(direction, flat.normal(region));
  if (speed == 0.0) return t;
  const double way = glm::dot(flat.origin(region) - origin, flat.normal(region)) / speed;
  return flat.foot(mesh, region, origin + way * direction).triangle;
}

void on_intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] != -1) return;
  const auto& mesh = *static_cast<const ContactMesh*>(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RayContext*>(args->context);
  double u = 0.0, v = 0.0;
  const std::uint32_t t = crossed_triangle(mesh, args->primID, ray.origin, ray.direction);
  const double distance = intersect(mesh, t, ray.origin, ray.direction, u, v);
  const bool better =
      !ray.best || distance < ray.best.distance_m || (distance == ray.best.distance_m && t < ray.best.triangle);
  if (!std::isfinite(distance) || !better) return;
  ray.best = {t, distance, u, v};
  auto* hit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  hit->ray.tfar = round_up(distance * (1.0 + 4.0 * FLT_EPSILON));
  hit->hit.primID = args->primID;
  hit->hit.geomID = args->geomID;
}

/// Square of the distance along a ray at which it enters a box, 0 from inside, -1: it passes by.
double entry2(const Vec3& low, const Vec3& high, const Vec3& origin, const Vec3& direction) {
  constexpr double kRoom = 1e-12;  // ratio: more than the rounding of a quotient
  double first = 0.0, last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (origin[k] < low[k] || origin[k] > high[k]) return -1.0;
      continue;
    }
    const double a = (low[k] - origin[k]) / direction[k], b = (high[k] - origin[k]) / direction[k];
    first = std::max(first, std::min(a, b) * (1.0 - kRoom));
    last = std::min(last, std::max(a, b) * (1.0 + kRoom));
  }
  return first <= last ? first * first : -1.0;
}

bool on_memory(void* counter, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<std::int64_t>*>(counter)->fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

}  // namespace

NearestHit closest_on_triangle(const ContactMesh& mesh, std::uint32_t t, const Vec3& query) {
  const TrianglePoint p =
      closest_point_on_triangle(mesh.position(t, 0), mesh.position(t, 1), mesh.position(t, 2), query);
  return {t, std::sqrt(p.distance2), p.u, p.v, p.point};
}

struct NearestTriangles::Impl {
  const ContactMesh* mesh = nullptr;
  const TriangleClusters* clusters = nullptr;   ///< null: by Embree
  std::unique_ptr<BuiltOnce<BoxTree>[]> parts;  ///< boxes about each cluster's triangles
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double extent;  ///< largest local coordinate of the mesh
  std::atomic<std::int64_t> bytes{0};

  Impl(const ContactMesh& of, const TriangleClusters* by)
      : mesh(&of),
        clusters(by),
        extent(std::max(largest_coordinate(of.bounds().min), largest_coordinate(of.bounds().max))) {
    if (by) parts = std::make_unique<BuiltOnce<BoxTree>[]>(by->count());
  }
  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Null: where this thread makes nothing (MakesNothing) and it is not built.
  const BoxTree* part(std::size_t cluster) const {
    return parts[cluster].find([&] {
      constexpr std::size_t kLeafTriangles = 4;
      std::vector<FloatBox> boxes;
      for (const std::uint32_t t : clusters->triangles(cluster)) {
        Box box;
        for (std::uint32_t k = 0; k < 3; ++k) box.include(mesh->position(t, k));
        boxes.push_back(FloatBox::about(box));
      }
      return BoxTree::build(boxes, kLeafTriangles);
    });
  }

  /// Calls visit(triangle) for those in boxes within reach (box_tree.h).
  template <class Reach, class Farthest, class Visit>
  void visit(const Reach& reach2, const Farthest& farthest2, const Visit& visit) const {
    clusters->tree().visit(reach2, farthest2, [&](std::uint32_t cluster) {
      const std::span<const std::uint32_t> triangles = clusters->triangles(cluster);
      const BoxTree* boxes = part(cluster);
      if (!boxes) {  // any triangle will do: what comes of it is thrown away
        visit(triangles.front());
        return false;
      }
      return boxes->visit(reach2, farthest2, [&](std::uint32_t i) {
        visit(triangles[i]);
        return true;
      });
    });
  }

  void collect(Collector& collector) const;
  RayHit cast(const Vec3& origin, const Vec3& direction) const;
};

void NearestTriangles::Impl::collect(Collector& collector) const {
  if (clusters) {
    constexpr double kRoom = 1e-9;  // ratio: a distance may be rounded up, that of its box down
    return visit([&](const Vec3& low, const Vec3& high) { return distance2_to_box(low, high, collector.query); },
                 [&] { return collector.radius * collector.radius * (1.0 + kRoom); },
                 [&](std::uint32_t t) { collector.offer(t); });
  }
  RTCPointQuery q{};
  q.x = static_cast<float>(collector.query.x);
  q.y = static_cast<float>(collector.query.y);
  q.z = static_cast<float>(collector.query.z);
  q.radius = culling_radius(collector.radius, collector.coordinate_scale);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &q, &context, on_point_query, &collector);
}

NearestTriangles::RayHit NearestTriangles::Impl::cast(const Vec3& origin, const Vec3& direction) const {
  RayHit best;
  best.distance_m = std::numeric_limits<double>::infinity();
  visit(
      [&](const Vec3& low, const Vec3& high) { return entry2(low, high, origin, direction); },
      [&] { return best.distance_m * best.distance_m; },
      [&](std::uint32_t t) {
        double u = 0.0, v = 0.0;
        const double distance = intersect(*mesh, t, origin, direction, u, v);
        if (distance < best.distance_m || (distance == best.distance_m && t < best.triangle && std::isfinite(distance)))
          best = {t, distance, u, v};
      });
  return best ? best : RayHit{};
}

NearestTriangles::NearestTriangles(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
NearestTriangles::NearestTriangles(NearestTriangles&&) noexcept = default;
NearestTriangles& NearestTriangles::operator=(NearestTriangles&&) noexcept = default;
NearestTriangles::~NearestTriangles() = default;

#if defined(__SANITIZE_THREAD__)
// TBB isn't built with the thread sanitizer, which can't see how its workers wait for each other: none, then.
static constexpr const char* kEmbreeConfig = "threads=1";
#else
static constexpr const char* kEmbreeConfig = nullptr;
#endif

/// Without a device its error is that of the thread.
static tl::unexpected<Error> not_started() {
  if (rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU)
    return fail("Embree could not be started", "nearest-triangle query", "the processor needs SSE2");
  return fail("not enough memory to start Embree", "nearest-triangle query", "free some memory or decimate the mesh");
}

Result<NearestTriangles> NearestTriangles::build(const ContactMesh& mesh) {
  auto impl = std::make_unique<Impl>(mesh, nullptr);
  impl->device = rtcNewDevice(kEmbreeConfig);
  if (!impl->device) return not_started();
  rtcSetDeviceMemoryMonitorFunction(impl->device, on_memory, &impl->bytes);
  impl->scene = rtcNewScene(impl->device);
  RTCGeometry geometry = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, mesh.triangle_count());
  // Embree wants a mutable pointer; nothing is written through it.
  rtcSetGeometryUserData(geometry, const_cast<ContactMesh*>(&mesh));
  rtcSetGeometryBoundsFunction(geometry, on_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, on_intersect);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(impl->scene, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(impl->scene);
  if (rtcGetDeviceError(impl->device) != RTC_ERROR_NONE)
    return fail("Embree could not build the query structure of " + std::to_string(mesh.triangle_count()) + " triangles",
                "nearest-triangle query", "free some memory or decimate the mesh");
  return NearestTriangles(std::move(impl));
}

NearestTriangles NearestTriangles::late(const ContactMesh& mesh, const TriangleClusters& clusters) {
  return NearestTriangles(std::make_unique<Impl>(mesh, &clusters));
}

NearestHit NearestTriangles::nearest(const Vec3& query, double radius_m) const {
  NearestHit hit;
  nearest_several(query, radius_m, {&hit, 1});
  return hit;
}

std::size_t NearestTriangles::nearest_several(const Vec3& query, double radius_m, std::span<NearestHit> out) const {
  if (out.empty() || !is_finite(query) || !(radius_m >= 0.0)) return 0;
  // Very far away (10^5 mesh sizes) float can't tell the triangles apart; from the point where the segment
  // to the query enters that range the nearest triangles are the same to 1e-5 of the mesh's size.
  Vec3 from = query;
  const double scale = largest_coordinate(query), limit = 1e5 * impl_->extent;
  if (scale > limit) from = query * (limit / scale);
  Collector collector{impl_->mesh, from, radius_m, std::max(largest_coordinate(from), impl_->extent), out};
  if (scale > limit) collector.radius = std::numeric_limits<double>::infinity();

  impl_->collect(collector);
  if (scale > limit) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < collector.size; ++i) {
      const NearestHit hit = closest_on_triangle(*impl_->mesh, out[i].triangle, query);
      if (hit.distance_m <= radius_m) out[kept++] = hit;
    }
    collector.size = kept;
  }
  return collector.size;
}

NearestTriangles::RayHit NearestTriangles::cast(const Vec3& origin, const Vec3& direction) const {
  if (impl_->clusters) return impl_->cast(origin, direction);
  RayContext ray{};
  rtcInitIntersectContext(&ray.context);
  ray.origin = origin;
  ray.direction = direction;
  RTCRayHit hit{};
  hit.ray.org_x = static_cast<float>(origin.x);
  hit.ray.org_y = static_cast<float>(origin.y);
  hit.ray.org_z = static_cast<float>(origin.z);
  hit.ray.dir_x = static_cast<float>(direction.x);
  hit.ray.dir_y = static_cast<float>(direction.y);
  hit.ray.dir_z = static_cast<float>(direction.z);
  hit.ray.tfar = std::numeric_limits<float>::infinity();
  hit.ray.mask = 0xFFFFFFFFu;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &ray.context, &hit);
  return ray.best;
}

std::size_t NearestTriangles::part_count() const { return impl_->clusters ? impl_->clusters->count() : 0; }

void NearestTriangles::build_part(std::size_t part) const { impl_->part(part); }
bool NearestTriangles::has_part(std::size_t part) const { return impl_->parts[part].if_built() != nullptr; }

std::size_t NearestTriangles::memory_bytes() const {
  if (impl_->clusters) {
    std::size_t bytes = part_count() * sizeof(impl_->parts[0]);
    for (std::size_t i = 0; i < part_count(); ++i)
      if (const BoxTree* built = impl_->parts[i].if_built()) bytes += sizeof(*built) + built->memory_bytes();
    return bytes;
  }
  return static_cast<std::size_t>(std::max<std::int64_t>(0, impl_->bytes.load()));
}

}  // namespace tangent
