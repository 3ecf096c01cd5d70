// Proof that the crease and boundary edges and vertices of a triangle hold no contact, and for how far around the
// centre.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/patch_cache.h"

#include <array>
#include <optional>
#include <utility>

namespace tangent {

/// Edges and vertices that one search has already excluded from another of their triangles. Forgets some; those that
/// were dear, vertices where many triangles meet, only for others of them. Of these it also knows which were found
/// possible so often that more starts from the same vertex are in vain.
class FeatureMemory {
 public:
  bool knows(std::uint64_t key) const {
    return seen_[slot(key)] == key || (dear_[dear_slot(key)].key == key && dear_[dear_slot(key)].tries >= kMostTries);
  }
  void add(std::uint64_t key) { seen_[slot(key)] = key; }
  void add_dear(std::uint64_t key, bool excluded) {
    Dear& dear = dear_[dear_slot(key)];
    if (dear.key != key) dear = {key, 0};
    dear.tries = excluded ? kMostTries : dear.tries + 1;
  }
  FeatureMemory() { seen_.fill(~std::uint64_t{0}); }
  /// What was looked at since it was last asked, in tests of a patch (search_work.h).
  void count(int tests) { tests_ += tests; }
  int take_tests() { return std::exchange(tests_, 0); }

 private:
  static constexpr std::size_t kSlots = 64, kDearSlots = 8;
  static constexpr int kMostTries = 8;
  struct Dear {
    std::uint64_t key = ~std::uint64_t{0};
    int tries = 0;
  };
  static std::size_t dear_slot(std::uint64_t key) { return (key >> 2) % kDearSlots; }
  std::array<Dear, kDearSlots> dear_;
  static std::size_t slot(std::uint64_t key) { return (key ^ key >> 7) % kSlots; }
  std::array<std::uint64_t, kSlots> seen_;
  int tests_ = 0;
};

/// Names of an edge, the same from both its triangles, and of a vertex.
std::uint64_t edge_key(const ContactMesh& mesh, std::uint32_t t, std::uint32_t k);
std::uint64_t vertex_key(const ContactMesh& mesh, std::uint32_t t, std::uint32_t k);

/// Which boundary edge of a triangle has that name, if one has.
std::optional<std::uint32_t> boundary_with_key(const ContactMesh& mesh, std::uint32_t t, std::uint64_t key);

/// The creases and boundaries of a triangle and their ends, or one of them.
struct TriangleFeatures {
  std::uint32_t triangle;
  std::uint32_t side = kAll;
  static constexpr std::uint32_t kAll = 3;
  bool has_side(std::uint32_t k) const { return side == kAll || side == k; }
  bool has_corner(std::uint32_t k) const { return side == kAll || side == k || (side + 1) % 3 == k; }
};

/// How far the centre may go until a contact on the crease or boundary edges of a triangle or on their ends can come
/// up that is nearer than `bound`; the largest double where there are none, 0 where one may be there now. An edge is
/// out where the centre is beyond its ends, seen along it from every place of it, or over one of its faces and not over
/// the fan between them, or too far off. A margin under `enough_m` is worth some effort to widen, or, where it is asked
/// for `enough_or_none`, nothing. What `memory` knows is left out, what is excluded added to it, and what was looked at
/// counted there. Round fingers.
double exclude_feature_contacts(PatchCache& cache, const TriangleFeatures& features, NormalForm form,
                                const Vec3& centre, const RankBound& bound, double enough_m = 0.0,
                                FeatureMemory* memory = nullptr, bool enough_or_none = false);

}  // namespace tangent
