// For a build without CGAL. The library with CGAL defines the same function and replaces this object file.
#include "workbench/bench/peers.h"

namespace tangent::bench {

std::optional<PeerReport> cgal_peer(const ContactScene&, std::span<const TickInput>, int, const TickClock&,
                                    const Stop&) {
  return std::nullopt;
}

}  // namespace tangent::bench
