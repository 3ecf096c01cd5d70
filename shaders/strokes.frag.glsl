#version 330 core
uniform float opacity;
flat in vec4 colour_in;
flat in vec2 half_width_length;
noperspective in vec2 place;
out vec4 colour;

void main() {
  float beyond = max(max(-place.y, place.y - half_width_length.y), 0.0);
  float distance_px = length(vec2(place.x, beyond));
  float cover = clamp(half_width_length.x + 0.5 - distance_px, 0.0, 1.0);
  if (cover <= 0.0) discard;
  colour = vec4(colour_in.rgb, colour_in.a * cover * opacity);
}
