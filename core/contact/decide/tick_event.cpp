#include "core/contact/decide/tick_event.h"

namespace tangent {

const char* to_string(TickEvent event) {
  switch (event) {
    case TickEvent::none:
      break;
    case TickEvent::first:
      return "first";
    case TickEvent::reseed:
      return "reseed";
    case TickEvent::switched:
      return "switch";
    case TickEvent::branch:
      return "branch";
  }
  return "none";
}

}  // namespace tangent
