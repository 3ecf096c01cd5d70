#include "core/mesh/edge_table.h"

namespace tangent {

EdgeTable::EdgeTable(std::span<const Index3> triangles, std::uint32_t vertex_count, const RunBoth& run_both)
    : begin_(vertex_count + 1, 0) {
  // Counting sort by the lower vertex, of both halves of the triangles at once: a vertex's uses of the second half
  // follow those of the first. `begin_` and `later` first count, then point at the next free places of either half; in
  // the end `later` is where a vertex's uses end and those of the next begin.
  std::vector<std::uint32_t> later(vertex_count, 0);
  const auto each_edge = [&](const auto& visit) {
    run_halves(run_both, triangles.size(), [&](std::size_t first, std::size_t last) {
      std::vector<std::uint32_t>& of_half = first == 0 ? begin_ : later;
      for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
        const Index3& v = triangles[t];
        if (v[0] == kNone) continue;
        for (std::uint32_t k = 0; k < 3; ++k) visit(t, k, of_half[std::min(v[k], v[next3(k)])]);
      }
    });
  };
  each_edge([](std::uint32_t, std::uint32_t, std::uint32_t& count) { ++count; });
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < vertex_count; ++i) {
    const std::uint32_t first = begin_[i], second = later[i];
    begin_[i] = sum;
    later[i] = sum + first;
    sum += first + second;
  }
  uses_ = Unfilled<EdgeUse>(sum);
  each_edge([&](std::uint32_t t, std::uint32_t k, std::uint32_t& place) {
    const std::uint32_t from = triangles[t][k], to = triangles[t][next3(k)];
    uses_[place++] = EdgeUse(std::max(from, to), from > to, t << 2 | k);
  });
  std::copy(later.begin(), later.end(), begin_.begin() + 1);
  begin_[0] = 0;
  run_halves(run_both, vertex_count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) std::sort(uses_.data() + begin_[i], uses_.data() + begin_[i + 1]);
  });
}

}  // namespace tangent
