// The closed list of what can have caused a tick to be more than a plain one.
#pragma once

#include <array>
#include <cstdint>

namespace tangent {

enum class TickCause : std::uint8_t {
  nothing,             ///< a plain tick: nothing is wrong
  first_contact,       ///< nothing was tracked before
  bad_pose,            ///< the pose is not a number
  unready,             ///< parts of a large mesh that a search had to look at were not built yet
  gain_too_large,      ///< of Eq. 1, for the curvature in the direction of travel
  gain_too_small,      ///< likewise
  unstable_ground,     ///< the finger is larger than the hollow
  other_facet,         ///< crossed onto a facet with another normal
  crease,              ///< corner normals differ across an edge
  boundary,            ///< the mesh ends
  sliver,              ///< a triangle much longer than high
  wild_normal,         ///< a corner normal far from its face's
  deeper_rival,        ///< another place was deeper and took over
  rivals_nearby,       ///< other places that might be deeper had to be looked at; none took over
  limit_or_tolerance,  ///< sound convergence that ran out of planes
  finger_leapt,        ///< the finger was put elsewhere
  not_told,            ///< none of the above could be shown
};
inline constexpr std::array kTickCauses{
    TickCause::nothing,         TickCause::first_contact,  TickCause::bad_pose,
    TickCause::unready,         TickCause::gain_too_large, TickCause::gain_too_small,
    TickCause::unstable_ground, TickCause::other_facet,    TickCause::crease,
    TickCause::boundary,        TickCause::sliver,         TickCause::wild_normal,
    TickCause::deeper_rival,    TickCause::rivals_nearby,  TickCause::limit_or_tolerance,
    TickCause::finger_leapt,    TickCause::not_told};
const char* to_string(TickCause cause);    ///< "gain-too-large"
const char* sentence_of(TickCause cause);  ///< "The gain is too large for ..."

}  // namespace tangent
