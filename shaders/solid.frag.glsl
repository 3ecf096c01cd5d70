#version 330 core
#include "lighting.glsl"
uniform vec4 albedo;      // alpha: opacity where the surface faces the eye
uniform float rim_opacity;  // opacity at the silhouette
in vec3 normal_eye;
in vec3 from_eye;
out vec4 colour;

void main() {
  vec3 n = normalize(normal_eye);
  vec3 to_eye = -normalize(from_eye);
  float facing = max(dot(n, to_eye), 0.0);
  // Imitates scattering in a translucent body: lighter shadows.
  float glow = 0.45 * (1.0 - albedo.a);
  vec3 shade = mix(lit(albedo.rgb, n), albedo.rgb, glow) + 0.22 * highlight(n, to_eye, 90.0);
  float rim = 1.0 - facing;
  float alpha = mix(albedo.a, rim_opacity, rim * rim * rim) + 0.5 * (1.0 - albedo.a) * highlight(n, to_eye, 90.0);
  // Antialiases the silhouette: this layer is not multisampled.
  alpha *= smoothstep(0.0, 1.5 * fwidth(facing) + 1e-6, facing);
  colour = vec4(shade, alpha);
}
