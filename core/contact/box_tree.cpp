#include "core/contact/box_tree.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace tangent {

FloatBox FloatBox::about(const Box& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  FloatBox out;
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = box.min[static_cast<int>(k)], high = box.max[static_cast<int>(k)];
    out.min[k] = static_cast<float>(low);
    if (out.min[k] > low) out.min[k] = std::nextafter(out.min[k], -kInfinity);
    out.max[k] = static_cast<float>(high);
    if (out.max[k] < high) out.max[k] = std::nextafter(out.max[k], kInfinity);
  }
  return out;
}

void FloatBox::include(const FloatBox& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    min[k] = std::min(min[k], other.min[k]);
    max[k] = std::max(max[k], other.max[k]);
  }
}

class BoxTreeBuilder {
 public:
  BoxTreeBuilder(std::span<const FloatBox> boxes, std::size_t leaf_size, BoxTree& tree)
      : boxes_(boxes), leaf_size_(leaf_size), tree_(tree) {}

  void build() {
    tree_.order_.resize(boxes_.size());
    std::iota(tree_.order_.begin(), tree_.order_.end(), 0u);
    build_node(0, boxes_.size());
    tree_.nodes_.shrink_to_fit();
  }

 private:
  /// Halves the boxes across the longest side of theirs, until they fit into a leaf.
  void build_node(std::size_t first, std::size_t last) {
    const std::span<std::uint32_t> part = std::span(tree_.order_).subspan(first, last - first);
    FloatBox box = boxes_[part[0]];
    for (const std::uint32_t i : part) box.include(boxes_[i]);
    const std::size_t index = tree_.nodes_.size();
    tree_.nodes_.push_back({box, leaf(first, last)});
    if (part.size() <= leaf_size_) return;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (box.max[k] - box.min[k] > box.max[axis] - box.min[axis]) axis = k;
    const auto middle = [&](std::uint32_t i) { return boxes_[i].min[axis] + boxes_[i].max[axis]; };
    const std::size_t half = part.size() / 2;
    std::nth_element(
        part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
        [&](std::uint32_t a, std::uint32_t b) { return middle(a) != middle(b) ? middle(a) < middle(b) : a < b; });
    build_node(first, first + half);
    tree_.nodes_[index].link = static_cast<std::uint32_t>(tree_.nodes_.size());
    build_node(first + half, last);
  }

  static std::uint32_t leaf(std::size_t first, std::size_t last) {
    const std::size_t count = std::min(last - first, BoxTree::kLargestLeaf);
    return BoxTree::kLeaf | static_cast<std::uint32_t>((count - 1) << BoxTree::kFirstBits | first);
  }

  std::span<const FloatBox> boxes_;
  std::size_t leaf_size_;
  BoxTree& tree_;
};

BoxTree BoxTree::build(std::span<const FloatBox> boxes, std::size_t leaf_size) {
  BoxTree tree;
  BoxTreeBuilder(boxes, leaf_size, tree).build();
  return tree;
}

}  // namespace tangent
