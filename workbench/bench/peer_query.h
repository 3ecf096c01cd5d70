// Another library's query as the benchmark asks it: the nearest point of the raw mesh. Between the program and the
// modules that hold the libraries (peer/), which are loaded only when they are measured.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <span>

namespace tangent::bench {

/// Local mesh coordinates, m.
struct PeerAnswer {
  bool found = false;
  Vec3 point{0.0};          ///< of the raw mesh
  double distance_m = 0.0;  ///< from the finger's centre
};

class PeerQuery {
 public:
  virtual ~PeerQuery() = default;
  virtual PeerAnswer ask(const Vec3& centre) = 0;
};

struct PeerInput {
  std::span<const std::array<Vec3, 3>> triangles;  ///< kept by the caller for as long as the query is
  double radius_m = 0.0;                           ///< of the finger
};

/// What each module exports, as "tangent_peer"; the caller deletes it. Null: not for this finger.
using MakePeer = PeerQuery* (*)(const PeerInput& input);

}  // namespace tangent::bench
