#version 330 core
#include "lighting.glsl"
uniform vec4 albedo;      // alpha: opacity where the body faces the eye
uniform float rim_opacity;  // and where it turns away
in vec3 normal_eye;
in vec3 from_eye;
out vec4 colour;

void main() {
  vec3 n = normalize(normal_eye);
  vec3 to_eye = -normalize(from_eye);
  float facing = max(dot(n, to_eye), 0.0);
  // A translucent body scatters light inside: its shadows fill up.
  float glow = 0.45 * (1.0 - albedo.a);
  vec3 shade = mix(lit(albedo.rgb, n), albedo.rgb, glow) + 0.22 * highlight(n, to_eye, 90.0);
  float rim = 1.0 - facing;
  float alpha = mix(albedo.a, rim_opacity, rim * rim * rim) + 0.5 * (1.0 - albedo.a) * highlight(n, to_eye, 90.0);
  // The silhouette ends within a pixel: this layer is not multisampled.
  alpha *= smoothstep(0.0, 1.5 * fwidth(facing) + 1e-6, facing);
  colour = vec4(shade, alpha);
}
