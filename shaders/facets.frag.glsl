#version 330 core
#include "wire.glsl"
uniform vec4 wire;        // colour and strength; strength 0: none
uniform float fill;       // 1: facets, 0: edges alone
uniform float width_px;
flat in vec3 facet_colour;
in vec2 weights;
out vec4 colour;

void main() {
  float edge = wire.a > 0.0 ? wire.a * edge_coverage(weights, width_px) : 0.0;
  if (fill > 0.5) {
    colour = vec4(mix(facet_colour, wire.rgb, edge), 1.0);
  } else {
    if (edge < 0.02) discard;
    colour = vec4(wire.rgb, edge);
  }
}
