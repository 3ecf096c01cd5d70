#version 330 core
#include "lighting.glsl"
#include "wire.glsl"
#include "paint.glsl"
uniform vec3 albedo;
uniform vec3 inside_albedo;
uniform float opacity;
uniform vec4 wire;       // patch borders; strength 0: none
uniform float width_px;
in vec3 normal_eye;
in vec3 from_eye;
in vec2 weights;
out vec4 colour;

void main() {
  int patch_index = patch_of(gl_PrimitiveID);
  if (left_out(patch_index)) discard;
  vec3 n = normalize(normal_eye);
  vec3 to_eye = -normalize(from_eye);
  float facing = dot(n, to_eye);
  vec3 shade = lit(facing < 0.0 ? inside_albedo : albedo, facing < 0.0 ? -n : n);
  if (map_level > 0) shade = lit_map(map_colour(patch_index, weights), lit(vec3(1.0), facing < 0.0 ? -n : n));
  else shade += 0.16 * highlight(facing < 0.0 ? -n : n, to_eye, 60.0);
  if (wire.a > 0.0) shade = mix(shade, wire.rgb, wire.a * edge_coverage(weights, width_px));
  // Glassy rim: more opaque towards the silhouette, where the line of sight through the surface is longer.
  float rim = 1.0 - min(abs(facing), 1.0);
  colour = vec4(shade, opacity + (1.0 - opacity) * 0.35 * rim * rim);
}
