#version 330 core
#include "wire.glsl"
#include "paint.glsl"
uniform vec4 wire;        // colour and strength; strength 0: none
uniform float fill;       // 1: facets, 0: edges only
uniform float width_px;
flat in vec3 facet_colour;
flat in vec3 facet_light;
in vec2 weights;
out vec4 colour;

void main() {
  int patch_index = patch_of(gl_PrimitiveID);
  if (left_out(patch_index)) discard;
  float edge = wire.a > 0.0 ? wire.a * edge_coverage(weights, width_px) : 0.0;
  if (fill > 0.5) {
    vec3 ground = map_level > 0 ? lit_map(map_colour(patch_index, weights), facet_light) : facet_colour;
    colour = vec4(mix(ground, wire.rgb, edge), 1.0);
  } else {
    if (edge < 0.02) discard;
    colour = vec4(wire.rgb, edge);
  }
}
