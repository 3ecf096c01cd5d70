#version 330 core
uniform vec3 top;
uniform vec3 bottom;
in float height;
out vec4 colour;

void main() {
  // Half a step of ordered noise keeps 8 bits from banding.
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  float t = smoothstep(0.0, 1.0, height);
  colour = vec4(mix(bottom, top, t) + noise / 255.0, 1.0);
}
