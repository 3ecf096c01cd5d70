#include "core/contact/prove/late_hierarchy.h"

namespace tangent {

LateHierarchy::LateHierarchy(const ContactMesh& mesh, const TriangleClusters* clusters)
    : mesh_(&mesh), clusters_(clusters) {
  if (clusters_) {
    parts_ = std::make_unique<BuiltOnce<ContactHierarchy>[]>(clusters_->count());
    const BoxTree& tree = clusters_->tree();
    outlines_ = std::make_unique<OutlineSlot[]>(tree.node_count());
    leaf_of_.resize(clusters_->count());
    for (std::uint32_t node = 0; node < tree.node_count(); ++node)
      if (tree.is_leaf(node)) leaf_of_[tree.box_of(node)] = node;
  } else {
    whole_.emplace(ContactHierarchy::build(mesh));
  }
}

void LateHierarchy::build_part(std::size_t number) const {
  if (clusters_) part(number);
}

std::size_t LateHierarchy::built_count() const {
  if (!clusters_) return 1;
  std::size_t built = 0;
  for (std::size_t i = 0; i < part_count(); ++i) built += parts_[i].if_built() != nullptr;
  return built;
}

std::size_t LateHierarchy::memory_bytes() const {
  if (!clusters_) return whole_->memory_bytes();
  std::size_t bytes =
      part_count() * (sizeof(parts_[0]) + sizeof(leaf_of_[0])) + clusters_->tree().node_count() * sizeof(outlines_[0]);
  for (std::size_t i = 0; i < part_count(); ++i)
    if (const ContactHierarchy* built = parts_[i].if_built()) bytes += sizeof(*built) + built->memory_bytes();
  return bytes;
}

}  // namespace tangent
