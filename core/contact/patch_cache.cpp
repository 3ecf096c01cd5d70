#include "core/contact/patch_cache.h"

namespace tangent {

void PatchCache::fill(CachedPatch& slot, std::uint32_t t, NormalForm form) {
  slot.patch = make_patch(*mesh_, t, form);
  slot.triangle = t;
  slot.form = form;
}

}  // namespace tangent
