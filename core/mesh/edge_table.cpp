#include "core/mesh/edge_table.h"

namespace tangent {

EdgeTable::EdgeTable(std::span<const Index3> triangles, std::uint32_t vertex_count, const RunBoth& run_both)
    : begin_(vertex_count + 1, 0) {
  // Counting sort by the lower vertex; begin_ first counts, then points at the next free place, which in the end is
  // the beginning of the next vertex: shifting by one place gives the beginnings.
  std::size_t total = 0;
  for (const Index3& v : triangles) {
    if (v[0] == kNone) continue;
    for (std::uint32_t k = 0; k < 3; ++k) ++begin_[std::min(v[k], v[next3(k)])];
    total += 3;
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin_) {
    const std::uint32_t count = b;
    b = sum;
    sum += count;
  }
  uses_.resize(total);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Index3& v = triangles[t];
    if (v[0] == kNone) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = v[k], to = v[next3(k)];
      uses_[begin_[std::min(from, to)]++] = EdgeUse(std::max(from, to), from > to, t << 2 | k);
    }
  }
  for (std::size_t i = vertex_count; i > 0; --i) begin_[i] = begin_[i - 1];
  begin_[0] = 0;
  run_halves(run_both, vertex_count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) std::sort(uses_.data() + begin_[i], uses_.data() + begin_[i + 1]);
  });
}

}  // namespace tangent
