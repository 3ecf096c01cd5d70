#include "core/contact/surface_place.h"

namespace tangent {

const char* to_string(Feature feature) {
  switch (feature) {
    case Feature::face:
      return "face";
    case Feature::edge:
      return "edge";
    case Feature::vertex:
      return "vertex";
    case Feature::none:
      break;
  }
  return "none";
}

}  // namespace tangent
