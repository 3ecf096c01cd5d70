#include "core/lab/explain/tick_cause.h"

namespace tangent {
namespace {

struct Words {
  const char *name, *sentence;
};

constexpr std::array<Words, kTickCauses.size()> kWords{{
    {"nothing", "Nothing is wrong"},
    {"first-contact", "Nothing was tracked before, so the contact was looked for on the whole mesh"},
    {"bad-pose", "The finger's pose is not a finite number"},
    {"unready", "Parts of the mesh that had to be searched were not built yet, so the last contact was rendered on"},
    {"gain-too-large", "The gain is too large for the curvature in the direction of travel: steps overshoot"},
    {"gain-too-small", "The gain is too small for the curvature in the direction of travel: steps fall short"},
    {"unstable-ground", "Unstable ground: the finger is larger than the hollow and touches on more than one side"},
    {"other-facet", "The contact crossed onto a facet with another normal"},
    {"crease", "The contact met a crease, where the normals of the two sides differ"},
    {"boundary", "The contact met a boundary, where the mesh ends"},
    {"sliver", "The contact met a sliver, a triangle much longer than high"},
    {"wild-normal", "The contact met a wild normal, far from that of its facet"},
    {"deeper-rival", "The finger is deeper at another place, which took over"},
    {"rivals-nearby", "Other places nearby might have been deeper and had to be looked at; none took over"},
    {"limit-or-tolerance", "The iteration converges well, but limit or tolerance is too tight"},
    {"finger-leapt", "The finger leapt to another place within one tick"},
    {"not-told", "The cause can't be told"},
}};

}  // namespace

const char* to_string(TickCause cause) { return kWords[static_cast<std::size_t>(cause)].name; }
const char* sentence_of(TickCause cause) { return kWords[static_cast<std::size_t>(cause)].sentence; }

}  // namespace tangent
