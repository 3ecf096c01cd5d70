// Other libraries on the same mesh and poses. They answer an easier question than a tick: where is the raw mesh
// nearest.
#pragma once

#include "core/lab/measure/distribution.h"
#include "core/tick/step.h"
#include "workbench/bench/peer_query.h"
#include "workbench/bench/tick_clock.h"
#include "workbench/bench/turns.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tangent::bench {

struct Peer {
  std::string name;
  std::string computes, lacks;  ///< one line each; lacks: of what a tick gives
  double build_s = 0.0;         ///< of its search tree; 0 for Embree, whose tree the scene has anyway
  std::shared_ptr<PeerQuery> query;
};

inline constexpr const char* kEmbreeBounded = "embree bounded";

/// Larger meshes are left to Embree, for the memory and the time the others' trees take.
inline constexpr std::uint32_t kMostPeerTriangles = 2'000'000;

/// Embree; Embree bounded by the distance to the triangle that was the nearest at the last pose, as a nearest point is
/// tracked from tick to tick; and CGAL and Bullet in a program that was built with them. Bullet: for fingers with a
/// radius. `scene` must outlive them; it has a mesh.
std::vector<Peer> make_peers(const ContactScene& scene, double radius_m);

/// Peers that this program was built without: their names, and the package that brings them.
struct MissingPeer {
  const char* name;
  const char* package;
};
std::vector<MissingPeer> missing_peers();

struct PeerReport {
  std::string name;
  double build_s = 0.0;
  Distribution ns;                      ///< of one query
  double largest_disagreement_m = 0.0;  ///< between its distances and Embree's, where it has an answer
};

/// The minimum of `repeats` passes for every pose.
PeerReport peer_report(const Peer& peer, const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                       const TickClock& clock, const Stop& stop);

}  // namespace tangent::bench
