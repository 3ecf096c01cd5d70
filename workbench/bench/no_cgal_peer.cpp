// For a build without CGAL: the library with the same function takes this one's place.
#include "workbench/bench/peers.h"

namespace tangent::bench {

std::optional<PeerReport> cgal_peer(const ContactScene&, std::span<const TickInput>, int, const TickClock&,
                                    const Stop&) {
  return std::nullopt;
}

}  // namespace tangent::bench
