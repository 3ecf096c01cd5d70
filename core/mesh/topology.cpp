#include "core/mesh/topology.h"

#include "core/mesh/edge_table.h"

#include <algorithm>
#include <array>
#include <unordered_set>

namespace tangent {
namespace {

/// A triangle's wish for one direction of a contested edge.
struct Claim {
  std::uint32_t packed;     ///< triangle << 2 | edge
  std::uint32_t direction;  ///< 2 * contested edge + backward
};

/// The same three vertices in the same turn: rotated so that the lowest comes first.
Index3 rotated(const Index3& v) {
  if (v[0] < v[1] && v[0] < v[2]) return v;
  return v[1] < v[2] ? Index3{v[1], v[2], v[0]} : Index3{v[2], v[0], v[1]};
}

struct TurnHash {
  std::size_t operator()(const Index3& v) const {
    return ((v[0] * 0x9E3779B97F4A7C15u ^ v[1]) * 0xBF58476D1CE4E5B9u ^ v[2]) * 0x94D049BB133111EBu >> 16;
  }
};

void link(std::span<Index3> links, std::uint32_t a, std::uint32_t b) {
  links[a >> 2][a & 3u] = b;
  links[b >> 2][b & 3u] = a;
}

void unlink(std::span<Index3> links, std::uint32_t triangle) {
  for (std::uint32_t& across : links[triangle]) {
    if (across == kNone) continue;
    links[across >> 2][across & 3u] = kNone;
    across = kNone;
  }
}

/// Links the edges with one forward and one backward use, and no others; returns the claims on edges of more uses, by
/// triangle.
std::vector<Claim> link_uncontested(const EdgeTable& edges, Topology& out, std::uint32_t& contested,
                                    const RunBoth& run_both) {
  std::array<std::vector<Claim>, 2> found;
  std::array<std::uint32_t, 2> edges_of{};
  run_halves(run_both, edges.vertex_count(), [&](std::size_t first, std::size_t last) {
    const std::size_t half = first == 0 ? 0 : 1;
    edges.for_each_edge(first, last, [&](std::uint32_t, std::span<const EdgeUse> uses) {
      if (uses.size() == 2 && !uses[0].backward() && uses[1].backward())
        return link(out.links, uses[0].packed(), uses[1].packed());
      for (const EdgeUse& use : uses) out.links[use.triangle()][use.edge()] = kNone;
      if (uses.size() == 1) return;
      for (const EdgeUse& use : uses) found[half].push_back({use.packed(), 2 * edges_of[half] + use.backward()});
      ++edges_of[half];
    });
  });
  contested = edges_of[0] + edges_of[1];
  for (Claim& claim : found[1]) claim.direction += 2 * edges_of[0];
  std::vector<Claim> claims = std::move(found[0]);
  claims.insert(claims.end(), found[1].begin(), found[1].end());
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.packed < b.packed; });
  return claims;
}

/// Gives every direction of the contested edges to the first triangle that may have it, in order of triangles.
void settle(std::span<Index3> triangles, std::span<const Claim> claims, std::uint32_t contested, Topology& out) {
  std::vector<std::uint32_t> holder(2 * std::size_t{contested}, kNone);
  std::unordered_set<Index3, TurnHash> detached_turns;
  while (!claims.empty()) {
    const std::uint32_t t = claims[0].packed >> 2;
    std::size_t n = 1;
    while (n < claims.size() && claims[n].packed >> 2 == t) ++n;
    const auto taken =
        std::find_if(claims.begin(), claims.begin() + n, [&](const Claim& c) { return holder[c.direction] != kNone; });
    if (taken == claims.begin() + n) {
      for (const Claim& c : claims.first(n)) holder[c.direction] = c.packed;
    } else {
      // A duplicate of a triangle on the surface shares all directions with it, so one of them tells.
      const Index3 turn = rotated(triangles[t]);
      unlink(out.links, t);
      if (turn == rotated(triangles[holder[taken->direction] >> 2]) || !detached_turns.insert(turn).second) {
        out.duplicates.push_back(t);
      } else {
        out.detached.push_back(t);
      }
    }
    claims = claims.subspan(n);
  }
  for (const std::uint32_t t : out.duplicates) triangles[t] = {kNone, kNone, kNone};
  for (std::size_t i = 0; i < holder.size(); i += 2)
    if (holder[i] != kNone && holder[i + 1] != kNone) link(out.links, holder[i], holder[i + 1]);
}

template <class Take>
void around_fan(std::span<const Index3> links, Corner start, const Take& take) {
  take(start);
  Corner c = turn_left(links, start);
  for (; !c.none() && c != start; c = turn_left(links, c)) take(c);
  if (!c.none()) return;  // came round
  for (c = turn_right(links, start); !c.none(); c = turn_right(links, c)) take(c);
}

/// A corner of every fan but the first of its vertex, in the order of corners.
std::vector<Corner> further_fans(std::span<const Index3> triangles, std::span<const Index3> links,
                                 std::uint32_t vertex_count, const RunBoth& run_both) {
  std::array<std::vector<Corner>, 2> found;
  // Even vertices here, odd ones there: those of low numbers often lie further apart in the file.
  const auto look = [&](std::uint32_t odd) {
    std::vector<bool> met(vertex_count / 2 + 1, false);
    CornerSet seen(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (triangles[t][0] == kNone) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = triangles[t][k];
        if ((vertex & 1u) != odd || seen.has({t, k})) continue;
        if (met[vertex >> 1]) found[odd].push_back({t, k});
        met[vertex >> 1] = true;
        around_fan(links, {t, k}, [&](Corner c) { seen.insert(c); });
      }
    }
  };
  run_both([&] { look(0); }, [&] { look(1); });
  std::vector<Corner> fans(found[0].size() + found[1].size());
  std::ranges::merge(found[0], found[1], fans.begin(), [](Corner a, Corner b) {
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.corner < b.corner;
  });
  return fans;
}

/// One vertex per fan: the first fan met keeps the number, the others get new ones.
void split_fans(std::span<Index3> triangles, std::uint32_t vertex_count, Topology& out, const RunBoth& run_both) {
  for (const Corner& fan : further_fans(triangles, out.links, vertex_count, run_both)) {
    const std::uint32_t vertex = vertex_count + static_cast<std::uint32_t>(out.copy_of.size());
    out.copy_of.push_back(triangles[fan.triangle][fan.corner]);
    around_fan(out.links, fan, [&](Corner c) { triangles[c.triangle][c.corner] = vertex; });
  }
}

}  // namespace

Topology build_topology(std::span<Index3> triangles, std::uint32_t vertex_count, const RunBoth& run_both) {
  Topology out;
  out.links.resize(triangles.size());
  std::uint32_t contested = 0;
  std::vector<Claim> claims;
  {
    const EdgeTable edges(triangles, vertex_count, run_both);
    claims = link_uncontested(edges, out, contested, run_both);
    if (edges.use_count() < 3 * triangles.size())
      for (std::size_t t = 0; t < triangles.size(); ++t)
        if (triangles[t][0] == kNone) out.links[t] = {kNone, kNone, kNone};
  }
  settle(triangles, claims, contested, out);
  split_fans(triangles, vertex_count, out, run_both);
  return out;
}

}  // namespace tangent
