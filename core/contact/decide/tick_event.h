// What became of the contact in a tick.
#pragma once

#include <array>
#include <cstdint>

namespace tangent {

enum class TickEvent : std::uint8_t {
  none,      ///< it went on from where it was
  first,     ///< there was none before
  reseed,    ///< following it failed, so it was looked for anew
  switched,  ///< a deeper nonadjacent place took over
  branch,    ///< the solution folded and the contact moved to another one by itself
};
inline constexpr std::array kTickEvents{TickEvent::none, TickEvent::first, TickEvent::reseed, TickEvent::switched,
                                        TickEvent::branch};
const char* to_string(TickEvent event);  ///< "switch" for switched

}  // namespace tangent
