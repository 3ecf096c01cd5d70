#include "workbench/bench/peers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <dlfcn.h>

namespace tangent::bench {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

PeerAnswer answer_of(const NearestHit& hit) { return {static_cast<bool>(hit), hit.point, hit.distance_m}; }

/// Culled in float, exact in double.
class EmbreeQuery final : public PeerQuery {
 public:
  explicit EmbreeQuery(const ContactScene& scene) : scene_(scene) {}
  PeerAnswer ask(const Vec3& centre) override { return answer_of(scene_.nearest().nearest(centre, kEverywhere)); }

 private:
  const ContactScene& scene_;
};

class BoundedQuery final : public PeerQuery {
 public:
  explicit BoundedQuery(const ContactScene& scene) : scene_(scene) {}
  PeerAnswer ask(const Vec3& centre) override {
    const double radius = last_ == kNone ? kEverywhere : closest_on_triangle(scene_.mesh(), last_, centre).distance_m;
    const NearestHit hit = scene_.nearest().nearest(centre, radius);
    last_ = hit.triangle;
    return answer_of(hit);
  }

 private:
  const ContactScene& scene_;
  std::uint32_t last_ = kNone;
};

using Corners = std::vector<std::array<Vec3, 3>>;

Corners corners_of(const ContactMesh& mesh) {
  Corners out;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.usable(t)) out.push_back({mesh.position(t, 0), mesh.position(t, 1), mesh.position(t, 2)});
  return out;
}

/// A library that is loaded when it is asked for.
struct Module {
  MissingPeer peer;
  const char* file;  ///< null: built without
  const char* query;
  const char* computes;
  const char* lacks;
};

#ifdef TANGENT_CGAL_MODULE
constexpr const char* kCgalFile = TANGENT_CGAL_MODULE;
#else
constexpr const char* kCgalFile = nullptr;
#endif
#ifdef TANGENT_BULLET_MODULE
constexpr const char* kBulletFile = TANGENT_BULLET_MODULE;
#else
constexpr const char* kBulletFile = nullptr;
#endif

constexpr const char* kNoSmooth = "smooth normal, force, display, tracking; the side of the mesh that the finger is on";
constexpr std::array kModules{
    Module{{"CGAL", "libcgal-dev"},
           kCgalFile,
           "cgal closest point",
           "nearest point of the raw mesh (AABB tree)",
           kNoSmooth},
    Module{{"Bullet", "libbullet-dev"},
           kBulletFile,
           "bullet sphere and mesh",
           "deepest touched place of the raw mesh (tree of bounding volumes, sphere against triangle)",
           "smooth normal, force, display, tracking; anything where the finger is off the mesh"}};

MakePeer load(const Module& module) {
  void* const library = module.file != nullptr ? ::dlopen(module.file, RTLD_NOW | RTLD_LOCAL) : nullptr;
  return library != nullptr ? reinterpret_cast<MakePeer>(::dlsym(library, "tangent_peer")) : nullptr;
}

/// With the triangles that it reads.
class ModuleQuery final : public PeerQuery {
 public:
  ModuleQuery(MakePeer make, std::shared_ptr<const Corners> corners, double radius_m)
      : corners_(std::move(corners)), query_(make({*corners_, radius_m})) {}
  bool made() const { return query_ != nullptr; }
  PeerAnswer ask(const Vec3& centre) override { return query_->ask(centre); }

 private:
  std::shared_ptr<const Corners> corners_;
  std::unique_ptr<PeerQuery> query_;
};

}  // namespace

std::vector<Peer> make_peers(const ContactScene& scene, double radius_m) {
  std::vector<Peer> out;
  const bool late = scene.nearest().part_count() > 0;
  out.push_back({"embree closest point",
                 late ? "nearest point of the raw mesh; so large a mesh by this program's boxes, not Embree's"
                      : "nearest point of the raw mesh",
                 kNoSmooth, 0.0, std::make_shared<EmbreeQuery>(scene)});
  out.push_back({kEmbreeBounded, "the same, bounded by the distance to the last nearest triangle", kNoSmooth, 0.0,
                 std::make_shared<BoundedQuery>(scene)});
  if (scene.mesh().triangle_count() > kMostPeerTriangles) return out;
  std::shared_ptr<const Corners> corners;
  for (const Module& module : kModules) {
    const MakePeer make = load(module);
    if (make == nullptr) continue;
    if (!corners) corners = std::make_shared<const Corners>(corners_of(scene.mesh()));
    const std::int64_t start = TickClock::now();
    auto query = std::make_shared<ModuleQuery>(make, corners, radius_m);
    const double build_s = 1e-9 * static_cast<double>(TickClock::now() - start);
    if (query->made()) out.push_back({module.query, module.computes, module.lacks, build_s, std::move(query)});
  }
  return out;
}

std::vector<MissingPeer> missing_peers() {
  std::vector<MissingPeer> out;
  for (const Module& module : kModules)
    if (load(module) == nullptr) out.push_back(module.peer);
  return out;
}

PeerReport peer_report(const Peer& peer, const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                       const TickClock& clock, const Stop& stop) {
  PeerReport report;
  report.name = peer.name;
  report.build_s = peer.build_s;
  std::vector<double> ns(poses.size(), 1e300);
  std::vector<PeerAnswer> answers(poses.size());  // stored, so that the compiler can't remove a query
  for (int pass = 0; pass < repeats; ++pass) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i % 256 == 0 && stop()) return report;
      const Vec3 centre = poses[i].finger.position - scene.mesh().origin();
      const std::int64_t from = clock.mark();
      answers[i] = peer.query->ask(centre);
      const std::int64_t to = clock.mark();
      ns[i] = std::min(ns[i], clock.elapsed_ns(from, to));
    }
  }
  report.ns = distribution(std::move(ns));
  for (std::size_t i = 0; i < poses.size() && !stop(); ++i) {
    if (!answers[i].found) continue;
    const double nearest =
        scene.nearest().nearest(poses[i].finger.position - scene.mesh().origin(), kEverywhere).distance_m;
    report.largest_disagreement_m = std::max(report.largest_disagreement_m, std::abs(nearest - answers[i].distance_m));
  }
  return report;
}

}  // namespace tangent::bench
