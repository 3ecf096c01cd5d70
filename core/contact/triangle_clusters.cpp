#include "core/contact/triangle_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

constexpr double kWanted = 1024.0;       // triangles of a cell
constexpr double kCellsOfSurface = 4.7;  // of k^3 cells a ball's surface meets about that many times k^2

/// A grid of cubes over the mesh's bounding box.
class Grid {
 public:
  explicit Grid(const ContactMesh& mesh) : low_(mesh.bounds().min) {
    constexpr double kFewest = 8.0, kMost = 128.0;
    const Vec3 size = mesh.bounds().size();
    const double wanted = std::sqrt(mesh.usable_triangle_count() / (kWanted * kCellsOfSurface));
    const double along = std::clamp(std::floor(wanted), kFewest, kMost);
    per_m_ = along / std::max({size.x, size.y, size.z});
    for (int k = 0; k < 3; ++k)
      cells_[static_cast<std::size_t>(k)] = 1 + static_cast<std::uint32_t>(std::min(size[k] * per_m_, along - 1.0));
  }
  std::uint32_t count() const { return cells_[0] * cells_[1] * cells_[2]; }
  std::uint32_t cell(const Vec3& p) const {
    const Vec3 at = (p - low_) * per_m_;
    const auto along = [&](double x, std::size_t k) {
      return std::min(static_cast<std::uint32_t>(std::max(x, 0.0)), cells_[k] - 1);
    };
    return (along(at.x, 0) * cells_[1] + along(at.y, 1)) * cells_[2] + along(at.z, 2);
  }

 private:
  Vec3 low_;
  double per_m_;
  std::array<std::uint32_t, 3> cells_;
};

Vec3 middle_of(const ContactMesh& mesh, std::uint32_t t) {
  return (mesh.position(t, 0) + mesh.position(t, 1) + mesh.position(t, 2)) / 3.0;
}

/// A control point of an edge is off the edge's third by at most a third of the edge (edge_control_offset,
/// crease_control_offset take a part of it away), the middle one off the corners' mean by one and a half times the mean
/// of these.
constexpr double kControlPointRoom = 0.5 + 1e-6;

FloatBox box_of_patches(const ContactMesh& mesh, std::span<const std::uint32_t> triangles) {
  Box box;
  double longest2 = 0.0;
  for (const std::uint32_t t : triangles) {
    const Vec3 &a = mesh.position(t, 0), &b = mesh.position(t, 1), &c = mesh.position(t, 2);
    for (const Vec3* p : {&a, &b, &c}) box.include(*p);
    for (const Vec3& edge : {b - a, c - b, a - c}) longest2 = std::max(longest2, glm::dot(edge, edge));
  }
  const Vec3 room(kControlPointRoom * std::sqrt(longest2));
  return FloatBox::about({box.min - room, box.max + room});
}

}  // namespace

class TriangleClustersBuilder {
 public:
  TriangleClustersBuilder(const ContactMesh& mesh, const RunBoth& run_both, TriangleClusters& out)
      : mesh_(mesh), run_both_(run_both), out_(out) {}

  void build() {
    sort_into_cells();
    std::vector<FloatBox>& boxes = out_.boxes_;
    boxes.resize(out_.count());
    run_halves(run_both_, boxes.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t c = first; c < last; ++c) boxes[c] = box_of_patches(mesh_, out_.triangles(c));
    });
    out_.tree_ = BoxTree::build(boxes, 1);
  }

 private:
  void sort_into_cells() {
    const Grid grid(mesh_);
    std::vector<std::uint32_t> cell_of(mesh_.triangle_count());
    run_halves(run_both_, cell_of.size(), [&](std::size_t first, std::size_t last) {
      for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
        cell_of[t] = mesh_.usable(t) ? grid.cell(middle_of(mesh_, t)) : kNone;
    });
    const std::vector<std::uint32_t> end = sort_by(cell_of, grid.count());
    std::array<std::vector<std::uint32_t>, 2> clusters;
    run_halves(run_both_, grid.count(), [&](std::size_t first, std::size_t last) {
      for (std::size_t cell = first; cell < last; ++cell) {
        const std::uint32_t begin = cell == 0 ? 0 : end[cell - 1];
        if (end[cell] > begin) add_clusters(begin, end[cell], clusters[first == 0 ? 0 : 1]);
      }
    });
    out_.first_ = std::move(clusters[0]);
    out_.first_.insert(out_.first_.end(), clusters[1].begin(), clusters[1].end());
    out_.first_.push_back(end.back());
  }

  /// Triangles cell by cell into order_, ascending in each; returns where each cell ends. Both halves of the triangles
  /// count and place their own, those of the second behind those of the first.
  std::vector<std::uint32_t> sort_by(const std::vector<std::uint32_t>& cell_of, std::uint32_t cells) {
    std::array<std::vector<std::uint32_t>, 2> places{std::vector<std::uint32_t>(cells),
                                                     std::vector<std::uint32_t>(cells)};
    const auto each = [&](const auto& visit) {
      run_halves(run_both_, cell_of.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t>& of_half = places[first == 0 ? 0 : 1];
        for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
          if (cell_of[t] != kNone) visit(t, of_half[cell_of[t]]);
      });
    };
    each([](std::uint32_t, std::uint32_t& count) { ++count; });
    std::uint32_t sum = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const std::uint32_t first = places[0][cell], second = places[1][cell];
      places[0][cell] = sum;
      places[1][cell] = sum + first;
      sum += first + second;
    }
    out_.order_.resize(sum);
    each([&](std::uint32_t t, std::uint32_t& place) { out_.order_[place++] = t; });
    return std::move(places[1]);
  }

  /// One, or those of both halves across the longest side of the box about the triangles' middles.
  void add_clusters(std::uint32_t first, std::uint32_t last, std::vector<std::uint32_t>& clusters) {
    if (last - first <= TriangleClusters::kLargest) return clusters.push_back(first);
    const std::uint32_t half = first + (last - first) / 2;
    halve(std::span(out_.order_).subspan(first, last - first), half - first);
    add_clusters(first, half, clusters);
    add_clusters(half, last, clusters);
  }

  void halve(std::span<std::uint32_t> triangles, std::size_t half) const {
    struct Place {
      std::array<float, 3> middle;
      std::uint32_t triangle;
    };
    std::vector<Place> places(triangles.size());
    Box box;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3 middle = middle_of(mesh_, triangles[i]);
      box.include(middle);
      places[i] = {{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)},
                   triangles[i]};
    }
    const Vec3 size = box.size();
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(half), places.end(),
                     [axis](const Place& a, const Place& b) {
                       return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis]
                                                               : a.triangle < b.triangle;
                     });
    for (std::size_t i = 0; i < places.size(); ++i) triangles[i] = places[i].triangle;
    // Which of them are on which side is determined, their order is not.
    std::sort(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half));
    std::sort(triangles.begin() + static_cast<std::ptrdiff_t>(half), triangles.end());
  }

  const ContactMesh& mesh_;
  const RunBoth& run_both_;
  TriangleClusters& out_;
};

TriangleClusters TriangleClusters::build(const ContactMesh& mesh, const RunBoth& run_both) {
  TriangleClusters clusters;
  TriangleClustersBuilder(mesh, run_both, clusters).build();
  return clusters;
}

std::size_t TriangleClusters::memory_bytes() const {
  return (order_.capacity() + first_.capacity()) * sizeof(std::uint32_t) + boxes_.capacity() * sizeof(FloatBox) +
         tree_.memory_bytes();
}

}  // namespace tangent
