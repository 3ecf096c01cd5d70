// Which contacts a preset asks for, and which of them force and display are rendered from: the rendering condition.
#pragma once

#include "core/preset/preset.h"
#include "core/shading/render.h"

namespace tangent {

/// Planes of one tick: of those contacts that the method, the force source and the tactile source ask for. Not
/// initialised: most ticks need one.
struct TickPlanes {
  RenderPlane smooth, facet, shaded;
  RenderPlane touched;                   ///< of all places that the finger touches, where the preset asks for them
  RenderPlane proxy_force, proxy_place;  ///< of the two-pass method: spring, and the surface under the proxy

  static TickPlanes all(const RenderPlane& plane) { return {plane, plane, plane, plane, plane, plane}; }
};

/// Whether force or display are rendered from the contact of the preset's method.
inline bool renders_method(const Preset& preset) {
  const ForceSource force = preset.force.source;
  const TactileSource display = preset.display.source;
  if (force == ForceSource::method || display == TactileSource::method) return true;
  if (is_smooth(preset.solver.method)) return force == ForceSource::smooth || display == TactileSource::smooth;
  if (preset.solver.method == Method::facet) return force == ForceSource::facet || display == TactileSource::facet;
  return preset.solver.method == Method::force_shading && force == ForceSource::force_shading;
}

/// Whose contact a tick reports: the method's, and where nothing is rendered from that, so that it isn't solved, that
/// of the force (C1 and C3: the facets').
inline Method reported_method(const Preset& preset) {
  if (renders_method(preset)) return preset.solver.method;
  switch (preset.force.source) {
    case ForceSource::facet:
      return Method::facet;
    case ForceSource::force_shading:
      return Method::force_shading;
    default:
      return Method::robust;
  }
}

/// Facet or force shading; the two-pass method finds its own.
inline bool wants_facet(const Preset& preset) {
  const Method reported = reported_method(preset);
  return reported == Method::facet || reported == Method::force_shading || preset.force.source == ForceSource::facet ||
         preset.force.source == ForceSource::force_shading || preset.display.source == TactileSource::facet;
}

inline bool wants_smooth(const Preset& preset) {
  return is_smooth(reported_method(preset)) || preset.force.source == ForceSource::smooth ||
         preset.display.source == TactileSource::smooth;
}

/// Whether the force comes from every place of the smooth surface that the finger touches.
inline bool wants_touched(const Preset& preset) {
  return preset.force.contacts == ForceContacts::all &&
         (preset.force.source == ForceSource::smooth ||
          (preset.force.source == ForceSource::method && is_smooth(preset.solver.method)));
}

/// The smooth method's own contact and no other, as most ticks do.
inline bool only_smooth(const Preset& preset) {
  return is_smooth(preset.solver.method) && is_smooth(reported_method(preset)) && !wants_facet(preset);
}

inline const RenderPlane& force_plane(const Preset& preset, const TickPlanes& planes) {
  if (wants_touched(preset)) return planes.touched;
  switch (preset.force.source) {
    case ForceSource::facet:
      return planes.facet;
    case ForceSource::force_shading:
      return planes.shaded;
    case ForceSource::smooth:
      return planes.smooth;
    case ForceSource::method:
      break;
  }
  switch (preset.solver.method) {
    case Method::facet:
      return planes.facet;
    case Method::force_shading:
      return planes.shaded;
    case Method::two_pass:
      return planes.proxy_force;
    default:
      return planes.smooth;
  }
}

/// Null: the display is held at its centre.
inline const RenderPlane* tactile_plane(const Preset& preset, const TickPlanes& planes) {
  switch (preset.display.source) {
    case TactileSource::held:
      return nullptr;
    case TactileSource::facet:
      return &planes.facet;
    case TactileSource::smooth:
      return &planes.smooth;
    case TactileSource::method:
      break;
  }
  if (preset.solver.method == Method::two_pass) return &planes.proxy_place;
  return is_smooth(preset.solver.method) ? &planes.smooth : &planes.facet;
}

}  // namespace tangent
